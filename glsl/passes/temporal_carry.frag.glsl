/* Reprojects the history of the previous frame: of the four texels around a point's previous position, those that
 * show the same instance, plane and side, by their bilinear weights. Switches LSF_LOBE: there is specular light;
 * LSF_DENOISED: denoised light has a history, too; LSF_PIXEL_SIDE. */
#include "lib/view.glsl"
#include "shared/brdf.h"

#include "lib/light_guide.glsl"
#include "passes/temporal_motion.glsl"

layout(binding = 4) uniform usampler2D old_guide_texture;
layout(binding = 5) uniform sampler2D old_diffuse_texture;
layout(binding = 6) uniform sampler2D old_diffuse_count_texture;
layout(location = 0) out vec4 diffuse_out;
layout(location = 1) out vec4 reach_out; /* samples of diffuse and of specular light; drift of the lobes */
#if LSF_LOBE
layout(binding = 7) uniform sampler2D old_specular_texture;
layout(binding = 8) uniform sampler2D old_specular_count_texture;
layout(location = 3) out vec4 specular_out;
layout(location = 5) uniform vec4 former_eye; /* previous eye; W 0: the direction of all rays */
#endif
#if LSF_DENOISED
layout(binding = 10) uniform sampler2D old_denoised_textures[1 + LSF_LOBE];
layout(binding = 12) uniform sampler2D old_denoised_count_texture;
layout(location = 3 + LSF_LOBE) out vec4 denoised_out[1 + LSF_LOBE]; /* A: samples */
#endif
layout(binding = 9) uniform sampler2D old_picture_texture; /* A: its samples */
layout(location = 2) out vec4 picture_out;                 /* A: below 0 where it is to be clamped to its
                                                            * neighbourhood */
layout(location = 4) uniform bool kept;
layout(location = 6) uniform bool changed; /* lighting may have changed */

/* Distance [pixels] of a point from the plane of the history's point: each may lie anywhere in its pixel. */
#define OFF_PLANE 2.0
/* Least cosine between the normals, 25 degrees: less than the angle of creases, more than a rotation within a
 * frame. */
#define SAME_SIDE 0.9
/* Largest difference of motion between neighbours [pixels] for which the picture counts as rigid. */
#define PARALLAX 0.25

bool finite(vec4 v)
{
    return !any(isnan(v)) && !any(isinf(v));
}

/* What the history held around a pixel's surface. */
struct former {
    bool seen;  /* the surface, there or in a neighbouring texel: pixels on edges show it in some iterations only */
    bool alone; /* nothing else, so that nothing else is mixed into the texels around the position */
};

former former_at(light_guide g, vec4 motion, ivec2 corner)
{
    ivec2 size = textureSize(guide_texture, 0);
    former f = former(false, true);
    for (int j = -1; j <= 2; j++)
        for (int i = -1; i <= 2; i++) {
            ivec2 at = corner + ivec2(i, j);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            uvec4 old = texelFetch(old_guide_texture, at, 0);
            float off = abs(uintBitsToFloat(old.y) - motion.z) * g.scale;
            bool same = old.w == uint(motion.w) && off < 2.0 * OFF_PLANE * (1.0 + length(g.slope) * g.scale);
            f.seen = f.seen || same;
            f.alone = f.alone && same;
        }
    return f;
}

/* Lanczos window of three texels to each side, a compromise between blur and ringing. */
float lanczos(float x)
{
    float a = LSF_PI * x;
    return abs(x) < 1e-4 ? 1.0 : abs(x) < 3.0 ? 3.0 * sin(a) * sin(a / 3.0) / (a * a) : 0.0;
}

/* Interpolates between texels, clamped to the range of the four around. */
vec4 old_picture(vec2 from)
{
    ivec2 size = textureSize(guide_texture, 0), corner = ivec2(floor(from));
    vec3 sum = vec3(0.0), low = vec3(1e30), high = vec3(0.0);
    float weight = 0.0, samples = 1e30, across[6], up[6];
    for (int k = 0; k < 6; k++) {
        across[k] = lanczos(float(corner.x + k - 2) - from.x);
        up[k] = lanczos(float(corner.y + k - 2) - from.y);
    }
    for (int j = -2; j <= 3; j++)
        for (int i = -2; i <= 3; i++) {
            ivec2 at = corner + ivec2(i, j);
            vec4 texel = texelFetch(old_picture_texture, clamp(at, ivec2(0), size - 1), 0);
            float w = across[i + 2] * up[j + 2];
            sum += w * texel.rgb;
            weight += w;
            if ((i == 0 || i == 1) && (j == 0 || j == 1)) {
                low = min(low, texel.rgb);
                high = max(high, texel.rgb);
                samples = min(samples, texel.a);
            }
        }
    return vec4(clamp(sum / weight, low, high), samples);
}

/* The picture of the previous frame, moved like the nearest surface around the pixel, so that both sides of edges
 * move together. */
vec4 carried_picture(ivec2 pixel, light_guide g)
{
    ivec2 size = textureSize(guide_texture, 0);
    vec4 own = motion_at(pixel), nearest = vec4(0.0);
    vec2 low = vec2(1e9), high = vec2(-1e9);
    float depth = 0.0;
    bool all_surface = true, edge = false;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = clamp(pixel + ivec2(i, j), ivec2(0), size - 1);
            vec4 motion = motion_at(at);
            float d = texelFetch(guide_texture, at, 0).z;
            low = min(low, motion.xy);
            high = max(high, motion.xy);
            all_surface = all_surface && d > 0.0;
            edge = edge || motion.w != own.w || abs(d - g.depth - dot(g.slope, vec2(at - pixel))) * g.scale > OFF_PLANE;
            if (d > depth) {
                depth = d;
                nearest = motion;
            }
        }
    vec2 from = vec2(pixel) - nearest.xy;
    if (depth == 0.0 || !finite(nearest) || any(lessThan(from, vec2(-0.5))) || any(greaterThan(from, vec2(size) - 0.5)))
        return vec4(0.0);
    former before = former(false, false);
    if (own.z > 0.0)
        before = former_at(g, own, ivec2(floor(vec2(pixel) - own.xy)));
    if (g.depth > 0.0 && !before.seen)
        return vec4(0.0);
    vec4 picture = old_picture(from);
    if (!finite(picture))
        return vec4(0.0);
    bool rigid = all_surface && all(lessThan(high - low, vec2(PARALLAX)));
    /* What was an edge, and is none, holds a share of what has uncovered it. */
    return rigid && (before.alone || edge) && !changed ? picture : vec4(picture.rgb, -picture.a);
}

#if LSF_LOBE
/* Movement of the mirrored direction within the lobe from frame to frame, in widths of the lobe. */
float lobe_drift(light_guide g)
{
    vec3 former = former_eye.w == 0.0 ? -former_eye.xyz : normalize(former_eye.xyz - g.position);
    /* The normal of the microfacets that would mirror the previous direction to the viewer. */
    vec3 h = g.view + reflect(-former, g.normal);
    float nh = dot(g.normal, h);
    vec3 across = h - nh * g.normal;
    return nh > 0.0 ? length(across) / max(g.alpha * nh, LSF_TINY) : 1e9;
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    diffuse_out = reach_out = picture_out = vec4(0.0);
#if LSF_LOBE
    specular_out = vec4(0.0);
#endif
#if LSF_DENOISED
    vec2 denoised_sums = vec2(0.0);
    for (int part = 0; part <= LSF_LOBE; part++)
        denoised_out[part] = vec4(0.0);
#endif
    light_guide g = light_guide_at(pixel);
    vec4 motion = motion_at(pixel);
    if (kept)
        picture_out = carried_picture(pixel, g);
    if (!kept || g.depth == 0.0 || motion.z <= 0.0 || !finite(motion))
        return;
    vec2 from = clamp(vec2(pixel) - motion.xy, vec2(-2.0), vec2(size) + 2.0);
    ivec2 corner = ivec2(floor(from));
    vec2 sums = vec2(0.0), counts = vec2(0.0);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            ivec2 at = corner + ivec2(i, j);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            uvec4 old = texelFetch(old_guide_texture, at, 0);
            vec2 apart = vec2(at) - from;
            float off = abs(uintBitsToFloat(old.y) - motion.z - dot(g.slope, apart)) * g.scale;
            if (old.z != uint(motion.w) || off > OFF_PLANE || dot(octahedral_decode(old.x), g.normal) < SAME_SIDE)
                continue;
            float w = (1.0 - abs(apart.x)) * (1.0 - abs(apart.y));
            float count = texelFetch(old_diffuse_count_texture, at, 0).r;
            if (count > 0.0) {
                diffuse_out += w * texelFetch(old_diffuse_texture, at, 0);
                counts.x += w * count;
                sums.x += w;
            }
#if LSF_LOBE
            count = texelFetch(old_specular_count_texture, at, 0).r;
            if (count > 0.0) {
                specular_out += w * texelFetch(old_specular_texture, at, 0);
                counts.y += w * count;
                sums.y += w;
            }
#endif
#if LSF_DENOISED
            vec2 samples = texelFetch(old_denoised_count_texture, at, 0).rg;
            for (int part = 0; part <= LSF_LOBE; part++) {
                if (samples[part] == 0.0)
                    continue;
                vec3 light = texelFetch(old_denoised_textures[part], at, 0).rgb;
                denoised_out[part] += w * vec4(light, samples[part]);
                denoised_sums[part] += w;
            }
#endif
        }
#if LSF_DENOISED
    for (int part = 0; part <= LSF_LOBE; part++)
        denoised_out[part] /= max(denoised_sums[part], 1e-6);
#endif
    diffuse_out /= max(sums.x, 1e-6);
    reach_out.xy = counts / max(sums, vec2(1e-6));
#if LSF_LOBE
    specular_out /= max(sums.y, 1e-6);
    reach_out.z = lobe_drift(g);
    /* Reflections do not move like the surface that reflects them. */
    if (reach_out.z > PARALLAX)
        picture_out.a = -abs(picture_out.a);
#endif
}
