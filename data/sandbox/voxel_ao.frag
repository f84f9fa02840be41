// Ambient occlusion by rays through voxels.
//
//     lightsheaf sandbox voxel_ao.frag scene.gltf -o ao.png
//
// From each visible point rays leave by the cosine; the share that meets no voxel within `reach` is how open the
// point is to its surroundings.

// @define voxel.resolution=192

uniform float reach = 0.5; // @slider 0.05 2   in half extents of the scene
uniform int rays = 32;     // @slider 1 128

#include <lightsheaf/hash.glsl>

// A unit direction about the normal n with density cosine / pi.
vec3 cosine_direction(vec3 n, vec2 u)
{
    float z = 1.0 - 2.0 * u.x, angle = 6.2831853 * u.y;
    vec3 on_sphere = vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(angle), sin(angle)), z);
    return normalize(n + 0.9999 * on_sphere);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(0.09, 0.10, 0.12, 1.0);
    if (!lsf_seen(fragCoord))
        return;
    vec3 n = lsf_surface(fragCoord).geometric_normal;
    vec3 start = lsf_voxel_leave(lsf_position(fragCoord), n);
    float cell_size = lsf_voxel_to(vec3(1.0)).x - lsf_voxel_to(vec3(0.0)).x, open = 0.0;
    for (int i = 0; i < rays; i++) {
        vec2 u = hash_unit(hash(uvec3(fragCoord, i))).xy;
        ivec3 cell;
        float distance;
        vec3 direction = cosine_direction(n, u);
        // In a corner the start lies in a voxel of the other wall: a cell further on, the ray is out of it.
        bool met = lsf_voxel_trace(start + cell_size * direction, direction, reach, cell, distance);
        open += met ? distance / reach : 1.0; // what is near counts most
    }
    fragColor.rgb = vec3(sqrt(open / float(rays)));
}
