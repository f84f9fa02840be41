#include "view/app.h"

#include "base/base.h"

#include <stdlib.h>
#include <string.h>

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
    viewer->turn = viewer->scene_params.environment_rotation;
    viewer->strength = viewer->scene_params.environment_strength;
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
