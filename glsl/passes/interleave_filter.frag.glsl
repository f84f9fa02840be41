/* Cross-bilateral filter along one axis, guided by the G-buffer. */
#include "lib/gbuffer.glsl"
#include "lib/view.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_GLOSS
layout(binding = 2) uniform usampler2D gloss_texture;
#endif
layout(binding = 3) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

layout(location = 0) uniform ivec2 along;  /* (1, 0), then (0, 1) */
layout(location = 1) uniform ivec2 reach;  /* pixels to each side; 1 when the outermost count half */
layout(location = 2) uniform vec2 weights; /* depth_weight, normal_weight */

vec3 position_at(ivec2 pixel, float depth)
{
    return position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth);
}

/* A pixel's width where the point lies [normalised space]. */
float pixel_size(float depth)
{
#if LSF_ORTHOGRAPHIC
    return 2.0 * length(view.origin_dx.xyz) * view.size.z;
#else
    return 2.0 * length(view.forward_dx.xyz) * view.size.z * view_depth(depth);
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(depth_texture, 0) - 1;
    irradiance_out = texelFetch(irradiance_texture, pixel, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, pixel, 0);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    if (depth == 0.0)
        return;
    uvec4 texel = texelFetch(surface_texture, pixel, 0);
    vec3 plane = octahedral_decode(texel.x), normal = octahedral_decode(texel.y);
    vec3 position = position_at(pixel, depth);
    float tolerance = weights.x * pixel_size(depth);
    float roughness = 1.0;
#if LSF_GLOSS
    roughness = unpackUnorm2x16(texelFetch(gloss_texture, pixel, 0).x).x;
#endif
    float sum = 1.0, specular_sum = 1.0;
    for (int i = -reach.x; i <= reach.x; i++) {
        ivec2 at = pixel + i * along;
        if (i == 0 || clamp(at, ivec2(0), last) != at)
            continue;
        float there = texelFetch(depth_texture, at, 0).r;
        if (there == 0.0)
            continue;
        float steps = abs(float(i));
        float off = dot(plane, position_at(at, there) - position) / (tolerance * steps);
        vec3 other = octahedral_decode(texelFetch(surface_texture, at, 0).y);
        float w = abs(i) == reach.x && reach.y != 0 ? 0.5 : 1.0;
        w *= exp2(-off * off) * pow(max(dot(normal, other), 0.0), weights.y);
        irradiance_out += w * texelFetch(irradiance_texture, at, 0);
        sum += w;
#if LSF_SPECULAR
        /* The sharper the lobe, the fewer neighbours reflect the same: none for a mirror. */
        float support = max(roughness * float(reach.x), 1e-4);
        w *= exp2(-steps * steps / (support * support));
        specular_out += w * texelFetch(specular_texture, at, 0);
        specular_sum += w;
#endif
    }
    irradiance_out /= sum;
#if LSF_SPECULAR
    specular_out /= specular_sum;
#endif
}
