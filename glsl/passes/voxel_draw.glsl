/* What the shaders of voxel_draw share. Switch LSF_VOXEL_SIDES: slices of radiance, 1 or 2. */
#include "lib/luminance.glsl"
#include "lib/voxel.glsl"
#include "shared/voxel_draw_data.h"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

layout(std430, binding = LSF_BINDING_VOXEL_DRAW_BRICKS) buffer lsf_voxel_draw_bricks
{
    float brick_sums[];
};

layout(std430, binding = LSF_BINDING_VOXEL_DRAWS) buffer lsf_voxel_draw_list
{
    float voxel_draw_total, voxel_draw_unused[LSF_VOXEL_DRAWS_HEADER - 1];
    uint voxel_draws[];
};

/* Number of the grid's bricks along each axis. */
ivec3 brick_counts()
{
    return ivec3(grid.size.xyz) / LSF_VOXEL_BRICK;
}

uint brick_index(ivec3 brick)
{
    ivec3 counts = brick_counts();
    return uint(brick.x + counts.x * (brick.y + counts.y * brick.z));
}

/* By which the side of a voxel is drawn. */
float side_weight(ivec3 cell, int slice)
{
    return luminance(texelFetch(radiance_texture, cell + ivec3(0, 0, slice * int(grid.size.z)), 0).rgb);
}
