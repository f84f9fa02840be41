/* Small triangles by a compute shader, the few large ones by GL. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "passes/ray_bundle_parts.h"
#include "shared/scene_data.h"

#define DRAW_WORDS 5 /* DrawElementsIndirectCommand */

/* In one dispatch: GL promises 65,535 work groups. */
#define MAX_TRIANGLES (65535u * LSF_BUNDLE_SMALL_SIZE)

static uint64_t large_bytes(const lsf_plan *plan)
{
    return 4 *
           (DRAW_WORDS * (uint64_t)plan->requirements.instances + 3 * plan->requirements.triangles);
}

void lsf_ray_bundle_raster_plan(lsf_plan *plan, const lsf_ray_bundle_params *params)
{
    uint64_t bytes = large_bytes(plan);
    if (params->raster == LSF_RAY_BUNDLE_RASTER_GL)
        lsf_plan_omit(plan, "ray_bundle.large", "bundle.raster is gl");
    else if (plan->requirements.triangles == 0)
        lsf_plan_omit(plan, "ray_bundle.large", "the scene has no triangles");
    else if (bytes > LSF_STORAGE_BLOCK_BYTES)
        lsf_plan_omit(plan, "ray_bundle.large", "the scene has too many triangles for its list");
    else
        lsf_plan_buffer_add(plan, "ray_bundle.large", bytes,
                            "large triangles, which GL draws; a shader rasterises small ones");
}

bool lsf_ray_bundle_raster_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/ray_bundle_small.comp.glsl"};
    if (!lsf_plan_find(plan, "ray_bundle.large"))
        return true;
    pass->draw_count = plan->requirements.instances;
    pass->draws = lsf_alloc(pass->draw_count, sizeof *pass->draws);
    if (!pass->draws)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u instances",
                             pass->draw_count);
    if (!lsf_plan_create_buffer(plan, pass->context, "ray_bundle.large", NULL,
                                GL_DYNAMIC_STORAGE_BIT, &pass->large, error) ||
        !lsf_triangle_fetch_create(&pass->fetch, pass->context, error))
        return false;
    pass->small_program = lsf_plan_program(plan, pass->context, "ray_bundle_build", files, error);
    return pass->small_program != 0;
}

/* Draws of no triangles yet, each with room for all of its instance's. */
static void reset_draws(lsf_ray_bundle *pass, const lsf_iteration *iteration)
{
    const lsf_scene *scene = iteration->scene->scene;
    uint32_t first = DRAW_WORDS * pass->draw_count;
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        pass->draws[i] = (lsf_ray_bundle_draw){0, 1, first, 0, i};
        first += scene->primitives[iteration->state->instances[i].primitive].index_count;
    }
    glNamedBufferSubData(pass->large, 0, (GLsizeiptr)(pass->draw_count * sizeof *pass->draws),
                         pass->draws);
}

/* Coprime to `groups`, and near the golden section of it: multiples modulo `groups` visit all, the
 * first few of any run of them far apart. */
static uint32_t stride_of(uint32_t groups)
{
    uint32_t stride = (uint32_t)(0.618 * groups) + 1, a, b;
    do {
        stride--;
        for (a = groups, b = stride; b != 0;) {
            uint32_t rest = a % b;
            a = b;
            b = rest;
        }
    } while (a != 1 && stride > 1);
    return stride > 0 ? stride : 1;
}

void lsf_ray_bundle_raster_run(lsf_ray_bundle *pass, const lsf_iteration *iteration,
                               uint32_t bundle)
{
    const lsf_scene_gpu *scene = iteration->scene;
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    reset_draws(pass, iteration);
    lsf_triangle_fetch_bind(&pass->fetch, scene);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_BUNDLE_LARGE, pass->large);
    glUseProgram(pass->small_program);
    glUniform1ui(0, pass->capacity);
    glUniform1f(8, ldexpf(1.0f, bits));
    lsf_ray_bundle_set_chance(pass, iteration, bundle);
    uint32_t bound = LSF_NONE;
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        uint32_t index = scene->draw_order[i];
        const lsf_instance_state *instance = &iteration->state->instances[index];
        if (instance->skipped)
            continue;
        if (instance->material != bound)
            lsf_scene_gpu_bind_material(scene, bound = instance->material, LSF_DRAW_POINTWISE);
        const lsf_primitive *primitive = &scene->scene->primitives[instance->primitive];
        for (uint32_t first = 0; first < primitive->index_count / 3; first += MAX_TRIANGLES) {
            uint32_t triangles = primitive->index_count / 3 - first;
            triangles = triangles < MAX_TRIANGLES ? triangles : MAX_TRIANGLES;
            lsf_triangle_fetch_instance(iteration, index, first, triangles);
            uint32_t groups = (triangles + LSF_BUNDLE_SMALL_SIZE - 1) / LSF_BUNDLE_SMALL_SIZE;
            glUniform1ui(27, stride_of(groups));
            glDispatchCompute(groups, 1, 1);
        }
    }
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(pass->build_program);
    glUniform1ui(0, pass->capacity);
    lsf_ray_bundle_set_chance(pass, iteration, bundle);
    lsf_scene_gpu_draw_listed(scene, iteration->state, pass->large);
}

void lsf_ray_bundle_raster_destroy(lsf_ray_bundle *pass)
{
    lsf_buffer_destroy(pass->context, &pass->large);
    lsf_triangle_fetch_destroy(&pass->fetch);
    free(pass->draws);
}
