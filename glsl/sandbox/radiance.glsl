/* Light that voxels send out, for user shaders. */
#ifndef LSF_SANDBOX_RADIANCE
#define LSF_SANDBOX_RADIANCE

#include "sandbox/voxels.glsl"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D sandbox_voxel_radiance;

/* The lobe of surfaces that face a viewer along an axis. Slices lie along z; coordinates keep half a texel away
 * from the neighbouring slice. */
vec4 sandbox_lobe(vec3 voxel, int slice, float level)
{
    vec3 size = grid.size.xyz;
    float texel = exp2(ceil(level));
    float z = clamp(voxel.z, 0.5 * texel, size.z - 0.5 * texel) / size.z;
    vec3 coordinates = vec3(voxel.xy / size.xy, (z + float(slice)) / float(LSF_VOXEL_SIDES_AXES));
    return textureLod(sandbox_voxel_radiance, coordinates, level);
}

vec4 lsf_voxel_radiance(vec3 voxel, vec3 direction, float level)
{
    if (any(lessThan(voxel, vec3(0.0))) || any(greaterThan(voxel, grid.size.xyz)))
        return vec4(0.0);
    level = clamp(level, 0.0, float(LSF_VOXEL_LEVELS - 1));
    vec4 sum = vec4(0.0);
    for (int axis = 0; axis < 3; axis++)
        sum += abs(direction[axis]) * sandbox_lobe(voxel, 2 * axis + (direction[axis] < 0.0 ? 1 : 0), level);
    return vec4(sum.rgb * grid.unit.x, min(sum.a, 1.0));
}

#endif
