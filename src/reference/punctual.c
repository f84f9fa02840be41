#include "reference/punctual.h"

#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/light.h"

/* Purpose of the random numbers of paths that begin at lights, a pair at each vertex; it is no
 * dimension's number. */
#define JOINED (UINT64_MAX - 1)

static uint32_t joined_seed(const lsf_walk *w)
{
    return lsf_hash(lsf_hash(w->sampler->pixel_seed, JOINED), w->vertex);
}

static float spot_offset(const lsf_light_state *light, float scale)
{
    return -light->cos_outer * scale;
}

/* Intensity in a direction, relative to that along the light's axis. */
static float spot_factor(const lsf_light_state *light, lsf_float3 away)
{
    if (light->type != LSF_LIGHT_SPOT)
        return 1.0f;
    float scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
    float cosine = lsf_f3_dot(lsf_f3_load(light->direction), away);
    return lsf_spot_attenuation(cosine, scale, spot_offset(light, scale));
}

float lsf_punctual_power(const lsf_light_state *light)
{
    float intensity = lsf_f3_luminance(lsf_f3_load(light->intensity));
    if (light->type == LSF_LIGHT_DIRECTIONAL)
        return 0.0f;
    if (light->type == LSF_LIGHT_POINT)
        return 4.0f * LSF_PI * intensity;
    float scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
    return lsf_spot_integral(scale, spot_offset(light, scale)) * intensity;
}

/* A light, seen from a vertex. */
typedef struct sight {
    lsf_float3 direction; /* unit, towards the light */
    float distance;       /* 0: it is far away */
    lsf_float3 radiance;  /* irradiance on a surface that faces it, without occlusion */
    lsf_reference_reflection reflection;
} sight;

/* A light on the other side is seen through a rough thin wall, but not through a medium, because no
 * ray drawn there hits a point. False: the light contributes nothing. */
static bool look_at(const lsf_walk *w, const lsf_light_state *light, sight *s)
{
    *s = (sight){.radiance = lsf_f3_load(light->intensity)};
    float attenuation = 1.0f;
    if (light->type == LSF_LIGHT_DIRECTIONAL) {
        s->direction = lsf_f3_scale(lsf_f3_load(light->direction), -1.0f);
    } else {
        lsf_float3 to = lsf_f3_sub(lsf_f3_load(light->position), w->surface.position);
        s->direction = lsf_f3_normalize_or(to, w->surface.geometric_normal);
        s->distance = lsf_f3_length(to);
        float inverse_range2 = isinf(light->range) ? 0.0f : 1.0f / (light->range * light->range);
        attenuation = lsf_distance_attenuation(lsf_f3_dot(to, to), inverse_range2) *
                      spot_factor(light, lsf_f3_scale(s->direction, -1.0f));
    }
    bool behind = lsf_f3_dot(w->surface.geometric_normal, s->direction) <= 0.0f;
    bool rough_wall = w->surface.transmission > 0.0f && !w->surface.volume &&
                      !lsf_reference_is_clear(&w->surface);
    if (!(attenuation > 0.0f) || (behind && !rough_wall) || !(lsf_f3_max(s->radiance) > 0.0f))
        return false;
    lsf_float3 left = lsf_left_after(lsf_walk_absorption(w, s->direction), s->distance);
    s->radiance = lsf_f3_scale(lsf_f3_mul(s->radiance, left), attenuation);
    s->reflection = lsf_reference_bsdf_evaluate(&w->bsdf, s->direction);
    return s->reflection.pdf > 0.0f;
}

/* A light may lie in a surface, which must not occlude it: rays begin and end at this distance
 * from it. */
static float short_of(lsf_float3 position)
{
    return 0x1p-20f * lsf_f3_max_abs(position);
}

/* Density, per steradian at `x`, with which lsf_add_joined finds y through the light. */
static float joined_pdf(const lsf_reference_world *world, uint32_t index, const sight *s,
                        const lsf_reference_surface *y, lsf_float3 x, lsf_float3 from_x)
{
    const lsf_light_state *light = &world->geometry.state->lights[index];
    if (light->type == LSF_LIGHT_DIRECTIONAL)
        return 0.0f;
    float emitted = 0.25f / LSF_PI;
    if (light->type == LSF_LIGHT_SPOT) {
        float scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
        emitted = spot_factor(light, lsf_f3_scale(s->direction, -1.0f)) /
                  lsf_spot_integral(scale, spot_offset(light, scale));
    }
    lsf_float3 span = lsf_f3_sub(y->position, x);
    float turned = fabsf(lsf_f3_dot(y->geometric_normal, s->direction) /
                         lsf_f3_dot(y->geometric_normal, from_x));
    float chosen = lsf_lit_probability(&world->lights, x, index);
    return chosen * emitted * turned * lsf_f3_dot(span, span) / (s->distance * s->distance);
}

/* Weight of a direction that the walk has drawn and that has hit a surface lit directly: the
 * share that paths from lights do not find. */
static float drawn_share(const lsf_walk *w, uint32_t index, float asked, const sight *s)
{
    const lsf_walk_arrival *arrival = &w->arrival;
    if (!arrival->joined)
        return 1.0f;
    float joined = joined_pdf(w->world, index, s, &w->surface, arrival->from, arrival->direction);
    return lsf_mis_weight(arrival->pdf * asked, joined);
}

void lsf_add_punctual(lsf_walk *w, uint32_t index, float asked)
{
    const lsf_light_state *light = &w->world->geometry.state->lights[index];
    sight s;
    if (!look_at(w, light, &s))
        return;
    lsf_float3 position = lsf_f3_load(light->position);
    lsf_float3 target = lsf_f3_mad(position, s.direction, -short_of(position));
    bool far = light->type == LSF_LIGHT_DIRECTIONAL;
    lsf_float3 radiance = lsf_f3_scale(s.radiance, 1.0f / asked);
    uint32_t walls = 0;
    if (w->world->thin_walls)
        radiance =
            lsf_f3_mul(radiance, lsf_walk_passes(w, s.direction, far ? NULL : &target, &walls));
    else if (!(far ? lsf_walk_reaches_sky(w, s.direction) : lsf_walk_reaches(w, target)))
        return;
    /* Paths from a light do not pass walls. */
    float share = walls == 0 ? drawn_share(w, index, asked, &s) : 1.0f;
    lsf_walk_add_reflected(w, &s.reflection, lsf_f3_scale(radiance, share));
}

/* A direction drawn in proportion to the light's intensity. */
static lsf_float3 draw_emitted(const lsf_light_state *light, const float u[2])
{
    if (light->type != LSF_LIGHT_SPOT)
        return lsf_sample_sphere(u[0], u[1]);
    float scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
    float cosine = lsf_spot_cosine(u[0], scale, spot_offset(light, scale));
    float sine = sqrtf(fmaxf(1.0f - cosine * cosine, 0.0f)), azimuth = 2.0f * LSF_PI * u[1];
    lsf_basis frame = lsf_basis_about(lsf_f3_load(light->direction));
    return lsf_basis_to_world(&frame, lsf_f3(sine * cosf(azimuth), sine * sinf(azimuth), cosine));
}

bool lsf_punctual_begin(const lsf_reference_geometry *geometry, const lsf_light_state *light,
                        const float u[2], lsf_reference_chance chance, lsf_reference_hit *hit)
{
    lsf_float3 position = lsf_f3_load(light->position);
    return lsf_reference_trace(geometry, position, draw_emitted(light, u), short_of(position),
                               light->range, chance, hit);
}

bool lsf_may_join(const lsf_walk *w)
{
    return w->world->lights.bulbs.nodes != NULL && !lsf_walk_is_last(w) &&
           !lsf_reference_is_clear(&w->surface);
}

/* The segment from x to y is treated as if x had drawn it, with the density of the path from the
 * light. */
void lsf_add_joined(lsf_walk *w)
{
    const lsf_reference_world *world = w->world;
    if (!lsf_may_join(w))
        return;
    lsf_light_numbers numbers = {joined_seed(w), w->sampler->index};
    lsf_light_choice choice;
    if (!lsf_lit_draw(&world->lights, w->surface.position, numbers, &choice))
        return;
    const lsf_light_state *light = &world->geometry.state->lights[choice.light];
    const float u[2] = {(float)choice.u[0], (float)choice.u[1]};
    lsf_reference_hit hit;
    if (!lsf_punctual_begin(&world->geometry, light, u, lsf_walk_chance(w), &hit))
        return;
    lsf_float3 y = lsf_reference_hit_position(&world->geometry, &hit);
    lsf_float3 to = lsf_f3_sub(y, w->surface.position);
    float distance = lsf_f3_length(to);
    if (!(distance > 0.0f))
        return;
    lsf_float3 direction = lsf_f3_scale(to, 1.0f / distance);
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f))
        return;
    lsf_walk next = *w;
    lsf_reference_surface surface;
    lsf_reference_surface_init(&surface, &world->geometry, &hit, direction);
    lsf_float3 absorption = lsf_walk_absorption(w, direction);
    float drawn = reflection.pdf;
    lsf_walk_move(&next, &reflection, false, absorption, &surface);
    sight s;
    if (!look_at(&next, light, &s))
        return;
    float joined = joined_pdf(world, choice.light, &s, &surface, w->surface.position, direction);
    lsf_light_receiver there = lsf_walk_receiver(&next);
    float asked = lsf_light_tree_probability(&world->lights.bulbs, &there, lsf_walk_most(&next),
                                             choice.light);
    float weight = drawn / joined * lsf_mis_weight(joined, drawn * asked);
    lsf_float3 target = lsf_ray_origin(&surface, lsf_f3_scale(direction, -1.0f));
    if (!(weight > 0.0f) || !lsf_walk_reaches(w, target))
        return;
    lsf_float3 left = lsf_left_after(absorption, distance);
    lsf_walk_add_reflected(&next, &s.reflection,
                           lsf_f3_scale(lsf_f3_mul(s.radiance, left), weight));
}
