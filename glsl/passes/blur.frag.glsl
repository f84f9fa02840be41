/* One phase of the blur along one axis: the texel and a neighbour on either side, weighted 1 : 2 : 1. The weights
 * are derived in src/passes/blur.md. */
#include "lib/sparse_grid.glsl"
#include "lib/view.glsl"
#include "passes/blur_texel.glsl"

layout(binding = 0) uniform usampler2D guide_texture;
layout(binding = 3) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

layout(location = 0) uniform ivec3 along; /* (1, 0) or (0, 1), phase */
layout(location = 1) uniform vec4 law;    /* step at the viewer [texels], growth, 1 / texels along
                                           * the axis, normal_weight */
layout(location = 2) uniform vec3 limits; /* squares of cutoff and slope; the phase's share of growth */

/* Width of a texel along the axis at view depth z [normalised space]. */
float texel_size(float z)
{
#if LSF_ORTHOGRAPHIC
    return 2.0 * law.z * length(along.x != 0 ? view.start_dx.xyz : view.start_dy.xyz);
#else
    return 2.0 * law.z * z * length(along.x != 0 ? view.forward_dx.xyz : view.forward_dy.xyz);
#endif
}

/* The texel, and the sums that it takes from its neighbours. */
struct exchange {
    vec3 position, normal, plane;
    float farthest; /* squared */
    vec4 own_irradiance, irradiance;
#if LSF_SPECULAR
    bool glossy;
    vec4 own_specular, specular;
#endif
};

void take(inout exchange e, ivec2 texel, ivec2 last)
{
    ivec2 at = clamp(texel, ivec2(0), last);
    uvec4 other = texelFetch(guide_texture, at, 0);
    vec3 apart = guide_position(other) - e.position;
    float cosine = dot(e.normal, guide_shading_normal(other)), rise = dot(e.plane, apart);
    float distance = dot(apart, apart);
    bool good = at == texel && guide_lit(other) && cosine > 0.0 && distance <= e.farthest &&
                rise * rise <= limits.y * distance;
    float w = 0.25 * pow(cosine, law.w);
    vec4 irradiance = w * (texelFetch(irradiance_texture, at, 0) - e.own_irradiance);
    e.irradiance += good ? irradiance : vec4(0.0);
#if LSF_SPECULAR
    good = good && e.glossy && guide_phases(other) >= along.z;
    vec4 specular = w * (texelFetch(specular_texture, at, 0) - e.own_specular);
    e.specular += good ? specular : vec4(0.0);
#endif
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
#if LSF_SPARSE
    ivec2 last = sparse_grid.xy - 1;
#else
    ivec2 last = textureSize(guide_texture, 0) - 1;
#endif
    uvec4 guide = texelFetch(guide_texture, texel, 0);
    exchange e;
    e.position = guide_position(guide);
    e.normal = guide_shading_normal(guide);
    e.plane = guide_geometric_normal(guide);
    float z = view.depth.w + dot(e.position - view.start.xyz, view.forward.xyz);
    int steps = int(floor(law.x * pow(1.0 + law.y * z, limits.z) + 0.5));
    float reach = float(steps) * texel_size(z);
    e.farthest = limits.x * reach * reach;
    e.own_irradiance = texelFetch(irradiance_texture, texel, 0);
    e.irradiance = vec4(0.0);
#if LSF_SPECULAR
    e.glossy = guide_phases(guide) >= along.z;
    e.own_specular = texelFetch(specular_texture, texel, 0);
    e.specular = vec4(0.0);
#endif
    take(e, texel + steps * along.xy, last);
    take(e, texel - steps * along.xy, last);
    bool lit = guide_lit(guide);
    irradiance_out = e.own_irradiance + (lit ? e.irradiance : vec4(0.0));
#if LSF_SPECULAR
    specular_out = e.own_specular + (lit ? e.specular : vec4(0.0));
#endif
}
