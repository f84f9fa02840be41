#include "bundle_rig.h"

#include <math.h>

#include "octahedral.h"

static void read_back(bundle_rig *rig, GLuint hits)
{
    const lsf_surface_maps *gbuffer = &rig->gbuffer.outputs.seen;
    GLsizei pixels = (GLsizei)(rig->width * rig->height);
    rig->depth = malloc((size_t)pixels * 4);
    rig->surface = malloc((size_t)pixels * 16);
    rig->hits = malloc((size_t)pixels * 8);
    glGetTextureImage(gbuffer->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, pixels * 4, rig->depth);
    glGetTextureImage(gbuffer->surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixels * 16,
                      rig->surface);
    glGetTextureImage(hits, 0, GL_RG_INTEGER, GL_UNSIGNED_INT, pixels * 8, rig->hits);
    glGetNamedBufferSubData(rig->bundle->projection_buffer, 0, sizeof rig->data, &rig->data);
}

void bundle_rig_run(bundle_rig *rig, const lsf_scene *scene, const lsf_render_params *params,
                    const lsf_ray_bundle_params *bundle, lsf_float3 direction, bool distances_only)
{
    lsf_error error = {0};
    *rig = (bundle_rig){.width = params->width, .height = params->height};
    rig->context = gl_test_context(gl_test_backend(), NULL);
    const lsf_ray_bundle_use use = {
        .count = 1, .slots = 1, .interleave = 1, .distances_only = distances_only};
    const lsf_gbuffer_params gbuffer = {LSF_GBUFFER_PARAMS_DEFAULTS};
    if (!lsf_setup_begin(&rig->setup, scene, params, true, &error))
        fail_msg("%s", error.message);
    lsf_plan *plan = rig->setup.plan;
    lsf_gbuffer_plan(plan);
    lsf_ray_bundle_plan(plan, bundle, &use);
    if (!lsf_scene_gpu_create(&rig->scene, rig->context, plan, scene, &rig->setup.state, NULL,
                              &error) ||
        !lsf_iteration_create(&rig->iteration, rig->context, plan, &rig->scene, &rig->setup.state,
                              NULL, params->seed, &error) ||
        !lsf_gbuffer_create(&rig->gbuffer, rig->context, plan, &gbuffer, &rig->scene, &error) ||
        !lsf_ray_bundle_create(&rig->bundle, rig->context, plan, bundle, &use, &error))
        fail_msg("%s", error.message);
    lsf_iteration_begin(&rig->iteration, 0);
    lsf_gbuffer_run(&rig->gbuffer, &rig->iteration);
    const lsf_ray_bundle_direction along = {{direction.x, direction.y, direction.z}, 0.5f};
    const lsf_region region = {0, 0, (int32_t)rig->width, (int32_t)rig->height, 0, 0};
    const lsf_ray_bundle_origins origins = {.depth = rig->gbuffer.outputs.seen.depth,
                                            .surface = rig->gbuffer.outputs.seen.surface};
    lsf_ray_bundle_aim(rig->bundle, &rig->iteration, &along, rig->gbuffer.outputs.seen.depth);
    GLuint hits;
    uint32_t done;
    do {
        lsf_ray_bundle_build(rig->bundle, &rig->iteration, 0);
        hits = lsf_ray_bundle_search(rig->bundle, &rig->iteration, 0, &origins, &region);
        lsf_ray_bundle_end(rig->bundle, &rig->iteration);
    } while (!lsf_ray_bundle_settle(rig->bundle, &rig->iteration, true, &done));
    read_back(rig, hits);
    gl_test_check(rig->context);
    /* What grew is in the plan, too. */
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, lsf_plan_bytes(plan));
}

void bundle_rig_finish(bundle_rig *rig)
{
    lsf_error error = {0};
    if (!lsf_context_make_current(rig->context, &error)) /* rigs may stand beside others */
        fail_msg("%s", error.message);
    lsf_ray_bundle_destroy(rig->bundle);
    lsf_gbuffer_destroy(&rig->gbuffer);
    lsf_iteration_destroy(&rig->iteration);
    lsf_scene_gpu_destroy(&rig->scene);
    lsf_setup_finish(&rig->setup);
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, 0);
    gl_test_check(rig->context);
    lsf_context_destroy(rig->context);
    free(rig->depth);
    free(rig->surface);
    free(rig->hits);
}

bool bundle_rig_origin(const bundle_rig *rig, uint32_t x, uint32_t y, lsf_float3 *position,
                       lsf_float3 *normal)
{
    const struct lsf_view_data *view = &rig->iteration.view;
    size_t pixel = (size_t)y * rig->width + x;
    float depth = rig->depth[pixel];
    float ndc_x = ((float)x + 0.5f) * 2.0f * view->size.z - 1.0f + view->jitter.x;
    float ndc_y = ((float)y + 0.5f) * 2.0f * view->size.w - 1.0f + view->jitter.y;
    lsf_float3 forward = lsf_f3_load(&view->forward.x);
    forward = lsf_f3_mad(forward, lsf_f3_load(&view->forward_dx.x), ndc_x);
    forward = lsf_f3_mad(forward, lsf_f3_load(&view->forward_dy.x), ndc_y);
    *position = lsf_f3_mad(lsf_f3_load(&view->start.x), forward, view->depth.y / depth);
    *normal = octahedral_decode(rig->surface[4 * pixel]);
    return depth != 0.0f;
}

float bundle_rig_distance(const bundle_rig *rig, uint32_t x, uint32_t y, uint32_t *node)
{
    const uint32_t *hit = rig->hits + 2 * ((size_t)y * rig->width + x);
    float distance;
    memcpy(&distance, hit, sizeof distance);
    *node = hit[1];
    return *node == UINT32_MAX ? INFINITY : distance;
}

uint32_t *bundle_rig_array(const bundle_rig *rig, int array)
{
    GLuint buffer = rig->bundle->slots[0].arrays[array];
    GLint64 bytes = 0;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &bytes);
    uint32_t *words = malloc((size_t)bytes);
    glGetNamedBufferSubData(buffer, 0, bytes, words);
    return words;
}

void bundle_rig_hit_words(const bundle_rig *rig, const uint32_t *surfaces, uint32_t pixel,
                          uint32_t words[4])
{
    const uint32_t *hit = rig->hits + 2 * (size_t)pixel;
    memset(words, 0, 4 * sizeof *words);
    words[0] = hit[0];
    if (hit[1] != UINT32_MAX)
        memcpy(words + 1, surfaces + 3 * (size_t)hit[1], 3 * sizeof *words);
}
