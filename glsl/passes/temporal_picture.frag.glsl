/* The picture with the history's change of its light, and the values of the frame to which points of the next one
 * are compared. Switches LSF_LOBE: there is specular light; LSF_PIXEL_SIDE. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"
#include "passes/temporal_motion.glsl"

layout(binding = 4) uniform sampler2D picture_texture;
layout(binding = 5) uniform sampler2D diffuse_texture;
layout(binding = 6) uniform sampler2D blended_diffuse_texture;
#if LSF_LOBE
layout(binding = 7) uniform sampler2D specular_texture;
layout(binding = 8) uniform sampler2D blended_specular_texture;
#endif
layout(location = 1) uniform float iterations;
layout(location = 0) out vec4 picture_out; /* A: variance of its luminance */
layout(location = 1) out uvec4 guide_out;

/* Variance of a mean's luminance. A of `light`: the sum of squared deviations, which temporal_blend sets for at least
 * two iterations. */
float variance_of(vec4 light)
{
    float n = max(iterations, 2.0);
    return light.a / (n * (n - 1.0));
}

/* Deviation of depth within a pixel [pixels] above which it shows an edge, whose light belongs to no single
 * surface. */
#define ONE_SURFACE 1.0

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    picture_out = texelFetch(picture_texture, pixel, 0);
    vec4 blended = texelFetch(blended_diffuse_texture, pixel, 0);
    picture_out.rgb += blended.rgb - texelFetch(diffuse_texture, pixel, 0).rgb;
    picture_out.a = variance_of(blended);
#if LSF_LOBE
    blended = texelFetch(blended_specular_texture, pixel, 0);
    picture_out.rgb += blended.rgb - texelFetch(specular_texture, pixel, 0).rgb;
    picture_out.a += variance_of(blended);
#endif
    light_guide g = light_guide_at(pixel);
    guide_out = uvec4(0u);
    uint instance = uint(motion_at(pixel).w);
    if (g.depth != 0.0 && g.spread * g.scale <= ONE_SURFACE)
        guide_out.xyz = uvec3(octahedral_encode(g.normal), floatBitsToUint(g.depth), instance);
    guide_out.yw = uvec2(floatBitsToUint(g.depth), instance);
}
