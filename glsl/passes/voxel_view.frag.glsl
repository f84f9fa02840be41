/* The first voxel on a pixel's ray. */
#include "lib/view.glsl"
#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

layout(location = 0) out vec4 albedo_out;
layout(location = 1) out vec4 normal_out; /* towards the viewer */
layout(location = 2) out vec4 radiance_out;

vec4 radiance_slice(ivec3 cell, int slice)
{
    return texelFetch(radiance_texture, cell + ivec3(0, 0, slice * int(grid.size.z)), 0);
}

vec3 radiance_seen(ivec3 cell, vec3 direction, bool front)
{
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_AXES
    vec4 sum = vec4(0.0);
    for (int axis = 0; axis < 3; axis++)
        sum += abs(direction[axis]) *
               radiance_slice(cell, 2 * axis + (direction[axis] < 0.0 ? 1 : 0));
    return sum.rgb / max(sum.a, 1e-6);
#elif LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_SURFACE
    return radiance_slice(cell, front ? 0 : 1).rgb;
#else
    return radiance_slice(cell, 0).rgb;
#endif
}

void main()
{
    albedo_out = normal_out = radiance_out = vec4(0.0);
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    vec3 direction = normalize(view_ray_direction(ndc));
    voxel_ray ray;
    if (!voxel_ray_begin(voxel_from_position(position_from_depth(ndc, 1.0)), direction, ray) ||
        !voxel_ray_trace(ray))
        return;
    vec3 n = voxel_normal_unpack(texelFetch(normal_texture, ray.cell, 0).r);
    bool front = dot(n, direction) < 0.0;
    albedo_out = vec4(voxel_albedo_unpack(texelFetch(albedo_texture, ray.cell, 0).r), 1.0);
    normal_out = vec4(front ? n : -n, 1.0);
    radiance_out = vec4(radiance_seen(ray.cell, direction, front) * grid.unit.x, 1.0);
}
