/* One phase of the blur along one axis: the texel and a neighbour at either side, weighed 1 : 2 : 1.
 * The weights are derived in src/passes/blur.md. */
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
layout(location = 2) uniform vec2 limits; /* cutoff, slope; squared */

/* A texel's width along the axis where view depth is z [normalised space]. */
float texel_size(float z)
{
#if LSF_ORTHOGRAPHIC
    return 2.0 * law.z * length(along.x != 0 ? view.origin_dx.xyz : view.origin_dy.xyz);
#else
    return 2.0 * law.z * z * length(along.x != 0 ? view.forward_dx.xyz : view.forward_dy.xyz);
#endif
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    irradiance_out = texelFetch(irradiance_texture, texel, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, texel, 0);
#endif
    uvec4 guide = texelFetch(guide_texture, texel, 0);
    if (!guide_lit(guide))
        return;
    vec3 position = guide_position(guide), normal = guide_shading_normal(guide);
    vec3 plane = guide_geometric_normal(guide);
    float z = dot(position - view.origin.xyz, view.forward.xyz);
    int steps = int(round(law.x * (1.0 + law.y * z)));
    float reach = float(steps) * texel_size(z), farthest = limits.x * reach * reach;
    /* Light is exchanged: what a neighbour gives the texel, it takes from it. Energy is kept, and a
     * constant stays what it is to the bit. */
    vec4 irradiance = vec4(0.0);
#if LSF_SPECULAR
    vec4 specular = vec4(0.0);
    bool glossy = guide_phases(guide) >= along.z;
#endif
    for (int side = -steps; side <= steps; side += 2 * steps) {
        ivec2 at = texel + side * along.xy;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
            continue;
        uvec4 other = texelFetch(guide_texture, at, 0);
        vec3 apart = guide_position(other) - position;
        float cosine = dot(normal, guide_shading_normal(other)), rise = dot(plane, apart);
        float distance = dot(apart, apart);
        if (!guide_lit(other) || cosine <= 0.0 || distance > farthest ||
            rise * rise > limits.y * distance)
            continue;
        float w = pow(cosine, law.w);
        irradiance += w * (texelFetch(irradiance_texture, at, 0) - irradiance_out);
#if LSF_SPECULAR
        if (glossy && guide_phases(other) >= along.z)
            specular += w * (texelFetch(specular_texture, at, 0) - specular_out);
#endif
    }
    irradiance_out += 0.25 * irradiance;
#if LSF_SPECULAR
    specular_out += 0.25 * specular;
#endif
}
