/* The projections of an iteration's bundles: axes, windows, depth ranges. */
#include <math.h>
#include <string.h>

#include "frame/purpose.h"
#include "math/sampling.h"
#include "passes/ray_bundle_parts.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

/* Depth is kept in 2^16 steps; finer ones than a position's rounding, 2^-24, say nothing. */
#define MIN_LENGTH 0x1p-8f

void lsf_ray_bundle_aim_plan(lsf_plan *plan)
{
    lsf_plan_pass_add(plan, "ray_bundle_bounds", "windows fitted to the visible points");
    lsf_plan_reads(plan, "view gbuffer");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_ray_bundle_gap_switch(plan);
    lsf_plan_texture_add(plan, "ray_bundle.tiles", GL_RG32F,
                         (plan->seen_width + LSF_BUNDLE_TILE - 1) / LSF_BUNDLE_TILE,
                         (plan->seen_height + LSF_BUNDLE_TILE - 1) / LSF_BUNDLE_TILE,
                         "nearest and farthest depth of %d x %d pixels", LSF_BUNDLE_TILE,
                         LSF_BUNDLE_TILE);
}

bool lsf_ray_bundle_aim_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const tiles_files[5] = {"lib/fullscreen.vert.glsl",
                                               "passes/ray_bundle_tiles.frag.glsl"};
    static const char *const fit_files[5] = {"passes/ray_bundle_fit.comp.glsl"};
    if (!lsf_plan_create_texture(plan, pass->context, "ray_bundle.tiles", &pass->tiles, error))
        return false;
    lsf_framebuffer_desc desc = {
        .label = "ray_bundle.tiles", .color_count = 1, .colors = {pass->tiles}, .layer = -1};
    pass->tiles_framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    pass->tiles_program =
        lsf_plan_program(plan, pass->context, "ray_bundle_bounds", tiles_files, error);
    pass->fit_program =
        lsf_plan_program(plan, pass->context, "ray_bundle_bounds", fit_files, error);
    pass->bounds_timer = lsf_timer_create(pass->context, "ray_bundle_bounds", error);
    return pass->tiles_framebuffer && pass->tiles_program && pass->fit_program &&
           pass->bounds_timer;
}

static lsf_vec4 vec4_from(lsf_float3 v, float w)
{
    return (lsf_vec4){v.x, v.y, v.z, w};
}

/* right and up of a map seen along the unit vector `forward`, turned by `angle` about it; the basis
 * is that of lib/octahedral.glsl. */
static void rotated_axes(lsf_float3 forward, float angle, lsf_float3 *right, lsf_float3 *up)
{
    float s = forward.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (s + forward.z), c = forward.x * forward.y * a;
    lsf_float3 t = lsf_f3(1.0f + s * forward.x * forward.x * a, s * c, -s * forward.x);
    lsf_float3 b = lsf_f3(c, s + forward.y * forward.y * a, -forward.y);
    *right = lsf_f3_mad(lsf_f3_scale(t, cosf(angle)), b, sinf(angle));
    *up = lsf_f3_cross(*right, forward);
}

/* All of the scene. With a window yet to be fitted, its centre carries the grid's offset [texels].
 */
static void project(const lsf_ray_bundle *pass, const lsf_iteration *iteration, uint32_t bundle,
                    const lsf_ray_bundle_direction *direction, struct lsf_bundle_data *data)
{
    float texels = (float)pass->side;
    const lsf_islands *islands = &iteration->plan->islands;
    float whole = (float)pass->params.resolution;
    lsf_iteration_number number = lsf_iteration_deal(iteration, bundle, pass->use.count);
    uint32_t turned[2], shifted[2];
    lsf_sobol_2d_bits(number.index, lsf_iteration_seed(iteration, LSF_PURPOSE_BUNDLE_ROTATION),
                      turned);
    lsf_sobol_2d_bits(number.index, lsf_iteration_seed(iteration, LSF_PURPOSE_BUNDLE_SHIFT),
                      shifted);
    float rotation = lsf_unit_float(turned[0] ^ number.shift[0]), shift[2];
    for (int axis = 0; axis < 2; axis++)
        shift[axis] = lsf_unit_float(shifted[axis] ^ number.shift[axis]);
    lsf_float3 axes[3];
    axes[2] = lsf_f3_load(direction->direction);
    rotated_axes(axes[2], rotation * 2.0f * LSF_PI, &axes[0], &axes[1]);
    float low[3] = {0}, high[3] = {0};
    lsf_ray_bundle_gaps gaps = {0};
    if (islands->count > 1)
        gaps = lsf_ray_bundle_close_gaps(islands, axes, texels, low, high);
    else
        lsf_state_bounds_along(iteration->state, axes, low, high);
    float extent[2], center[2];
    for (int axis = 0; axis < 2; axis++) {
        extent[axis] = lsf_bundle_extent(low[axis], high[axis], texels);
        center[axis] = shift[axis] - 0.5f;
        if (!pass->fitted)
            center[axis] =
                0.5f * (low[axis] + high[axis]) + center[axis] * 2.0f * extent[axis] / texels;
    }
    if (!pass->fitted)
        for (int axis = 0; axis < 2; axis++)
            extent[axis] *= whole / texels;
    *data = (struct lsf_bundle_data){
        .right = vec4_from(axes[0], whole / texels),
        .up = vec4_from(axes[1], 0.0f),
        .forward = vec4_from(axes[2], direction->pdf),
        .window = {center[0], center[1], extent[0], extent[1]},
        .range = {low[2], fmaxf(high[2] - low[2], MIN_LENGTH), texels, 1.0f / whole},
    };
    lsf_ray_bundle_set_sizes(&pass->params, data);
    memcpy(data->gap_starts, gaps.starts, sizeof gaps.starts);
    memcpy(data->gap_lengths, gaps.lengths, sizeof gaps.lengths);
}

static void fit(lsf_ray_bundle *pass, const lsf_iteration *iteration, GLuint depth)
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->bounds_timer);
    lsf_begin_fullscreen(
        pass->tiles_framebuffer, (plan->seen_width + LSF_BUNDLE_TILE - 1) / LSF_BUNDLE_TILE,
        (plan->seen_height + LSF_BUNDLE_TILE - 1) / LSF_BUNDLE_TILE, pass->tiles_program);
    lsf_bind_texture(0, depth);
    glUniform1i(0, LSF_BUNDLE_TILE * LSF_BUNDLE_TILE);
    lsf_draw_fullscreen(pass->context);
    lsf_bind_texture(0, pass->tiles);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_BUNDLE_NODES, pass->projection_buffer);
    glUseProgram(pass->fit_program);
    glDispatchCompute(pass->use.count, 1, 1);
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT);
    lsf_timer_end(pass->bounds_timer);
}

void lsf_ray_bundle_aim(lsf_ray_bundle *pass, const lsf_iteration *iteration,
                        const lsf_ray_bundle_direction *directions, GLuint depth)
{
    for (uint32_t i = 0; i < pass->use.count; i++)
        project(pass, iteration, i, &directions[i], &pass->projections[i].data);
    glNamedBufferSubData(pass->projection_buffer, 0,
                         (GLsizeiptr)(pass->use.count * sizeof *pass->projections),
                         pass->projections);
    if (pass->fitted)
        fit(pass, iteration, depth);
}
