#include "view/camera.h"

#include <math.h>
#include <string.h>

/* A camera that looks straight up or down has no horizontal direction that is up. */
#define STEEPEST (89.9 * M_PI / 180.0)
#define ORBIT_SPEED M_PI /* radians for a drag as long as the picture is high */
#define LOOK_SPEED 1.2
#define ZOOM_STEP 0.88 /* of the distance, for a notch */
#define NEAREST 1e-4   /* distance to the target, in extents */

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    memcpy(out, c, sizeof c);
}

static double normalise(double a[3])
{
    double length = sqrt(dot(a, a));
    for (int i = 0; i < 3 && length > 0.0; i++)
        a[i] /= length;
    return length;
}

static void load(const float from[3], double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = (double)from[i];
}

/* --- spherical coordinates about the vertical axis --- */

typedef struct spherical {
    double azimuth, rise, distance; /* radians, from +z and from the horizon */
} spherical;

static spherical of_offset(const double offset[3])
{
    double flat = hypot(offset[0], offset[2]);
    return (spherical){atan2(offset[0], offset[2]), atan2(offset[1], flat), hypot(flat, offset[1])};
}

static void to_offset(const spherical *d, double offset[3])
{
    double rise = fmax(-STEEPEST, fmin(STEEPEST, d->rise));
    offset[0] = d->distance * cos(rise) * sin(d->azimuth);
    offset[1] = d->distance * sin(rise);
    offset[2] = d->distance * cos(rise) * cos(d->azimuth);
}

/* From the target to the position. */
static spherical back_of(const lsf_viewer_camera *camera)
{
    double position[3], target[3], offset[3];
    load(camera->position, position);
    load(camera->target, target);
    subtract(position, target, offset);
    return of_offset(offset);
}

static void place(lsf_viewer_camera *camera, const double position[3], const double target[3])
{
    for (int i = 0; i < 3; i++) {
        camera->position[i] = (float)position[i];
        camera->target[i] = (float)target[i];
    }
    if (memcmp(camera->position, camera->target, sizeof camera->target) == 0)
        camera->target[2] = nextafterf(camera->target[2], -INFINITY);
    camera->own = true;
}

/* Stands back from the target by that. */
static void stand(lsf_viewer_camera *camera, const spherical *back)
{
    double target[3], position[3];
    load(camera->target, target);
    to_offset(back, position);
    for (int i = 0; i < 3; i++)
        position[i] += target[i];
    place(camera, position, target);
}

/* --- moves --- */

bool lsf_viewer_camera_reset(lsf_viewer_camera *camera, const lsf_scene *scene,
                             const lsf_render_params *params, lsf_error *error)
{
    lsf_view view;
    if (!lsf_render_params_view(scene, params, &view, error))
        return false;
    const lsf_requirements *r = lsf_scene_get_requirements(scene);
    double size[3], middle[3], forward[3], to_middle[3], target[3];
    bool empty = r->bounds_min[0] > r->bounds_max[0];
    subtract(r->bounds_max, r->bounds_min, size);
    camera->extent = empty ? (float)(1.0 / r->scale) : (float)(0.5 * sqrt(dot(size, size)));
    for (int i = 0; i < 3; i++)
        middle[i] = empty ? r->center[i] : 0.5 * (r->bounds_min[i] + r->bounds_max[i]);
    load(view.forward, forward);
    normalise(forward);
    subtract(middle, view.position, to_middle);
    /* What is looked at is as far away as the middle of the scene. */
    double distance = fmax(dot(to_middle, forward), 0.25 * (double)camera->extent);
    for (int i = 0; i < 3; i++)
        target[i] = view.position[i] + distance * forward[i];
    place(camera, view.position, target);
    camera->own = params->camera_position || params->camera_target;
    if (params->camera_target)
        memcpy(camera->target, params->camera_target, sizeof camera->target);
    camera->fov_y = params->fov_y;
    camera->shown_fov_y = view.fov_y;
    camera->shown_height = view.height;
    return true;
}

void lsf_viewer_camera_orbit(lsf_viewer_camera *camera, double dx, double dy)
{
    spherical back = back_of(camera);
    back.azimuth -= ORBIT_SPEED * dx;
    back.rise += ORBIT_SPEED * dy;
    stand(camera, &back);
}

void lsf_viewer_camera_axes(const lsf_viewer_camera *camera, double axes[3][3])
{
    const double up[3] = {0.0, 1.0, 0.0};
    double position[3];
    load(camera->position, position);
    load(camera->target, axes[2]);
    subtract(axes[2], position, axes[2]);
    normalise(axes[2]);
    cross(axes[2], up, axes[0]);
    if (normalise(axes[0]) == 0.0)
        axes[0][0] = 1.0;
    cross(axes[0], axes[2], axes[1]);
}

static void shift(lsf_viewer_camera *camera, const double by[3])
{
    double position[3], target[3];
    load(camera->position, position);
    load(camera->target, target);
    for (int i = 0; i < 3; i++) {
        position[i] += by[i];
        target[i] += by[i];
    }
    place(camera, position, target);
}

/* Half the picture's height where the target is. */
static double half_height(const lsf_viewer_camera *camera)
{
    if (camera->shown_height > 0.0f)
        return 0.5 * (double)camera->shown_height;
    return back_of(camera).distance * tan(0.5 * (double)camera->shown_fov_y * M_PI / 180.0);
}

/* The point under the cursor stays under the cursor. */
void lsf_viewer_camera_pan(lsf_viewer_camera *camera, double dx, double dy)
{
    double axes[3][3], by[3], height = 2.0 * half_height(camera);
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++)
        by[i] = height * (dy * axes[1][i] - dx * axes[0][i]);
    shift(camera, by);
}

void lsf_viewer_camera_look(lsf_viewer_camera *camera, double dx, double dy)
{
    double position[3], target[3], offset[3];
    load(camera->position, position);
    load(camera->target, target);
    subtract(target, position, offset);
    spherical ahead = of_offset(offset);
    ahead.azimuth -= LOOK_SPEED * dx;
    ahead.rise -= LOOK_SPEED * dy;
    to_offset(&ahead, offset);
    for (int i = 0; i < 3; i++)
        target[i] = position[i] + offset[i];
    place(camera, position, target);
}

void lsf_viewer_camera_zoom(lsf_viewer_camera *camera, double notches)
{
    spherical back = back_of(camera);
    if (camera->shown_height > 0.0f) { /* the command has no option for a height: the view
                                        * becomes a perspective one */
        double half = half_height(camera);
        camera->fov_y = (float)(2.0 * atan(half / back.distance) * 180.0 / M_PI);
        camera->shown_fov_y = camera->fov_y;
        camera->shown_height = 0.0f;
    }
    back.distance *= pow(ZOOM_STEP, notches);
    back.distance = fmax(back.distance, NEAREST * (double)camera->extent);
    stand(camera, &back);
}

void lsf_viewer_camera_fly(lsf_viewer_camera *camera, double right, double up, double forward)
{
    double axes[3][3], by[3], extent = (double)camera->extent;
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++)
        by[i] = extent * (right * axes[0][i] + forward * axes[2][i]);
    by[1] += extent * up;
    shift(camera, by);
}

void lsf_viewer_camera_focus(lsf_viewer_camera *camera, const double point[3])
{
    double position[3], offset[3];
    spherical back = back_of(camera);
    load(camera->position, position);
    subtract(position, point, offset);
    back.distance = fmax(sqrt(dot(offset, offset)), NEAREST * (double)camera->extent);
    for (int i = 0; i < 3; i++)
        camera->target[i] = (float)point[i];
    stand(camera, &back);
}

void lsf_viewer_camera_from(lsf_viewer_camera *camera, lsf_viewer_axis axis)
{
    static const double azimuths[] = {0.0, M_PI, 0.5 * M_PI, -0.5 * M_PI, 0.0, 0.0};
    spherical back = back_of(camera);
    back.azimuth = azimuths[axis];
    back.rise = axis == LSF_VIEWER_TOP ? STEEPEST : axis == LSF_VIEWER_BOTTOM ? -STEEPEST : 0.0;
    stand(camera, &back);
}

void lsf_viewer_camera_frame(lsf_viewer_camera *camera, const lsf_requirements *scene,
                             double aspect)
{
    double half = 0.5 * (double)camera->shown_fov_y * M_PI / 180.0;
    if (camera->shown_height > 0.0f || scene->bounds_min[0] > scene->bounds_max[0])
        return;
    spherical back = back_of(camera);
    for (int i = 0; i < 3; i++)
        camera->target[i] = (float)(0.5 * (scene->bounds_min[i] + scene->bounds_max[i]));
    half = fmin(half, atan(aspect * tan(half)));
    back.distance = (double)camera->extent / sin(half); /* of the sphere around the bounds */
    stand(camera, &back);
}

/* --- queries --- */

lsf_view lsf_viewer_camera_view(const lsf_viewer_camera *camera)
{
    lsf_view view = {
        .up = {0.0f, 1.0f, 0.0f}, .fov_y = camera->shown_fov_y, .height = camera->shown_height};
    double axes[3][3];
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++) {
        view.position[i] = (double)camera->position[i];
        view.forward[i] = (float)axes[2][i];
    }
    return view;
}

void lsf_viewer_camera_params(const lsf_viewer_camera *camera, lsf_render_params *params)
{
    params->camera_position = camera->own ? camera->position : NULL;
    params->camera_target = camera->own ? camera->target : NULL;
    params->fov_y = camera->fov_y;
}

void lsf_viewer_camera_ray(const lsf_viewer_camera *camera, double x, double y, double aspect,
                           double origin[3], double direction[3])
{
    double axes[3][3];
    bool flat = camera->shown_height > 0.0f;
    double half = flat ? 0.5 * (double)camera->shown_height
                       : tan(0.5 * (double)camera->shown_fov_y * M_PI / 180.0);
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++) {
        double aside = half * (x * aspect * axes[0][i] + y * axes[1][i]);
        origin[i] = (double)camera->position[i] + (flat ? aside : 0.0);
        direction[i] = axes[2][i] + (flat ? 0.0 : aside);
    }
    normalise(direction);
}

bool lsf_viewer_camera_project(const lsf_viewer_camera *camera, const double point[3],
                               double aspect, double xy[2])
{
    double axes[3][3], position[3], offset[3];
    lsf_viewer_camera_axes(camera, axes);
    load(camera->position, position);
    subtract(point, position, offset);
    double ahead = dot(offset, axes[2]);
    bool flat = camera->shown_height > 0.0f;
    double half = flat ? 0.5 * (double)camera->shown_height
                       : ahead * tan(0.5 * (double)camera->shown_fov_y * M_PI / 180.0);
    if (!flat && ahead <= 1e-6 * (double)camera->extent)
        return false;
    xy[0] = dot(offset, axes[0]) / (half * aspect);
    xy[1] = dot(offset, axes[1]) / half;
    return true;
}
