/* The values of each texel that the blur compares, computed once for all phases: two fetches instead of four, and
 * no view rays. See src/passes/blur.md. */
#include "lib/gbuffer.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/sparse_grid.glsl"
#include "lib/view.glsl"
#include "passes/blur_texel.glsl"

layout(location = 0) out uvec4 guide_out;

layout(location = 0) uniform vec2 brackets; /* min_roughness, phases */

/* Number of phases that blur the specular part: brackets of equal width from min_roughness to 1. */
uint phases_of(ivec2 pixel)
{
    float roughness = 1.0;
#if LSF_SPECULAR_PARAMS
    uvec2 specular_params = texelFetch(specular_params_texture, pixel, 0).xy;
    roughness = unpackUnorm2x16(specular_params.x).x;
#if LSF_ANISOTROPY
    /* The surface is rougher along the tangent. */
    float strength = unpackUnorm2x16(specular_params.y).x;
    roughness = sqrt(lsf_alpha_along_tangent(roughness * roughness, strength));
#endif
#endif
    if (roughness < brackets.x)
        return 0u;
    float fraction = (roughness - brackets.x) / max(1.0 - brackets.x, 1e-30); /* 0 to 1 */
    return uint(min(floor(fraction * brackets.y) + 1.0, brackets.y));
}

void main()
{
    ivec2 pixel = sparse_pixel(ivec2(gl_FragCoord.xy));
    guide_out = uvec4(0u);
    if (any(greaterThanEqual(pixel, ivec2(view.size.xy))))
        return;
    float depth = texelFetch(depth_texture, pixel, 0).r;
    uvec4 surface = texelFetch(surface_texture, pixel, 0);
    if (depth != 0.0 && !surface_texel_unlit(surface))
        guide_out = guide_pack(position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth), surface.x, surface.y,
                               phases_of(pixel));
}
