/* Adds what each voxel reflects of the light in turn, from the side that faces it. */
#include "lib/light.glsl"
#include "lib/shadow.glsl"
#include "lib/voxel_sides.glsl"
#include "shared/brdf.h"
#include "shared/light.h"

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D point_texture;

/* Places in voxels are kept to 2^-10 of a voxel; the receiver is lifted off its surface by as much. */
#define LIFT (1.0 / 1024.0)

void add(ivec3 cell, int slice, vec3 radiance)
{
    ivec3 texel = slice_texel(cell, slice);
    vec4 before = imageLoad(radiance_image, texel);
    imageStore(radiance_image, texel, vec4(min(before.rgb + radiance, RADIANCE_MAX), before.a));
}

void light_voxel(ivec3 cell)
{
    vec3 n = voxel_normal_unpack(texelFetch(normal_texture, cell, 0).r);
    vec3 place = vec3(cell) + voxel_point_unpack(texelFetch(point_texture, cell, 0).r);
    vec3 position = voxel_to_position(place);
    vec3 irradiance;
    float distance2;
    vec3 to_light = light_direction(position, irradiance, distance2);
    float cosine = dot(n, to_light);
    bool front = cosine > 0.0;
    vec3 side = front ? n : -n;
    if (max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0)
        return;
#if LSF_VOXEL_SIDES == 1
    if (!front)
        return;
#endif
    float visibility = shadow_visibility(position + LIFT * grid.origin.w * side, side);
    if (visibility == 0.0)
        return;
    vec3 albedo = voxel_albedo_unpack(texelFetch(albedo_texture, cell, 0).r);
    vec3 radiance = albedo * irradiance * (visibility * abs(cosine) / LSF_PI * grid.unit.y);
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_AXES
    for (int axis = 0; axis < 3; axis++)
        if (side[axis] != 0.0)
            add(cell, lobe_slice(axis, side[axis]), side[axis] * side[axis] * radiance);
#else
    add(cell, front ? 0 : 1, radiance);
#endif
}

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    for (int n = voxel_brick_lane(); n < voxels; n += VOXEL_BRICK_LANES)
        light_voxel(voxel_brick_cell(brick, n));
}
