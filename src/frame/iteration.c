#include "frame/iteration.h"
#include "frame/purpose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

void lsf_region_set(const lsf_region *region)
{
    glViewport(region->x, region->y, region->width, region->height);
    glUniform4i(LSF_LOCATION_REGION, region->x, region->y, region->tile_x, region->tile_y);
}

void lsf_iteration_plan(lsf_plan *plan)
{
    lsf_plan_buffer_add(plan, "view", sizeof(struct lsf_view_data),
                        "the camera, jittered each iteration");
}

static lsf_vec4 vec4_from(const float v[3])
{
    return (lsf_vec4){v[0], v[1], v[2], 0.0f};
}

static float dot3(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Parameters of the reverse-Z depth (view.h): 1 on the near plane, 0 on the far one. */
static void depth_law(const lsf_camera_state *camera, float *slope, float *offset)
{
    float near_depth = camera->orthographic ? 1.0f : camera->start_depth + camera->near_plane;
    *slope = 0.0f;
    *offset = near_depth;
    if (isfinite(camera->far_plane)) {
        *slope = -near_depth / (camera->far_plane - camera->near_plane);
        *offset = -*slope * camera->far_plane;
    }
}

/* The clip-space matrix, of positions relative to the camera's start, whose inverse is
 * lsf_camera_state. The jitter moves the picture so that a pixel's centre shows its sample
 * point. */
static lsf_mat4 clip_matrix(const lsf_camera_state *camera, float jitter_x, float jitter_y)
{
    const float *dx = camera->orthographic ? camera->start_dx : camera->forward_dx;
    const float *dy = camera->orthographic ? camera->start_dy : camera->forward_dy;
    float rows[4][4] = {{0}}, slope;
    depth_law(camera, &slope, &rows[2][3]);
    for (int axis = 0; axis < 3; axis++) {
        /* dx and dy are perpendicular to each other and to forward. */
        rows[0][axis] = dx[axis] / dot3(dx, dx);
        rows[1][axis] = dy[axis] / dot3(dy, dy);
        rows[2][axis] = slope * camera->forward[axis];
        rows[3][axis] = camera->orthographic ? 0.0f : camera->forward[axis];
    }
    rows[3][3] = camera->orthographic ? 1.0f : camera->start_depth;
    lsf_mat4 matrix;
    for (int column = 0; column < 4; column++) {
        matrix.m[4 * column + 0] = rows[0][column] - jitter_x * rows[3][column];
        matrix.m[4 * column + 1] = rows[1][column] - jitter_y * rows[3][column];
        matrix.m[4 * column + 2] = rows[2][column];
        matrix.m[4 * column + 3] = rows[3][column];
    }
    return matrix;
}

/* Bound of the error of a position that is found from a depth: half a unit in the last place of
 * each of its coordinates, and an error relative to its distance from the start, by the vertex
 * (twice), the division, the depth and the reconstruction. */
static float position_error(const lsf_state *state)
{
    const float *low = state->bounds_min, *high = state->bounds_max;
    float reach2 = 0.0f;
    for (int axis = 0; axis < 3 && low[0] <= high[0]; axis++) {
        float apart = fmaxf(fabsf(low[axis] - state->camera.start[axis]),
                            fabsf(high[axis] - state->camera.start[axis]));
        reach2 += apart * apart;
    }
    return 0x1p-24f * (1.0f + 6.0f * sqrtf(reach2));
}

static void set_view(struct lsf_view_data *view, const lsf_plan *plan, const lsf_state *state)
{
    const lsf_camera_state *camera = &state->camera;
    float width = (float)plan->seen_width, height = (float)plan->seen_height;
    memset(view, 0, sizeof *view);
    view->start = vec4_from(camera->start);
    view->start_dx = vec4_from(camera->start_dx);
    view->start_dy = vec4_from(camera->start_dy);
    view->start.w = position_error(state);
    view->forward = vec4_from(camera->forward);
    view->forward_dx = vec4_from(camera->forward_dx);
    view->forward_dy = vec4_from(camera->forward_dy);
    view->size = (lsf_vec4){width, height, 1.0f / width, 1.0f / height};
    view->depth.z = (float)(1.0 / state->scale);
    view->depth.w = camera->start_depth;
    depth_law(camera, &view->depth.x, &view->depth.y);
}

/* Suppression m' of glossy lobes, Tokuyoshi and Ogaki 2012, section 5. */
#define KERNEL_SAMPLES 16.0f

static bool create_lights(lsf_iteration *iteration, lsf_error *error)
{
    const lsf_state *state = iteration->state;
    uint32_t count = state->light_count + iteration->plan->sky_lights;
    iteration->light_count = count;
    iteration->lights = lsf_alloc(count, sizeof *iteration->lights);
    iteration->shares = lsf_alloc(count, sizeof *iteration->shares);
    if (!iteration->lights || !iteration->shares)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights", count);
    for (uint32_t i = 0; i < count; i++)
        iteration->shares[i] = (lsf_sky_share){.shares = {1.0f, 1.0f}};
    return iteration->plan->sky_lights == 0 ||
           lsf_sky_init(&iteration->sky, &iteration->scene->scene->environment) ||
           lsf_error_set(error, LSF_ERROR_RENDER,
                         "out of memory for the environment's distribution");
}

bool lsf_iteration_create(lsf_iteration *iteration, lsf_context *context, lsf_plan *plan,
                          lsf_scene_gpu *scene, const lsf_state *state, const lsf_state *previous,
                          uint64_t seed, lsf_error *error)
{
    *iteration = (lsf_iteration){
        .context = context, .plan = plan, .state = state, .scene = scene, .seed = seed};
    if (!create_lights(iteration, error))
        return false;
    lsf_iteration_frame(iteration, state, previous, 0);
    return lsf_plan_create_buffer(plan, context, "view", NULL, GL_DYNAMIC_STORAGE_BIT,
                                  &iteration->view_buffer, error);
}

bool lsf_iteration_update_sky(lsf_iteration *iteration)
{
    lsf_sky_finish(&iteration->sky);
    return iteration->plan->sky_lights == 0 ||
           lsf_sky_init(&iteration->sky, &iteration->scene->scene->environment);
}

void lsf_iteration_frame(lsf_iteration *iteration, const lsf_state *state,
                         const lsf_state *previous, uint32_t first_index)
{
    iteration->state = state;
    iteration->first_index = first_index;
    iteration->serial_before = iteration->serial;
    iteration->kept = 0.0f;
    set_view(&iteration->view, iteration->plan, state);
    iteration->previous_camera = previous ? previous->camera : state->camera;
    if (state->light_count > 0)
        memcpy(iteration->lights, state->lights, state->light_count * sizeof *state->lights);
}

void lsf_iteration_destroy(lsf_iteration *iteration)
{
    if (iteration->context)
        lsf_buffer_destroy(iteration->context, &iteration->view_buffer);
    lsf_sky_finish(&iteration->sky);
    free(iteration->lights);
    free(iteration->shares);
}

float lsf_iteration_expected(const lsf_iteration *iteration)
{
    uint32_t samples = iteration->plan->samples;
    uint32_t own =
        samples == UINT32_MAX || iteration->done >= samples ? iteration->done + 1 : samples;
    return (float)own + iteration->kept;
}

/* Of all iterations of all frames. */
static uint32_t sky_number(const lsf_iteration *iteration, uint32_t direction)
{
    return iteration->index * iteration->plan->sky_lights + direction;
}

uint32_t lsf_iteration_sky_sequence(const lsf_iteration *iteration, uint32_t direction)
{
    return sky_number(iteration, direction) % 2;
}

static void draw_sky_lights(lsf_iteration *iteration)
{
    uint32_t count = iteration->plan->sky_lights;
    uint32_t first = iteration->light_count - count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits[2];
        lsf_iteration_sample(iteration, sky_number(iteration, i) / 2,
                             LSF_PURPOSE_SKY + lsf_iteration_sky_sequence(iteration, i), bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        lsf_sky_share *share = &iteration->shares[first + i];
        lsf_sky_light_draw(&iteration->lights[first + i], share, &iteration->sky, u, count);
        if (share->density > 0.0f)
            share->kernel = lsf_iteration_kernel(iteration) / share->density;
    }
}

float lsf_iteration_kernel(const lsf_iteration *iteration)
{
    return KERNEL_SAMPLES / lsf_iteration_expected(iteration);
}

float lsf_iteration_sky_angle(const lsf_iteration *iteration)
{
    float directions = (float)iteration->plan->sky_lights * lsf_iteration_expected(iteration);
    return directions > 0.0f ? 4.0f * LSF_PI * KERNEL_SAMPLES / directions : 0.0f;
}

void lsf_iteration_sample(const lsf_iteration *iteration, uint32_t index, uint32_t purpose,
                          uint32_t bits[2])
{
    uint32_t seed = lsf_iteration_seed(iteration, purpose);
    if (!iteration->plan->random_samples) {
        lsf_sobol_2d_bits(index, seed, bits);
        return;
    }
    bits[0] = lsf_hash(seed, 2 * (uint64_t)index);
    bits[1] = lsf_hash(seed, 2 * (uint64_t)index + 1);
}

lsf_iteration_number lsf_iteration_deal(const lsf_iteration *iteration, uint32_t i, uint32_t count)
{
    const lsf_plan *plan = iteration->plan;
    uint32_t tiles = plan->tiles > 0 && !plan->random_samples ? plan->tiles : 1;
    uint32_t slot = i % tiles, each = (count + tiles - 1) / tiles;
    lsf_iteration_number number = {.index = iteration->index * each + i / tiles};
    if (slot == 0)
        return number;
    uint32_t turned = 0; /* the slot's binary digits in reverse order */
    for (uint32_t power = 1; power < tiles; power *= 2)
        turned = 2 * turned + (slot / power & 1);
    number.shift[0] = (uint32_t)((uint64_t)slot * UINT32_MAX / (tiles - 1));
    number.shift[1] = (uint32_t)((uint64_t)turned * UINT32_MAX / (tiles - 1));
    return number;
}

void lsf_iteration_sample_dealt(const lsf_iteration *iteration, uint32_t i, uint32_t count,
                                uint32_t purpose, uint32_t bits[2])
{
    lsf_iteration_number number = lsf_iteration_deal(iteration, i, count);
    lsf_iteration_sample(iteration, number.index, purpose, bits);
    bits[0] ^= number.shift[0];
    bits[1] ^= number.shift[1];
}

void lsf_iteration_set_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map)
{
    glUniform2ui(LSF_LOCATION_CHANCE, lsf_hash(lsf_iteration_seed(iteration, purpose), map),
                 iteration->index);
}

void lsf_iteration_set_blend_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map)
{
    if (iteration->plan->requirements.blended)
        lsf_iteration_set_chance(iteration, purpose, map);
}

uint32_t lsf_iteration_seed(const lsf_iteration *iteration, uint32_t purpose)
{
    return lsf_hash(iteration->seed, purpose);
}

void lsf_iteration_bind_view(const lsf_iteration *iteration)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VIEW, iteration->view_buffer);
}

void lsf_iteration_begin(lsf_iteration *iteration, uint32_t done)
{
    float point[2];
    iteration->done = done;
    iteration->index = iteration->first_index + done;
    uint32_t places = lsf_sparse_grid_is_of_pixels(iteration->plan) ? LSF_PURPOSE_PIXEL_POINT
                                                                    : LSF_PURPOSE_SPARSE_GRID;
    iteration->grid = lsf_sparse_grid_at(iteration->plan, done, iteration->index,
                                         lsf_iteration_seed(iteration, places));
    iteration->serial = iteration->serial_before + done + 1;
    lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_PIXEL), point);
    float x = (2.0f * point[0] - 1.0f) * iteration->view.size.z;
    float y = (2.0f * point[1] - 1.0f) * iteration->view.size.w;
    iteration->view.jitter =
        (lsf_vec4){x, y, (float)iteration->plan->pixel_side, (float)iteration->plan->interleave};
    iteration->view.clip = clip_matrix(&iteration->state->camera, x, y);
    iteration->view.previous_clip = clip_matrix(&iteration->previous_camera, x, y);
    iteration->view.previous_start = vec4_from(iteration->previous_camera.start);
    glNamedBufferSubData(iteration->view_buffer, 0, sizeof iteration->view, &iteration->view);
    lsf_iteration_bind_view(iteration);
    draw_sky_lights(iteration);
}

void lsf_iteration_bind_sky(const lsf_iteration *iteration)
{
    const lsf_sky *sky = &iteration->sky;
    glUniform4f(LSF_LOCATION_SKY, sky->whole, sky->held, sky->mean,
                (float)iteration->plan->sky_lights);
}

void lsf_iteration_region(const lsf_iteration *iteration, lsf_draw_region *region)
{
    const float *m = iteration->view.clip.m;
    region->plane_count = 5;
    for (int i = 0; i < 5; i++) {
        for (int column = 0; column < 4; column++) {
            float w = m[4 * column + 3];
            /* -w <= x <= w, -w <= y <= w, z <= w: the near plane of reverse-Z */
            float value = m[4 * column + (i < 4 ? i / 2 : 2)];
            region->planes[i][column] = i % 2 == 0 ? w - value : w + value;
        }
        region->planes[i][3] -= dot3(region->planes[i], iteration->state->camera.start);
    }
}
