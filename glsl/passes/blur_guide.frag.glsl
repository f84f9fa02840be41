/* What the blur compares of each texel, made once for all phases: 2 fetches of it instead of 4, and
 * no view rays. See src/passes/blur.md. */
#include "lib/coarse.glsl"
#include "lib/gbuffer.glsl"
#include "lib/gbuffer_textures.glsl"
#include "passes/blur_texel.glsl"

layout(location = 0) out uvec4 guide_out;

layout(location = 0) uniform vec2 brackets; /* min_roughness, phases */

/* Phases that blur the specular part: brackets of equal width from min_roughness to 1. */
uint phases_of(ivec2 texel)
{
    float roughness = 1.0;
#if LSF_GLOSS
    uvec2 gloss = texelFetch(gloss_texture, texel, 0).xy;
    roughness = unpackUnorm2x16(gloss.x).x;
#if LSF_ANISOTROPY
    /* Along the tangent it is the rougher. */
    float strength = unpackUnorm2x16(gloss.y).x;
    roughness = sqrt(lsf_alpha_along_tangent(roughness * roughness, strength));
#endif
#endif
    if (roughness < brackets.x)
        return 0u;
    float place = (roughness - brackets.x) / max(1.0 - brackets.x, 1e-30); /* 0 to 1 */
    return uint(min(floor(place * brackets.y) + 1.0, brackets.y));
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, texel, 0).r;
    uvec4 surface = texelFetch(surface_texture, texel, 0);
    guide_out = uvec4(0u);
    if (depth != 0.0 && !surface_texel_unlit(surface))
        guide_out = guide_pack(position_from_depth(coarse_ndc(texel), depth), surface.x, surface.y,
                               phases_of(texel));
}
