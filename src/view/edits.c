/* What its user changes in a scene, so that it can be typed, and done again to the same file. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Intensity of a new light that shows on white from a quarter of the scene away, in squares of its
 * extent. */
#define NEW_LIGHT 0.3f

bool lsf_viewer_begin_edits(lsf_viewer *viewer)
{
    bool good = true;
    for (int kind = 0; kind < LSF_KIND_CAMERA; kind++) {
        uint32_t count = lsf_scene_count(viewer->scene, (lsf_kind)kind);
        free(viewer->edited[kind]);
        viewer->edited[kind] = lsf_alloc((uint64_t)count + 1, sizeof(bool));
        good = good && viewer->edited[kind];
    }
    viewer->node = viewer->light = viewer->material = LSF_NONE;
    viewer->dragged = -1;
    return good;
}

/* --- as text --- */

static void add_numbers(lsf_string *text, const char *kind, uint32_t index, const char *value,
                        const float *numbers, int count)
{
    lsf_string_add(text, "%s/%u/%s=", kind, index, value);
    for (int i = 0; i < count; i++)
        lsf_string_add(text, "%s%.9g", i ? "," : "", (double)numbers[i]);
    lsf_string_add(text, "\n");
}

static void add_node(lsf_string *text, const lsf_scene *scene, uint32_t node)
{
    double matrix[16];
    if (!lsf_scene_get_node(scene, node, matrix, NULL))
        return;
    lsf_string_add(text, "node/%u/matrix=", node);
    for (int i = 0; i < 16; i++)
        lsf_string_add(text, "%s%.17g", i ? "," : "", matrix[i]);
    lsf_string_add(text, "\n");
}

static void add_light(lsf_string *text, const lsf_scene *scene, uint32_t light)
{
    lsf_light_desc desc;
    if (!lsf_scene_get_light(scene, light, &desc, NULL))
        return;
    add_numbers(text, "light", light, "intensity", desc.intensity, 3);
    if (desc.type == LSF_LIGHT_SPOT) {
        add_numbers(text, "light", light, "inner_cone", &desc.inner_cone, 1);
        add_numbers(text, "light", light, "outer_cone", &desc.outer_cone, 1);
    }
}

static void add_material(lsf_string *text, const lsf_scene *scene, uint32_t material)
{
    lsf_material_desc desc;
    if (!lsf_scene_get_material(scene, material, &desc, NULL))
        return;
    add_numbers(text, "material", material, "base_color", desc.base_color, 4);
    add_numbers(text, "material", material, "metallic", &desc.metallic, 1);
    add_numbers(text, "material", material, "roughness", &desc.roughness, 1);
    add_numbers(text, "material", material, "emission", desc.emission, 3);
}

char *lsf_viewer_edits(const lsf_viewer *viewer)
{
    static void (*const adders[])(lsf_string *, const lsf_scene *,
                                  uint32_t) = {[LSF_KIND_NODE] = add_node,
                                               [LSF_KIND_LIGHT] = add_light,
                                               [LSF_KIND_MATERIAL] = add_material};
    lsf_string text = {0};
    lsf_string_add(&text, "%s", "");
    for (uint32_t i = 0; i < viewer->start->edit_count; i++)
        lsf_string_add(&text, "%s\n", viewer->start->edits[i]);
    for (int kind = 0; kind < LSF_KIND_CAMERA; kind++)
        for (uint32_t i = 0; i < lsf_scene_count(viewer->scene, (lsf_kind)kind); i++)
            if (viewer->edited[kind] && viewer->edited[kind][i])
                adders[kind](&text, viewer->scene, i);
    if (text.failed) {
        free(text.text);
        return NULL;
    }
    return text.text;
}

/* Which thing an edit is of; false: one of the start that names it. */
static bool parse(const char *edit, lsf_kind *kind, uint32_t *index)
{
    static const char *const words[] = {"node/", "light/", "material/"};
    for (int k = 0; k < LSF_KIND_CAMERA; k++)
        if (strncmp(edit, words[k], strlen(words[k])) == 0) {
            char *end;
            *kind = (lsf_kind)k;
            *index = (uint32_t)strtoul(edit + strlen(words[k]), &end, 10);
            return *end == '/';
        }
    return false;
}

void lsf_viewer_reload(lsf_viewer *viewer)
{
    lsf_error error;
    char *edits = viewer->scene ? lsf_viewer_edits(viewer) : NULL;
    uint32_t start_edits = viewer->start->edit_count;
    lsf_scene *scene = lsf_scene_load(viewer->paths[viewer->shown], &viewer->scene_params, &error);
    if (!scene) {
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
        free(edits);
        return;
    }
    uint32_t node = viewer->node, light = viewer->light, material = viewer->material;
    lsf_viewer_close_scene(viewer);
    viewer->scene = scene;
    viewer->scene_error = (lsf_error){LSF_OK, ""};
    lsf_viewer_begin_edits(viewer);
    char *rest = edits, *line;
    for (uint32_t i = 0; edits && (line = strsep(&rest, "\n")) != NULL; i++) {
        lsf_kind kind;
        uint32_t index;
        if (*line == '\0')
            continue;
        bool good = lsf_scene_edit(scene, line, &error); /* the file may hold less by now */
        if (i >= start_edits && good && parse(line, &kind, &index))
            viewer->edited[kind][index] = true;
    }
    free(edits);
    viewer->node = node < lsf_scene_count(scene, LSF_KIND_NODE) ? node : LSF_NONE;
    viewer->light = light < lsf_scene_count(scene, LSF_KIND_LIGHT) ? light : LSF_NONE;
    viewer->material = material < lsf_scene_count(scene, LSF_KIND_MATERIAL) ? material : LSF_NONE;
    viewer->duration = lsf_scene_duration(scene);
    viewer->cut = true;
    lsf_viewer_touch_settings(viewer);
}

/* --- edits --- */

static void finish(lsf_viewer *viewer, bool good, lsf_kind kind, uint32_t index,
                   const lsf_error *error)
{
    if (!good)
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error->message);
    else
        viewer->edited[kind][index] = true;
    lsf_viewer_touch(viewer);
}

void lsf_viewer_set_light(lsf_viewer *viewer, uint32_t light, const lsf_light_desc *desc)
{
    lsf_error error;
    lsf_viewer_stop_rival(viewer);
    finish(viewer, lsf_scene_set_light(viewer->scene, light, desc, &error), LSF_KIND_LIGHT, light,
           &error);
}

void lsf_viewer_set_material(lsf_viewer *viewer, uint32_t material, const lsf_material_desc *desc)
{
    lsf_error error;
    lsf_viewer_stop_rival(viewer);
    finish(viewer, lsf_scene_set_material(viewer->scene, material, desc, &error), LSF_KIND_MATERIAL,
           material, &error);
}

/* x with A x = b, by Cramer's rule; A of the columns of a node's transform. */
static void solve(const double a[16], const double b[3], double x[3])
{
    double m[3][3];
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            m[row][column] = a[4 * column + row];
    double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    for (int k = 0; k < 3; k++) {
        double c[3][3];
        memcpy(c, m, sizeof c);
        for (int row = 0; row < 3; row++)
            c[row][k] = b[row];
        x[k] = (c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
                c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
                c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0])) /
               determinant;
    }
}

void lsf_viewer_move_node(lsf_viewer *viewer, uint32_t node, const double by[3])
{
    lsf_error error;
    lsf_node_info info;
    double matrix[16], world[16], local[3] = {by[0], by[1], by[2]};
    lsf_viewer_stop_rival(viewer);
    bool good = lsf_scene_get_node(viewer->scene, node, matrix, &error) &&
                lsf_scene_get_node_info(viewer->scene, node, &info, &error) &&
                (info.parent == LSF_NONE ||
                 lsf_scene_get_node_world(viewer->scene, info.parent, viewer->time, world, &error));
    if (good && info.parent != LSF_NONE)
        solve(world, by, local);
    for (int i = 0; i < 3; i++) {
        matrix[12 + i] += local[i];
        viewer->anchor[i] += by[i];
    }
    good = good && lsf_scene_set_node(viewer->scene, node, matrix, &error);
    finish(viewer, good, LSF_KIND_NODE, node, &error);
}

void lsf_viewer_add_light(lsf_viewer *viewer, const double position[3])
{
    uint32_t count = viewer->scene_params.light_count;
    if (count == LSF_VIEWER_LIGHTS) {
        lsf_viewer_say(viewer, LSF_UI_WARNING, "There are %u lights added already", count);
        return;
    }
    float watts = NEW_LIGHT * viewer->camera.extent * viewer->camera.extent;
    lsf_placed_light *light = &viewer->lights[count];
    *light = (lsf_placed_light){
        .light = {.type = LSF_LIGHT_POINT, .intensity = {watts, watts, watts}, .range = INFINITY},
        .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, (double)(float)position[0],
                   (double)(float)position[1], (double)(float)position[2], 1}};
    viewer->scene_params.lights = viewer->lights;
    viewer->scene_params.light_count++;
    lsf_viewer_reload(viewer);
    lsf_viewer_choose_node(viewer, lsf_scene_count(viewer->scene, LSF_KIND_NODE) - 1);
    viewer->tab = LSF_VIEWER_TAB_SCENE;
    viewer->tab_wanted = true;
}
