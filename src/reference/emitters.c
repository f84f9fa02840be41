#include "reference/emitters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/surface.h"

/* A textured emitter is sampled at 4 to 64 points, about one for each texel that it covers. */
#define MIN_SAMPLES 4u
#define MAX_SAMPLES 64u

static const lsf_material *material_of(const lsf_reference_geometry *geometry, uint32_t instance)
{
    return &geometry->state->animated.materials[geometry->state->instances[instance].material];
}

static bool emission_varies(const lsf_scene *scene, const lsf_material *material)
{
    if (material->alpha_mode != LSF_ALPHA_OPAQUE)
        return true;
    if (material->unlit)
        return material->base_color_texture.texture != LSF_NONE || scene->vertices.color != NULL;
    return material->emissive_texture.texture != LSF_NONE;
}

/* Number of texels that a triangle covers in its emission's texture. */
static float covered_texels(const lsf_reference_geometry *geometry, const lsf_material *material,
                            uint32_t instance, uint32_t triangle)
{
    const lsf_scene *scene = geometry->scene;
    const lsf_texture_slot *slot =
        material->unlit ? &material->base_color_texture : &material->emissive_texture;
    const float *uv = slot->uv_set == 0 ? scene->vertices.uv0 : scene->vertices.uv1;
    if (slot->texture == LSF_NONE || uv == NULL)
        return (float)MAX_SAMPLES;
    uint64_t v[3];
    lsf_reference_vertices(geometry, instance, triangle, v);
    float ax = uv[2 * v[1]] - uv[2 * v[0]], ay = uv[2 * v[1] + 1] - uv[2 * v[0] + 1];
    float bx = uv[2 * v[2]] - uv[2 * v[0]], by = uv[2 * v[2] + 1] - uv[2 * v[0] + 1];
    const float *m = slot->transform;
    const lsf_texture_image *image = &scene->images[scene->textures[slot->texture].image];
    return 0.5f * fabsf((ax * by - ay * bx) * (m[0] * m[4] - m[1] * m[3])) * (float)image->width *
           (float)image->height;
}

/* Mean luminance over the triangle's front. */
static float mean_emission(const lsf_reference_geometry *geometry, const lsf_material *material,
                           uint32_t instance, uint32_t triangle)
{
    lsf_reference_hit hit = {instance, triangle, 1.0f / 3.0f, 1.0f / 3.0f, 0.0f};
    if (!emission_varies(geometry->scene, material))
        return lsf_f3_luminance(lsf_reference_emission(geometry, &hit, true));
    float texels = covered_texels(geometry, material, instance, triangle);
    uint32_t samples = texels < (float)MAX_SAMPLES ? MIN_SAMPLES + (uint32_t)texels : MAX_SAMPLES;
    float sum = 0.0f;
    for (uint32_t i = 0; i < samples; i++) {
        float u[2];
        lsf_sobol_2d(i, triangle, u);
        lsf_sample_triangle(u[0], u[1], &hit.b1, &hit.b2);
        sum += lsf_f3_luminance(lsf_reference_emission(geometry, &hit, true)) *
               lsf_reference_coverage(geometry, &hit);
    }
    return sum / (float)samples;
}

/* Least mean luminance of a textured emitter, a share of its emission factor: emission that the few
 * samples have missed is then still drawn occasionally. */
static float emission_floor(const lsf_reference_geometry *geometry, const lsf_material *material)
{
    if (!emission_varies(geometry->scene, material))
        return 0.0f;
    const float *factor = material->unlit ? material->base_color : material->emission;
    return 0.01f * lsf_f3_luminance(lsf_f3_load(factor));
}

static uint64_t count_emitters(lsf_reference_emitters *emitters,
                               const lsf_reference_geometry *geometry)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < geometry->state->instance_count; i++) {
        emitters->first[i] = UINT64_MAX;
        if (geometry->meshes[i].triangle_count == 0 ||
            !lsf_reference_material_emits(material_of(geometry, i)))
            continue;
        emitters->first[i] = count;
        count += geometry->meshes[i].triangle_count;
    }
    return count;
}

static void list_emitters(lsf_reference_emitters *emitters, const lsf_reference_geometry *geometry)
{
    uint64_t at = 0;
    for (uint32_t i = 0; i < geometry->state->instance_count; i++) {
        if (emitters->first[i] == UINT64_MAX)
            continue;
        const lsf_material *material = material_of(geometry, i);
        float floor = emission_floor(geometry, material);
        for (uint32_t t = 0; t < geometry->meshes[i].triangle_count; t++, at++) {
            lsf_float3 corners[3];
            lsf_reference_corners(geometry, i, t, corners);
            float area;
            emitters->normal[at] = lsf_reference_triangle_normal(geometry, i, corners, &area);
            emitters->area[at] = area;
            emitters->instance[at] = i;
            emitters->triangle[at] = t;
            float emission = area > 0.0f ? mean_emission(geometry, material, i, t) : 0.0f;
            emitters->intensity[at] = area * fmaxf(emission, floor);
        }
    }
}

bool lsf_reference_emitters_init(lsf_reference_emitters *emitters,
                                 const lsf_reference_geometry *geometry, lsf_error *error)
{
    memset(emitters, 0, sizeof *emitters);
    emitters->first = lsf_alloc(geometry->state->instance_count, sizeof *emitters->first);
    if (emitters->first == NULL)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the list of emitters");
    uint64_t count = count_emitters(emitters, geometry);
    if (count == 0)
        return true;
    emitters->instance = lsf_alloc(count, sizeof *emitters->instance);
    emitters->triangle = lsf_alloc(count, sizeof *emitters->triangle);
    emitters->normal = lsf_alloc(count, sizeof *emitters->normal);
    emitters->area = lsf_alloc(count, sizeof *emitters->area);
    emitters->intensity = lsf_alloc(count, sizeof *emitters->intensity);
    if (emitters->instance == NULL || emitters->triangle == NULL || emitters->normal == NULL ||
        emitters->area == NULL || emitters->intensity == NULL) {
        lsf_reference_emitters_finish(emitters);
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %llu emissive triangles",
                             (unsigned long long)count);
    }
    list_emitters(emitters, geometry);
    emitters->count = count;
    return true;
}

void lsf_reference_emitters_finish(lsf_reference_emitters *emitters)
{
    free(emitters->first);
    free(emitters->instance);
    free(emitters->triangle);
    free(emitters->normal);
    free(emitters->area);
    free(emitters->intensity);
    memset(emitters, 0, sizeof *emitters);
}

lsf_light_bounds lsf_reference_emitter_bounds(const lsf_reference_emitters *emitters,
                                              const lsf_reference_geometry *geometry,
                                              uint64_t index)
{
    uint32_t instance = emitters->instance[index];
    const lsf_material *material = material_of(geometry, instance);
    lsf_float3 corners[3];
    lsf_reference_corners(geometry, instance, emitters->triangle[index], corners);
    lsf_light_bounds bounds = {.cos_spread = 1.0f,
                               .cos_emission = 0.0f,
                               .intensity = emitters->intensity[index],
                               .range = INFINITY,
                               .two_sided = material->double_sided || material->unlit};
    lsf_f3_store(bounds.axis, emitters->normal[index]);
    lsf_f3_store(bounds.low, corners[0]);
    lsf_f3_store(bounds.high, corners[0]);
    for (int i = 1; i < 3; i++) {
        const float corner[3] = {corners[i].x, corners[i].y, corners[i].z};
        for (int axis = 0; axis < 3; axis++) {
            bounds.low[axis] = fminf(bounds.low[axis], corner[axis]);
            bounds.high[axis] = fmaxf(bounds.high[axis], corner[axis]);
        }
    }
    return bounds;
}

lsf_reference_emitter_sample lsf_reference_emitter_draw(const lsf_reference_emitters *emitters,
                                                        const lsf_reference_geometry *geometry,
                                                        uint64_t index, lsf_float3 from,
                                                        const float u[2])
{
    lsf_reference_emitter_sample sample = {.pdf = 0.0f};
    lsf_reference_hit hit = {emitters->instance[index], emitters->triangle[index], 0.0f, 0.0f,
                             0.0f};
    lsf_sample_triangle(u[0], u[1], &hit.b1, &hit.b2);
    lsf_float3 corners[3];
    lsf_reference_corners(geometry, hit.instance, hit.triangle, corners);
    lsf_float3 normal = emitters->normal[index];
    lsf_float3 point = lsf_f3_scale(corners[0], 1.0f - hit.b1 - hit.b2);
    point = lsf_f3_mad(lsf_f3_mad(point, corners[1], hit.b1), corners[2], hit.b2);

    lsf_float3 to = lsf_f3_sub(point, from);
    float distance2 = lsf_f3_dot(to, to);
    if (!(distance2 > 0.0f))
        return sample;
    sample.direction = lsf_f3_scale(to, 1.0f / sqrtf(distance2));
    float cosine = -lsf_f3_dot(normal, sample.direction);
    if (cosine == 0.0f)
        return sample;
    sample.radiance = lsf_f3_scale(lsf_reference_emission(geometry, &hit, cosine > 0.0f),
                                   lsf_reference_coverage(geometry, &hit));
    sample.pdf = distance2 / (emitters->area[index] * fabsf(cosine));
    float offset = copysignf(lsf_reference_ray_offset(corners), cosine);
    sample.target = lsf_f3_mad(point, normal, offset);
    return sample;
}

uint64_t lsf_reference_emitter_of(const lsf_reference_emitters *emitters,
                                  const lsf_reference_hit *hit)
{
    if (emitters->count == 0 || emitters->first[hit->instance] == UINT64_MAX)
        return UINT64_MAX;
    return emitters->first[hit->instance] + hit->triangle;
}

float lsf_reference_emitter_pdf(const lsf_reference_emitters *emitters, uint64_t index,
                                lsf_float3 at, lsf_float3 from, lsf_float3 direction)
{
    lsf_float3 to = lsf_f3_sub(at, from);
    float shown = emitters->area[index] * fabsf(lsf_f3_dot(emitters->normal[index], direction));
    return shown > 0.0f ? lsf_f3_dot(to, to) / shown : 0.0f;
}
