/* What voxels emit, in the place of what they held. */
#include "passes/voxel_light.glsl"

void light_voxel(ivec3 cell)
{
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
        imageStore(radiance_image, slice_texel(cell, lobe_slice(axis, n[axis])),
                   share * vec4(front, 1.0));
        imageStore(radiance_image, slice_texel(cell, lobe_slice(axis, -n[axis])),
                   share * vec4(back, 1.0));
    }
#else
    imageStore(radiance_image, cell, vec4(front, 1.0));
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_SURFACE
    imageStore(radiance_image, slice_texel(cell, 1), vec4(back, 1.0));
#endif
#endif
}

void main()
{
    voxel_brick brick;
    if (!voxel_brick_of_group(brick))
        return;
    for (int n = int(gl_LocalInvocationID.x); n < brick.count; n += LSF_VOXEL_BRICK_GROUP)
        light_voxel(voxel_brick_cell(brick, n));
}
