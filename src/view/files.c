#include "view/app.h"

#include "base/base.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

bool lsf_viewer_add_path(lsf_viewer *viewer, const char *path)
{
    char *copy = strdup(path);
    if (!copy || !lsf_grow((void **)&viewer->paths, &viewer->path_capacity,
                           (uint64_t)viewer->path_count + 1, sizeof *viewer->paths)) {
        free(copy);
        return false;
    }
    viewer->paths[viewer->path_count++] = copy;
    return true;
}

void lsf_viewer_close_scene(lsf_viewer *viewer)
{
    lsf_viewer_drop_pictures(viewer);
    lsf_scene_destroy(viewer->scene);
    viewer->scene = NULL;
    viewer->budget_version = 0;
}

/* 0: it is not there. */
static int64_t changed_at(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0)
        return 0;
    return (int64_t)status.st_mtim.tv_sec * 1000000000 + status.st_mtim.tv_nsec;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool load(lsf_viewer *viewer, lsf_error *error)
{
    viewer->scene = lsf_scene_load(viewer->paths[viewer->shown], &viewer->scene_params, error);
    if (!viewer->scene || !lsf_viewer_begin_edits(viewer))
        return false;
    for (uint32_t i = 0; i < viewer->start->edit_count; i++)
        if (!lsf_scene_edit(viewer->scene, viewer->start->edits[i], error))
            return false;
    lsf_render_params params = lsf_viewer_params(viewer, 1024, 768);
    params.camera = viewer->start->render.camera;
    params.camera_position = viewer->start->render.camera_position;
    params.camera_target = viewer->start->render.camera_target;
    params.fov_y = viewer->start->render.fov_y;
    return lsf_viewer_camera_reset(&viewer->camera, viewer->scene, &params, error);
}

void lsf_viewer_show_file(lsf_viewer *viewer, uint32_t index)
{
    lsf_viewer_close_scene(viewer);
    viewer->shown = index;
    viewer->scene_error = (lsf_error){LSF_OK, ""};
    viewer->time = viewer->start->render.time;
    viewer->playing = false;
    viewer->file_camera = 0;
    viewer->scene_params = viewer->start->scene;
    uint32_t lights = viewer->scene_params.light_count;
    viewer->scene_params.light_count = lights < LSF_VIEWER_LIGHTS ? lights : LSF_VIEWER_LIGHTS;
    if (lights > 0)
        memcpy(viewer->lights, viewer->scene_params.lights,
               viewer->scene_params.light_count * sizeof viewer->lights[0]);
    viewer->scene_changed = changed_at(viewer->paths[index]); /* before it is read */
    if (!load(viewer, &viewer->scene_error)) {
        lsf_scene_destroy(viewer->scene);
        viewer->scene = NULL;
    }
    viewer->duration = viewer->scene ? lsf_scene_duration(viewer->scene) : 0.0;
    char title[256];
    lsf_print(title, sizeof title, "%s - Lightsheaf", name_of(viewer->paths[index]));
    lsf_window_set_title(viewer->window, title);
    lsf_viewer_touch(viewer);
}

/* --- files that are let fall on the window --- */

static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

static void set_environment(lsf_viewer *viewer, const char *path)
{
    if (!viewer->scene)
        return;
    lsf_print(viewer->environment, sizeof viewer->environment, "%s", path);
    viewer->scene_params.environment_path = viewer->environment;
    viewer->scene_params.environment_radiance = NULL;
    lsf_viewer_reload(viewer);
}

void lsf_viewer_take_dropped(lsf_viewer *viewer)
{
    uint32_t first = viewer->path_count;
    for (uint32_t i = 0; i < viewer->input->dropped_count; i++) {
        const char *path = viewer->input->dropped[i];
        if (ends_with(path, ".glb") || ends_with(path, ".gltf"))
            lsf_viewer_add_path(viewer, path);
        else if (ends_with(path, ".hdr") || ends_with(path, ".exr"))
            set_environment(viewer, path);
        else
            lsf_viewer_say(viewer, LSF_UI_WARNING,
                           "%s: neither a scene (.glb, .gltf) nor an environment (.hdr, .exr)",
                           name_of(path));
    }
    if (viewer->path_count > first)
        lsf_viewer_show_file(viewer, first);
}

/* --- files that change --- */

/* When the last of the shaders was written. */
static int64_t shaders_changed_at(const char *folder)
{
    static const char *const parts[] = {"shared", "lib", "passes"};
    int64_t last = 0;
    for (size_t i = 0; i < LSF_COUNT(parts); i++) {
        char path[4096];
        lsf_print(path, sizeof path, "%s/%s", folder, parts[i]);
        DIR *files = opendir(path);
        for (struct dirent *file; files && (file = readdir(files)) != NULL;) {
            char name[4608];
            lsf_print(name, sizeof name, "%s/%s", path, file->d_name);
            int64_t at = file->d_name[0] == '.' ? 0 : changed_at(name);
            last = at > last ? at : last;
        }
        if (files)
            closedir(files);
    }
    return last;
}

#define LOOK_EVERY 0.5 /* seconds */

void lsf_viewer_watch(lsf_viewer *viewer)
{
    const char *folder = viewer->start->window.shader_dir;
    if (viewer->path_count == 0 || viewer->input->time - viewer->looked_at < LOOK_EVERY)
        return;
    viewer->looked_at = viewer->input->time;
    int64_t scene = changed_at(viewer->paths[viewer->shown]);
    int64_t shaders = folder ? shaders_changed_at(folder) : 0;
    bool other = viewer->scene_changed != 0 && scene != 0 && scene != viewer->scene_changed;
    if (other && viewer->scene)
        lsf_viewer_reload(viewer);
    else if (other)
        lsf_viewer_show_file(viewer, viewer->shown);
    if (viewer->shaders_changed != 0 && shaders != viewer->shaders_changed) {
        lsf_viewer_drop_pictures(viewer);
        lsf_viewer_touch_settings(viewer);
        lsf_viewer_say(viewer, LSF_UI_TEXT, "Shaders have changed");
    }
    if (other && viewer->scene)
        lsf_viewer_say(viewer, LSF_UI_TEXT, "%s has changed",
                       name_of(viewer->paths[viewer->shown]));
    viewer->scene_changed = scene ? scene : viewer->scene_changed;
    viewer->shaders_changed = shaders;
}

/* --- where nothing is open --- */

void lsf_viewer_start_page(lsf_viewer *viewer)
{
    static const struct {
        const char *file, *name, *help;
    } scenes[] = {
        {"interior.gltf", "Interior", "A furnished room at a low sun, with five lamps"},
        {"cornell_point.gltf", "Cornell box", "Two blocks and a point light"},
        {"cornell_emissive.gltf", "Cornell box, a glowing lamp", "Light from a surface"},
        {"cornell_glossy.gltf", "Cornell box, glossy", "Rough metal and polished blocks"},
        {"cornell_glass.gltf", "Cornell box, glass", "Light through glass"},
    };
    lsf_ui_dialogue_begin("Start", 26.0f);
    lsf_ui_text(LSF_UI_ACCENT, "Lightsheaf");
    lsf_ui_text_wrapped(LSF_UI_TEXT, "Drop a .glb or .gltf here, or start with one of these.");
    lsf_ui_gap();
    for (size_t i = 0; viewer->start->scene_folder && i < LSF_COUNT(scenes); i++) {
        char path[4096];
        bool chosen = lsf_ui_button(scenes[i].name);
        lsf_ui_help(scenes[i].help);
        lsf_print(path, sizeof path, "%s/%s", viewer->start->scene_folder, scenes[i].file);
        if (chosen && lsf_viewer_add_path(viewer, path))
            lsf_viewer_show_file(viewer, viewer->path_count - 1);
    }
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_DIM, "H shows keys and mouse");
    lsf_ui_dialogue_end();
}
