/* Pixels whose search continues in ray_bundle_rest.comp.glsl. */
#ifndef LSF_PASSES_RAY_BUNDLE_REST
#define LSF_PASSES_RAY_BUNDLE_REST

layout(std430, binding = LSF_BINDING_REST) LSF_BUNDLE_REST_ACCESS buffer lsf_rest_block
{
    uint rest_count;
    uint rest[]; /* x | y << 16 */
};

uvec2 hit_pack(bundle_ray ray, bundle_hit hit, bundle_frame frame)
{
    if (hit.node < 0)
        return uvec2(0u, LSF_NO_NODE);
    float distance = hit.distance / frame.scale.z;
#if LSF_BUNDLE_GAPS
    float from = bundle.range.x + ray.depth / frame.scale.z;
    distance += abs(bundle_gaps_between(from, from + ray.sign * distance));
#endif
    return uvec2(floatBitsToUint(distance), uint(hit.node));
}

#endif
