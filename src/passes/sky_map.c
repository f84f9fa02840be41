#include "passes/sky_map.h"
#include "frame/purpose.h"

#include <math.h>
#include <stdio.h>
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

/* Texels along a side of a map, where what the camera sees needs fewer. */
#define MIN_SIDE 32

/* The pipeline draws triangles that may be this many texels long, a compute shader the others. */
#define MANY_TEXELS 16.0f

typedef struct resource_name {
    char text[64];
} resource_name;

static resource_name name_of(const char *prefix, const char *what)
{
    resource_name name;
    snprintf(name.text, sizeof name.text, "sky_map.%s%s", prefix, what);
    return name;
}

static uint32_t batch_of(const lsf_plan *plan, uint32_t side)
{
    uint64_t fitting = BATCH_BYTES / ((uint64_t)side * side * sizeof(uint32_t));
    uint32_t batch = fitting < LSF_SKY_MAPS_MAX ? (uint32_t)fitting : LSF_SKY_MAPS_MAX;
    batch = batch < plan->sky_lights ? batch : plan->sky_lights;
    return batch > 0 ? batch : 1;
}

static void plan_target(lsf_plan *plan, const char *prefix, uint32_t side, const char *what)
{
    uint32_t batch = batch_of(plan, side);
    lsf_texture_desc desc = {NULL, GL_TEXTURE_2D_ARRAY, GL_R32UI, side, side, batch, 1};
    lsf_plan_texture_desc_add(plan, name_of(prefix, "map").text, &desc,
                              "%u direction%s at a time%s", batch, lsf_plural(batch), what);
    desc.internal_format = GL_DEPTH_COMPONENT32F;
    desc.depth = 1;
    lsf_plan_texture_desc_add(plan, name_of(prefix, "depth").text, &desc,
                              "what the pipeline draws, of one map");
    /* Up to a batch's end. */
    uint64_t slots = (uint64_t)plan->sky_lights + LSF_SKY_MAPS_MAX;
    lsf_plan_buffer_add(plan, name_of(prefix, "maps").text, slots * sizeof(struct lsf_sky_map_data),
                        "directions and their maps' projections");
    if (!lsf_plan_find_pass(plan, "sky_map_straight"))
        return;
    desc.internal_format = lsf_light_tint_format(plan);
    desc.depth = batch;
    lsf_plan_texture_desc_add(plan, name_of(prefix, "tint").text, &desc,
                              "what it leaves of the light");
}

void lsf_sky_map_plan(lsf_plan *plan, uint32_t side)
{
    lsf_plan_pass_add(plan, "sky_map", "what %u direction%s of the environment see%s",
                      plan->sky_lights, lsf_plural(plan->sky_lights),
                      plan->sky_lights == 1 ? "s" : "");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_mask_switches(plan);
    if (plan->straight && lsf_light_walls_needed(plan)) {
        lsf_plan_pass_add(plan, "sky_map_straight", "light passes materials that transmit");
        lsf_plan_reads(plan, "scene");
        lsf_scene_gpu_material_switches(plan, true, false);
        lsf_scene_gpu_media_switch(plan);
    }
    if (side > 0)
        plan_target(plan, "", side, "");
    lsf_scene_gpu_plan_triangles(plan);
}

void lsf_sky_map_plan_scene(lsf_plan *plan, uint32_t side)
{
    plan_target(plan, "scene_", side, ", for voxels that the camera's maps do not hold");
}

static bool create_tint(lsf_sky_map_target *target, lsf_context *context, const lsf_plan *plan,
                        const char *name, lsf_error *error)
{
    if (!lsf_plan_create_texture(plan, context, name, &target->tint, error))
        return false;
    for (uint32_t i = 0; i < target->batch; i++) {
        lsf_framebuffer_desc desc = {
            .label = name, .color_count = 1, .colors = {target->tint}, .layer = (int32_t)i};
        target->tint_framebuffers[i] = lsf_framebuffer_create(context, &desc, error);
        if (!target->tint_framebuffers[i])
            return false;
    }
    return true;
}

static bool create_target(lsf_sky_map_target *target, lsf_context *context, const lsf_plan *plan,
                          const char *prefix, lsf_error *error)
{
    const resource_name map_name = name_of(prefix, "map"), tint_name = name_of(prefix, "tint");
    const lsf_plan_resource *map = lsf_plan_find(plan, map_name.text);
    if (!map)
        return true;
    target->batch = map->texture.depth;
    target->side = map->texture.width;
    target->maps = lsf_alloc(plan->sky_lights, sizeof *target->maps);
    target->regions = lsf_alloc(plan->sky_lights, sizeof *target->regions);
    target->lights = lsf_alloc(plan->sky_lights, sizeof *target->lights);
    if (!target->maps || !target->regions || !target->lights)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for %u directions of the environment",
                             plan->sky_lights);
    if (!lsf_plan_create_texture(plan, context, map_name.text, &target->map, error) ||
        !lsf_plan_create_texture(plan, context, name_of(prefix, "depth").text, &target->depth,
                                 error) ||
        !lsf_plan_create_buffer(plan, context, name_of(prefix, "maps").text, NULL,
                                GL_DYNAMIC_STORAGE_BIT, &target->buffer, error))
        return false;
    /* Layers of both are drawn to one after the other. */
    lsf_framebuffer_desc desc = {.label = map_name.text,
                                 .color_count = 1,
                                 .colors = {target->map},
                                 .depth = target->depth,
                                 .layer = 0};
    target->framebuffer = lsf_framebuffer_create(context, &desc, error);
    return target->framebuffer && (!lsf_plan_find(plan, tint_name.text) ||
                                   create_tint(target, context, plan, tint_name.text, error));
}

static bool create_straight(lsf_sky_map *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/sky_map_straight.vert.glsl",
                                         "passes/sky_map_straight.frag.glsl"};
    static const char *const tint_files[5] = {"passes/sky_map_straight.vert.glsl",
                                              "passes/sky_map_straight_tint.frag.glsl"};
    if (!lsf_plan_find_pass(plan, "sky_map_straight"))
        return true;
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

bool lsf_sky_map_create(lsf_sky_map *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_scene_gpu *scene, lsf_error *error)
{
    static const char *const small_files[5] = {"passes/sky_map_small.comp.glsl"};
    static const char *const large_files[5] = {"passes/sky_map_large.vert.glsl",
                                               "passes/sky_map_large.frag.glsl"};
    static const char *const map_files[5] = {"passes/sky_map.vert.glsl",
                                             "passes/sky_map.frag.glsl"};
    *pass = (lsf_sky_map){.context = context,
                          .masked = plan->requirements.masked || plan->requirements.blended};
    if (!create_target(&pass->seen, context, plan, "", error) ||
        !create_target(&pass->scene, context, plan, "scene_", error))
        return false;
    if (scene->triangle_count > 0)
        create_array(pass, scene);
    pass->small_program = lsf_plan_program(plan, context, "sky_map", small_files, error);
    pass->large_program = lsf_plan_program(plan, context, "sky_map", large_files, error);
    pass->map_program = lsf_plan_program(plan, context, "sky_map", map_files, error);
    pass->timer = lsf_timer_create(context, "sky_map", error);
    return pass->small_program && pass->large_program && pass->map_program && pass->timer &&
           create_straight(pass, plan, error);
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
static struct lsf_sky_map_data map_of(const struct lsf_light_data *light, bool whole)
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
        .error = {light->map_offset.z, whole ? 1.0f : 0.0f, 0.0f, 0.0f}};
}

/* `seen`: what the camera sees, with texels from `least` to `side` along a side; else the scene. */
static struct lsf_light_data project(const lsf_iteration *iteration, uint32_t light, uint32_t least,
                                     uint32_t side, bool seen)
{
    const lsf_light_projection_layout layout = {.faces = 1,
                                                .view = seen,
                                                .fitted = seen,
                                                .least = least,
                                                .resolution = side,
                                                .purpose = LSF_PURPOSE_SHADOW_MAP,
                                                .use = LSF_LIGHT_STRAIGHT};
    struct lsf_light_data data;
    lsf_light_projection_project(&data, iteration, light, &layout);
    return data;
}

/* Whether a map of what the camera sees serves all points of the scene: its window and its depths
 * hold them, and its texels are as fine as those of a map of the whole scene. */
static bool serves_scene(const lsf_sky_map *pass, const lsf_iteration *iteration, uint32_t light,
                         const struct lsf_light_data *seen)
{
    uint32_t side = (uint32_t)seen->map_shape.z;
    if (pass->scene.side == 0 || side < pass->scene.side)
        return false;
    struct lsf_light_data scene = project(iteration, light, side, side, false);
    return memcmp(&seen->map_window[0], &scene.map_window[0], sizeof scene.map_window[0]) == 0 &&
           seen->map_shape.x <= scene.map_shape.x && seen->map_shape.y >= scene.map_shape.y;
}

static void add_map(lsf_sky_map_target *target, uint32_t light, const struct lsf_light_data *data,
                    bool whole)
{
    lsf_light_projection_region(data, 0, &target->regions[target->count]);
    target->maps[target->count] = map_of(data, whole);
    target->lights[target->count++] = light;
}

/* Batches of the maps come next. */
static void start(lsf_sky_map *pass, const lsf_sky_map_target *target)
{
    pass->target = target;
    pass->outputs = (lsf_sky_map_outputs){
        .shadow = {.depth = target->map, .tint = target->tint, .light = target->buffer}};
    if (target->count > 0)
        glNamedBufferSubData(target->buffer, 0, (GLsizeiptr)(target->count * sizeof *target->maps),
                             target->maps);
}

void lsf_sky_map_begin(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    lsf_sky_map_target *target = &pass->seen;
    uint32_t least = pass->scene.side > MIN_SIDE ? pass->scene.side : MIN_SIDE;
    target->count = 0;
    for (uint32_t i = iteration->state->light_count; i < iteration->light_count; i++) {
        struct lsf_light_data data = project(iteration, i, least, target->side, true);
        add_map(target, i, &data, serves_scene(pass, iteration, i, &data));
    }
    start(pass, target);
}

void lsf_sky_map_begin_scene(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    lsf_sky_map_target *target = &pass->scene;
    uint32_t first = iteration->state->light_count;
    target->count = 0;
    for (uint32_t i = first; i < iteration->light_count; i++) {
        if (pass->seen.count > 0 && pass->seen.maps[i - first].error.y > 0.0f)
            continue;
        struct lsf_light_data data = project(iteration, i, target->side, target->side, false);
        add_map(target, i, &data, true);
    }
    start(pass, target);
}

/* Texels along a side of a map of the batch. */
static uint32_t side_of(const lsf_sky_map *pass, uint32_t layer)
{
    return (uint32_t)pass->target->maps[pass->outputs.first + layer].texel.w;
}

/* Of the scene's listed triangles, the largest of which come first, how many the pipeline draws. */
static uint32_t large_count(const lsf_sky_map *pass, const lsf_iteration *iteration, uint32_t layer)
{
    const lsf_vec4 *texel = &pass->target->maps[pass->outputs.first + layer].texel;
    return lsf_scene_gpu_triangles_from(iteration->scene, MANY_TEXELS * fminf(texel->x, texel->y));
}

/* What the pipeline draws into a map of the batch. */
static void draw_surfaces(lsf_sky_map *pass, const lsf_iteration *iteration, uint32_t layer)
{
    static const GLuint nothing[4] = {0};
    static const GLfloat farthest[4] = {0};
    const lsf_sky_map_target *target = pass->target;
    uint32_t light = target->lights[pass->outputs.first + layer];
    const lsf_draw_region *region = &target->regions[pass->outputs.first + layer];
    bool listed = iteration->scene->triangle_count > 0;
    uint32_t side = side_of(pass, layer);
    lsf_begin_surfaces(side, side, pass->large_program);
    glEnable(GL_DEPTH_CLAMP);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glNamedFramebufferTextureLayer(target->framebuffer, GL_COLOR_ATTACHMENT0,
                                   pass->outputs.shadow.depth, 0, (GLint)layer);
    glClearNamedFramebufferuiv(target->framebuffer, GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(target->framebuffer, GL_DEPTH, 0, farthest);
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

/* The other triangles that are listed, by a compute shader. The list takes at most 128 MiB, whose
 * triangles need fewer work groups than GL promises for a dispatch (GL 4.5, table 23.61). */
static void draw_small(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    const lsf_scene_gpu *scene = iteration->scene;
    if (scene->triangle_count == 0)
        return;
    glBindImageTexture(0, pass->outputs.shadow.depth, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES, scene->triangles);
    glUseProgram(pass->small_program);
    uint32_t firsts[LSF_SKY_MAPS_MAX], first = scene->triangle_count;
    for (uint32_t layer = 0; layer < pass->outputs.count; layer++) {
        firsts[layer] = large_count(pass, iteration, layer);
        first = firsts[layer] < first ? firsts[layer] : first;
        pass->counts[LSF_DRAW_TRIANGLES] += scene->triangle_count - firsts[layer];
    }
    glUniform1i(0, (GLint)pass->outputs.count);
    glUniform2ui(1, first, scene->triangle_count);
    glUniform1uiv(2, (GLsizei)pass->outputs.count, firsts);
    glDispatchCompute((scene->triangle_count - first + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

/* The tint of what lets light through and is not there, before what the maps show. */
static void draw_tints(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    static const GLfloat white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    const lsf_sky_map_target *target = pass->target;
    lsf_begin_fullscreen(target->tint_framebuffers[0], target->side, target->side,
                         pass->tint_program);
    glEnable(GL_DEPTH_CLAMP);
    lsf_blend_multiply(0);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, pass->outputs.shadow.depth);
    for (uint32_t i = 0; i < pass->outputs.count; i++) {
        uint32_t light = target->lights[pass->outputs.first + i];
        glBindFramebuffer(GL_FRAMEBUFFER, target->tint_framebuffers[i]);
        glViewport(0, 0, (GLsizei)side_of(pass, i), (GLsizei)side_of(pass, i));
        glClearNamedFramebufferfv(target->tint_framebuffers[i], GL_COLOR, 0, white);
        glUniform1i(0, (GLint)i);
        lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_SHADOW_MAP, light);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_TRANSMISSIVE,
                           &target->regions[pass->outputs.first + i], pass->counts);
    }
}

bool lsf_sky_map_next(lsf_sky_map *pass, const lsf_iteration *iteration)
{
    lsf_sky_map_outputs *out = &pass->outputs;
    const lsf_sky_map_target *target = pass->target;
    out->first += out->count;
    if (out->first >= target->count)
        return false;
    uint32_t left = target->count - out->first;
    out->count = left < target->batch ? left : target->batch;
    out->whole = 0;
    for (uint32_t i = 0; i < out->count; i++)
        out->whole += target->maps[out->first + i].error.y > 0.0f;
    lsf_timer_begin(pass->timer);
    out->shadow.offset = (GLintptr)(out->first * sizeof *target->maps);
    out->shadow.size = LSF_SKY_MAPS_MAX * sizeof *target->maps;
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

static void destroy_target(lsf_context *context, lsf_sky_map_target *target)
{
    lsf_framebuffer_destroy(context, &target->framebuffer);
    for (uint32_t i = 0; i < LSF_SKY_MAPS_MAX; i++)
        lsf_framebuffer_destroy(context, &target->tint_framebuffers[i]);
    lsf_texture_destroy(context, &target->depth);
    lsf_texture_destroy(context, &target->map);
    lsf_texture_destroy(context, &target->tint);
    lsf_buffer_destroy(context, &target->buffer);
    free(target->maps);
    free(target->regions);
    free(target->lights);
}

void lsf_sky_map_destroy(lsf_sky_map *pass)
{
    if (!pass->context)
        return;
    destroy_target(pass->context, &pass->seen);
    destroy_target(pass->context, &pass->scene);
    glDeleteVertexArrays(1, &pass->large_array);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
