/* Points on emissive surfaces that vertices of paths are joined to. */
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "passes/voxel_path.h"

#define POINT_COUNT (LSF_EMITTER_CELLS * LSF_EMITTER_CELLS)
#define CELL_BITS 6
_Static_assert(LSF_EMITTER_CELLS == 1 << CELL_BITS, "a point's cell is its leading bits");

static const char buffer_name[] = "voxel_path.emitters";

void lsf_voxel_path_emitters_plan(lsf_plan *plan, const lsf_voxel_path_params *params)
{
    bool wanted = plan->requirements.emissive && params->emitters > 0;
    lsf_plan_switch_add(plan, "LSF_EMITTERS", wanted,
                        "some material emits, and voxel_path.emitters is not 0");
    if (wanted)
        lsf_plan_buffer_add(plan, buffer_name, POINT_COUNT * sizeof(struct lsf_emitter_point_data),
                            "points on emissive surfaces, drawn by power each iteration");
}

bool lsf_voxel_path_emitters_create(lsf_voxel_path_emitters *emitters, lsf_context *context,
                                    const lsf_plan *plan, const lsf_scene *scene,
                                    const lsf_state *state, lsf_error *error)
{
    if (!lsf_plan_find(plan, buffer_name))
        return true;
    emitters->points = lsf_alloc(POINT_COUNT, sizeof *emitters->points);
    if (!emitters->points || !lsf_emitters_init(&emitters->list, scene, state))
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for the scene's %llu triangles",
                             (unsigned long long)scene->requirements.triangles);
    return lsf_plan_create_buffer(plan, context, buffer_name, NULL, GL_DYNAMIC_STORAGE_BIT,
                                  &emitters->buffer, error);
}

static struct lsf_emitter_point_data point_of(const lsf_emitters *list, const uint32_t bits[2])
{
    const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
    lsf_emitter_sample s = lsf_emitters_sample(list, u);
    return (struct lsf_emitter_point_data){
        .position = {s.position[0], s.position[1], s.position[2], 0.0f},
        .normal = {s.normal[0], s.normal[1], s.normal[2], s.density},
        .radiance = {s.radiance[0], s.radiance[1], s.radiance[2], (float)s.sides}};
}

/* As many points of a (0,2)-sequence as there are cells, from a multiple of their number on, lie
 * one in each. */
void lsf_voxel_path_emitters_draw(lsf_voxel_path_emitters *emitters, const lsf_iteration *iteration,
                                  int32_t count)
{
    const lsf_emitters *list = &emitters->list;
    if (!emitters->buffer)
        return;
    uint32_t seed = lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_EMITTER);
    for (uint32_t i = 0; i < POINT_COUNT && list->power.sum > 0.0; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(iteration->index * POINT_COUNT + i, seed, bits);
        uint32_t column = bits[0] >> (32 - CELL_BITS), row = bits[1] >> (32 - CELL_BITS);
        emitters->points[column * LSF_EMITTER_CELLS + row] = point_of(list, bits);
    }
    glNamedBufferSubData(emitters->buffer, 0, POINT_COUNT * sizeof *emitters->points,
                         emitters->points);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_EMITTERS, emitters->buffer);
    /* Without area nothing is drawn, whatever emits. */
    glUniform2f(2, lsf_emitters_weight(list), list->power.sum > 0.0 ? (float)count : 0.0f);
}

void lsf_voxel_path_emitters_destroy(lsf_voxel_path_emitters *emitters, lsf_context *context)
{
    lsf_buffer_destroy(context, &emitters->buffer);
    lsf_emitters_finish(&emitters->list);
    free(emitters->points);
    memset(emitters, 0, sizeof *emitters);
}
