#include "scene/emitters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "scene/placed_triangle.h"
#include "scene/texture_sample.h"
#include "shared/brdf.h"

/* Number of points whose mean is taken over a triangle where its emission varies. */
#define MEAN_POINTS 32

/* The least mean, as a share of the emission's factor, so that emission which all of these
 * points missed is also drawn now and then. */
#define MEAN_FLOOR 0.01f

typedef struct triangle_point {
    uint64_t vertices[3];
    float weights[3];
} triangle_point;

static const lsf_material *material_of(const lsf_emitters *e, uint32_t instance)
{
    return &e->state->animated.materials[e->state->instances[instance].material];
}

static uint32_t triangle_count(const lsf_emitters *e, uint32_t instance)
{
    const lsf_instance_state *s = &e->state->instances[instance];
    const lsf_material *material = &e->state->animated.materials[s->material];
    bool emits = !material->unlit && lsf_f3_max(lsf_f3_load(material->emission)) > 0.0f;
    return emits && !s->skipped ? e->scene->primitives[s->primitive].index_count / 3 : 0;
}

static triangle_point point_on(const lsf_emitters *e, uint64_t at, float u, float v)
{
    const lsf_primitive *primitive =
        &e->scene->primitives[e->state->instances[e->instance[at]].primitive];
    const uint32_t *indices = e->scene->indices + primitive->first_index + 3 * e->triangle[at];
    triangle_point p = {.vertices = {indices[0], indices[1], indices[2]}};
    lsf_sample_triangle(u, v, &p.weights[1], &p.weights[2]);
    p.weights[0] = 1.0f - p.weights[1] - p.weights[2];
    return p;
}

static lsf_texel sample_slot(const lsf_emitters *e, const lsf_texture_slot *slot,
                             const triangle_point *p)
{
    const float *stream = slot->uv_set == 0 ? e->scene->vertices.uv0 : e->scene->vertices.uv1;
    float uv[2] = {0.0f, 0.0f};
    for (int i = 0; stream && i < 3; i++)
        for (int c = 0; c < 2; c++)
            uv[c] += p->weights[i] * stream[2 * p->vertices[i] + (uint64_t)c];
    return lsf_texture_sample(e->scene, slot, uv);
}

/* The probability that the surface is hit: 0 or 1 unless it is blended. */
static float coverage(const lsf_emitters *e, const lsf_material *material, const triangle_point *p)
{
    if (material->alpha_mode == LSF_ALPHA_OPAQUE)
        return 1.0f;
    float alpha = material->base_color[3], of_vertices = 0.0f;
    if (material->base_color_texture.texture != LSF_NONE)
        alpha *= sample_slot(e, &material->base_color_texture, p).a;
    for (int i = 0; e->scene->vertices.color && i < 3; i++)
        of_vertices += p->weights[i] * e->scene->vertices.color[4 * p->vertices[i] + 3];
    if (e->scene->vertices.color)
        alpha *= of_vertices;
    if (material->alpha_mode == LSF_ALPHA_BLEND)
        return fminf(fmaxf(alpha, 0.0f), 1.0f);
    return alpha < material->alpha_cutoff ? 0.0f : 1.0f;
}

/* Emission where the surface is hit. */
static lsf_float3 emission_at(const lsf_emitters *e, uint64_t at, const triangle_point *p)
{
    const lsf_material *material = material_of(e, e->instance[at]);
    lsf_float3 emission = lsf_f3_load(material->emission);
    if (material->emissive_texture.texture == LSF_NONE)
        return emission;
    lsf_texel t = sample_slot(e, &material->emissive_texture, p);
    return lsf_f3_mul(emission, lsf_f3(t.r, t.g, t.b));
}

static float mean_luminance(const lsf_emitters *e, uint64_t at)
{
    const lsf_material *material = material_of(e, e->instance[at]);
    bool opaque = material->alpha_mode == LSF_ALPHA_OPAQUE;
    float factor = lsf_f3_luminance(lsf_f3_load(material->emission)), sum = 0.0f;
    if (material->emissive_texture.texture == LSF_NONE && opaque)
        return factor;
    for (uint32_t i = 0; i < MEAN_POINTS; i++) {
        float u[2];
        lsf_sobol_2d(i, (uint32_t)at, u);
        triangle_point p = point_on(e, at, u[0], u[1]);
        sum += lsf_f3_luminance(emission_at(e, at, &p)) * coverage(e, material, &p);
    }
    return fmaxf(sum / MEAN_POINTS, MEAN_FLOOR * factor);
}

static float weight_of(const lsf_emitters *e, uint64_t at)
{
    uint32_t instance = e->instance[at];
    float sides = material_of(e, instance)->double_sided ? 2.0f : 1.0f;
    double area = lsf_place_triangle(e->scene, e->state, instance, e->triangle[at]).area;
    return sides * (float)area * e->mean[at];
}

static void list_triangles(lsf_emitters *e)
{
    uint64_t at = 0;
    for (uint32_t i = 0; i < e->state->instance_count; i++) {
        uint32_t count = triangle_count(e, i);
        for (uint32_t t = 0; t < count; t++, at++) {
            e->instance[at] = i;
            e->triangle[at] = t;
            e->mean[at] = mean_luminance(e, at);
            e->weight[at] = weight_of(e, at);
        }
    }
}

bool lsf_emitters_init(lsf_emitters *e, const lsf_scene *scene, const lsf_state *state)
{
    *e = (lsf_emitters){.scene = scene, .state = state};
    for (uint32_t i = 0; i < state->instance_count; i++)
        e->count += triangle_count(e, i);
    e->instance = lsf_alloc(e->count, sizeof *e->instance);
    e->triangle = lsf_alloc(e->count, sizeof *e->triangle);
    e->mean = lsf_alloc(e->count, sizeof *e->mean);
    e->weight = lsf_alloc(e->count, sizeof *e->weight);
    if (!e->instance || !e->triangle || !e->mean || !e->weight)
        return false;
    list_triangles(e);
    return lsf_distribution_init(&e->power, e->weight, e->count);
}

/* Whether the list holds the triangles of exactly those instances that the state draws. */
static bool lists_all(const lsf_emitters *e)
{
    uint64_t at = 0;
    for (uint32_t i = 0; i < e->state->instance_count; i++) {
        uint32_t count = triangle_count(e, i);
        if (count > 0 && (at + count > e->count || e->instance[at] != i))
            return false;
        at += count;
    }
    return at == e->count;
}

bool lsf_emitters_update(lsf_emitters *e, bool materials_edited)
{
    if (materials_edited || !lists_all(e)) {
        const lsf_scene *scene = e->scene;
        const lsf_state *state = e->state;
        lsf_emitters_finish(e);
        return lsf_emitters_init(e, scene, state);
    }
    for (uint64_t at = 0; at < e->count; at++)
        e->weight[at] = weight_of(e, at);
    lsf_distribution_set(&e->power, e->weight);
    return true;
}

void lsf_emitters_finish(lsf_emitters *e)
{
    free(e->instance);
    free(e->triangle);
    free(e->mean);
    free(e->weight);
    lsf_distribution_finish(&e->power);
    memset(e, 0, sizeof *e);
}

float lsf_emitters_power(const lsf_emitters *e)
{
    return LSF_PI * (float)e->power.sum;
}

float lsf_emitters_weight(const lsf_emitters *e)
{
    return e->power.sum > 0.0 ? (float)(1.0 / e->power.sum) : 0.0f;
}

/* A third number in [0, 1), made of the last digits of the first two. */
static float chance_of(const double u[2])
{
    return lsf_random_float((uint64_t)(u[0] * 0x1p32), (uint64_t)(u[1] * 0x1p32));
}

lsf_emitter_sample lsf_emitters_sample(const lsf_emitters *e, const double u[2])
{
    double rest;
    lsf_emitter_sample sample;
    uint64_t at = lsf_distribution_sample(&e->power, u[0], &rest);
    double side = 1.0;
    sample.sides = material_of(e, e->instance[at])->double_sided ? 2 : 1;
    if (sample.sides == 2) {
        side = rest < 0.5 ? 1.0 : -1.0;
        rest = rest < 0.5 ? 2.0 * rest : 2.0 * rest - 1.0;
    }
    triangle_point p = point_on(e, at, (float)rest, (float)u[1]);
    lsf_float3 radiance = lsf_f3(0.0f, 0.0f, 0.0f);
    if (chance_of(u) < coverage(e, material_of(e, e->instance[at]), &p))
        radiance = emission_at(e, at, &p);
    lsf_placed_triangle placed =
        lsf_place_triangle(e->scene, e->state, e->instance[at], e->triangle[at]);
    lsf_placed_triangle_point(&placed, p.weights, sample.position);
    for (int axis = 0; axis < 3; axis++)
        sample.normal[axis] = (float)(side * placed.normal[axis]);
    lsf_f3_store(sample.radiance, radiance);
    sample.density = (float)(e->mean[at] / e->power.sum);
    sample.weight_density = lsf_f3_luminance(radiance) * lsf_emitters_weight(e);
    return sample;
}
