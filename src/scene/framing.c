/* A point (x, y, z) in the camera's axes, z towards the viewer, is seen by a camera at (c_x, c_y,
 * c_z) when |x - c_x| <= (c_z - z) t_x, and likewise in y. With the supports
 *
 *   a = max (x + z t_x),  b = max (-x + z t_x)
 *
 * over all points this is a <= c_x + c_z t_x and b <= -c_x + c_z t_x: the nearest camera has c_z =
 * (a + b) / 2 t_x, and c_x = (a - b) / 2 centres the picture for every farther one. Of the two
 * directions the one that needs more distance decides. */
#include "scene/framing.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "scene/hierarchy.h"
#include "scene/pose.h"

enum { SUPPORTS = 4 };

/* Vertices visited for exact supports. Beyond that number instances are represented by the
 * corners of their boxes, which can only move the camera back. */
#define EXACT_VISITS_MAX ((uint64_t)1 << 26)

typedef struct frame {
    double directions[SUPPORTS][3]; /* scene space: x + z t_x, -x + z t_x, and the same of y */
    double center[3];               /* positions are relative to it */
    double supports[SUPPORTS];
    uint64_t visits;
} frame;

static void frame_init(frame *f, const lsf_scene *scene, double tangent_x, double tangent_y,
                       const double camera[16])
{
    *f = (frame){0};
    for (int c = 0; c < 3; c++) {
        double x = camera[c], y = camera[4 + c], z = camera[8 + c];
        f->directions[0][c] = x + z * tangent_x;
        f->directions[1][c] = -x + z * tangent_x;
        f->directions[2][c] = y + z * tangent_y;
        f->directions[3][c] = -y + z * tangent_y;
        f->center[c] = scene->requirements.center[c];
    }
    for (int i = 0; i < SUPPORTS; i++)
        f->supports[i] = -INFINITY;
}

static void support(const frame *f, const double *matrix, const double point[3],
                    double supports[SUPPORTS])
{
    double world[3];
    lsf_transform_point(matrix, point, world);
    for (int i = 0; i < SUPPORTS; i++) {
        double along = 0.0;
        for (int c = 0; c < 3; c++)
            along += f->directions[i][c] * (world[c] - f->center[c]);
        supports[i] = fmax(supports[i], along);
    }
}

static void box_supports(const frame *f, const lsf_primitive *primitive, const double *matrix,
                         double supports[SUPPORTS])
{
    for (int i = 0; i < SUPPORTS; i++)
        supports[i] = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int c = 0; c < 3; c++)
            point[c] = corner & (1 << c) ? (double)primitive->bounds_max[c]
                                         : (double)primitive->bounds_min[c];
        support(f, matrix, point, supports);
    }
}

static void add_instance(frame *f, const lsf_scene *scene, const lsf_pose *pose,
                         const lsf_primitive *primitive, const double *matrix)
{
    double box[SUPPORTS];
    box_supports(f, primitive, matrix, box);
    bool inside = true;
    for (int i = 0; i < SUPPORTS; i++)
        inside = inside && box[i] <= f->supports[i];
    if (inside)
        return;
    f->visits += primitive->index_count;
    if (f->visits > EXACT_VISITS_MAX) {
        for (int i = 0; i < SUPPORTS; i++)
            f->supports[i] = fmax(f->supports[i], box[i]);
        return;
    }
    for (uint32_t i = 0; i < primitive->index_count; i++) {
        const float *p =
            pose->vertices.position + 3 * (size_t)scene->indices[primitive->first_index + i];
        support(f, matrix, (const double[]){(double)p[0], (double)p[1], (double)p[2]}, f->supports);
    }
}

static bool add_moments(frame *f, const lsf_scene *scene)
{
    double first, last;
    uint32_t moments = lsf_scene_moments(scene, &first, &last);
    double *matrices = lsf_alloc(scene->node_count, 16 * sizeof *matrices);
    lsf_pose pose = {0};
    bool enough = matrices != NULL;
    for (uint32_t moment = 0; enough && moment < moments; moment++) {
        double time = lsf_moment(moment, moments, first, last);
        lsf_scene_world_matrices(scene, time, matrices);
        enough = lsf_pose_update(&pose, scene, time, matrices);
        for (uint32_t i = 0; enough && i < scene->instance_count; i++) {
            const lsf_primitive *primitive = &pose.primitives[scene->instances[i].primitive];
            if (primitive->index_count > 0)
                add_instance(f, scene, &pose, primitive, lsf_pose_world(&pose, scene, matrices, i));
        }
    }
    lsf_pose_finish(&pose);
    free(matrices);
    return enough;
}

/* An empty scene, or one that is a single point, has no size to frame. */
static bool has_size(const frame *f)
{
    return f->supports[0] + f->supports[1] > 0.0 || f->supports[2] + f->supports[3] > 0.0;
}

double lsf_frame_scene(const lsf_scene *scene, double tangent_x, double tangent_y,
                       double camera[16])
{
    static const lsf_primitive cube = {.bounds_min = {-1, -1, -1}, .bounds_max = {1, 1, 1}};
    frame f;
    frame_init(&f, scene, tangent_x, tangent_y, camera);
    if (!add_moments(&f, scene))
        return -1.0;
    if (!has_size(&f)) {
        const double *c = f.center;
        box_supports(&f, &cube,
                     (const double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, c[0], c[1], c[2], 1},
                     f.supports);
    }
    double x = 0.5 * (f.supports[0] - f.supports[1]), y = 0.5 * (f.supports[2] - f.supports[3]);
    double z = fmax((f.supports[0] + f.supports[1]) / (2.0 * tangent_x),
                    (f.supports[2] + f.supports[3]) / (2.0 * tangent_y));
    for (int c = 0; c < 3; c++)
        camera[12 + c] = f.center[c] + x * camera[c] + y * camera[4 + c] + z * camera[8 + c];
    return z;
}
