#include "reference/walk.h"

#include "math/sampling.h"

/* Purpose of the random numbers that decide whether rays hit blended surfaces; it is no
 * dimension's number. */
#define CHANCE UINT64_MAX

/* Fraction of its length by which a visibility ray ends before its target, because the target's
 * position is rounded. */
#define REACH (1.0f - 0x1p-22f)

uint32_t lsf_walk_seed(const lsf_walk *w, lsf_walk_dimension dimension)
{
    return lsf_hash(w->sampler->pixel_seed,
                    1u + (uint64_t)w->vertex * LSF_WALK_DIMENSIONS + dimension);
}

lsf_reference_chance lsf_walk_chance(lsf_walk *w)
{
    uint32_t seed = lsf_hash(w->sampler->pixel_seed, CHANCE);
    return (lsf_reference_chance){lsf_hash(seed, w->path->rays++), w->sampler->index};
}

lsf_light_receiver lsf_walk_receiver(const lsf_walk *w)
{
    const lsf_reference_surface *s = &w->surface;
    return (lsf_light_receiver){s->position, s->frame.n, s->transmission > 0.0f};
}

uint32_t lsf_walk_most(const lsf_walk *w)
{
    bool few = w->world->geometry.state->light_count <= LSF_LIGHTS_MOST;
    return few || w->vertex == w->walls ? LSF_LIGHTS_MOST : LSF_LIGHTS_LATER;
}

bool lsf_walk_is_last(const lsf_walk *w)
{
    return w->vertex - w->walls >= w->world->bounces;
}

/* Transmittance of clear walls between the camera and the first vertex behind them, or up to the
 * last of them. */
static lsf_float3 seen_through(const lsf_walk *w)
{
    return w->vertex == 0 ? lsf_f3(1.0f, 1.0f, 1.0f) : w->specular;
}

void lsf_walk_add_reflected(lsf_walk *w, const lsf_reference_reflection *reflection,
                            lsf_float3 radiance)
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

void lsf_walk_add_met(lsf_walk *w, const lsf_reference_reflection *reflection, bool crosses,
                      lsf_float3 radiance)
{
    lsf_reference_path *path = w->path;
    if (!crosses || w->vertex != w->walls) {
        lsf_walk_add_reflected(w, reflection, radiance);
        return;
    }
    lsf_float3 left = lsf_f3_mul(seen_through(w), reflection->specular);
    path->emission = lsf_f3_add(path->emission, lsf_f3_mul(left, radiance));
}

void lsf_walk_move(lsf_walk *w, const lsf_reference_reflection *reflection, bool crosses,
                   lsf_float3 absorption, const lsf_reference_surface *next)
{
    lsf_float3 diffuse = lsf_f3_scale(reflection->diffuse, 1.0f / reflection->pdf);
    lsf_float3 specular = lsf_f3_scale(reflection->specular, 1.0f / reflection->pdf);
    if (w->vertex == w->walls) {
        w->diffuse = lsf_f3_mul(seen_through(w), diffuse);
        w->specular = lsf_f3_mul(seen_through(w), specular);
    } else {
        lsf_float3 both = lsf_f3_add(diffuse, specular);
        w->diffuse = lsf_f3_mul(w->diffuse, both);
        w->specular = lsf_f3_mul(w->specular, both);
    }
    w->absorption = absorption;
    w->surface = *next;
    lsf_reference_bsdf_init(&w->bsdf, &w->surface);
    w->vertex++;
    w->walls += crosses;
}

lsf_float3 lsf_ray_origin(const lsf_reference_surface *s, lsf_float3 direction)
{
    float side = lsf_f3_dot(s->geometric_normal, direction);
    return lsf_f3_mad(s->position, s->geometric_normal, copysignf(s->ray_offset, side));
}

/* Media do not nest: crossing the surface of one leads to air. */
lsf_float3 lsf_walk_absorption(const lsf_walk *w, lsf_float3 direction)
{
    const lsf_reference_surface *s = &w->surface;
    if (!s->volume)
        return w->absorption;
    bool outwards = (lsf_f3_dot(s->geometric_normal, direction) > 0.0f) == s->front;
    return outwards ? lsf_f3(0.0f, 0.0f, 0.0f) : s->absorption;
}

lsf_float3 lsf_left_after(lsf_float3 absorption, float distance)
{
    return lsf_f3(expf(-absorption.x * distance), expf(-absorption.y * distance),
                  expf(-absorption.z * distance));
}

bool lsf_walk_reaches(lsf_walk *w, lsf_float3 target)
{
    lsf_float3 to = lsf_f3_sub(target, w->surface.position);
    lsf_float3 origin = lsf_ray_origin(&w->surface, to);
    return !lsf_reference_occluded(&w->world->geometry, origin, lsf_f3_sub(target, origin), REACH,
                                   lsf_walk_chance(w));
}

bool lsf_walk_reaches_sky(lsf_walk *w, lsf_float3 direction)
{
    return !lsf_reference_occluded(&w->world->geometry, lsf_ray_origin(&w->surface, direction),
                                   direction, INFINITY, lsf_walk_chance(w));
}

lsf_float3 lsf_walk_passes(lsf_walk *w, lsf_float3 direction, const lsf_float3 *target,
                           uint32_t *walls)
{
    const lsf_float3 dark = {0.0f, 0.0f, 0.0f};
    lsf_float3 left = {1.0f, 1.0f, 1.0f}, origin = lsf_ray_origin(&w->surface, direction);
    for (*walls = 0; *walls < LSF_REFERENCE_WALLS; ++*walls) {
        lsf_float3 span = target ? lsf_f3_sub(*target, origin) : direction;
        lsf_reference_hit hit;
        if (!lsf_reference_trace(&w->world->geometry, origin, span, 0.0f, target ? REACH : INFINITY,
                                 lsf_walk_chance(w), &hit))
            return left;
        lsf_reference_surface wall;
        lsf_reference_surface_init(&wall, &w->world->geometry, &hit, direction);
        left = lsf_f3_mul(left, lsf_reference_straight(&wall));
        if (!(lsf_f3_max(left) > 0.0f))
            return dark;
        origin = lsf_ray_origin(&wall, direction);
    }
    return dark;
}
