#include "frame/light_projection.h"

#include <math.h>
#include <string.h>

#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/light.h"

/* Nearest occluder of a perspective map, in half extents of the scene. With reverse-Z and 32-bit
 * floats a small near plane costs no precision. */
#define NEAR_PLANE 1e-5f

/* A spot wider than this half angle gets a cube: one face would spend its texels on the rim. */
#define WIDE_SPOT_COSINE 0.5f

/* Each cascade sees this many times farther than the one before. */
#define CASCADE_RATIO 3.0f

lsf_light_projection_kind lsf_light_projection_kind_of(const lsf_light_state *light)
{
    if (light->type == LSF_LIGHT_DIRECTIONAL)
        return LSF_LIGHT_PROJECTION_WINDOWS;
    bool narrow = light->type == LSF_LIGHT_SPOT && light->cos_outer >= WIDE_SPOT_COSINE;
    return narrow ? LSF_LIGHT_PROJECTION_SPOT : LSF_LIGHT_PROJECTION_CUBE;
}

bool lsf_light_any(const lsf_plan *plan, const lsf_state *state)
{
    return state->light_count > 0 || plan->sky_lights > 0;
}

void lsf_light_projection_kinds(const lsf_plan *plan, const lsf_state *state,
                                bool needed[LSF_LIGHT_PROJECTION_KINDS])
{
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        needed[kind] = false;
    for (uint32_t i = 0; i < state->light_count; i++)
        needed[lsf_light_projection_kind_of(&state->lights[i])] = true;
    if (plan->sky_lights > 0 && plan->requirements.environment_map)
        needed[LSF_LIGHT_PROJECTION_WINDOWS] = true;
}

void lsf_shadow_bind(const lsf_shadow *shadow)
{
    lsf_bind_texture(LSF_UNIT_SHADOW_DEPTH, shadow->depth);
    lsf_bind_texture(LSF_UNIT_SHADOW_GRADIENT, shadow->gradient);
    lsf_bind_texture(LSF_UNIT_SHADOW_TINT, shadow->tint);
    if (shadow->light)
        glBindBufferRange(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, shadow->light, shadow->offset,
                          shadow->size);
}

bool lsf_light_emission_is_adaptive(const lsf_plan *plan)
{
    return lsf_plan_find_pass(plan, "reflective_shadow_map_pdf") != NULL;
}

void lsf_light_switches(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_switch_add(plan, "LSF_SPOT_LIGHT", r->spot_lights > 0, "there are spot lights (%u)",
                        r->spot_lights);
    lsf_plan_switch_add(plan, "LSF_DIRECTIONAL_LIGHT",
                        r->directional_lights > 0 || plan->sky_lights > 0,
                        "there are directional lights (%u), or the environment lights as such",
                        r->directional_lights);
}

static lsf_vec4 vec4_from(lsf_float3 v, float w)
{
    return (lsf_vec4){v.x, v.y, v.z, w};
}

static void set_face(struct lsf_light_data *data, uint32_t face, lsf_float3 right, lsf_float3 up,
                     lsf_float3 forward)
{
    data->map_right[face] = vec4_from(right, 0.0f);
    data->map_up[face] = vec4_from(up, 0.0f);
    data->map_forward[face] = vec4_from(forward, 0.0f);
}

/* Six faces about three axes, turned at random, so that no texel border stays in place. */
static void project_cube(struct lsf_light_data *data, const float rotation[9])
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        lsf_float3 forward = lsf_f3_load(rotation + 3 * axis);
        lsf_float3 right = lsf_f3_load(rotation + 3 * ((axis + 1) % 3));
        lsf_float3 up = lsf_f3_load(rotation + 3 * ((axis + 2) % 3));
        set_face(data, 2 * axis, right, up, forward);
        set_face(data, 2 * axis + 1, right, up, lsf_f3_scale(forward, -1.0f));
    }
    for (uint32_t face = 0; face < 6; face++)
        data->map_window[face] = (lsf_vec4){0.0f, 0.0f, 1.0f, 1.0f};
}

/* right and up of a map that looks along `forward`, rotated by `angle` about it. */
static void rotated_axes(const lsf_light_state *light, float angle, lsf_float3 *right,
                         lsf_float3 *up)
{
    lsf_float3 forward = lsf_f3_load(light->direction), t = lsf_f3_load(light->tangent);
    lsf_float3 b = lsf_f3_cross(forward, t);
    *right = lsf_f3_mad(lsf_f3_scale(t, cosf(angle)), b, sinf(angle));
    *up = lsf_f3_cross(forward, *right);
}

typedef struct box {
    float low[3], high[3];
} box;

static void box_add(box *b, const lsf_float3 axes[3], lsf_float3 p)
{
    for (int axis = 0; axis < 3; axis++) {
        float at = lsf_f3_dot(p, axes[axis]);
        b->low[axis] = fminf(b->low[axis], at);
        b->high[axis] = fmaxf(b->high[axis], at);
    }
}

static const box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* The scene's axis-aligned bounds; the unit box when it is empty. */
static box scene_box(const lsf_state *state, const lsf_float3 axes[3])
{
    box b;
    return lsf_state_bounds_along(state, axes, b.low, b.high) ? b : (box){{-1, -1, -1}, {1, 1, 1}};
}

/* Axis-aligned bounds of what the camera sees up to `depth` from its start. */
static box view_box(const lsf_camera_state *camera, const lsf_float3 axes[3], float depth)
{
    box b = empty_box;
    for (int corner = 0; corner < 8; corner++) {
        float x = corner & 1 ? 1.0f : -1.0f, y = corner & 2 ? 1.0f : -1.0f;
        float z = corner & 4 ? depth : fminf(camera->near_plane, 0.0f);
        lsf_float3 p = lsf_f3_load(camera->start);
        p = lsf_f3_mad(p, lsf_f3_load(camera->start_dx), x);
        p = lsf_f3_mad(p, lsf_f3_load(camera->start_dy), y);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward), z);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward_dx), z * x);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward_dy), z * y);
        box_add(&b, axes, p);
    }
    return b;
}

/* View depths, from the camera's start on, between which the visible part of the scene lies. */
static void seen_depths(const lsf_iteration *iteration, float *nearest, float *farthest)
{
    const lsf_state *state = iteration->state;
    const lsf_camera_state *camera = &state->camera;
    lsf_draw_region picture;
    lsf_iteration_region(iteration, &picture);
    *nearest = INFINITY;
    *farthest = -INFINITY;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        if (instance->skipped || !lsf_clusters_inside(&picture, instance))
            continue;
        for (int corner = 0; corner < 8; corner++) {
            lsf_float3 p = lsf_f3((corner & 1 ? instance->bounds_max : instance->bounds_min)[0],
                                  (corner & 2 ? instance->bounds_max : instance->bounds_min)[1],
                                  (corner & 4 ? instance->bounds_max : instance->bounds_min)[2]);
            float depth =
                lsf_f3_dot(lsf_f3_sub(p, lsf_f3_load(camera->start)), lsf_f3_load(camera->forward));
            *nearest = fminf(*nearest, depth);
            *farthest = fmaxf(*farthest, depth);
        }
    }
    float camera_depth = fminf(camera->near_plane, 0.0f);
    *nearest = fmaxf(*nearest, camera_depth);
    if (!(*nearest <= *farthest)) /* nothing to see */
        *nearest = *farthest = camera_depth;
}

static void set_window(struct lsf_light_data *data, uint32_t face, const lsf_float3 axes[3],
                       const float center[2], const float extent[2])
{
    /* One more texel on each side leaves space for the offset. */
    float margin = 1.0f + 2.0f * data->map_shape.w;
    set_face(data, face, axes[0], axes[1], axes[2]);
    data->map_window[face] = (lsf_vec4){center[0], center[1], fmaxf(extent[0], 1e-4f) * margin,
                                        fmaxf(extent[1], 1e-4f) * margin};
}

/* Depths from the farthest to the nearest visible point along the light, with a sixteenth to
 * spare on either side: the plane of a lit surface reaches beyond it within a texel. */
static void fit_depths(struct lsf_light_data *data, lsf_float3 along, const box *view,
                       const box *scene)
{
    float low = fmaxf(view->low[2], scene->low[2]), high = fminf(view->high[2], scene->high[2]);
    float start =
        lsf_f3_dot(lsf_f3(data->map_origin.x, data->map_origin.y, data->map_origin.z), along);
    float margin = fmaxf(0.0625f * (high - low), 1e-4f);
    if (!(low <= high)) /* nothing of the scene is in view */
        return;
    data->map_shape.x = low - margin - start;
    data->map_shape.y = high + margin - start;
}

/* Smaller side of a pixel, on a plane of constant view depth. */
static float pixel_size(const lsf_iteration *iteration, float depth)
{
    const lsf_camera_state *camera = &iteration->state->camera;
    lsf_float3 across =
        lsf_f3_mad(lsf_f3_load(camera->start_dx), lsf_f3_load(camera->forward_dx), depth);
    lsf_float3 down =
        lsf_f3_mad(lsf_f3_load(camera->start_dy), lsf_f3_load(camera->forward_dy), depth);
    return 2.0f * fminf(lsf_f3_length(across) / (float)iteration->plan->width,
                        lsf_f3_length(down) / (float)iteration->plan->height);
}

/* As many texels as what the camera sees from outside needs: each as wide as a pixel where the
 * scene is nearest, over N^1/4 of N iterations. Borders are blurred by a texel, which moves the
 * mean of a pixel by its square: this error falls with N as fast as the noise. */
static void fit_texels(struct lsf_light_data *data, const lsf_iteration *iteration,
                       const lsf_light_projection_layout *layout, float nearest,
                       const float extent[2])
{
    float texel = pixel_size(iteration, nearest) / powf(lsf_iteration_expected(iteration), 0.25f);
    float texels = ceilf(2.0f * fmaxf(extent[0], extent[1]) / texel);
    texels = fminf(fmaxf(texels, (float)layout->least), (float)layout->resolution);
    data->map_shape.z = texels;
    data->map_shape.w = 1.0f / texels;
}

/* Nested windows: each reaches a third as deep into the visible scene as the next one, so that a
 * texel is everywhere about as wide as a pixel is there; the last holds all that is visible. */
static void set_nested_windows(struct lsf_light_data *data, const lsf_iteration *iteration,
                               const lsf_light_projection_layout *layout, const lsf_float3 axes[3],
                               const box *scene)
{
    float nearest, farthest;
    uint32_t faces = layout->faces;
    seen_depths(iteration, &nearest, &farthest);
    float reach = farthest - nearest;
    for (uint32_t i = 0; i < faces; i++, reach /= CASCADE_RATIO) {
        box view = view_box(&iteration->state->camera, axes, nearest + reach);
        float center[2], extent[2];
        for (int axis = 0; axis < 2; axis++) {
            float low = fmaxf(view.low[axis], scene->low[axis]);
            float high = fminf(view.high[axis], scene->high[axis]);
            bool outside = !(low <= high); /* nothing of the scene is in view */
            center[axis] = outside ? scene->low[axis] : 0.5f * (low + high);
            extent[axis] = outside ? 0.0f : 0.5f * (high - low);
        }
        if (layout->fitted && i == 0) {
            fit_depths(data, axes[2], &view, scene);
            fit_texels(data, iteration, layout, nearest, extent);
        }
        set_window(data, faces - 1 - i, axes, center, extent);
    }
}

/* Along the light, each window holds the whole scene: surfaces outside the view may cast shadows
 * into it. */
static void project_windows(struct lsf_light_data *data, const lsf_iteration *iteration,
                            const lsf_light_projection_layout *layout, const lsf_float3 axes[3])
{
    box scene = scene_box(iteration->state, axes);
    float half_range = fmaxf(0.5f * (scene.high[2] - scene.low[2]), 1e-3f);
    float start = 0.5f * (scene.high[2] + scene.low[2]) - 1.01f * half_range;
    data->map_origin = vec4_from(lsf_f3_scale(axes[2], start), (float)layout->faces);
    data->map_shape.x = 0.0f;
    data->map_shape.y = 2.02f * half_range;
    if (layout->view) {
        set_nested_windows(data, iteration, layout, axes, &scene);
        return;
    }
    float center[2], extent[2];
    for (int axis = 0; axis < 2; axis++) {
        center[axis] = 0.5f * (scene.low[axis] + scene.high[axis]);
        extent[axis] = 0.5f * (scene.high[axis] - scene.low[axis]);
    }
    set_window(data, 0, axes, center, extent);
}

static void set_light(struct lsf_light_data *data, const lsf_light_state *light,
                      const lsf_sky_share *share, lsf_light_use use)
{
    float spot_scale = 0.0f, spot_offset = 1.0f;
    if (light->type == LSF_LIGHT_SPOT) {
        spot_scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
        spot_offset = -light->cos_outer * spot_scale;
    }
    memset(data, 0, sizeof *data);
    data->position = vec4_from(lsf_f3_load(light->position), 0.0f);
    data->direction = vec4_from(lsf_f3_load(light->direction), 0.0f);
    data->intensity =
        vec4_from(lsf_f3_scale(lsf_f3_load(light->intensity), share->shares[use]), share->density);
    data->attenuation = (lsf_vec4){1.0f / (light->range * light->range), spot_scale, spot_offset,
                                   (float)light->type};
    data->map_offset.w = share->kernel;
}

void lsf_light_projection_project(struct lsf_light_data *data, const lsf_iteration *iteration,
                                  uint32_t light_index, const lsf_light_projection_layout *layout)
{
    const lsf_light_state *light = &iteration->lights[light_index];
    uint32_t purpose = layout->purpose + 2 * light_index;
    float texels = (float)layout->resolution;
    set_light(data, light, &iteration->shares[light_index], layout->use);
    float numbers[2], shift[2], rotation[9];
    lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, purpose), numbers);
    lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, purpose + 1), shift);
    data->map_shape = (lsf_vec4){NEAR_PLANE, 0.0f, texels, 1.0f / texels};
    data->map_origin = vec4_from(lsf_f3_load(light->position), (float)layout->faces);
    data->map_offset.z = iteration->view.start.w;
    if (lsf_light_projection_kind_of(light) == LSF_LIGHT_PROJECTION_CUBE) {
        lsf_sample_rotation(numbers[0], numbers[1], shift[0], rotation);
        project_cube(data, rotation);
        return;
    }
    lsf_float3 axes[3] = {[2] = lsf_f3_load(light->direction)};
    rotated_axes(light, numbers[0] * 2.0f * LSF_PI, &axes[0], &axes[1]);
    if (light->type == LSF_LIGHT_DIRECTIONAL) {
        project_windows(data, iteration, layout, axes);
    } else {
        float tangent = sqrtf(1.0f - light->cos_outer * light->cos_outer) / light->cos_outer;
        float extent = fmaxf(tangent, 1e-4f) * (1.0f + 2.0f / texels);
        set_face(data, 0, axes[0], axes[1], axes[2]);
        data->map_window[0] = (lsf_vec4){0.0f, 0.0f, extent, extent};
    }
    data->map_offset.x = (2.0f * shift[0] - 1.0f) * data->map_shape.w;
    data->map_offset.y = (2.0f * shift[1] - 1.0f) * data->map_shape.w;
}

/* x, y = +-1 on the map. */
void lsf_light_projection_region(const struct lsf_light_data *data, uint32_t face,
                                 lsf_draw_region *region)
{
    const float window[4] = {data->map_window[face].x, data->map_window[face].y,
                             data->map_window[face].z, data->map_window[face].w};
    const float offset[2] = {data->map_offset.x, data->map_offset.y};
    const float *axes[3] = {&data->map_right[face].x, &data->map_up[face].x,
                            &data->map_forward[face].x};
    const float *origin = &data->map_origin.x;
    bool perspective = data->map_shape.y == 0.0f;
    region->plane_count = 4;
    for (int i = 0; i < 4; i++) {
        int side = i / 2;
        float sign = i % 2 ? -1.0f : 1.0f;
        /* 1 - sign ((q - center) / extent + offset) >= 0; when perspective, times q.z */
        float along = perspective ? 1.0f - sign * offset[side] : 0.0f;
        float *plane = region->planes[i];
        plane[3] =
            perspective ? 0.0f : 1.0f - sign * (offset[side] - window[side] / window[2 + side]);
        for (int axis = 0; axis < 3; axis++) {
            plane[axis] = along * axes[2][axis] - sign * axes[side][axis] / window[2 + side];
            plane[3] -= plane[axis] * origin[axis];
        }
    }
}
