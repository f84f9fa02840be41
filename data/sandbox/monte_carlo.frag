// An accumulated Monte Carlo estimate: one bounce of light, a ray of each pixel in each frame, and the mean of all
// frames in a buffer.
//
//     lightsheaf sandbox monte_carlo.frag scene.gltf --frame 255 -o mean.png
//
// @jitter lets each frame see other points and other voxels, so that the mean has neither steps nor blocks.

// @output radiance
// @jitter
// @define voxel.resolution=96

#include <lightsheaf/hash.glsl>

// @buffer a
// @channel 0 a filter=nearest

// A unit direction about n with density cosine / pi.
vec3 cosine_direction(vec3 n, vec2 u)
{
    float z = 1.0 - 2.0 * u.x, angle = 6.2831853 * u.y;
    return normalize(n + 0.9999 * vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(angle), sin(angle)), z));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 light = lsf_seen(fragCoord) ? lsf_emission(fragCoord) : vec3(0.0);
    if (lsf_seen(fragCoord)) {
        surface s = lsf_surface(fragCoord);
        vec3 position = lsf_position(fragCoord), n = s.geometric_normal;
        vec3 to_light, direct = lsf_light(0, position, to_light);
        direct *= max(dot(s.normal, to_light), 0.0) * lsf_visibility(position, n) / 3.14159265;

        // Radiance that comes along a direction drawn by the cosine, over its density, is pi times the radiance.
        vec2 u = hash_unit(hash(uvec3(fragCoord, iFrame))).xy;
        vec3 direction = cosine_direction(s.normal, u), bounced = vec3(0.0);
        ivec3 cell;
        float distance;
        if (dot(direction, n) > 0.0 &&
            lsf_voxel_trace(lsf_voxel_leave(position, n), direction, 9.0, cell, distance)) {
            vec4 seen = lsf_voxel_radiance(vec3(cell) + 0.5, direction, 0.0);
            bounced = seen.rgb / max(seen.a, 1e-3);
        }
        light += s.base_color * (1.0 - s.metallic) * (direct + bounced);
    }
    fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + vec4(light, 1.0);
}

// @image
// @channel 0 a filter=nearest

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec4 sum = texelFetch(iChannel0, ivec2(fragCoord), 0);
    fragColor = vec4(sum.rgb / sum.a, 1.0);
}
