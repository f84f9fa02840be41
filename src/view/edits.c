/* The user's edits of a scene, as text, and applied again to the same file. */
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
    viewer->environment_edited = false;
    viewer->node = viewer->light = viewer->material = LSF_NONE;
    viewer->dragged = -1;
    return good;
}

/* --- as text --- */

const char *const lsf_viewer_light_types[] = {[LSF_LIGHT_POINT] = "point",
                                              [LSF_LIGHT_SPOT] = "spot",
                                              [LSF_LIGHT_DIRECTIONAL] = "directional"};

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
    lsf_string_add(text, "light/%u/type=%s\n", light, lsf_viewer_light_types[desc.type]);
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

static void add_environment(lsf_string *text, const lsf_viewer *viewer)
{
    float rotation, strength;
    if (!viewer->environment_edited ||
        !lsf_scene_get_environment(viewer->scene, &rotation, &strength, NULL))
        return;
    lsf_string_add(text, "environment/rotation=%.9g\n", (double)rotation);
    if (strength != 1.0f)
        lsf_string_add(text, "environment/strength=%.9g\n", (double)strength);
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
    add_environment(&text, viewer);
    if (text.failed) {
        free(text.text);
        return NULL;
    }
    return text.text;
}

/* The thing that an edit is of; false: an edit of the command line that names it instead. */
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
        if (i < start_edits || !good)
            continue;
        if (parse(line, &kind, &index))
            viewer->edited[kind][index] = true;
        else
            viewer->environment_edited = true;
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

void lsf_viewer_set_environment(lsf_viewer *viewer, float rotation, float strength)
{
    lsf_error error;
    float before[2];
    lsf_viewer_stop_rival(viewer);
    bool good = lsf_scene_get_environment(viewer->scene, &before[0], &before[1], &error) &&
                (rotation == before[0] ||
                 lsf_scene_set_environment_rotation(viewer->scene, rotation, &error)) &&
                (strength == before[1] ||
                 lsf_scene_set_environment_strength(viewer->scene, strength, &error));
    if (!good)
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
    viewer->environment_edited = viewer->environment_edited || good;
    lsf_viewer_touch(viewer);
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

/* A node's matrix, and its parent's to the scene; the identity where it has none. */
static bool get_matrices(const lsf_viewer *viewer, uint32_t node, double matrix[16],
                         double parent[16], lsf_error *error)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    lsf_node_info info;
    memcpy(parent, identity, sizeof identity);
    return lsf_scene_get_node(viewer->scene, node, matrix, error) &&
           lsf_scene_get_node_info(viewer->scene, node, &info, error) &&
           (info.parent == LSF_NONE ||
            lsf_scene_get_node_world(viewer->scene, info.parent, viewer->time, parent, error));
}

static void apply(const double linear[9], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = linear[3 * i] * v[0] + linear[3 * i + 1] * v[1] + linear[3 * i + 2] * v[2];
}

void lsf_viewer_transform_node(lsf_viewer *viewer, uint32_t node, const double linear[9])
{
    lsf_error error;
    double matrix[16], parent[16];
    const double *anchor = viewer->anchor;
    lsf_viewer_stop_rival(viewer);
    bool good = get_matrices(viewer, node, matrix, parent, &error);
    for (int column = 0; good && column < 4; column++) {
        double *local = matrix + 4 * column, world[3], turned[3];
        for (int i = 0; i < 3; i++) {
            world[i] = parent[i] * local[0] + parent[4 + i] * local[1] + parent[8 + i] * local[2];
            if (column == 3)
                world[i] += parent[12 + i] - anchor[i];
        }
        apply(linear, world, turned);
        for (int i = 0; column == 3 && i < 3; i++)
            turned[i] += anchor[i] - parent[12 + i];
        solve(parent, turned, local);
    }
    good = good && lsf_scene_set_node(viewer->scene, node, matrix, &error);
    finish(viewer, good, LSF_KIND_NODE, node, &error);
}

void lsf_viewer_move_node(lsf_viewer *viewer, uint32_t node, const double by[3])
{
    lsf_error error;
    double matrix[16], parent[16], local[3];
    lsf_viewer_stop_rival(viewer);
    bool good = get_matrices(viewer, node, matrix, parent, &error);
    if (good)
        solve(parent, by, local);
    for (int i = 0; good && i < 3; i++) {
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
