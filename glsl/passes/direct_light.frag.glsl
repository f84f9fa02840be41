/* Light that one light sends to the eye by one reflection: f V E, added to the target. Switches LSF_SHADOW_SKY: not
 * one light's, but that of a batch of directions of the environment; LSF_SKY_CHANCE, lsf_sky_chance: what else
 * finds the environment, and leaves a share of it; LSF_SKY_PATTERN: light of these directions stays split, and pixels
 * take turns at that for their diffuse lobes. */
#include "lib/brdf.glsl"
#if LSF_SKY_CHANCE
#include "lib/brdf_sample.glsl"
#endif
#include "lib/gbuffer_textures.glsl"
#include "lib/shadow.glsl"
#if !LSF_SHADOW_SKY
#include "lib/light.glsl"
#endif
#include "lib/straight.glsl"
#include "lib/view.glsl"

#if LSF_SKY_PATTERN
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif
#else
layout(location = 0) out vec4 radiance_out;
#endif

#if LSF_SHADOW_SKY
layout(location = 0) uniform int sky_map_count;
#endif
#if LSF_SKY_PATTERN
layout(location = 2) uniform ivec2 sky_turn; /* first direction of the batch; turn of the pattern */

/* Whether a direction falls to the pixel's place in the pattern. */
bool takes_direction(ivec2 pixel, int direction)
{
    const int tiles = LSF_SKY_PATTERN * LSF_SKY_PATTERN;
    int tile = (direction + sky_turn.y) % tiles;
    return tile == pixel.x % LSF_SKY_PATTERN + pixel.y % LSF_SKY_PATTERN * LSF_SKY_PATTERN;
}
#endif

#if LSF_SKY_CHANCE
#define LSF_SKY_CHANCE_PATHS 1
#define LSF_SKY_CHANCE_LOBES 2

/* Number of paths, or rays, of a pixel at roughness 0 and 1. */
layout(location = LSF_LOCATION_SKY_CHANCE) uniform vec2 sky_paths;

/* Takes what is left to this light of the environment, which it has `density` of. */
void share_sky(surface s, vec3 view_direction, vec3 direction, float density, inout brdf_value f)
{
    float count = floor(mix(sky_paths.x, sky_paths.y, surface_widest_roughness(s)) + 0.5);
    brdf_sampler p = brdf_sampler_of(s, view_direction, true);
#if LSF_SKY_CHANCE == LSF_SKY_CHANCE_PATHS
    float left = density / (density + count * brdf_pdf(p, direction));
    f.diffuse *= left;
    f.specular *= left;
#else
    f.diffuse *= density / (density + count * dot(s.normal, direction) / LSF_PI);
#if LSF_SPECULAR && LSF_SKY_CHANCE == LSF_SKY_CHANCE_LOBES
    p.specular = 1.0;
    f.specular *= density / (density + brdf_pdf(p, direction));
#else
    f.specular = vec3(0.0);
#endif
#endif
}
#endif

struct light_parts {
    vec3 irradiance, specular;
};

/* What a visible point reflects of the light from a direction, `irradiance` on a plane that faces it. `density`: of
 * the environment's directions, 0: it is no part of it. */
light_parts reflected(surface s, vec3 position, vec3 view_direction, vec3 direction, vec3 irradiance,
               float density, float kernel)
{
    float cosine = dot(s.normal, direction);
    if (cosine <= 0.0 || dot(s.geometric_normal, direction) <= 0.0 ||
        max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0)
        return light_parts(vec3(0.0), vec3(0.0));
    bool transmits = false;
#if LSF_SHADOW_TINT
    transmits = s.transmission > 0.0;
#if !LSF_SHADOW_SKY
    transmits = transmits && !s.volume;
#endif
#endif
    float visibility = shadow_visibility(position, s.geometric_normal, transmits);
    if (visibility == 0.0)
        return light_parts(vec3(0.0), vec3(0.0));
#if LSF_SHADOW_TINT
    irradiance *= shadow_tint(position, s.geometric_normal, straight_tint_or_one(s, direction));
#endif
#if LSF_SKY_CHANCE
    brdf_value f = brdf_evaluate(s, view_direction, direction, 0.0);
    if (density > 0.0)
        share_sky(s, view_direction, direction, density, f);
#else
    brdf_value f = brdf_evaluate(s, view_direction, direction, kernel);
#endif
    irradiance *= cosine * visibility;
    return light_parts(f.diffuse * irradiance, f.specular * irradiance);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if LSF_SKY_PATTERN
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
#else
    radiance_out = vec4(0.0);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    if (depth == 0.0)
        return;
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_GLOSS
    gloss_unpack(texelFetch(gloss_texture, pixel, 0), s);
#endif
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    vec3 position = position_from_depth(ndc, depth);
    vec3 view_direction = surface_view(s, -normalize(view_ray_direction(ndc)));
    light_parts sum = light_parts(vec3(0.0), vec3(0.0));
#if LSF_SHADOW_SKY
    for (shadow_sky_map = 0; shadow_sky_map < sky_map_count; shadow_sky_map++) {
        bool takes = true;
#if LSF_SKY_PATTERN
        takes = takes_direction(pixel, sky_turn.x + shadow_sky_map);
#endif
        if (!takes && LSF_SPECULAR == 0)
            continue;
        light_parts r = reflected(s, position, view_direction, sky_maps[shadow_sky_map].to_sky.xyz,
                                  sky_maps[shadow_sky_map].irradiance.rgb, sky_maps[shadow_sky_map].to_sky.w,
                                  sky_maps[shadow_sky_map].irradiance.w);
        sum.specular += r.specular;
        if (takes)
            sum.irradiance += r.irradiance;
    }
#else
    vec3 irradiance;
    float distance2;
    vec3 direction = light_direction(position, irradiance, distance2);
#if LSF_SCATTER
    if (s.through) {
        /* What the lobe leaves to light that goes straight on, nothing brings of a lamp's. */
        irradiance /= scattered_share(s);
    } else if (LSF_STRAIGHT == 0 && s.transmission > 0.0 && dot(s.normal, direction) < 0.0 &&
               scattered_share(s) > 0.0) {
        surface_look_through(s); /* other light from there, paths find */
        view_direction = surface_view(s, view_direction);
    }
#endif
    sum = reflected(s, position, view_direction, direction, irradiance, 0.0, 0.0);
#endif
#if LSF_SKY_PATTERN
    const float tiles = float(LSF_SKY_PATTERN * LSF_SKY_PATTERN); /* each takes one of as many directions */
    irradiance_out.rgb = tiles * sum.irradiance;
#if LSF_SPECULAR
    specular_out.rgb = sum.specular; /* of all: what a lobe shows is hardly ever a neighbour's to share */
#endif
#else
    radiance_out.rgb = surface_diffuse(s) / LSF_PI * sum.irradiance + sum.specular;
#endif
}
