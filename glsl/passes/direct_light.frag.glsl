/* Light that one light sends to the eye by one reflection: f V E, added to the target. Switches LSF_SHADOW_SKY:
 * instead of one light, a batch of directions of the environment; LSF_SKY_CHANCE, lsf_sky_chance: other strategies
 * that find the environment, and share its light; LSF_SKY_SPLIT: light of these directions stays split;
 * LSF_SKY_CONTROL, lsf_sky_control: the directions estimate only the difference from the light of an unoccluded sky,
 * which is known; LSF_SPECULAR_PATHS: rays have told how much of it narrow lobes reflect. Texels without a surface
 * are not drawn (lsf_skip_background). */
#include "lib/brdf.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/luminance.glsl"
#include "lib/shadow.glsl"
#include "lib/sky_chance.glsl"
#include "lib/sky_control.glsl"
#include "lib/specular_share.glsl"
#if !LSF_SHADOW_SKY
#include "lib/light.glsl"
#endif
#include "lib/straight.glsl"
#include "lib/view.glsl"

#if LSF_SKY_SPLIT
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
struct light_parts {
    vec3 irradiance, specular;
};

/* Visibility and tint of light from a direction. */
float passing(surface s, vec3 position, vec3 direction, out vec3 tint)
{
    tint = vec3(1.0);
    bool transmits = false;
#if LSF_SHADOW_TINT
    transmits = s.transmission > 0.0;
#if !LSF_SHADOW_SKY
    transmits = transmits && !s.volume;
#endif
#endif
    float visibility = shadow_visibility(position, s.geometric_normal, transmits);
#if LSF_SHADOW_TINT
    if (visibility > 0.0)
        tint = shadow_tint(position, s.geometric_normal, straight_tint_or_one(s, direction));
#endif
    return visibility;
}

/* `density`: of the environment's directions, 0: the light does not belong to it. */
brdf_value reflectance(surface s, vec3 view_direction, vec3 direction, float density, float kernel)
{
#if LSF_SKY_CHANCE
    brdf_value f = brdf_evaluate(s, view_direction, direction, 0.0);
    if (density > 0.0)
        share_sky(s, view_direction, direction, density, f);
    return f;
#else
    return brdf_evaluate(s, view_direction, direction, kernel);
#endif
}

/* Whether the surface can reflect light from a direction, with `irradiance` on a plane that faces it. */
bool reaches(surface s, vec3 direction, vec3 irradiance)
{
    return dot(s.normal, direction) > 0.0 && dot(s.geometric_normal, direction) > 0.0 &&
           max(irradiance.r, max(irradiance.g, irradiance.b)) > 0.0;
}

/* Light that the visible point reflects. */
light_parts reflected(surface s, vec3 position, vec3 view_direction, vec3 direction, vec3 irradiance,
               float density, float kernel)
{
    vec3 tint;
    if (!reaches(s, direction, irradiance))
        return light_parts(vec3(0.0), vec3(0.0));
    float visibility = passing(s, position, direction, tint);
    if (visibility == 0.0)
        return light_parts(vec3(0.0), vec3(0.0));
    irradiance *= tint;
    brdf_value f = reflectance(s, view_direction, direction, density, kernel);
    irradiance *= dot(s.normal, direction) * visibility;
    return light_parts(f.diffuse * irradiance, f.specular * irradiance);
}

#if LSF_SKY_CONTROL
layout(binding = 3) uniform sampler2D open_irradiance_texture;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D open_specular_texture;
#endif
#if LSF_SPECULAR_PATHS
layout(binding = 5) uniform sampler2D lobe_texture; /* as open_sky leaves it */
layout(binding = 8) uniform sampler2D open_narrow_texture;
float twice; /* lobe_widened_twice */
#endif
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
/* Background fails the depth test. Because of the image, that test would else come after this shader. */
layout(early_fragment_tests) in;
/* Statistics of the directions of both sequences: sums in two layers, the largest squares in a third. */
layout(binding = 0, rgba32f) uniform image2DArray control_image;
#endif
layout(location = 3) uniform vec2 control; /* the share of one direction; the reciprocal of the light's typical
                                            * value */
layout(location = 4) uniform int sequence; /* sequence of the first direction, 0 or 1 */

/* Sums over the directions of one sequence. */
struct sky_part {
    light_parts lit, open; /* light that arrives, and light that would arrive unoccluded */
    sky_found found;
#if LSF_SPECULAR_PATHS
    vec3 narrow_lit, narrow_open; /* the specular light that rays along narrow lobes have a share of */
#endif
};

/* Statistics of one direction; `left`: transmittance on the way. */
sky_found found_by(vec3 diffuse, vec3 specular, vec3 left)
{
    vec2 whole = control.y * vec2(luminance(diffuse), luminance(specular));
    vec2 lit = control.y * vec2(luminance(diffuse * left), luminance(specular * left));
    return sky_found(whole * lit, whole * whole, whole.x * whole.x);
}

/* Adds the current direction. */
void add_direction(surface s, vec3 position, vec3 view_direction, inout sky_part part)
{
    vec3 direction = sky_maps[shadow_sky_map].to_sky.xyz, irradiance = sky_maps[shadow_sky_map].irradiance.rgb;
    if (!reaches(s, direction, irradiance))
        return;
    brdf_value f = reflectance(s, view_direction, direction, sky_maps[shadow_sky_map].to_sky.w,
                               sky_maps[shadow_sky_map].irradiance.w);
    irradiance *= dot(s.normal, direction);
    vec3 tint, diffuse = f.diffuse * irradiance, specular = f.specular * irradiance;
    vec3 left = passing(s, position, direction, tint) * tint;
    part.found = sky_found_both(part.found, found_by(diffuse, specular, left));
    part.lit.specular += specular * left;
    part.open.specular += specular;
#if LSF_SPECULAR_PATHS
    float narrow = narrow_sky_share(twice, control.x * sky_maps[shadow_sky_map].to_sky.w);
    part.narrow_lit += narrow * specular * left;
    part.narrow_open += narrow * specular;
#endif
    part.lit.irradiance += diffuse * left;
    part.open.irradiance += diffuse;
}

/* Puts the sums of the other sequence first. */
void take_turns(inout sky_part parts[2])
{
    sky_part first = parts[0];
    parts[0] = parts[1];
    parts[1] = first;
}

/* Control variate: the directions' light, less the share of their unoccluded light, plus that share of the
 * unoccluded light's expectation. */
light_parts controlled(sky_part part, int directions, light_parts open_sky, vec2 share)
{
    vec3 irradiance = control.x * float(directions) * open_sky.irradiance;
    vec3 specular = control.x * float(directions) * open_sky.specular;
    return light_parts(part.lit.irradiance + share.x * (irradiance - part.open.irradiance),
                       part.lit.specular + share.y * (specular - part.open.specular));
}

/* The sum over the batch. Each sequence uses the share of diffuse light that the other one has found, which is
 * independent of it. Rays have their share of narrow lobes. */
light_parts controlled_sum(surface s, vec3 view_direction, ivec2 pixel, sky_part parts[2], ivec2 directions)
{
    light_parts open_sky = light_parts(texelFetch(open_irradiance_texture, pixel, 0).rgb, vec3(0.0));
#if LSF_SPECULAR
    open_sky.specular = texelFetch(open_specular_texture, pixel, 0).rgb;
#endif
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    vec2 most = imageLoad(control_image, ivec3(pixel, 2)).xy;
    for (int i = 0; i < 2; i++) {
        vec4 sums = imageLoad(control_image, ivec3(pixel, i));
        parts[i].found = sky_found_both(parts[i].found, sky_found(sums.xy, sums.zw, most[i]));
        imageStore(control_image, ivec3(pixel, i), vec4(parts[i].found.lit, parts[i].found.whole));
    }
    imageStore(control_image, ivec3(pixel, 2), vec4(parts[0].found.most, parts[1].found.most, 0.0, 0.0));
#endif
    float specular = sky_control_specular(sky_found_both(parts[0].found, parts[1].found));
    light_parts one =
        controlled(parts[0], directions.x, open_sky, vec2(sky_control_diffuse(parts[1].found), specular));
    light_parts other =
        controlled(parts[1], directions.y, open_sky, vec2(sky_control_diffuse(parts[0].found), specular));
    light_parts sum = light_parts(one.irradiance + other.irradiance, one.specular + other.specular);
#if LSF_SPECULAR_PATHS
    vec2 leave = texelFetch(lobe_texture, pixel, 0).xy;
    vec3 open_part = control.x * float(directions.x + directions.y) * texelFetch(open_narrow_texture, pixel, 0).rgb;
    vec3 open_found = parts[0].narrow_open + parts[1].narrow_open;
    vec3 found = parts[0].narrow_lit + parts[1].narrow_lit + specular * (open_part - open_found);
    sum.specular += leave.x * open_part - (1.0 - leave.y) * found;
#endif
    return sum;
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if LSF_SKY_SPLIT
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
#else
    radiance_out = vec4(0.0);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, pixel, 0), s);
#endif
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    vec3 position = position_from_depth(ndc, depth);
    shadow_raster_error = view_raster_error(position, s.geometric_normal);
    vec3 view_direction = surface_view(s, -normalize(view_ray_direction(ndc)));
    light_parts sum = light_parts(vec3(0.0), vec3(0.0));
#if LSF_SHADOW_SKY
#if LSF_SKY_CONTROL
    light_parts nothing = light_parts(vec3(0.0), vec3(0.0));
    sky_part parts[2]; /* of the sequence whose turn it is, and of the other */
    parts[0].lit = parts[0].open = nothing;
    parts[0].found = sky_found_nothing();
#if LSF_SPECULAR_PATHS
    parts[0].narrow_lit = parts[0].narrow_open = vec3(0.0);
    twice = lobe_widened_twice(s, view_direction);
#endif
    parts[1] = parts[0];
#endif
    for (shadow_sky_map = 0; shadow_sky_map < sky_map_count; shadow_sky_map++) {
#if LSF_SKY_CONTROL
        add_direction(s, position, view_direction, parts[0]);
        take_turns(parts);
#else
        light_parts r = reflected(s, position, view_direction, sky_maps[shadow_sky_map].to_sky.xyz,
                                  sky_maps[shadow_sky_map].irradiance.rgb, sky_maps[shadow_sky_map].to_sky.w,
                                  sky_maps[shadow_sky_map].irradiance.w);
        sum.irradiance += r.irradiance;
        sum.specular += r.specular;
#endif
    }
#if LSF_SKY_CONTROL
    if (((sequence + sky_map_count) & 1) != 0)
        take_turns(parts); /* back in the order of the sequences */
    int others = (sky_map_count + sequence) / 2; /* directions of the second sequence */
    sum = controlled_sum(s, view_direction, pixel, parts, ivec2(sky_map_count - others, others));
#endif
#else
    vec3 irradiance;
    float distance2;
    vec3 direction = light_direction(position, irradiance, distance2);
#if LSF_SCATTER
    if (s.through) {
        /* No strategy finds the light of a lamp that goes straight on, so that the scattered share stands for all
         * of it. */
        irradiance /= scattered_share(s);
    }
#endif
    sum = reflected(s, position, view_direction, direction, irradiance, 0.0, 0.0);
#endif
#if LSF_SKY_SPLIT
    irradiance_out.rgb = sum.irradiance;
#if LSF_SPECULAR
    specular_out.rgb = sum.specular;
#endif
#else
    radiance_out.rgb = surface_diffuse(s) / LSF_PI * sum.irradiance + sum.specular;
#endif
}
