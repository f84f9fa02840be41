#include "scene/complete.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/default_light.h"
#include "scene/hierarchy.h"
#include "scene/light_range.h"

/* Coordinates beyond this, in scene units, could overflow a double on their way to the picture. */
#define COORDINATE_MAX 1e100

/* After the file's own cameras, which may show little of the scene, comes one that frames it: a
 * three-quarter view from the front (glTF assets face +z), a little from above, through a lens
 * that does not exaggerate: 45 mm for a picture 24 mm high. */
static bool add_default_camera(lsf_scene *scene)
{
    static const double back[3] = {0.48, 0.36, 0.8}; /* unit */
    double right[3] = {back[2] / hypot(back[0], back[2]), 0.0, -back[0] / hypot(back[0], back[2])};
    double up[3] = {back[1] * right[2], back[2] * right[0] - back[0] * right[2],
                    -back[1] * right[0]};
    lsf_camera *cameras =
        realloc(scene->cameras, ((size_t)scene->camera_count + 1) * sizeof *cameras);
    if (!cameras)
        return false;
    scene->cameras = cameras;
    lsf_camera *camera = &cameras[scene->camera_count];
    *camera = (lsf_camera){.name = strdup("default"),
                           .node = LSF_NONE,
                           .frames_scene = true,
                           .fov_y = (float)(2.0 * atan(12.0 / 45.0)),
                           .x_magnification = 1.0f,
                           .y_magnification = 1.0f};
    for (int c = 0; c < 3; c++) {
        camera->matrix[c] = right[c];
        camera->matrix[4 + c] = up[c];
        camera->matrix[8 + c] = back[c];
    }
    camera->matrix[15] = 1.0;
    scene->camera_count++;
    return camera->name != NULL;
}

static bool check_transforms(const lsf_scene *scene, lsf_error *error)
{
    double *matrices = lsf_alloc(scene->node_count, 16 * sizeof(double));
    if (!matrices)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for %u nodes",
                             scene->path, scene->node_count);
    lsf_scene_world_matrices(scene, 0.0, matrices);
    bool good = true;
    for (uint64_t i = 0; good && i < (uint64_t)16 * scene->node_count; i++)
        if (!(fabs(matrices[i]) <= COORDINATE_MAX))
            good = lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: the transforms above node \"%s\" multiply to more than %g; "
                                 "use smaller scales",
                                 scene->path, scene->nodes[i / 16].name, COORDINATE_MAX);
    free(matrices);
    return good;
}

static bool no_memory(const lsf_scene *scene, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", scene->path);
}

bool lsf_scene_complete(lsf_scene *scene, lsf_default_light default_light, lsf_error *error)
{
    if (!check_transforms(scene, error) || !lsf_bound_radiance(scene, error))
        return false;
    lsf_scene_settle_alpha(scene);
    if (!lsf_scene_compute_requirements(scene))
        return no_memory(scene, error);
    if (!lsf_bound_lights(scene, error))
        return false;
    if (!add_default_camera(scene))
        return no_memory(scene, error);
    return lsf_default_light_add(scene, default_light, error) &&
           (!scene->note_lost || no_memory(scene, error));
}
