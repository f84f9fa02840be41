/* What the shaders of voxel_draw share. Switches LSF_VOXEL_SIDES: slices of radiance, 1 or 2; LSF_EMITTERS: points are
 * drawn on emitters. */
#include "lib/luminance.glsl"
#include "lib/voxel_emission.glsl"
#include "shared/voxel_draw_data.h"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

layout(std430, binding = LSF_BINDING_VOXEL_DRAW_BRICKS) buffer lsf_voxel_draw_bricks
{
    float brick_sums[];
};

layout(std430, binding = LSF_BINDING_VOXEL_DRAWS) buffer lsf_voxel_draw_list
{
    float voxel_draw_total, voxel_draw_unused[LSF_VOXEL_DRAWS_HEADER - 1];
    uvec2 voxel_draws[];
};

/* Bricks are in Morton order, so that bricks that follow each other are close to each other. */
uint brick_index(ivec3 brick)
{
    uvec3 bits = uvec3(brick), index = uvec3(0u);
    for (int i = 0; i < LSF_VOXEL_DRAW_BITS; i++)
        index |= (bits & (1u << i)) << (2 * i);
    return index.x | (index.y << 1) | (index.z << 2);
}

ivec3 brick_of(uint index)
{
    uvec3 bits = uvec3(index, index >> 1, index >> 2), brick = uvec3(0u);
    for (int i = 0; i < LSF_VOXEL_DRAW_BITS; i++)
        brick |= (bits >> (2 * i)) & (1u << i);
    return ivec3(brick);
}

/* By which the side of a voxel is drawn: its radiance without what points on emitters find. */
float side_weight(ivec3 cell, int slice)
{
    vec3 radiance = texelFetch(radiance_texture, cell + ivec3(0, 0, slice * int(grid.size.z)), 0).rgb;
    return luminance(max(radiance - voxel_emission_drawn(cell, slice), 0.0));
}
