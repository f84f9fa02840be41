#include "passes/sky_map.h"
#include "frame/purpose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

/* A batch ends at a boundary of uniform buffers' ranges (GL 4.5, table 23.64). */
_Static_assert(LSF_SKY_MAPS_MAX * sizeof(struct lsf_sky_map_data) % 256 == 0, "see sky_map_data.h");

/* What the maps of a batch may take where more than one fits: fetching triangles once for all pays
 * for small maps. */
#define BATCH_BYTES ((uint64_t)32 << 20)

#define BINDING_TRIANGLES 3 /* storage buffer */

#define GROUP_SIZE 64

/* Triangles that may be this many texels long have a work group each, others an invocation. */
#define MANY_TEXELS 5.0f

/* Work groups of a dispatch that GL promises (GL 4.5, table 23.61). */
#define LARGE_DISPATCH 65535u

static uint32_t batch_of(const lsf_plan *plan, uint32_t side)
{
    uint64_t fitting = BATCH_BYTES / ((uint64_t)side * side * sizeof(uint32_t));
    uint32_t batch = fitting < LSF_SKY_MAPS_MAX ? (uint32_t)fitting : LSF_SKY_MAPS_MAX;
    batch = batch < plan->sky_lights ? batch : plan->sky_lights;
    return batch > 0 ? batch : 1;
}

void lsf_sky_map_plan(lsf_plan *plan, uint32_t side)
{
    uint32_t batch = batch_of(plan, side);
    lsf_texture_desc desc = {NULL, GL_TEXTURE_2D_ARRAY, GL_R32UI, side, side, batch, 1};
    lsf_plan_pass_add(plan, "sky_map", "what %u direction%s of the environment see%s",
                      plan->sky_lights, lsf_plural(plan->sky_lights),
                      plan->sky_lights == 1 ? "s" : "");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_mask_switches(plan);
    lsf_plan_texture_desc_add(plan, "sky_map.map", &desc, "%u direction%s at a time", batch,
                              lsf_plural(batch));
    desc.internal_format = GL_DEPTH_COMPONENT32F;
    desc.depth = 1;
    lsf_plan_texture_desc_add(plan, "sky_map.depth", &desc, "what the pipeline draws, of one map");
    /* Up to a batch's end. */
    uint64_t slots = (uint64_t)plan->sky_lights + LSF_SKY_MAPS_MAX;
    lsf_plan_buffer_add(plan, "sky_map.maps", slots * sizeof(struct lsf_sky_map_data),
                        "directions and their maps' projections");
    lsf_scene_gpu_plan_triangles(plan);
    if (!plan->straight || !lsf_light_walls_needed(plan))
        return;
    lsf_plan_pass_add(plan, "sky_map_straight", "light passes materials that transmit");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_material_switches(plan, true, false);
    lsf_scene_gpu_media_switch(plan);
    desc.internal_format = lsf_light_tint_format(plan);
    desc.depth = batch;
    lsf_plan_texture_desc_add(plan, "sky_map.tint", &desc, "what it leaves of the light");
}

static bool create_straight(lsf_sky_map *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/sky_map_straight.vert.glsl",
                                         "passes/sky_map_straight.frag.glsl"};
    static const char *const tint_files[5] = {"passes/sky_map_straight.vert.glsl",
                                              "passes/sky_map_straight_tint.frag.glsl"};
    if (!lsf_plan_find_pass(plan, "sky_map_straight"))
        return true;
    if (!lsf_plan_create_texture(plan, pass->context, "sky_map.tint", &pass->outputs.shadow.tint,
                                 error))
        return false;
    for (uint32_t i = 0; i < pass->batch; i++) {
        lsf_framebuffer_desc desc = {.label = "sky_map.tint",
                                     .color_count = 1,
                                     .colors = {pass->outputs.shadow.tint},
                                     .layer = (int32_t)i};
        pass->tint_framebuffers[i] = lsf_framebuffer_create(pass->context, &desc, error);
        if (!pass->tint_framebuffers[i])
            return false;
    }
    pass->straight_program =
        lsf_plan_program(plan, pass->context, "sky_map_straight", files, error);
    pass->tint_program =
        lsf_plan_program(plan, pass->context, "sky_map_straight", tint_files, error);
    return pass->straight_program && pass->tint_program;
}

/* The scene's listed triangles as vertices. */
static void create_array(lsf_sky_map *pass, const lsf_scene_gpu *scene)
{
    glCreateVertexArrays(1, &pass->large_array);
    glVertexArrayVertexBuffer(pass->large_array, 0, scene->triangles, 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(pass->large_array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(pass->large_array, 0, 0);
    glEnableVertexArrayAttrib(pass->large_array, 0);
}

static bool create_buffers(lsf_sky_map *pass, const lsf_plan *plan, lsf_error *error)
{
    lsf_context *context = pass->context;
    return lsf_plan_create_texture(plan, context, "sky_map.map", &pass->outputs.shadow.depth,
                                   error) &&
           lsf_plan_create_texture(plan, context, "sky_map.depth", &pass->depth, error) &&
           lsf_plan_create_buffer(plan, context, "sky_map.maps", NULL, GL_DYNAMIC_STORAGE_BIT,
                                  &pass->outputs.shadow.light, error);
}

bool lsf_sky_map_create(lsf_sky_map *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_scene_gpu *scene, lsf_error *error)
{
    static const char *const small_files[5] = {"passes/sky_map_small.comp.glsl"};
    static const char *const large_files[5] = {"passes/sky_map_large.vert.glsl",
                                               "passes/sky_map_large.frag.glsl"};
    static const char *const map_files[5] = {"passes/sky_map.vert.glsl",
                                             "passes/sky_map.frag.glsl"};
    const lsf_plan_resource *map = lsf_plan_find(plan, "sky_map.map");
    *pass = (lsf_sky_map){.context = context,
                          .masked = plan->requirements.masked || plan->requirements.blended,
                          .batch = map->texture.depth,
                          .side = map->texture.width};
    pass->maps = lsf_alloc(plan->sky_lights, sizeof *pass->maps);
    pass->regions = lsf_alloc(plan->sky_lights, sizeof *pass->regions);
    if (!pass->maps || !pass->regions)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for %u directions of the environment",
                             plan->sky_lights);
    if (!create_buffers(pass, plan, error))
        return false;
    if (scene->triangle_count > 0)
        create_array(pass, scene);
    /* Layers of both are drawn to one after the other. */
    lsf_framebuffer_desc desc = {.label = "sky_map",
                                 .color_count = 1,
                                 .colors = {pass->outputs.shadow.depth},
                                 .depth = pass->depth,
                                 .layer = 0};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->small_program = lsf_plan_program(plan, context, "sky_map", small_files, error);
    pass->large_program = lsf_plan_program(plan, context, "sky_map", large_files, error);
    pass->map_program = lsf_plan_program(plan, context, "sky_map", map_files, error);
    pass->timer = lsf_timer_create(context, "sky_map", error);
    return pass->framebuffer && pass->small_program && pass->large_program && pass->map_program &&
           pass->timer && create_straight(pass, plan, error);
}

/* scale (axis . (p - origin)) + offset */
static lsf_vec4 row_of(const lsf_vec4 *axis, const lsf_vec4 *origin, double scale, double offset)
{
    double start = (double)axis->x * (double)origin->x + (double)axis->y * (double)origin->y +
                   (double)axis->z * (double)origin->z;
    return (lsf_vec4){(float)(scale * (double)axis->x), (float)(scale * (double)axis->y),
                      (float)(scale * (double)axis->z), (float)(offset - scale * start)};
}

/* A light's orthographic map as affine functions of a point. */
static struct lsf_sky_map_data map_of(const struct lsf_light_data *light)
{
    const lsf_vec4 *window = &light->map_window[0];
    double near_plane = (double)light->map_shape.x, far_plane = (double)light->map_shape.y;
    double side = (double)light->map_shape.z, range = far_plane - near_plane;
    double scale[2] = {0.5 * side / (double)window->z, 0.5 * side / (double)window->w};
    double middle[2] = {0.5 * side * (1.0 + (double)light->map_offset.x),
                        0.5 * side * (1.0 + (double)light->map_offset.y)};
    return (struct lsf_sky_map_data){
        .right = row_of(&light->map_right[0], &light->map_origin, scale[0],
                        middle[0] - scale[0] * (double)window->x),
        .up = row_of(&light->map_up[0], &light->map_origin, scale[1],
                     middle[1] - scale[1] * (double)window->y),
        .towards =
            row_of(&light->map_forward[0], &light->map_origin, -1.0 / range, far_plane / range),
        .to_sky = {-light->direction.x, -light->direction.y, -light->direction.z,
                   light->intensity.w},
        .irradiance = {light->intensity.x, light->intensity.y, light->intensity.z,
                       light->map_offset.w},
        .texel = {(float)(1.0 / scale[0]), (float)(1.0 / scale[1]), (float)range, (float)side},
        .error = {light->map_offset.z, 0.0f, 0.0f, 0.0f}};
}

void lsf_sky_map_begin(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    const lsf_light_projection_layout layout = {.faces = 1,
                                                .view = true,
                                                .fitted = true,
                                                .resolution = pass->side,
                                                .purpose = LSF_PURPOSE_SHADOW_MAP,
                                                .use = LSF_LIGHT_STRAIGHT};
    uint32_t first = iteration->state->light_count, count = iteration->light_count - first;
    for (uint32_t i = 0; i < count; i++) {
        struct lsf_light_data data;
        lsf_light_projection_project(&data, iteration, first + i, &layout);
        lsf_light_projection_region(&data, 0, &pass->regions[i]);
        pass->maps[i] = map_of(&data);
    }
    glNamedBufferSubData(pass->outputs.shadow.light, 0, (GLsizeiptr)(count * sizeof *pass->maps),
                         pass->maps);
    pass->outputs.first = pass->outputs.count = 0;
}

/* Of the scene's listed triangles, the largest of which come first, how many the pipeline draws. */
static uint32_t large_count(const lsf_sky_map *pass, const lsf_iteration *iteration, uint32_t layer)
{
    const lsf_vec4 *texel = &pass->maps[pass->outputs.first + layer].texel;
    return lsf_scene_gpu_triangles_from(iteration->scene, MANY_TEXELS * fminf(texel->x, texel->y));
}

/* What the pipeline draws into a map of the batch. */
static void draw_surfaces(lsf_sky_map *pass, const lsf_iteration *iteration, uint32_t layer)
{
    static const GLuint nothing[4] = {0};
    static const GLfloat farthest[4] = {0};
    uint32_t light = iteration->state->light_count + pass->outputs.first + layer;
    const lsf_draw_region *region = &pass->regions[pass->outputs.first + layer];
    bool listed = iteration->scene->triangle_count > 0;
    lsf_begin_surfaces(pass->side, pass->side, pass->large_program);
    glEnable(GL_DEPTH_CLAMP);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->framebuffer);
    glNamedFramebufferTextureLayer(pass->framebuffer, GL_COLOR_ATTACHMENT0,
                                   pass->outputs.shadow.depth, 0, (GLint)layer);
    glClearNamedFramebufferuiv(pass->framebuffer, GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(pass->framebuffer, GL_DEPTH, 0, farthest);
    if (listed) {
        uint32_t large = large_count(pass, iteration, layer);
        glUniform1i(0, (GLint)layer);
        glBindVertexArray(pass->large_array);
        glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * large));
        pass->counts[LSF_DRAW_TRIANGLES] += large;
    }
    if (pass->masked || !listed) {
        glUseProgram(pass->map_program);
        glUniform1i(0, (GLint)layer);
        lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_SHADOW_MAP, light);
        lsf_scene_gpu_draw(iteration->scene, iteration->state,
                           listed ? LSF_DRAW_MASKED : LSF_DRAW_OPAQUE, region, pass->counts);
    }
    if (pass->straight_program) {
        glUseProgram(pass->straight_program);
        glUniform1i(0, (GLint)layer);
        lsf_iteration_set_chance(iteration, LSF_PURPOSE_STRAIGHT_SHADOW_MAP, light);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_TRANSMISSIVE, region,
                           pass->counts);
    }
}

/* The other triangles that are listed, by a compute shader. */
static void draw_small(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    const lsf_scene_gpu *scene = iteration->scene;
    if (scene->triangle_count == 0)
        return;
    glBindImageTexture(0, pass->outputs.shadow.depth, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES, scene->triangles);
    glUseProgram(pass->small_program);
    for (uint32_t layer = 0; layer < pass->outputs.count; layer++) {
        uint32_t large = large_count(pass, iteration, layer);
        uint32_t small = scene->triangle_count - large;
        glUniform1i(0, (GLint)layer);
        glUniform2ui(1, large, scene->triangle_count);
        glDispatchCompute((small + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
        pass->counts[LSF_DRAW_TRIANGLES] += small;
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

/* The tint of what lets light through and is not there, before what the maps show. */
static void draw_tints(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    static const GLfloat white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    lsf_begin_fullscreen(pass->tint_framebuffers[0], pass->side, pass->side, pass->tint_program);
    glEnable(GL_DEPTH_CLAMP);
    lsf_blend_multiply(0);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, pass->outputs.shadow.depth);
    for (uint32_t i = 0; i < pass->outputs.count; i++) {
        uint32_t light = iteration->state->light_count + pass->outputs.first + i;
        glBindFramebuffer(GL_FRAMEBUFFER, pass->tint_framebuffers[i]);
        glClearNamedFramebufferfv(pass->tint_framebuffers[i], GL_COLOR, 0, white);
        glUniform1i(0, (GLint)i);
        lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_SHADOW_MAP, light);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_TRANSMISSIVE,
                           &pass->regions[pass->outputs.first + i], pass->counts);
    }
}

bool lsf_sky_map_next(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    lsf_sky_map_outputs *out = &pass->outputs;
    uint32_t total = iteration->plan->sky_lights;
    out->first += out->count;
    if (out->first >= total)
        return false;
    out->count = total - out->first < pass->batch ? total - out->first : pass->batch;
    lsf_timer_begin(pass->timer);
    out->shadow.offset = (GLintptr)(out->first * sizeof *pass->maps);
    out->shadow.size = LSF_SKY_MAPS_MAX * sizeof *pass->maps;
    glBindBufferRange(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, out->shadow.light, out->shadow.offset,
                      out->shadow.size);
    for (uint32_t layer = 0; layer < out->count; layer++)
        draw_surfaces(pass, iteration, layer);
    draw_small(pass, iteration);
    if (pass->tint_program)
        draw_tints(pass, iteration);
    lsf_timer_end(pass->timer);
    return true;
}

void lsf_sky_map_destroy(lsf_sky_map *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    for (uint32_t i = 0; i < LSF_SKY_MAPS_MAX; i++)
        lsf_framebuffer_destroy(pass->context, &pass->tint_framebuffers[i]);
    glDeleteVertexArrays(1, &pass->large_array);
    lsf_texture_destroy(pass->context, &pass->depth);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow.depth);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow.tint);
    lsf_buffer_destroy(pass->context, &pass->outputs.shadow.light);
    lsf_timer_destroy(pass->timer);
    free(pass->maps);
    free(pass->regions);
    memset(pass, 0, sizeof *pass);
}
