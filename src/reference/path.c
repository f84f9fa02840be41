#include "reference/path.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/bsdf.h"
#include "reference/direct.h"
#include "reference/punctual.h"
#include "reference/walk.h"
#include "scene/environment.h"
#include "shared/brdf.h"

void lsf_reference_pixel_sample(const lsf_reference_sampler *sampler, float point[2])
{
    lsf_sobol_2d(sampler->index, lsf_hash(sampler->pixel_seed, 0), point);
}

bool lsf_reference_world_init(lsf_reference_world *world, const lsf_scene *scene,
                              const lsf_state *state, uint32_t bounces, lsf_error *error)
{
    memset(world, 0, sizeof *world);
    world->bounces = bounces;
    for (uint32_t i = 0; i < scene->material_count; i++)
        world->thin_walls |= lsf_material_is_thin_wall(&state->animated.materials[i]);
    if (!lsf_reference_geometry_init(&world->geometry, scene, state, LSF_REFERENCE_USE_PICTURE,
                                     error))
        return false;
    if (lsf_reference_lights_init(&world->lights, &world->geometry, error))
        return true;
    lsf_reference_world_finish(world);
    return false;
}

void lsf_reference_world_finish(lsf_reference_world *world)
{
    lsf_reference_lights_finish(&world->lights);
    lsf_reference_geometry_finish(&world->geometry);
}

/* Russian roulette by the throughput alone, so that it does not depend on the scene's
 * brightness. */
static bool survives(lsf_walk *w)
{
    if (w->vertex + 1 < LSF_REFERENCE_ROULETTE_VERTEX)
        return true;
    float q = fminf(lsf_f3_max(lsf_f3_add(w->diffuse, w->specular)), 0.95f);
    uint32_t seed = lsf_walk_seed(w, LSF_WALK_ROULETTE);
    if (!(lsf_sobol_1d(w->sampler->index, seed) < q))
        return false;
    w->diffuse = lsf_f3_scale(w->diffuse, 1.0f / q);
    w->specular = lsf_f3_scale(w->specular, 1.0f / q);
    return true;
}

/* The last ray continues through clear walls to light sources behind them. Such walls occlude
 * light samples, so that this ray finds all of that light. */
static void add_behind(lsf_walk *w, const lsf_reference_reflection *reflection,
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
        if (!lsf_reference_trace(&world->geometry, lsf_ray_origin(&wall, direction), direction,
                                 0.0f, INFINITY, lsf_walk_chance(w), &hit)) {
            if (world->lights.sky.environment->present)
                lsf_walk_add_reflected(
                    w, reflection,
                    lsf_f3_mul(left,
                               lsf_environment_radiance(world->lights.sky.environment, direction)));
            return;
        }
        lsf_reference_surface_init(&wall, &world->geometry, &hit, direction);
        if (lsf_f3_max(wall.emission) > 0.0f)
            lsf_walk_add_reflected(w, reflection, lsf_f3_mul(left, wall.emission));
    }
}

/* Density per steradian with which the vertex draws a point that a ray has found. */
static float drawn_pdf(const lsf_walk *w, const lsf_reference_hit *hit, lsf_float3 at,
                       lsf_float3 direction)
{
    const lsf_reference_lights *lights = &w->world->lights;
    uint64_t emitter = lsf_reference_emitter_of(&lights->emitters, hit);
    if (emitter == UINT64_MAX)
        return 0.0f;
    lsf_light_receiver receiver = lsf_walk_receiver(w);
    return lsf_light_tree_probability(&lights->glow, &receiver, 1, (uint32_t)emitter) *
           lsf_reference_emitter_pdf(&lights->emitters, emitter, at, w->surface.position,
                                     direction);
}

/* Follows a direction drawn from the BRDF to the next vertex: adds the light emitted there, then
 * moves the walk on. False when the path ends. */
static bool step(lsf_walk *w)
{
    const lsf_reference_world *world = w->world;
    bool last = lsf_walk_is_last(w), clear = lsf_reference_is_clear(&w->surface);
    if (last && !clear && !lsf_reference_lights_are_met(&world->lights))
        return false;
    uint32_t index = w->sampler->index;
    float lobe = lsf_sobol_1d(index, lsf_walk_seed(w, LSF_WALK_LOBE));
    float u[2];
    lsf_sobol_2d(index, lsf_walk_seed(w, LSF_WALK_DIRECTION), u);
    lsf_float3 direction = lsf_reference_bsdf_sample(&w->bsdf, lobe, u);
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f))
        return false;
    bool crosses = clear && lsf_f3_dot(w->surface.geometric_normal, direction) < 0.0f;
    last = last && !crosses;
    lsf_float3 from = w->surface.position;
    lsf_reference_hit hit;
    if (!lsf_reference_trace(&world->geometry, lsf_ray_origin(&w->surface, direction), direction,
                             0.0f, INFINITY, lsf_walk_chance(w), &hit)) {
        if (world->lights.sky.environment->present) {
            lsf_light_receiver receiver = lsf_walk_receiver(w);
            float other = lsf_sky_probability(&world->lights, &receiver, lsf_walk_most(w));
            if (other > 0.0f)
                other *= lsf_sky_pdf(&world->lights.sky, direction);
            float weight = lsf_mis_weight(reflection.pdf, other) / reflection.pdf;
            lsf_float3 radiance =
                lsf_environment_radiance(world->lights.sky.environment, direction);
            lsf_walk_add_met(w, &reflection, crosses, lsf_f3_scale(radiance, weight));
        }
        return false;
    }
    lsf_float3 absorption = lsf_walk_absorption(w, direction);
    lsf_float3 left = lsf_left_after(absorption, hit.distance);
    reflection.diffuse = lsf_f3_mul(reflection.diffuse, left);
    reflection.specular = lsf_f3_mul(reflection.specular, left);
    lsf_reference_surface next;
    lsf_reference_surface_init(&next, &world->geometry, &hit, direction);
    if (lsf_f3_max(next.emission) > 0.0f) {
        float other = drawn_pdf(w, &hit, next.position, direction);
        float weight = lsf_mis_weight(reflection.pdf, other) / reflection.pdf;
        lsf_walk_add_met(w, &reflection, crosses, lsf_f3_scale(next.emission, weight));
    }
    if (last) {
        if (world->thin_walls)
            add_behind(w, &reflection, next, direction);
        return false;
    }
    w->arrival = (lsf_walk_arrival){lsf_may_join(w), from, direction, reflection.pdf};
    lsf_walk_move(w, &reflection, crosses, absorption, &next);
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
    lsf_walk w = {.world = world, .sampler = sampler, .path = path};
    const lsf_camera_state *camera = &world->geometry.state->camera;
    lsf_float3 origin = camera_vector(camera->start, camera->start_dx, camera->start_dy, ndc);
    /* The ray's direction has a length for which its distance is the depth along the view axis. */
    lsf_float3 along = camera_vector(camera->forward, camera->forward_dx, camera->forward_dy, ndc);
    /* A start that is not the camera's position lies beyond the scene. */
    float before = fminf(camera->near_plane, 0.0f);
    origin = lsf_f3_mad(origin, along, before);
    lsf_float3 direction = lsf_f3_normalize(along);
    lsf_reference_hit hit;
    if (!lsf_reference_see(&world->geometry, origin, along, camera->near_plane - before,
                           lsf_walk_chance(&w), &hit)) {
        path->emission = world->background.environment
                             ? lsf_environment_radiance(world->lights.sky.environment, direction)
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
        lsf_add_direct(&w);
        lsf_add_joined(&w);
        walking = step(&w);
    }
}
