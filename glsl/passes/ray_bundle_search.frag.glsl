/* The nearest fragment beyond each origin, along the bundle or against it, depending on the side that the origin's
 * surface faces. Pixels that need more than the slices are listed for ray_bundle_rest.comp.glsl, because in
 * software GL all lanes wait for the slowest. */
#define LSF_BUNDLE_REST_ACCESS coherent
#include "passes/ray_bundle_ray.glsl"
#include "passes/ray_bundle_rest.glsl"

noperspective in vec3 frame_start, frame_along;
flat in vec3 frame_forward;
flat in vec4 frame_scale;

layout(location = 0) out uvec2 hit_out; /* distance as float bits, node */

void main()
{
    bundle_frame frame = bundle_frame(frame_start, frame_along, frame_forward, frame_scale);
    bundle_ray ray = ray_of(ivec2(gl_FragCoord.xy), frame);
    bundle_hit hit = search_slices(ray);
    if (hit.tie || ray.count > int(bundle.sliced))
        rest[atomicAdd(rest_count, 1u)] = uint(gl_FragCoord.x) | uint(gl_FragCoord.y) << 16;
    hit_out = hit_pack(ray, hit, frame);
}
