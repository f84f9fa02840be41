/* Unidirectional paths from visible points through the voxels; see src/passes/voxel_path.md. Switches LSF_ENVIRONMENT,
 * LSF_SPLIT_DIRECT, LSF_RANDOM_TEXTURE, LSF_SPECULAR_PARAMS, LSF_TRANSMISSION, LSF_ABSORPTION (there are media), LSF_VOXEL_MIRRORS
 * and those of the libraries. */
#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/path_random.glsl"
#include "lib/pixel_tile.glsl"
#include "lib/sky.glsl"
#include "lib/sparse.glsl"
#include "lib/voxel_sky_lamp.glsl"
#include "lib/voxel_vertex.glsl"
#if LSF_VOXEL_DRAW
#include "lib/voxel_draw.glsl"
#endif

#if LSF_EMISSION && !LSF_ENVIRONMENT
layout(binding = LSF_UNIT_VOXEL_SHINING) uniform usampler3D shining_bricks;
#endif
layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D voxel_radiance;

layout(location = 0) uniform ivec4 lengths; /* bounces, segments, least and most samples */
layout(location = 1) uniform uvec2 iteration;    /* iteration, seed */
#if LSF_VOXEL_DRAW
layout(location = LSF_LOCATION_VOXEL_DRAW) uniform int draws; /* sides of voxels that are drawn at a vertex */
#endif

layout(location = 0) out vec4 irradiance_out;
#if LSF_SPLIT_DIRECT
layout(location = 1) out vec4 direct_irradiance_out;
#endif
#if LSF_SPECULAR
layout(location = 1 + LSF_SPLIT_DIRECT) out vec4 specular_out;
#if LSF_SPLIT_DIRECT
layout(location = 3) out vec4 direct_specular_out;
#endif
#endif

/* The two parts of light that compose takes. */
struct light_parts {
    vec3 irradiance, specular;
};

light_parts indirect, direct; /* sums over the pixel's paths; direct: light found by the first segment */

void add_light(light_parts through, vec3 radiance, bool is_direct)
{
#if LSF_SPLIT_DIRECT
    if (is_direct) {
        direct.irradiance += through.irradiance * radiance;
        direct.specular += through.specular * radiance;
        return;
    }
#endif
    indirect.irradiance += through.irradiance * radiance;
    indirect.specular += through.specular * radiance;
}

/* Transmission from which the diffuse lobe counts for nothing. */
#define CLEAR_LEAST 0.99

/* Whether a voxel that was hit along a direction of that density shows the environment in its lobe: smooth metals do, and
 * clear glass, whose lobe is all that it reflects. */
bool voxel_mirrors_light(surface s, float pdf)
{
#if LSF_TRANSMISSION
    if (s.transmission >= CLEAR_LEAST)
        return true;
#endif
#if LSF_VOXEL_MIRRORS
    return voxel_mirrors(s, pdf);
#else
    return false;
#endif
}

/* The voxel that a path from v hits. The last segment is traced only if there may be emission on it. */
bool trace(path_vertex v, vec3 direction, bool last, out ivec3 cell)
{
    voxel_ray ray;
    bool inside;
    if (!path_ray_begin(v, direction, ray, inside))
        return false;
#if LSF_EMISSION && !LSF_ENVIRONMENT
    if (last && !voxel_ray_passes(ray, shining_bricks))
        return false;
#endif
    return path_ray_meet(ray, inside, cell);
}

/* Throughput for light from a direction: `through` the path so far, times f cos / density. */
light_parts reflect_by(light_parts through, path_vertex v, brdf_value f, float weight, int segment)
{
    if (segment == 0)
        return light_parts(vec3(f.diffuse * weight), f.specular * weight);
    vec3 reflected = brdf_sum(v.s, f) * weight;
    return light_parts(through.irradiance * reflected, through.specular * reflected);
}

#if LSF_EMITTERS
/* Adds light of points drawn on emitters, weighted against segments from v that hit them. */
void add_emitters(light_parts through, path_vertex v, brdf_sampler sampler_of_v, vec3 absorption,
                  path_random_key key, uint index, int segment)
{
    uint count = uint(emitters.y);
    for (uint i = 0u; i < count; i++) {
        emitter_view e;
        float cosine;
        vec2 u = path_random(key, index * count + i, ~uint(segment)).xy;
        if (!emitter_seen_from(v.position, v.s.geometric_normal, v.s.normal, u, e, cosine))
            continue;
        float density = emitters.y * e.density;
        float weight = cosine / density *
                       emitter_share(density, e.chance * brdf_pdf(sampler_of_v, e.direction));
        brdf_value f = brdf_evaluate(v.s, v.view, e.direction, 0.0);
        vec3 radiance = segment == 0 ? e.radiance : e.resolved * e.radiance;
#if LSF_ABSORPTION
        radiance *= left_after(absorption_along(v, e.direction, absorption), e.position - v.position);
#endif
        add_light(reflect_by(through, v, f, weight, segment), radiance, segment == 0);
    }
}

/* Weight of the emission of a voxel that a direction drawn from v with density `pdf` hits. */
float met_share(path_vertex v, vec3 direction, float pdf, ivec3 cell, path_vertex met, vec3 emission)
{
    float drawn = emitter_density_met(v.position, direction, cell, met.position, met.s.geometric_normal,
                                      grid.unit.x * emission);
    return emitter_share(pdf, emitters.y * drawn);
}
#endif

/* What a side of a voxel shines without its emission, if it spreads light as a diffuse surface; `drawn`: the radiance
 * by which the side is drawn. */
vec3 spread_of(ivec3 cell, int side, out vec3 drawn)
{
    vec3 held = texelFetch(voxel_radiance, cell + ivec3(0, 0, side * int(grid.size.z)), 0).rgb;
    drawn = max(held - voxel_emission_drawn(cell, side), 0.0);
    return max(held - voxel_emission_at(cell, side), 0.0);
}

/* The same towards v along the ray that has met it, one of `density` [1/sr] with those of all paths. */
vec3 reflected_of(vec3 spread, path_vertex met, ivec3 cell, int side, path_vertex v, vec3 direction, float density)
{
#if LSF_VOXEL_LAMPS
    return voxel_reflects(spread, met.s, cell, side, v.position, direction, density);
#else
    return spread;
#endif
}

/* What a voxel that mirrors shows of lamps; `sky_lamps`: its share of the environment's (sky_lamp_share). */
vec3 lamps_of(path_vertex met, ivec3 cell, int side, path_vertex v, vec3 direction, float density, float sky_lamps)
{
    vec3 shown = vec3(0.0);
#if LSF_VOXEL_LAMPS
    shown = voxel_shows_lamp(met.s, cell, side, v.position, direction, density);
#endif
#if VOXEL_SKY_LAMPS
    if (sky_lamps > 0.0)
        shown += sky_lamps * sky_lamp_mirrored(met.s, cell, side, v.position, direction, density);
#endif
    return shown;
}

#if LSF_VOXEL_DRAW
/* Density of draws at v that find the side of a voxel along a direction. */
float draw_density(path_vertex v, vec3 direction, ivec3 cell, vec3 drawn)
{
    return float(draws) * voxel_draw_density(v.position, direction, cell, voxel_draw_plane(cell), drawn);
}

/* Adds light that drawn sides of voxels reflect, weighted against segments from v that hit them. */
void add_draws(light_parts through, path_vertex v, brdf_sampler sampler_of_v, vec3 absorption, path_random_key key,
               uint index, int segment, float count)
{
    for (int i = 0; i < draws; i++) {
        vec3 u = path_random(key, index * uint(draws) + uint(i), 0x10000u + uint(segment));
        voxel_drawn drawn;
        /* Pixels of a tile take different parts of the list, others in each iteration. */
        float place = fract((tile_order() + u.x) / 16.0 + tile_number(iteration.y).x + 0.6180339887 * float(iteration.x));
        bool faces = voxel_draw(vec2(place, u.y), v.position, drawn);
        float cosine = dot(v.s.normal, drawn.direction);
        ivec3 cell;
        if (!faces || cosine <= 0.0 || dot(v.s.geometric_normal, drawn.direction) <= 0.0 ||
            !trace(v, drawn.direction, false, cell) || cell != drawn.cell)
            continue;
        int side;
        path_vertex met = vertex_at(cell, v.position, drawn.direction, side);
        float pdf = brdf_pdf(sampler_of_v, drawn.direction);
        if (side != drawn.slice || voxel_mirrors_light(met.s, pdf))
            continue;
        vec3 by, spread = spread_of(cell, side, by);
        float density = pdf + draw_density(v, drawn.direction, cell, by), weight = cosine / density;
        vec3 radiance = reflected_of(spread, met, cell, side, v, drawn.direction, count * density);
        brdf_value f = brdf_evaluate(v.s, v.view, drawn.direction, 0.0);
#if LSF_ABSORPTION
        radiance *= left_after(absorption_along(v, drawn.direction, absorption), met.position - v.position);
#endif
        add_light(reflect_by(through, v, f, weight, segment), grid.unit.x * radiance, false);
    }
}
#endif

/* Draws the next direction from v with density `pdf` and multiplies its weight into `through`. False: no light is
 * reflected from there. A direction through the surface gets density 0, because no other strategy finds its hits. */
bool draw_direction(path_vertex v, brdf_sampler sampler_of_v, vec3 u, int segment,
                    inout light_parts through, out vec3 direction, out float pdf)
{
    pdf = 0.0;
#if LSF_TRANSMISSION
    vec3 weight;
    if (brdf_pass(sampler_of_v, v.s, u, direction, weight)) {
        through.irradiance *= segment == 0 ? vec3(0.0) : weight;
        through.specular *= weight;
        return weight != vec3(0.0) && dot(v.s.geometric_normal, direction) < 0.0;
    }
#endif
    direction = brdf_draw(sampler_of_v, u);
    float cosine = dot(v.s.normal, direction);
    if (cosine <= 0.0 || dot(v.s.geometric_normal, direction) <= 0.0)
        return false;
    brdf_value f = brdf_evaluate(v.s, v.view, direction, 0.0);
    pdf = brdf_pdf(sampler_of_v, direction);
    through = reflect_by(through, v, f, cosine / pdf, segment);
    return true;
}

#if LSF_ENVIRONMENT
/* Radiance of the environment along a direction drawn with density `pdf`, weighted against directions drawn by
 * this radiance: at a visible point, which has `count` paths, by its BRDF, at voxels by the cosine, as in
 * voxel_light. Voxels that mirror find it by their lobe, and by such directions with the share `sky_lamps`. Light
 * through a surface is found by no other strategy. */
vec3 sky_found(path_vertex v, vec3 direction, float pdf, int segment, float count, bool mirrors, float sky_lamps)
{
    vec3 radiance = environment_radiance(direction);
    if (pdf <= 0.0)
        return radiance;
    if (mirrors)
        return mix(radiance, sky_left(radiance, pdf), sky_lamps);
    return sky_left(radiance,
                    segment == 0 ? count * pdf : dot(v.s.normal, direction) / LSF_PI);
}
#endif

/* Traces a path from a visible point of that body: number `index` among those of all iterations, one of
 * `count` of this one. */
void add_path(path_vertex v, seen_body body, path_random_key key, uint index, int count)
{
    light_parts through = light_parts(vec3(1.0), vec3(1.0));
    vec3 absorption = vec3(0.0); /* the camera is in air */
    bool mirrors = false;        /* v shows the environment in its lobe */
    float sky_lamps = 0.0;       /* sky_lamp_share of v */
    for (int segment = 0; segment < lengths.y; segment++) {
        brdf_sampler sampler_of_v = brdf_sampler_of(v.s, v.view, segment == 0);
#if LSF_TRANSMISSION
        /* What a thin wall transmits to the eye is seen where the wall is absent, or scatters it. */
        if (segment == 0 && !v.s.volume)
            sampler_of_v.passing = 0.0;
#endif
#if LSF_EMITTERS
        add_emitters(through, v, sampler_of_v, absorption, key, index, segment);
#endif
#if LSF_VOXEL_DRAW
        if (segment < lengths.x)
            add_draws(through, v, sampler_of_v, absorption, key, index, segment, float(count));
#endif
        vec3 direction;
        float pdf;
        if (!draw_direction(v, sampler_of_v, path_random(key, index, uint(segment)), segment, through,
                            direction, pdf))
            return;
#if LSF_ABSORPTION
        path_vertex far_side;
        if (segment == 0 && path_through_wall(v, direction, body, far_side)) {
            vec3 kept = left_after(absorption_along(v, direction, absorption), far_side.position - v.position);
            through.irradiance *= kept;
            through.specular *= kept;
            v = far_side;
            mirrors = true;
            continue;
        }
#endif
        ivec3 cell = ivec3(0);
        int side = 0;
        bool meets = trace(v, direction, segment == lengths.x, cell);
        path_vertex met = v;
        if (meets)
            met = vertex_at(cell, v.position, direction, side);
#if LSF_ABSORPTION
        path_find_exit(v, direction, meets, cell, side, met);
#endif
        if (!meets) {
#if LSF_ENVIRONMENT
            add_light(through, sky_found(v, direction, pdf, segment, float(count), mirrors, sky_lamps), segment == 0);
#endif
            return;
        }
#if LSF_ABSORPTION
        absorption = absorption_along(v, direction, absorption);
        vec3 left = left_after(absorption, met.position - v.position);
        through.irradiance *= left;
        through.specular *= left;
#endif
        /* The last segment collects emission, with no bounce left to reflect other light; emission at the first
         * hit counts as direct light. */
        mirrors = voxel_mirrors_light(met.s, pdf);
#if VOXEL_SKY_LAMPS
        sky_lamps = mirrors ? sky_lamp_share(met.s, direction, float(count) * pdf) : 0.0;
#endif
        if (segment < lengths.x && mirrors) {
            add_light(through, grid.unit.x * lamps_of(met, cell, side, v, direction, float(count) * pdf, sky_lamps),
                      false);
        } else if (segment < lengths.x) {
            vec3 by, spread = spread_of(cell, side, by);
            float density = pdf;
#if LSF_VOXEL_DRAW
            if (pdf > 0.0)
                density += draw_density(v, direction, cell, by);
#endif
            vec3 radiance = reflected_of(spread, met, cell, side, v, direction, float(count) * density);
            add_light(through, grid.unit.x * (pdf > 0.0 ? pdf / density : 1.0) * radiance, false);
        }
#if LSF_EMISSION
        vec3 emission = voxel_emission_at(cell, side);
#if LSF_EMITTERS
        if (pdf > 0.0)
            emission *= met_share(v, direction, pdf, cell, met, emission);
#endif
        add_light(through, grid.unit.x * emission, segment == 0);
#endif
        if (met.s.unlit)
            return;
        v = met;
    }
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, texel, 0).r;
    uvec4 surface_texel = texelFetch(surface_texture, texel, 0);
    indirect = direct = light_parts(vec3(0.0), vec3(0.0));
    float share = 0.0;
    if (depth != 0.0 && !surface_texel_unlit(surface_texel)) {
        vec2 ndc = position_ndc(texel);
        vec3 position = position_from_depth(ndc, depth);
        path_vertex v;
        v.position = voxel_from_position(position);
        v.s = surface_unpack(surface_texel);
#if LSF_SPECULAR_PARAMS
        specular_params_unpack(texelFetch(specular_params_texture, texel, 0), v.s);
#endif
        v.view = surface_view(v.s, -normalize(view_ray_direction(ndc)));
        seen_body body = seen_body_none();
#if LSF_ABSORPTION
        body = seen_body_of(v, position_pixel(texel), ndc);
#endif
        int count = int(surface_path_count(v.s, vec2(lengths.zw)));
        path_random_key key;
        key.pixel = uint(texel.x) | (uint(texel.y) << 16);
        key.seed = iteration.y;
        key.texel = texel + int(view_depth(depth) * grid.size.w);
        for (int i = 0; i < count; i++)
            add_path(v, body, key, iteration.x * uint(count) + uint(i), count);
        share = 1.0 / float(count);
    }
    irradiance_out = vec4(share * indirect.irradiance, 0.0);
#if LSF_SPLIT_DIRECT
    direct_irradiance_out = vec4(share * direct.irradiance, 0.0);
#endif
#if LSF_SPECULAR
    specular_out = vec4(share * indirect.specular, 0.0);
#if LSF_SPLIT_DIRECT
    direct_specular_out = vec4(share * direct.specular, 0.0);
#endif
#endif
}
