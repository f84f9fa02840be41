#include "plan/iteration.h"
#include "plan/purpose.h"

#include <math.h>
#include <string.h>

#include "math/sampling.h"
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

/* The clip-space matrix whose inverse is lsf_camera_state: reverse-Z with depth near / z for
 * perspective (infinite far plane), (far - z) / (far - near) for orthographic cameras. The jitter
 * moves the picture so that a pixel's centre shows its sample point. */
static lsf_mat4 clip_matrix(const lsf_camera_state *camera, float jitter_x, float jitter_y)
{
    const float *dx = camera->orthographic ? camera->origin_dx : camera->forward_dx;
    const float *dy = camera->orthographic ? camera->origin_dy : camera->forward_dy;
    float rows[4][4] = {{0}};
    for (int axis = 0; axis < 3; axis++) {
        /* dx and dy are perpendicular to each other and to forward. */
        rows[0][axis] = dx[axis] / dot3(dx, dx);
        rows[1][axis] = dy[axis] / dot3(dy, dy);
        if (camera->orthographic)
            rows[2][axis] = -camera->forward[axis] / (camera->far_plane - camera->near_plane);
        else
            rows[3][axis] = camera->forward[axis];
    }
    for (int row = 0; row < 4; row++)
        rows[row][3] = -dot3(rows[row], camera->origin);
    if (camera->orthographic) {
        rows[2][3] += camera->far_plane / (camera->far_plane - camera->near_plane);
        rows[3][3] = 1.0f;
    } else {
        rows[2][3] = camera->near_plane;
    }
    lsf_mat4 matrix;
    for (int column = 0; column < 4; column++) {
        matrix.m[4 * column + 0] = rows[0][column] - jitter_x * rows[3][column];
        matrix.m[4 * column + 1] = rows[1][column] - jitter_y * rows[3][column];
        matrix.m[4 * column + 2] = rows[2][column];
        matrix.m[4 * column + 3] = rows[3][column];
    }
    return matrix;
}

static void set_view(struct lsf_view_data *view, const lsf_plan *plan, const lsf_state *state)
{
    const lsf_camera_state *camera = &state->camera;
    float width = (float)plan->width, height = (float)plan->height;
    memset(view, 0, sizeof *view);
    view->origin = vec4_from(camera->origin);
    view->origin_dx = vec4_from(camera->origin_dx);
    view->origin_dy = vec4_from(camera->origin_dy);
    view->forward = vec4_from(camera->forward);
    view->forward_dx = vec4_from(camera->forward_dx);
    view->forward_dy = vec4_from(camera->forward_dy);
    view->size = (lsf_vec4){width, height, 1.0f / width, 1.0f / height};
    view->depth = (lsf_vec4){camera->near_plane, camera->orthographic ? camera->far_plane : 0.0f,
                             (float)(1.0 / state->scale), 0.0f};
}

bool lsf_iteration_create(lsf_iteration *iteration, lsf_context *context, lsf_plan *plan,
                          lsf_scene_gpu *scene, const lsf_state *state, const lsf_state *previous,
                          uint64_t seed, lsf_error *error)
{
    *iteration = (lsf_iteration){
        .context = context, .plan = plan, .state = state, .scene = scene, .seed = seed};
    set_view(&iteration->view, plan, state);
    iteration->previous_camera = previous ? previous->camera : state->camera;
    return lsf_plan_create_buffer(plan, context, "view", NULL, GL_DYNAMIC_STORAGE_BIT,
                                  &iteration->view_buffer, error);
}

void lsf_iteration_destroy(lsf_iteration *iteration)
{
    if (iteration->context)
        lsf_buffer_destroy(iteration->context, &iteration->view_buffer);
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

void lsf_iteration_set_chance(const lsf_iteration *iteration, uint32_t purpose, uint32_t map)
{
    glUniform2ui(LSF_LOCATION_CHANCE, lsf_hash(lsf_iteration_seed(iteration, purpose), map),
                 iteration->index);
}

uint32_t lsf_iteration_seed(const lsf_iteration *iteration, uint32_t purpose)
{
    return lsf_hash(iteration->seed, purpose);
}

void lsf_iteration_begin(lsf_iteration *iteration, uint32_t index)
{
    float point[2];
    iteration->index = index;
    lsf_sobol_2d(index, lsf_iteration_seed(iteration, LSF_PURPOSE_PIXEL), point);
    float x = (2.0f * point[0] - 1.0f) * iteration->view.size.z;
    float y = (2.0f * point[1] - 1.0f) * iteration->view.size.w;
    iteration->view.jitter = (lsf_vec4){x, y, 0.0f, 0.0f};
    iteration->view.clip_from_position = clip_matrix(&iteration->state->camera, x, y);
    iteration->view.previous_clip_from_position = clip_matrix(&iteration->previous_camera, x, y);
    glNamedBufferSubData(iteration->view_buffer, 0, sizeof iteration->view, &iteration->view);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VIEW, iteration->view_buffer);
}

void lsf_iteration_region(const lsf_iteration *iteration, lsf_draw_region *region)
{
    const float *m = iteration->view.clip_from_position.m;
    region->plane_count = 5;
    for (int i = 0; i < 5; i++)
        for (int column = 0; column < 4; column++) {
            float w = m[4 * column + 3];
            /* -w <= x <= w, -w <= y <= w, z <= w: the near plane of reverse-Z */
            float value = m[4 * column + (i < 4 ? i / 2 : 2)];
            region->planes[i][column] = i % 2 == 0 ? w - value : w + value;
        }
}
