/* Pixels whose search goes on in ray_bundle_rest.comp.glsl. */
#ifndef LSF_PASSES_RAY_BUNDLE_REST
#define LSF_PASSES_RAY_BUNDLE_REST

layout(std430, binding = LSF_BINDING_REST) LSF_BUNDLE_REST_ACCESS buffer lsf_rest_block
{
    uint rest_count;
    uint rest[]; /* x | y << 16 */
};

uvec2 hit_pack(bundle_hit hit, bundle_frame frame)
{
    /* -1 is LSF_NO_NODE */
    return uvec2(hit.node < 0 ? 0u : floatBitsToUint(hit.distance / frame.scale.z), uint(hit.node));
}

#endif
