#include "frame/emitter_points.h"

#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/scene_data.h"

#define CELL_BITS 6
_Static_assert(LSF_EMITTER_CELLS == 1 << CELL_BITS, "a point's cell is its leading bits");

void lsf_emitter_points_plan(lsf_plan *plan, const char *name)
{
    lsf_upload_plan(plan, name, LSF_EMITTER_POINTS * sizeof(struct lsf_emitter_point_data),
                    "points on emissive surfaces, drawn by power each iteration");
}

bool lsf_emitter_points_create(lsf_emitter_points *points, lsf_context *context,
                               const lsf_plan *plan, const char *name, const lsf_scene *scene,
                               const lsf_state *state, lsf_error *error)
{
    if (!lsf_emitters_init(&points->list, scene, state))
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for the scene's %llu triangles",
                             (unsigned long long)scene->requirements.triangles);
    return lsf_upload_create(&points->upload, context, plan, name, error);
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

/* Of a (0,2)-sequence, as many consecutive points as there are cells, from a multiple of their
 * number on, have one point in each cell. */
bool lsf_emitter_points_draw(lsf_emitter_points *points, const lsf_iteration *iteration,
                             uint32_t purpose)
{
    const lsf_emitters *list = &points->list;
    uint32_t seed = lsf_iteration_seed(iteration, purpose);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_EMITTERS, points->upload.buffer);
    if (!(list->power.sum > 0.0))
        return false;
    struct lsf_emitter_point_data *drawn = lsf_upload_begin(&points->upload);
    for (uint32_t i = 0; i < LSF_EMITTER_POINTS; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(iteration->index * LSF_EMITTER_POINTS + i, seed, bits);
        uint32_t column = bits[0] >> (32 - CELL_BITS), row = bits[1] >> (32 - CELL_BITS);
        drawn[column * LSF_EMITTER_CELLS + row] = point_of(list, bits);
    }
    lsf_upload_end(&points->upload);
    return true;
}

bool lsf_emitter_points_follow(lsf_emitter_points *points, bool materials_edited)
{
    return !points->upload.buffer || lsf_emitters_update(&points->list, materials_edited);
}

void lsf_emitter_points_bind(const lsf_emitter_points *points, int32_t count)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_EMITTERS, points->upload.buffer);
    glUniform2f(LSF_LOCATION_EMITTERS, lsf_emitters_weight(&points->list),
                points->list.power.sum > 0.0 ? (float)count : 0.0f);
}

void lsf_emitter_points_destroy(lsf_emitter_points *points, lsf_context *context)
{
    lsf_upload_destroy(&points->upload, context);
    lsf_emitters_finish(&points->list);
    memset(points, 0, sizeof *points);
}
