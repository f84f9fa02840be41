/* What voxels emit, in the place of what they held. */
#include "lib/voxel_sides.glsl"

layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D point_texture;
#if LSF_EMISSION
layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D emission_texture;
#endif

/* Returns which slices it has filled, a bit each. */
uint light_voxel(ivec3 cell)
{
    uint filled = 0u;
    vec3 front = vec3(0.0), back = vec3(0.0);
#if LSF_EMISSION
    front = min(voxel_emission_unpack(texelFetch(emission_texture, cell, 0).r), RADIANCE_MAX);
    if (voxel_emits_both(texelFetch(point_texture, cell, 0).r))
        back = front;
#endif
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_AXES
    vec3 n = voxel_normal_unpack(texelFetch(normal_texture, cell, 0).r);
    for (int axis = 0; axis < 3; axis++) {
        float share = n[axis] * n[axis];
        if (share == 0.0)
            continue; /* empty before, too */
        filled |= 3u << (2 * axis);
        imageStore(radiance_image, slice_texel(cell, lobe_slice(axis, n[axis])),
                   share * vec4(front, 1.0));
        imageStore(radiance_image, slice_texel(cell, lobe_slice(axis, -n[axis])),
                   share * vec4(back, 1.0));
    }
#else
    filled = (1u << LSF_VOXEL_SIDES) - 1u;
    imageStore(radiance_image, cell, vec4(front, 1.0));
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_SURFACE
    imageStore(radiance_image, slice_texel(cell, 1), vec4(back, 1.0));
#endif
#endif
    return filled;
}

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    uint filled = 0u;
    for (int n = voxel_brick_lane(); n < voxels; n += VOXEL_BRICK_LANES)
        filled |= light_voxel(voxel_brick_cell(brick, n));
    atomicOr(bricks[at].sides, filled);
}
