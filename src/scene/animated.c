#include "scene/animated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/hierarchy.h"
#include "scene/property.h"

enum { WIDEST = 4 /* values of one property */ };

static bool animates(const lsf_scene *scene, lsf_kind kind)
{
    for (uint32_t i = 0; i < scene->animated_count; i++)
        if (scene->animated[i].property->of == kind)
            return true;
    return false;
}

static void *copy_array(void **own, const void *array, uint32_t count, size_t size)
{
    if (!*own)
        *own = lsf_alloc(count, size);
    if (*own && count > 0)
        memcpy(*own, array, count * size);
    return *own;
}

/* Copies of the scene's materials and lights, where some are animated. */
static bool begin(lsf_animated *a, const lsf_scene *scene)
{
    void *materials = a->own_materials, *lights = a->own_lights;
    bool enough =
        (!animates(scene, LSF_KIND_MATERIAL) ||
         copy_array(&materials, scene->materials, scene->material_count, sizeof(lsf_material))) &&
        (!animates(scene, LSF_KIND_LIGHT) ||
         copy_array(&lights, scene->lights, scene->light_count, sizeof(lsf_light)));
    a->own_materials = materials;
    a->own_lights = lights;
    if (!a->values)
        a->values = lsf_alloc(scene->animated_width, sizeof *a->values);
    if (!a->own_hidden && animates(scene, LSF_KIND_NODE))
        a->own_hidden = lsf_alloc(scene->node_count, sizeof *a->own_hidden);
    a->materials = a->own_materials ? a->own_materials : scene->materials;
    a->lights = a->own_lights ? a->own_lights : scene->lights;
    a->hidden = a->own_hidden;
    return enough && a->values && (a->own_hidden || !animates(scene, LSF_KIND_NODE));
}

/* Sets the nodes' own values, then those of their descendants. */
static void hide_nodes(lsf_animated *a, const lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->node_count; i++)
        a->own_hidden[i] = false;
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        const lsf_animated_value *v = &scene->animated[i];
        if (v->property->of == LSF_KIND_NODE)
            a->own_hidden[v->index] = a->values[v->first] == 0.0;
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        uint32_t parent = scene->nodes[i].parent;
        a->own_hidden[i] = a->own_hidden[i] || (parent != LSF_NONE && a->own_hidden[parent]);
    }
}

bool lsf_animated_update(lsf_animated *a, const lsf_scene *scene, double time)
{
    a->materials = scene->materials;
    a->lights = scene->lights;
    if (scene->animated_count == 0)
        return true;
    if (!begin(a, scene))
        return false;
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        const lsf_animated_value *v = &scene->animated[i];
        double *values = a->values + v->first;
        lsf_curve_sample(&v->curve, time, values);
        if (v->property->of == LSF_KIND_MATERIAL && !scene->materials[v->index].edited)
            lsf_property_set(v, values, &a->own_materials[v->index]);
        if (v->property->of == LSF_KIND_LIGHT && !scene->lights[v->index].edited)
            lsf_property_set(v, values, &a->own_lights[v->index]);
    }
    if (a->own_hidden)
        hide_nodes(a, scene);
    return true;
}

void lsf_animated_finish(lsf_animated *a)
{
    free(a->values);
    free(a->own_materials);
    free(a->own_lights);
    free(a->own_hidden);
    memset(a, 0, sizeof *a);
}

bool lsf_animated_has(const lsf_scene *scene, lsf_kind kind, const lsf_animated *animated,
                      const double *values)
{
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        const lsf_animated_value *v = &scene->animated[i];
        if (v->property->of == kind && memcmp(animated->values + v->first, values + v->first,
                                              v->curve.width * sizeof *values) != 0)
            return false;
    }
    return true;
}

void lsf_animated_set_camera(const lsf_scene *scene, uint32_t index, double time,
                             lsf_camera *camera)
{
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        const lsf_animated_value *v = &scene->animated[i];
        double values[WIDEST];
        if (v->property->of != LSF_KIND_CAMERA || v->index != index)
            continue;
        lsf_curve_sample(&v->curve, time, values);
        lsf_property_set(v, values, camera);
    }
}

/* --- ranges --- */

/* The least and the greatest value of a curve. A cubic segment lies within the hull of its
 * Bezier points: a third of the tangents away from its ends. */
static void find_bounds(const lsf_curve *curve, double low[WIDEST], double high[WIDEST])
{
    bool cubic = curve->interpolation == LSF_CUBIC;
    for (uint32_t c = 0; c < curve->width; c++) {
        low[c] = INFINITY;
        high[c] = -INFINITY;
        for (uint32_t k = 0; k < curve->key_count; k++) {
            const float *key = curve->values + (size_t)k * curve->width * (cubic ? 3 : 1) + c;
            double value = (double)key[cubic ? curve->width : 0], in = 0.0, out = 0.0;
            if (cubic && k > 0)
                in = (double)key[0] / 3.0 * ((double)curve->times[k] - (double)curve->times[k - 1]);
            if (cubic && k + 1 < curve->key_count)
                out = (double)key[2 * curve->width] / 3.0 *
                      ((double)curve->times[k + 1] - (double)curve->times[k]);
            low[c] = fmin(low[c], fmin(value, fmin(value - in, value + out)));
            high[c] = fmax(high[c], fmax(value, fmax(value - in, value + out)));
        }
    }
}

bool lsf_animated_find_range(lsf_animated_range *range, const lsf_scene *scene)
{
    *range = (lsf_animated_range){.materials = {scene->materials, scene->materials},
                                  .lights = {scene->lights, scene->lights}};
    if (scene->animated_count == 0)
        return true;
    range->owned = true;
    bool enough = true;
    for (int end = 0; end < 2; end++) {
        void *materials = NULL, *lights = NULL;
        enough &= copy_array(&materials, scene->materials, scene->material_count,
                             sizeof(lsf_material)) != NULL &&
                  copy_array(&lights, scene->lights, scene->light_count, sizeof(lsf_light)) != NULL;
        range->materials[end] = materials;
        range->lights[end] = lights;
    }
    for (uint32_t i = 0; enough && i < scene->animated_count; i++) {
        const lsf_animated_value *v = &scene->animated[i];
        double ends[2][WIDEST];
        find_bounds(&v->curve, ends[0], ends[1]);
        for (int end = 0; end < 2; end++) {
            if (v->property->of == LSF_KIND_MATERIAL && !scene->materials[v->index].edited)
                lsf_property_set(v, ends[end], &range->materials[end][v->index]);
            if (v->property->of == LSF_KIND_LIGHT && !scene->lights[v->index].edited)
                lsf_property_set(v, ends[end], &range->lights[end][v->index]);
        }
    }
    if (!enough)
        lsf_animated_range_finish(range);
    return enough;
}

void lsf_animated_range_finish(lsf_animated_range *range)
{
    for (int end = 0; range->owned && end < 2; end++) {
        free(range->materials[end]);
        free(range->lights[end]);
    }
    memset(range, 0, sizeof *range);
}
