#include "scene/state.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "scene/checks.h"
#include "scene/framing.h"
#include "scene/hierarchy.h"
#include "scene/reach.h"
#include "shared/brdf.h"

typedef struct vec3d {
    double x, y, z;
} vec3d;

static vec3d column(const double *matrix, int index)
{
    return (vec3d){matrix[4 * index], matrix[4 * index + 1], matrix[4 * index + 2]};
}

static vec3d cross(vec3d a, vec3d b)
{
    return (vec3d){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(vec3d a, vec3d b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec3d scaled(vec3d a, double factor)
{
    return (vec3d){a.x * factor, a.y * factor, a.z * factor};
}

/* Unit vector along `a`, or `fallback` when `a` has no direction. */
static vec3d unit(vec3d a, vec3d fallback)
{
    double largest = fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
    if (!(largest > 0.0) || !isfinite(largest))
        return fallback;
    a = (vec3d){a.x / largest, a.y / largest, a.z / largest}; /* no under- or overflow below */
    return scaled(a, 1.0 / sqrt(dot(a, a)));
}

/* Some unit vector perpendicular to the unit vector `a`. */
static vec3d perpendicular(vec3d a)
{
    vec3d axis = fabs(a.x) < 0.6 ? (vec3d){1, 0, 0} : (vec3d){0, 1, 0};
    return unit(cross(a, axis), (vec3d){0, 0, 1});
}

static void store(float out[3], vec3d a)
{
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}

static vec3d normalised_position(const lsf_state *state, vec3d position)
{
    return (vec3d){(position.x - state->center[0]) * state->scale,
                   (position.y - state->center[1]) * state->scale,
                   (position.z - state->center[2]) * state->scale};
}

/* Bounds of the transformed box: conservative for the primitive inside it. */
static void transform_bounds(lsf_instance_state *instance, const lsf_primitive *primitive)
{
    for (int row = 0; row < 3; row++) {
        const float *m = instance->transform + 4 * row;
        float low = m[3], high = m[3];
        for (int axis = 0; axis < 3; axis++) {
            float a = m[axis] * primitive->bounds_min[axis];
            float b = m[axis] * primitive->bounds_max[axis];
            low += fminf(a, b);
            high += fmaxf(a, b);
        }
        instance->bounds_min[row] = low;
        instance->bounds_max[row] = high;
    }
}

static void update_instance(lsf_instance_state *out, const lsf_state *state,
                            const lsf_instance *instance, const double *world)
{
    vec3d x = column(world, 0), y = column(world, 1), z = column(world, 2);
    vec3d position = normalised_position(state, column(world, 3));
    const double rows[3][4] = {
        {x.x, y.x, z.x, position.x}, {x.y, y.y, z.y, position.y}, {x.z, y.z, z.z, position.z}};
    for (int row = 0; row < 3; row++) {
        for (int axis = 0; axis < 3; axis++)
            out->transform[4 * row + axis] = (float)(rows[row][axis] * state->scale);
        out->transform[4 * row + 3] = (float)rows[row][3];
    }
    /* The inverse transpose is the cofactor matrix over the determinant; only its sign matters
     * once normals are normalised, and the cofactors exist for a flattened instance too. */
    vec3d cofactor[3] = {cross(y, z), cross(z, x), cross(x, y)}; /* columns */
    double determinant = dot(x, cofactor[0]);
    double largest = 0.0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest,
                       fmax(fabs(cofactor[i].x), fmax(fabs(cofactor[i].y), fabs(cofactor[i].z))));
    double sign = determinant < 0.0 ? -1.0 : 1.0;
    double factor = largest > 0.0 && isfinite(largest) ? sign / largest : 0.0;
    for (int axis = 0; axis < 3; axis++) {
        out->normal_transform[axis] = (float)(cofactor[axis].x * factor);
        out->normal_transform[3 + axis] = (float)(cofactor[axis].y * factor);
        out->normal_transform[6 + axis] = (float)(cofactor[axis].z * factor);
    }
    const lsf_primitive *primitive = &state->pose.primitives[instance->primitive];
    out->primitive = instance->primitive;
    out->material = primitive->material;
    out->mirrored = determinant < 0.0;
    out->skipped = factor == 0.0 || primitive->index_count == 0 ||
                   (state->animated.hidden && state->animated.hidden[instance->node]);
    transform_bounds(out, primitive);
    for (int axis = 0; axis < 3; axis++)
        if (!isfinite(out->bounds_min[axis]) || !isfinite(out->bounds_max[axis]))
            out->skipped = true;
}

static void update_bounds(lsf_state *state)
{
    for (int axis = 0; axis < 3; axis++) {
        state->bounds_min[axis] = INFINITY;
        state->bounds_max[axis] = -INFINITY;
    }
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        for (int axis = 0; !instance->skipped && axis < 3; axis++) {
            state->bounds_min[axis] = fminf(state->bounds_min[axis], instance->bounds_min[axis]);
            state->bounds_max[axis] = fmaxf(state->bounds_max[axis], instance->bounds_max[axis]);
        }
    }
}

static void update_light(lsf_light_state *out, const lsf_state *state, const lsf_light *light,
                         const double *world)
{
    vec3d direction = unit(scaled(column(world, 2), -1.0), (vec3d){0, 0, -1});
    vec3d along = column(world, 0);
    along = (vec3d){along.x - dot(along, direction) * direction.x,
                    along.y - dot(along, direction) * direction.y,
                    along.z - dot(along, direction) * direction.z};
    out->type = light->type;
    store(out->position, normalised_position(state, column(world, 3)));
    store(out->direction, direction);
    store(out->tangent, unit(along, perpendicular(direction)));
    /* E = I / d^2 must stay what it was when d is scaled. */
    double factor = light->type == LSF_LIGHT_DIRECTIONAL ? 1.0 : state->scale * state->scale;
    for (int i = 0; i < 3; i++)
        out->intensity[i] = (float)(light->intensity[i] * factor);
    lsf_store_light(out->intensity, out->intensity, 1.0);
    out->range = (float)(light->range * state->scale);
    out->cos_inner = (float)cos(light->inner_cone);
    out->cos_outer = (float)cos(light->outer_cone);
}

/* Brought into the form of a file's light that a node carries. */
static void update_key_light(lsf_light_state *out, const lsf_state *state, const lsf_key_light *key)
{
    float e = key->irradiance;
    lsf_light light = {.type = LSF_LIGHT_DIRECTIONAL, .intensity = {e, e, e}, .range = INFINITY};
    vec3d back = scaled((vec3d){key->direction[0], key->direction[1], key->direction[2]}, -1.0);
    vec3d right = perpendicular(back), up = cross(back, right);
    const double world[16] = {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0,
                              back.x,  back.y,  back.z,  0, 0,    0,    0,    1};
    update_light(out, state, &light, world);
}

static void update_default_lamp(lsf_light_state *out, const lsf_state *state,
                                const lsf_default_lamp *lamp)
{
    float i = lamp->intensity;
    const double *p = lamp->position;
    lsf_light light = {.type = LSF_LIGHT_POINT, .intensity = {i, i, i}, .range = INFINITY};
    const double world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, p[0], p[1], p[2], 1};
    update_light(out, state, &light, world);
}

static bool update_lights(lsf_state *state, const lsf_scene *scene, const double *worlds)
{
    uint32_t count = scene->key_light.present + scene->default_lamp.present, at = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        count += scene->nodes[i].light != LSF_NONE;
    if (count != state->light_count || (count && !state->lights)) {
        free(state->lights);
        state->lights = lsf_alloc(count, sizeof *state->lights);
        state->light_count = state->lights ? count : 0;
        if (!state->lights)
            return false;
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        uint32_t light = scene->nodes[i].light;
        if (light == LSF_NONE)
            continue;
        update_light(&state->lights[at], state, &state->animated.lights[light],
                     worlds + 16 * (size_t)i);
        if (state->animated.hidden && state->animated.hidden[i])
            memset(state->lights[at].intensity, 0, sizeof state->lights[at].intensity);
        at++;
    }
    if (scene->key_light.present)
        update_key_light(&state->lights[at++], state, &scene->key_light);
    if (scene->default_lamp.present)
        update_default_lamp(&state->lights[at], state, &scene->default_lamp);
    return true;
}

/* Index of the camera named or numbered `which`; -1 when there is none. A name goes first. */
static int find_camera(const lsf_scene *scene, const char *which)
{
    if (!which)
        return 0;
    for (uint32_t i = 0; i < scene->camera_count; i++)
        if (scene->cameras[i].name && strcmp(scene->cameras[i].name, which) == 0)
            return (int)i;
    char *end;
    long index = strtol(which, &end, 10);
    if (end != which && *end == '\0' && index >= 0 && index < (long)scene->camera_count)
        return (int)index;
    return -1;
}

static bool no_such_camera(const lsf_scene *scene, const char *which, lsf_error *error)
{
    enum { LISTED = 8 };
    lsf_string names = {0};
    for (uint32_t i = 0; i < scene->camera_count && i < LISTED; i++)
        lsf_string_add(&names, "%s%u \"%s\"", i ? ", " : "", i,
                       scene->cameras[i].name ? scene->cameras[i].name : "");
    lsf_error_set(error, LSF_ERROR_USAGE, "camera '%s' is not in the scene, which has %s%s", which,
                  names.text ? names.text : "others",
                  scene->camera_count > LISTED ? " and more; `lightsheaf info` lists them" : "");
    free(names.text);
    return false;
}

/* How far the camera may be from the nearest of the scene, in depths of the scene, before depths
 * are counted from the far plane. Positions are rounded by what they are counted from. */
#define FAR_AWAY 4.0

/* What the near and the far plane leave to the scene on each side, in half extents of it. */
#define PLANE_ROOM 1e-3

/* Farthest camera, in half extents: doubles round its distance (2^-53) by as much as floats round
 * positions (2^-24). */
#define FARTHEST_CAMERA 0x1p29

/* The lowest picture, in half extents: 16 roundings of a position, which is noise. */
#define LOWEST_PICTURE 0x1p-20

/* Depths between which the scene lies, seen from its centre; of an empty scene, that of the centre.
 */
static void scene_depths(const lsf_state *state, vec3d forward, double *nearest, double *farthest)
{
    bool empty = state->bounds_min[0] > state->bounds_max[0];
    *nearest = empty ? 0.0 : INFINITY;
    *farthest = empty ? 0.0 : -INFINITY;
    for (int corner = 0; corner < 8 && !empty; corner++) {
        vec3d p = {(corner & 1 ? state->bounds_max : state->bounds_min)[0],
                   (corner & 2 ? state->bounds_max : state->bounds_min)[1],
                   (corner & 4 ? state->bounds_max : state->bounds_min)[2]};
        *nearest = fmin(*nearest, dot(p, forward));
        *farthest = fmax(*farthest, dot(p, forward));
    }
}

/* The camera as placed for a picture of that aspect. A field of view that is given zooms from
 * there. */
static bool frame_scene(lsf_state *state, const lsf_scene *scene, lsf_camera *camera, float aspect)
{
    if (state->framed_aspect == aspect && state->framed_edits == scene->edits.nodes) {
        *camera = state->framed;
        return true;
    }
    /* Of the picture's width and height, what the scene may fill. */
    static const double filled = 0.95;
    double tangent = filled * tan(0.5 * (double)camera->fov_y);
    double distance = lsf_frame_scene(scene, tangent * (double)aspect, tangent, camera->matrix);
    camera->near_plane = fmaxf((float)(1e-3 * distance), FLT_MIN);
    state->framed = *camera;
    state->framed_aspect = distance >= 0.0 ? aspect : 0.0f;
    state->framed_edits = scene->edits.nodes;
    return distance >= 0.0;
}

/* Where the depths of a camera are counted from, and its planes. */
static void place_planes(lsf_camera_state *out, const lsf_state *state, double near_plane,
                         vec3d origin, vec3d forward)
{
    double nearest, farthest, center = -dot(origin, forward);
    scene_depths(state, forward, &nearest, &farthest);
    double depth = farthest - nearest + 2.0 * PLANE_ROOM;
    double start = center + farthest + PLANE_ROOM;
    if (center + nearest > FAR_AWAY * depth && near_plane < start) {
        vec3d axis = scaled(forward, start);
        store(out->start, (vec3d){origin.x + axis.x, origin.y + axis.y, origin.z + axis.z});
        out->start_depth = (float)start;
        out->near_plane = (float)fmax(near_plane - start, -depth);
        out->far_plane = 0.0f;
        return;
    }
    store(out->start, origin);
    /* An orthographic camera may start at 0; a perspective one made of it may not. */
    out->near_plane = fmaxf((float)near_plane, 1e-12f);
    /* A tenth more than the farthest corner, so that nothing lies on the far plane. */
    out->far_plane = out->orthographic ? fmaxf(1.1f * (float)(center + farthest),
                                               fmaxf(2.0f * out->near_plane, 1e-3f))
                                       : INFINITY;
}

static bool update_camera(lsf_state *state, const lsf_camera *camera, const double *world,
                          const lsf_view_params *params, lsf_error *error)
{
    lsf_camera_state *out = &state->camera;
    vec3d position = column(world, 3);
    vec3d forward = unit(scaled(column(world, 2), -1.0), (vec3d){0, 0, -1});
    vec3d up = column(world, 1);
    bool overridden = !params->view;
    if (overridden && params->position) {
        const float *p = params->position;
        position = (vec3d){p[0], p[1], p[2]};
    }
    if (overridden && params->target) {
        const float *t = params->target;
        forward = unit((vec3d){t[0] - position.x, t[1] - position.y, t[2] - position.z}, forward);
        up = (vec3d){0, 1, 0};
    }
    vec3d right = unit(cross(forward, up), perpendicular(forward));
    up = cross(right, forward);
    vec3d origin = normalised_position(state, position);
    double distance = sqrt(dot(origin, origin));
    if (!(distance <= FARTHEST_CAMERA))
        return lsf_error_set(
            error, LSF_ERROR_USAGE,
            "the camera is %.3g half extents of the scene from its centre, farther "
            "than %.3g: move it closer",
            distance, FARTHEST_CAMERA);

    state->view = (lsf_view){.position = {position.x, position.y, position.z},
                             .forward = {(float)forward.x, (float)forward.y, (float)forward.z},
                             .up = {(float)up.x, (float)up.y, (float)up.z},
                             .near_plane = camera->near_plane};
    bool fov_given = overridden && !isnan(params->fov_y);
    memset(out, 0, sizeof *out);
    out->orthographic = camera->orthographic && !fov_given;
    store(out->forward, forward);
    place_planes(out, state, camera->near_plane * state->scale, origin, forward);
    double half_height = camera->y_magnification * state->scale, farthest_shown = 1.0;
    state->view.height = out->orthographic ? 2.0f * camera->y_magnification : 0.0f;
    if (!out->orthographic) {
        double fov_y = fov_given ? params->fov_y * (M_PI / 180.0) : camera->fov_y;
        state->view.fov_y = (float)(fov_y * (180.0 / M_PI));
        half_height = tan(0.5 * fov_y);
        store(out->forward_dx, scaled(right, half_height * params->aspect));
        store(out->forward_dy, scaled(up, half_height));
        farthest_shown = distance + 1.0;
    }
    if (half_height * farthest_shown < LOWEST_PICTURE)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the camera shows %.3g of the scene's half extent from the picture's "
                             "centre to its top, and positions are rounded to %.0e of it: %s",
                             half_height * farthest_shown, 0x1p-24,
                             out->orthographic ? "enlarge ymag" : "widen the field of view");
    double at_start = out->orthographic ? half_height : half_height * out->start_depth;
    store(out->start_dx, scaled(right, at_start * params->aspect));
    store(out->start_dy, scaled(up, at_start));
    return true;
}

static bool is_point(const float *point)
{
    return !point || (isfinite(point[0]) && isfinite(point[1]) && isfinite(point[2]));
}

static bool is_field_of_view(float degrees)
{
    return degrees > 0.0f && degrees < 180.0f;
}

static bool check_params(const lsf_view_params *params, lsf_error *error)
{
    if (!isfinite(params->time))
        return lsf_error_set(error, LSF_ERROR_USAGE, "time %g: must be finite", params->time);
    if (params->view)
        return true;
    if (!is_point(params->position) || !is_point(params->target))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the camera's position and target must be finite numbers");
    return isnan(params->fov_y) || is_field_of_view(params->fov_y) ||
           lsf_error_set(error, LSF_ERROR_USAGE, "fov_y %g: must lie between 0 and 180 degrees",
                         (double)params->fov_y);
}

/* The camera that a program has placed, as one of a file that stands alone. */
static bool place_view(lsf_camera *camera, const lsf_scene *scene, const lsf_view *view,
                       lsf_error *error)
{
    vec3d nowhere = {0};
    vec3d forward = unit((vec3d){view->forward[0], view->forward[1], view->forward[2]}, nowhere);
    vec3d up = unit((vec3d){view->up[0], view->up[1], view->up[2]}, nowhere);
    vec3d right = unit(cross(forward, up), nowhere);
    const double *p = view->position;
    if (dot(right, right) == 0.0 || !isfinite(p[0] + p[1] + p[2]))
        return lsf_error_set(
            error, LSF_ERROR_USAGE,
            "the view's position must be finite, and its directions forward and up "
            "finite, not 0, and not parallel");
    if (!(view->height >= 0.0f && isfinite(view->height)) ||
        (view->height == 0.0f && !is_field_of_view(view->fov_y)))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the view needs a fov_y between 0 and 180 degrees, or a height above "
                             "0: they are %g and %g",
                             (double)view->fov_y, (double)view->height);
    if (!(view->near_plane >= 0.0f && isfinite(view->near_plane)))
        return lsf_error_set(error, LSF_ERROR_USAGE, "the view's near_plane %g: must be 0 or more",
                             (double)view->near_plane);
    up = cross(right, forward);
    *camera = (lsf_camera){.node = LSF_NONE,
                           .matrix = {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, -forward.x,
                                      -forward.y, -forward.z, 0, p[0], p[1], p[2], 1},
                           .orthographic = view->height > 0.0f,
                           .fov_y = (float)((double)view->fov_y * (M_PI / 180.0)),
                           .y_magnification = 0.5f * view->height,
                           .near_plane = view->near_plane > 0.0f
                                             ? view->near_plane
                                             : (float)(1e-3 / scene->requirements.scale)};
    return true;
}

static bool choose_camera(lsf_state *state, lsf_camera *camera, const lsf_scene *scene,
                          const lsf_view_params *params, lsf_error *error)
{
    if (params->view)
        return place_view(camera, scene, params->view, error);
    int index = find_camera(scene, params->camera);
    if (index < 0)
        return no_such_camera(scene, params->camera, error);
    *camera = scene->cameras[index];
    lsf_animated_set_camera(scene, (uint32_t)index, params->time, camera);
    return !camera->frames_scene || frame_scene(state, scene, camera, params->aspect) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u nodes", scene->node_count);
}

/* Whether instances and lights are already those of the scene at that time. */
static bool is_current(const lsf_state *state, const lsf_scene *scene, double time)
{
    return state->worlds && memcmp(&state->edits, &scene->edits, sizeof state->edits) == 0 &&
           (state->time == time || (scene->channel_count == 0 && scene->animated_count == 0));
}

static bool update_scene(lsf_state *state, const lsf_scene *scene, double time)
{
    if (is_current(state, scene, time))
        return true;
    if (!state->worlds)
        state->worlds = lsf_alloc(scene->node_count, 16 * sizeof *state->worlds);
    if (!state->instances)
        state->instances = lsf_alloc(scene->instance_count, sizeof *state->instances);
    if (!state->worlds || !state->instances)
        return false;
    state->instance_count = scene->instance_count;
    memcpy(state->center, scene->requirements.center, sizeof state->center);
    state->scale = scene->requirements.scale;
    lsf_scene_world_matrices(scene, time, state->worlds);
    if (!lsf_pose_update(&state->pose, scene, time, state->worlds) ||
        !lsf_animated_update(&state->animated, scene, time))
        return false;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        update_instance(&state->instances[i], state, &scene->instances[i],
                        lsf_pose_world(&state->pose, scene, state->worlds, i));
    update_bounds(state);
    if (!lsf_state_update_reach(state, scene) || !update_lights(state, scene, state->worlds))
        return false;
    state->time = time;
    state->edits = scene->edits;
    return true;
}

bool lsf_state_update(lsf_state *state, const lsf_scene *scene, const lsf_view_params *params,
                      lsf_error *error)
{
    lsf_camera camera;
    if (!check_params(params, error) || !choose_camera(state, &camera, scene, params, error))
        return false;
    if (!update_scene(state, scene, params->time))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u instances",
                             scene->instance_count);
    return update_camera(state, &camera,
                         camera.node == LSF_NONE ? camera.matrix
                                                 : state->worlds + 16 * (size_t)camera.node,
                         params, error);
}

bool lsf_state_bounds_along(const lsf_state *state, const lsf_float3 axes[3], float low[3],
                            float high[3])
{
    float least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        for (int corner = 0; corner < 8 && !instance->skipped; corner++) {
            lsf_float3 p = lsf_f3((corner & 1 ? instance->bounds_max : instance->bounds_min)[0],
                                  (corner & 2 ? instance->bounds_max : instance->bounds_min)[1],
                                  (corner & 4 ? instance->bounds_max : instance->bounds_min)[2]);
            for (int axis = 0; axis < 3; axis++) {
                float at = lsf_f3_dot(p, axes[axis]);
                least[axis] = fminf(least[axis], at);
                most[axis] = fmaxf(most[axis], at);
            }
        }
    }
    if (least[0] > most[0])
        return false;
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = least[axis];
        high[axis] = most[axis];
    }
    return true;
}

void lsf_state_finish(lsf_state *state)
{
    free(state->instances);
    free(state->lights);
    free(state->worlds);
    lsf_pose_finish(&state->pose);
    lsf_animated_finish(&state->animated);
    memset(state, 0, sizeof *state);
}

float lsf_light_power(const lsf_light_state *light)
{
    float intensity = lsf_f3_luminance(lsf_f3_load(light->intensity));
    switch (light->type) {
    case LSF_LIGHT_DIRECTIONAL:
        return LSF_PI * 3.0f * intensity;
    case LSF_LIGHT_SPOT:
        return 2.0f * LSF_PI * (1.0f - light->cos_outer) * intensity;
    case LSF_LIGHT_POINT:
        break;
    }
    return 4.0f * LSF_PI * intensity;
}
