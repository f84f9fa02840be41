#include "reference/path.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/bsdf.h"
#include "scene/environment.h"
#include "shared/brdf.h"
#include "shared/light.h"

/* Sets of random numbers: one for the pixel, then these for every vertex. */
enum {
    DIMENSION_LIGHT,
    DIMENSION_EMITTER,
    DIMENSION_EMITTER_POINT,
    DIMENSION_SKY,
    DIMENSION_LOBE,
    DIMENSION_DIRECTION,
    DIMENSION_ROULETTE,
    DIMENSIONS_PER_VERTEX,
};

/* Of what decides whether rays meet blended surfaces; no dimension's number. */
#define CHANCE UINT64_MAX

static uint32_t dimension_seed(const lsf_reference_sampler *sampler, uint32_t vertex,
                               uint32_t dimension)
{
    return lsf_hash(sampler->pixel_seed, 1u + (uint64_t)vertex * DIMENSIONS_PER_VERTEX + dimension);
}

void lsf_reference_pixel_sample(const lsf_reference_sampler *sampler, float point[2])
{
    lsf_sobol_2d(sampler->index, lsf_hash(sampler->pixel_seed, 0), point);
}

static bool init_light_power(lsf_reference_world *world, const lsf_state *state, lsf_error *error)
{
    if (state->light_count <= LSF_REFERENCE_ALL_LIGHTS)
        return true;
    float *weights = lsf_alloc(state->light_count, sizeof *weights);
    for (uint32_t i = 0; weights != NULL && i < state->light_count; i++)
        weights[i] = lsf_light_power(&state->lights[i]);
    bool ok =
        weights != NULL && lsf_distribution_init(&world->light_power, weights, state->light_count);
    free(weights);
    return ok || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights",
                               state->light_count);
}

static bool init_sky(lsf_sky *sky, const lsf_environment *environment, lsf_error *error)
{
    return lsf_sky_init(sky, environment) ||
           lsf_error_set(error, LSF_ERROR_RENDER,
                         "out of memory for a %u x %u environment's distribution",
                         environment->width, environment->height);
}

/* Else rays drawn by the BRDF find what there is: nothing, or the same everywhere. */
static bool sky_is_drawn(const lsf_sky *sky)
{
    return sky->weights && sky->mean > 0.0f;
}

bool lsf_reference_world_init(lsf_reference_world *world, const lsf_scene *scene,
                              const lsf_state *state, uint32_t bounces, lsf_error *error)
{
    memset(world, 0, sizeof *world);
    world->bounces = bounces;
    for (uint32_t i = 0; i < scene->material_count; i++)
        world->thin_walls |= lsf_material_is_thin_wall(&scene->materials[i]);
    if (!lsf_reference_geometry_init(&world->geometry, scene, state, LSF_REFERENCE_USE_PICTURE,
                                     error))
        return false;
    if (lsf_reference_emitters_init(&world->emitters, &world->geometry, error) &&
        init_sky(&world->sky, &scene->environment, error) && init_light_power(world, state, error))
        return true;
    lsf_reference_world_finish(world);
    return false;
}

void lsf_reference_world_finish(lsf_reference_world *world)
{
    lsf_distribution_finish(&world->light_power);
    lsf_sky_finish(&world->sky);
    lsf_reference_emitters_finish(&world->emitters);
    lsf_reference_geometry_finish(&world->geometry);
}

/* Power heuristic, exponent 2: E. Veach, "Robust Monte Carlo Methods for Light Transport
 * Simulation", 1997, section 9.2.2. By the ratio, whose square stays in range. */
static float mis_weight(float pdf, float other_pdf)
{
    float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* A path on its way. Throughput is kept apart for the two lobes of the first hit, by which
 * indirect light is split; what the path meets is weighed with their sum. */
typedef struct walk {
    const lsf_reference_world *world;
    const lsf_reference_sampler *sampler;
    lsf_reference_path *path;
    uint32_t vertex; /* 0: the first hit */
    uint32_t walls;  /* clear ones among the vertices before, which are no bounces */
    lsf_float3 diffuse, specular;
    lsf_float3 absorption; /* of the medium that the path last came through; 0: air */
    lsf_reference_surface surface;
    lsf_reference_bsdf bsdf;
} walk;

/* What clear walls leave on the way from the camera to the first vertex behind them, or to the last
 * of them. */
static lsf_float3 seen_through(const walk *w)
{
    return w->vertex == 0 ? lsf_f3(1.0f, 1.0f, 1.0f) : w->specular;
}

/* Adds light that reaches the current vertex and is reflected along the path; `reflection` is
 * weighed by `radiance`, which includes one over the density. */
static void add_reflected(walk *w, const lsf_reference_reflection *reflection, lsf_float3 radiance)
{
    lsf_float3 f = lsf_f3_mul(lsf_f3_add(reflection->diffuse, reflection->specular), radiance);
    lsf_reference_path *path = w->path;
    if (w->vertex == w->walls) {
        path->direct = lsf_f3_add(path->direct, lsf_f3_mul(seen_through(w), f));
        return;
    }
    path->indirect_diffuse = lsf_f3_add(path->indirect_diffuse, lsf_f3_mul(w->diffuse, f));
    path->indirect_specular = lsf_f3_add(path->indirect_specular, lsf_f3_mul(w->specular, f));
}

/* Adds light that a direction drawn at the current vertex met. What shines behind clear walls is
 * seen. */
static void add_met(walk *w, const lsf_reference_reflection *reflection, bool crosses,
                    lsf_float3 radiance)
{
    lsf_reference_path *path = w->path;
    if (!crosses || w->vertex != w->walls) {
        add_reflected(w, reflection, radiance);
        return;
    }
    lsf_float3 left = lsf_f3_mul(seen_through(w), reflection->specular);
    path->emission = lsf_f3_add(path->emission, lsf_f3_mul(left, radiance));
}

/* On the side that the ray leaves to. */
static lsf_float3 ray_origin(const lsf_reference_surface *s, lsf_float3 direction)
{
    float side = lsf_f3_dot(s->geometric_normal, direction);
    return lsf_f3_mad(s->position, s->geometric_normal, copysignf(s->ray_offset, side));
}

/* Absorption of the medium that a ray from the current vertex goes through. A medium ends where its
 * surface is crossed, to air: media do not nest. */
static lsf_float3 absorption_along(const walk *w, lsf_float3 direction)
{
    const lsf_reference_surface *s = &w->surface;
    if (!s->volume)
        return w->absorption;
    bool outwards = (lsf_f3_dot(s->geometric_normal, direction) > 0.0f) == s->front;
    return outwards ? lsf_f3(0.0f, 0.0f, 0.0f) : s->absorption;
}

/* Beer and Lambert's law: what is left of light after a distance. */
static lsf_float3 left_after(lsf_float3 absorption, float distance)
{
    return lsf_f3(expf(-absorption.x * distance), expf(-absorption.y * distance),
                  expf(-absorption.z * distance));
}

/* Of the ray that is to be traced next. */
static lsf_reference_chance next_chance(walk *w)
{
    uint32_t seed = lsf_hash(w->sampler->pixel_seed, CHANCE);
    return (lsf_reference_chance){lsf_hash(seed, w->path->rays++), w->sampler->index};
}

/* A ray that asks for visibility ends so far before its target, of its length: the target is known
 * to no more bits than that. */
#define REACH (1.0f - 0x1p-22f)

/* Nothing between the current vertex and `target`. */
static bool reaches(walk *w, lsf_float3 target)
{
    lsf_float3 to = lsf_f3_sub(target, w->surface.position);
    lsf_float3 origin = ray_origin(&w->surface, to);
    return !lsf_reference_occluded(&w->world->geometry, origin, lsf_f3_sub(target, origin), REACH,
                                   next_chance(w));
}

static bool reaches_sky(walk *w, lsf_float3 direction)
{
    return !lsf_reference_occluded(&w->world->geometry, ray_origin(&w->surface, direction),
                                   direction, INFINITY, next_chance(w));
}

/* What clear walls of glass leave of a punctual light's way to the current vertex, which is free of
 * all else; 0 where it is not. `target` NULL: the light comes from far away along `direction`. */
static lsf_float3 passes(walk *w, lsf_float3 direction, const lsf_float3 *target)
{
    const lsf_float3 dark = {0.0f, 0.0f, 0.0f};
    lsf_float3 left = {1.0f, 1.0f, 1.0f}, origin = ray_origin(&w->surface, direction);
    for (int walls = 0; walls < LSF_REFERENCE_WALLS; walls++) {
        lsf_float3 way = target ? lsf_f3_sub(*target, origin) : direction;
        lsf_reference_hit hit;
        if (!lsf_reference_trace(&w->world->geometry, origin, way, 0.0f, target ? REACH : INFINITY,
                                 next_chance(w), &hit))
            return left;
        lsf_reference_surface wall;
        lsf_reference_surface_init(&wall, &w->world->geometry, &hit, direction);
        left = lsf_f3_mul(left, lsf_reference_straight(&wall));
        if (!(lsf_f3_max(left) > 0.0f))
            return dark;
        origin = ray_origin(&wall, direction);
    }
    return dark;
}

static float spot_factor(const lsf_light_state *light, lsf_float3 to_light)
{
    if (light->type != LSF_LIGHT_SPOT)
        return 1.0f;
    float scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
    float cosine = -lsf_f3_dot(lsf_f3_load(light->direction), to_light);
    return lsf_spot_attenuation(cosine, scale, -light->cos_outer * scale);
}

/* Light of punctual lights passes clear walls straight on, and ends at every other surface, as in
 * shadow maps. Rough walls transmit it to the side that they are seen from; media do not, for no
 * ray that is drawn there finds a point.
 */
static void add_light(walk *w, const lsf_light_state *light, float weight)
{
    lsf_float3 intensity = lsf_f3_scale(lsf_f3_load(light->intensity), weight);
    lsf_float3 position = lsf_f3_load(light->position);
    lsf_float3 direction;
    float attenuation = 1.0f, distance = 0.0f;
    if (light->type == LSF_LIGHT_DIRECTIONAL) {
        direction = lsf_f3_scale(lsf_f3_load(light->direction), -1.0f);
    } else {
        lsf_float3 to = lsf_f3_sub(position, w->surface.position);
        direction = lsf_f3_normalize_or(to, w->surface.geometric_normal);
        distance = lsf_f3_length(to);
        float inverse_range2 = isinf(light->range) ? 0.0f : 1.0f / (light->range * light->range);
        attenuation = lsf_distance_attenuation(lsf_f3_dot(to, to), inverse_range2) *
                      spot_factor(light, direction);
    }
    bool behind = lsf_f3_dot(w->surface.geometric_normal, direction) <= 0.0f;
    bool rough_wall = w->surface.transmission > 0.0f && !w->surface.volume &&
                      !lsf_reference_is_clear(&w->surface);
    if (!(attenuation > 0.0f) || (behind && !rough_wall))
        return;
    intensity = lsf_f3_mul(intensity, left_after(absorption_along(w, direction), distance));
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f))
        return;
    /* A light may lie in a surface, which must not hide it: the ray ends short of it. */
    float short_of = 0x1p-20f * lsf_f3_max_abs(position);
    bool far = light->type == LSF_LIGHT_DIRECTIONAL;
    lsf_float3 target = lsf_f3_mad(position, direction, -short_of);
    if (w->world->thin_walls)
        intensity = lsf_f3_mul(intensity, passes(w, direction, far ? NULL : &target));
    if (w->world->thin_walls || (far ? reaches_sky(w, direction) : reaches(w, target)))
        add_reflected(w, &reflection, lsf_f3_scale(intensity, attenuation));
}

static void add_punctual(walk *w)
{
    const lsf_reference_world *world = w->world;
    const lsf_state *state = world->geometry.state;
    if (world->light_power.count == 0) {
        for (uint32_t i = 0; i < state->light_count; i++)
            add_light(w, &state->lights[i], 1.0f);
    } else if (world->light_power.sum > 0.0) {
        uint32_t seed = dimension_seed(w->sampler, w->vertex, DIMENSION_LIGHT);
        double u = lsf_unit_double(lsf_sobol_1d_bits(w->sampler->index, seed));
        uint64_t i = lsf_distribution_sample(&world->light_power, u, NULL);
        double probability = lsf_distribution_probability(&world->light_power, i);
        add_light(w, &state->lights[i], (float)(1.0 / probability));
    }
}

static void add_emitter(walk *w)
{
    const lsf_reference_world *world = w->world;
    if (world->emitters.count == 0)
        return;
    uint32_t index = w->sampler->index;
    float u[2];
    uint32_t choice =
        lsf_sobol_1d_bits(index, dimension_seed(w->sampler, w->vertex, DIMENSION_EMITTER));
    lsf_sobol_2d(index, dimension_seed(w->sampler, w->vertex, DIMENSION_EMITTER_POINT), u);
    lsf_reference_emitter_sample light = lsf_reference_emitters_sample(
        &world->emitters, &world->geometry, w->surface.position, lsf_unit_double(choice), u);
    if (!(light.pdf > 0.0f) || !(lsf_f3_max(light.radiance) > 0.0f))
        return;
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, light.direction);
    if (!(reflection.pdf > 0.0f) || !reaches(w, light.target))
        return;
    float weight = mis_weight(light.pdf, reflection.pdf) / light.pdf;
    lsf_float3 to = lsf_f3_sub(light.target, w->surface.position);
    lsf_float3 left = left_after(absorption_along(w, light.direction), lsf_f3_length(to));
    add_reflected(w, &reflection, lsf_f3_scale(lsf_f3_mul(light.radiance, left), weight));
}

/* Outside of the scene is air: what comes from there to a medium comes through its surface. */
static void add_sky(walk *w)
{
    const lsf_sky *sky = &w->world->sky;
    if (!sky_is_drawn(sky))
        return;
    uint32_t bits[2];
    lsf_sobol_2d_bits(w->sampler->index, dimension_seed(w->sampler, w->vertex, DIMENSION_SKY),
                      bits);
    double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
    float pdf;
    lsf_float3 direction = lsf_sky_sample(sky, u, &pdf);
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f) || !reaches_sky(w, direction))
        return;
    float weight = mis_weight(pdf, reflection.pdf) / pdf;
    add_reflected(w, &reflection,
                  lsf_f3_scale(lsf_environment_radiance(sky->environment, direction), weight));
}

/* Whether rays that leave a surface can meet something that shines. */
static bool rays_find_light(const lsf_reference_world *world)
{
    return world->emitters.count != 0 || world->geometry.scene->environment.present;
}

/* Russian roulette by the throughput, which does not depend on the scene's brightness. */
static bool survives(walk *w)
{
    if (w->vertex + 1 < LSF_REFERENCE_ROULETTE_VERTEX)
        return true;
    float q = fminf(lsf_f3_max(lsf_f3_add(w->diffuse, w->specular)), 0.95f);
    uint32_t seed = dimension_seed(w->sampler, w->vertex, DIMENSION_ROULETTE);
    if (!(lsf_sobol_1d(w->sampler->index, seed) < q))
        return false;
    w->diffuse = lsf_f3_scale(w->diffuse, 1.0f / q);
    w->specular = lsf_f3_scale(w->specular, 1.0f / q);
    return true;
}

/* The last ray goes on through clear walls to what shines behind them. Walls hide that from points
 * that are drawn: all of it is found so. */
static void add_behind(walk *w, const lsf_reference_reflection *reflection,
                       lsf_reference_surface wall, lsf_float3 direction)
{
    const lsf_reference_world *world = w->world;
    float scale = 1.0f / reflection->pdf;
    lsf_float3 left = {scale, scale, scale};
    for (int walls = 0; walls < LSF_REFERENCE_WALLS; walls++) {
        left = lsf_f3_mul(left, lsf_reference_straight(&wall));
        lsf_reference_hit hit;
        if (!(lsf_f3_max(left) > 0.0f))
            return;
        w->path->rays++;
        if (!lsf_reference_trace(&world->geometry, ray_origin(&wall, direction), direction, 0.0f,
                                 INFINITY, next_chance(w), &hit)) {
            if (world->sky.environment->present)
                add_reflected(
                    w, reflection,
                    lsf_f3_mul(left, lsf_environment_radiance(world->sky.environment, direction)));
            return;
        }
        lsf_reference_surface_init(&wall, &world->geometry, &hit, direction);
        if (lsf_f3_max(wall.emission) > 0.0f)
            add_reflected(w, reflection, lsf_f3_mul(left, wall.emission));
    }
}

/* Follows a direction drawn from the BRDF to the next vertex: adds what shines there, then moves
 * the walk on. False when the path ends. */
static bool step(walk *w)
{
    const lsf_reference_world *world = w->world;
    bool last = w->vertex - w->walls >= world->bounces, clear = lsf_reference_is_clear(&w->surface);
    if (last && !clear && !rays_find_light(world))
        return false;
    uint32_t index = w->sampler->index;
    float lobe = lsf_sobol_1d(index, dimension_seed(w->sampler, w->vertex, DIMENSION_LOBE));
    float u[2];
    lsf_sobol_2d(index, dimension_seed(w->sampler, w->vertex, DIMENSION_DIRECTION), u);
    lsf_float3 direction = lsf_reference_bsdf_sample(&w->bsdf, lobe, u);
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f))
        return false;
    bool crosses = clear && lsf_f3_dot(w->surface.geometric_normal, direction) < 0.0f;
    last = last && !crosses;
    lsf_float3 from = w->surface.position;
    lsf_reference_hit hit;
    if (!lsf_reference_trace(&world->geometry, ray_origin(&w->surface, direction), direction, 0.0f,
                             INFINITY, next_chance(w), &hit)) {
        if (world->sky.environment->present) {
            float other = sky_is_drawn(&world->sky) ? lsf_sky_pdf(&world->sky, direction) : 0.0f;
            float weight = mis_weight(reflection.pdf, other) / reflection.pdf;
            lsf_float3 radiance = lsf_environment_radiance(world->sky.environment, direction);
            add_met(w, &reflection, crosses, lsf_f3_scale(radiance, weight));
        }
        return false;
    }
    w->absorption = absorption_along(w, direction);
    lsf_float3 left = left_after(w->absorption, hit.distance);
    reflection.diffuse = lsf_f3_mul(reflection.diffuse, left);
    reflection.specular = lsf_f3_mul(reflection.specular, left);
    lsf_reference_surface next;
    lsf_reference_surface_init(&next, &world->geometry, &hit, direction);
    if (lsf_f3_max(next.emission) > 0.0f) {
        float other =
            lsf_reference_emitters_pdf(&world->emitters, &world->geometry, &hit, from, direction);
        float weight = mis_weight(reflection.pdf, other) / reflection.pdf;
        add_met(w, &reflection, crosses, lsf_f3_scale(next.emission, weight));
    }
    if (last) {
        if (world->thin_walls)
            add_behind(w, &reflection, next, direction);
        return false;
    }
    lsf_float3 diffuse = lsf_f3_scale(reflection.diffuse, 1.0f / reflection.pdf);
    lsf_float3 specular = lsf_f3_scale(reflection.specular, 1.0f / reflection.pdf);
    if (w->vertex == w->walls) {
        diffuse = lsf_f3_mul(seen_through(w), diffuse);
        specular = lsf_f3_mul(seen_through(w), specular);
    } else {
        lsf_float3 both = lsf_f3_add(diffuse, specular);
        diffuse = lsf_f3_mul(w->diffuse, both);
        specular = lsf_f3_mul(w->specular, both);
    }
    w->surface = next;
    lsf_reference_bsdf_init(&w->bsdf, &w->surface);
    w->diffuse = diffuse;
    w->specular = specular;
    w->vertex++;
    w->walls += crosses;
    return survives(w);
}

static lsf_float3 camera_vector(const float base[3], const float dx[3], const float dy[3],
                                const float ndc[2])
{
    lsf_float3 at_x = lsf_f3_mad(lsf_f3_load(base), lsf_f3_load(dx), ndc[0]);
    return lsf_f3_mad(at_x, lsf_f3_load(dy), ndc[1]);
}

void lsf_reference_trace_path(const lsf_reference_world *world, const float ndc[2],
                              const lsf_reference_sampler *sampler, lsf_reference_path *path)
{
    *path = (lsf_reference_path){.depth = INFINITY};
    walk w = {.world = world, .sampler = sampler, .path = path};
    const lsf_camera_state *camera = &world->geometry.state->camera;
    lsf_float3 origin = camera_vector(camera->start, camera->start_dx, camera->start_dy, ndc);
    /* Its length makes the distance along the ray the depth along the view axis. */
    lsf_float3 along = camera_vector(camera->forward, camera->forward_dx, camera->forward_dy, ndc);
    /* A start that is not the camera's position lies behind the scene. */
    float before = fminf(camera->near_plane, 0.0f);
    origin = lsf_f3_mad(origin, along, before);
    lsf_float3 direction = lsf_f3_normalize(along);
    lsf_reference_hit hit;
    if (!lsf_reference_see(&world->geometry, origin, along, camera->near_plane - before,
                           next_chance(&w), &hit)) {
        path->emission = world->background.environment
                             ? lsf_environment_radiance(world->sky.environment, direction)
                             : lsf_f3_load(world->background.radiance);
        return;
    }
    lsf_reference_surface_init(&w.surface, &world->geometry, &hit, direction);
    lsf_reference_bsdf_init(&w.bsdf, &w.surface);
    path->depth = camera->start_depth + before + hit.distance;
    path->emission = w.surface.emission;
    path->albedo = w.surface.base_color;
    path->normal = w.surface.frame.n;
    bool walking = true;
    while (walking && w.bsdf.specular_probability >= 0.0f) {
        add_punctual(&w);
        add_emitter(&w);
        add_sky(&w);
        walking = step(&w);
    }
}
