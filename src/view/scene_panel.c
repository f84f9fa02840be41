/* The tab of the scene: nodes, lights and materials, and what can be changed of them. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

static void label_of(const lsf_viewer *viewer, lsf_kind kind, uint32_t index, char *label,
                     size_t size)
{
    static const char *const words[] = {"node", "light", "material"};
    const char *name = lsf_scene_name(viewer->scene, kind, index);
    if (name && *name)
        lsf_print(label, size, "%.60s##%s%u", name, words[kind], index);
    else
        lsf_print(label, size, "%s %u##%s%u", words[kind], index, words[kind], index);
}

/* --- lists --- */

static int depth_of(const lsf_viewer *viewer, uint32_t node)
{
    lsf_node_info info;
    int depth = 0;
    while (depth < 12 && lsf_scene_get_node_info(viewer->scene, node, &info, NULL) &&
           info.parent != LSF_NONE) {
        node = info.parent;
        depth++;
    }
    return depth;
}

static void node_list(lsf_viewer *viewer)
{
    char label[128];
    lsf_ui_list_begin("nodes", 11.0f);
    for (uint32_t i = 0; i < lsf_scene_count(viewer->scene, LSF_KIND_NODE); i++) {
        lsf_node_info info;
        if (!lsf_scene_get_node_info(viewer->scene, i, &info, NULL))
            continue;
        bool bare = info.mesh == LSF_NONE && info.light == LSF_NONE;
        label_of(viewer, LSF_KIND_NODE, i, label, sizeof label);
        if (lsf_ui_row(label, depth_of(viewer, i), i == viewer->node, bare))
            lsf_viewer_choose_node(viewer, i);
        if (info.light != LSF_NONE)
            lsf_ui_help("carries a light");
    }
    lsf_ui_list_end();
}

static void list(lsf_viewer *viewer, lsf_kind kind, uint32_t *chosen, float lines)
{
    char label[128];
    lsf_ui_list_begin(kind == LSF_KIND_LIGHT ? "lights" : "materials", lines);
    for (uint32_t i = 0; i < lsf_scene_count(viewer->scene, kind); i++) {
        label_of(viewer, kind, i, label, sizeof label);
        if (lsf_ui_row(label, 0, i == *chosen, false))
            *chosen = i;
    }
    lsf_ui_list_end();
}

/* --- what is chosen --- */

static void node_values(lsf_viewer *viewer)
{
    double world[16];
    float position[3], before[3];
    if (!lsf_scene_get_node_world(viewer->scene, viewer->node, viewer->time, world, NULL))
        return;
    for (int i = 0; i < 3; i++)
        position[i] = before[i] = (float)world[12 + i];
    if (lsf_ui_drag("Position", position, 3, 0.004f * viewer->camera.extent, -INFINITY, INFINITY,
                    "%.3f")) {
        double by[3];
        for (int i = 0; i < 3; i++)
            by[i] = (double)position[i] - (double)before[i];
        lsf_viewer_move_node(viewer, viewer->node, by);
    }
    lsf_ui_help("In scene units; or drag the arrows in the picture");
}

/* W/sr become W/m^2, and the other way, as from one extent of the scene away. */
static void change_type(const lsf_viewer *viewer, lsf_light_desc *desc, lsf_light_type type)
{
    float area = viewer->camera.extent * viewer->camera.extent, times = 1.0f;
    if (type == LSF_LIGHT_DIRECTIONAL && desc->type != LSF_LIGHT_DIRECTIONAL)
        times = 1.0f / area;
    if (type != LSF_LIGHT_DIRECTIONAL && desc->type == LSF_LIGHT_DIRECTIONAL)
        times = area;
    for (int i = 0; i < 3; i++)
        desc->intensity[i] *= times;
    if (type == LSF_LIGHT_SPOT && !(desc->outer_cone > 0.0f)) {
        desc->outer_cone = (float)M_PI / 6.0f;
        desc->inner_cone = 0.5f * desc->outer_cone;
    }
    desc->type = type;
}

static void light_values(lsf_viewer *viewer)
{
    lsf_light_desc desc;
    if (!lsf_scene_get_light(viewer->scene, viewer->light, &desc, NULL))
        return;
    int type = (int)desc.type;
    bool changed = lsf_ui_choice("Kind", &type, lsf_viewer_light_types, 3);
    lsf_ui_help(
        "Spot and directional lights shine along their node's axis, which the rings rotate");
    if (changed)
        change_type(viewer, &desc, (lsf_light_type)type);
    float most = fmaxf(desc.intensity[0], fmaxf(desc.intensity[1], desc.intensity[2]));
    float color[3] = {1.0f, 1.0f, 1.0f};
    for (int i = 0; i < 3 && most > 0.0f; i++)
        color[i] = desc.intensity[i] / most;
    changed = lsf_ui_color3("Colour", color) || changed;
    float top = desc.type == LSF_LIGHT_DIRECTIONAL
                    ? 100.0f
                    : 100.0f * viewer->camera.extent * viewer->camera.extent;
    changed = lsf_ui_slider("Intensity", &most, 0.0f, fmaxf(top, most), "%.4g", true) || changed;
    lsf_ui_help(desc.type == LSF_LIGHT_DIRECTIONAL ? "W/m^2 of the brightest colour; 0 is off"
                                                   : "W/sr of the brightest colour; 0 is off");
    if (desc.type == LSF_LIGHT_SPOT) {
        float degrees = desc.outer_cone * (float)(180.0 / M_PI);
        if (lsf_ui_slider("Cone", &degrees, 1.0f, 89.0f, "%.1f°", false)) {
            desc.outer_cone = degrees * (float)(M_PI / 180.0);
            desc.inner_cone = fminf(desc.inner_cone, 0.999f * desc.outer_cone);
            changed = true;
        }
    }
    if (!changed)
        return;
    for (int i = 0; i < 3; i++)
        desc.intensity[i] = most * color[i];
    lsf_viewer_set_light(viewer, viewer->light, &desc);
}

static void material_values(lsf_viewer *viewer)
{
    lsf_material_desc desc;
    if (!lsf_scene_get_material(viewer->scene, viewer->material, &desc, NULL))
        return;
    bool changed = lsf_ui_color3("Base colour", desc.base_color);
    lsf_ui_help("Multiplies the material's texture, if it has one");
    changed = lsf_ui_slider("Metallic", &desc.metallic, 0.0f, 1.0f, "%.2f", false) || changed;
    changed = lsf_ui_slider("Roughness", &desc.roughness, 0.0f, 1.0f, "%.2f", false) || changed;
    float most = fmaxf(desc.emission[0], fmaxf(desc.emission[1], desc.emission[2]));
    float color[3] = {1.0f, 1.0f, 1.0f};
    for (int i = 0; i < 3 && most > 0.0f; i++)
        color[i] = desc.emission[i] / most;
    bool glows = lsf_ui_slider("Emission", &most, 0.0f, fmaxf(100.0f, most), "%.3g", true);
    lsf_ui_help("Radiance of the brightest colour, W/(m^2 sr)");
    if (most > 0.0f)
        glows = lsf_ui_color3("Its colour", color) || glows;
    for (int i = 0; i < 3 && glows; i++)
        desc.emission[i] = most * color[i];
    for (int i = 0; i < 3; i++)
        desc.base_color[i] = fminf(fmaxf(desc.base_color[i], 0.0f), 1.0f);
    if (changed || glows)
        lsf_viewer_set_material(viewer, viewer->material, &desc);
}

static void environment_values(lsf_viewer *viewer, float rotation, float strength)
{
    bool changed = lsf_ui_slider("Turn", &rotation, -180.0f, 180.0f, "%.0f°", false);
    lsf_ui_help("About the vertical axis, anticlockwise seen from above");
    changed = lsf_ui_slider("Strength", &strength, 0.0f, 16.0f, "%.2f", true) || changed;
    lsf_ui_help("Factor of the environment's radiance");
    if (changed)
        lsf_viewer_set_environment(viewer, rotation, fmaxf(strength, 0.0f));
}

void lsf_viewer_scene_tab(lsf_viewer *viewer)
{
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_DIM, "%u nodes, %u lights, %u materials, %llu triangles",
                lsf_scene_count(viewer->scene, LSF_KIND_NODE),
                lsf_scene_count(viewer->scene, LSF_KIND_LIGHT),
                lsf_scene_count(viewer->scene, LSF_KIND_MATERIAL),
                (unsigned long long)lsf_scene_get_requirements(viewer->scene)->triangles);
    if (lsf_ui_section("Nodes", true)) {
        node_list(viewer);
        if (viewer->node != LSF_NONE)
            node_values(viewer);
        else
            lsf_ui_text(LSF_UI_DIM, "Click on something in the picture");
    }
    if (lsf_ui_section("Lights", true)) {
        if (lsf_scene_count(viewer->scene, LSF_KIND_LIGHT) > 0)
            list(viewer, LSF_KIND_LIGHT, &viewer->light, 4.5f);
        if (viewer->light != LSF_NONE)
            light_values(viewer);
        if (lsf_ui_button(viewer->placing ? "Click a surface" : "New light"))
            viewer->placing = !viewer->placing;
        lsf_ui_help("Adds a light slightly above the surface that you click next");
    }
    if (lsf_ui_section("Materials", true)) {
        list(viewer, LSF_KIND_MATERIAL, &viewer->material, 6.0f);
        if (viewer->material != LSF_NONE)
            material_values(viewer);
    }
    float rotation, strength;
    if (lsf_scene_get_environment(viewer->scene, &rotation, &strength, NULL) &&
        lsf_ui_section("Environment", true))
        environment_values(viewer, rotation, strength);
    uint32_t notes = lsf_scene_note_count(viewer->scene);
    if (notes > 0 && lsf_ui_section("Notes", false))
        for (uint32_t i = 0; i < notes; i++)
            lsf_ui_text_wrapped(LSF_UI_DIM, lsf_scene_note(viewer->scene, i));
}
