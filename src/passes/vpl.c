#include "passes/vpl.h"
#include "frame/purpose.h"

#include <string.h>

#include "base/base.h"
#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "math/sampling.h"
#include "shared/light_data.h"
#include "shared/scene_data.h"

/* Bytes from one VPL's map description to the next: a uniform buffer's offset is a multiple of at
 * most 256 (GL 4.5, table 23.64). The shader's array has the same stride. */
#define MAP_STRIDE 512
_Static_assert(sizeof(struct lsf_light_data) == MAP_STRIDE - 16, "see vpl_draw.comp.glsl");

#define GROUP_SIZE 64

/* Storage buffers of vpl_draw and vpl_emitter. */
#define BINDING_MAPS 2
#define BINDING_RANDOM 3
#define BINDING_SUMS 4

/* Uniforms of vpl_small and vpl_large. */
#define BINDING_LARGE 1
#define BINDING_COMMAND 2
#define BINDING_TRIANGLES 3

const lsf_option_row lsf_vpl_options[LSF_VPL_OPTION_COUNT] = {
    {"vpl.count", LSF_OPTION_INT, offsetof(lsf_vpl_params, count), 0, 4096, NULL, "",
     "virtual point lights per iteration of punctual lights, and as many on emissive surfaces; 0: "
     "none"},
    {"vpl.shadow_resolution", LSF_OPTION_INT, offsetof(lsf_vpl_params, shadow_resolution), 16, 4096,
     NULL, "texels", "width and height of a VPL's shadow map"},
};

/* Those that light falls on. */
static void plan_draw(lsf_plan *plan, uint64_t count)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_plan_surfaces_differ(plan);
    lsf_plan_pass_add(plan, "vpl_draw", "what punctual lights fall on");
    lsf_plan_reads(plan, "reflective_shadow_map");
    lsf_light_switches(plan);
    lsf_plan_switch_add(plan, "LSF_EMISSION_ADAPTIVE", lsf_light_emission_is_adaptive(plan),
                        "rsm.pdf is adaptive");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_SHADOW_TINT", lsf_light_walls_needed(plan),
                        "light passes thin walls");
    lsf_plan_buffer_add(plan, "vpl.random", count * sizeof(lsf_vec4),
                        "what the host draws for each");
}

/* Transmitting surfaces are drawn apart. */
static void plan_straight(lsf_plan *plan, const lsf_vpl_use *use, uint32_t side)
{
    if (!plan->straight)
        return;
    lsf_plan_pass_add(plan, "vpl_straight", "light passes materials that transmit");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_material_switches(plan, true, false);
    lsf_scene_gpu_media_switch(plan);
    if (use->lights)
        lsf_plan_texture_add(plan, "vpl.shadow_tint", lsf_light_tint_format(plan), side, side,
                             "what it leaves of the light");
    if (use->emitters)
        lsf_plan_texture_add(plan, "vpl.emitter_tint", lsf_light_tint_format(plan), side, side,
                             "what it leaves of the light");
}

void lsf_vpl_plan(lsf_plan *plan, const lsf_vpl_params *params, const lsf_vpl_use *use)
{
    uint64_t count = (uint64_t)params->count;
    uint32_t side = (uint32_t)params->shadow_resolution;
    if (use->lights)
        plan_draw(plan, count);
    else
        lsf_plan_omit(plan, "vpl_draw", "no punctual light bounces");
    if (use->emitters)
        lsf_plan_pass_add(plan, "vpl_emitter", "surfaces emit light");
    else
        lsf_plan_omit(plan, "vpl_emitter", "no surface emits light");
    uint64_t total = count * (use->lights && use->emitters ? 2 : 1);
    lsf_plan_buffer_add(plan, "vpl.vpls", total * sizeof(struct lsf_vpl_data), "vpl.count is %u",
                        (unsigned)count);
    lsf_plan_buffer_add(plan, "vpl.maps", total * MAP_STRIDE, "the projection of each one's map");
    lsf_plan_pass_add(plan, "vpl_shadow_map", "what each virtual point light sees");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_mask_switches(plan);
    if (use->lights)
        lsf_plan_texture_add(plan, "vpl.shadow_map", GL_R32UI, side, side,
                             "vpl.shadow_resolution is %u", side);
    if (use->emitters)
        lsf_plan_texture_add(plan, "vpl.emitter_map", GL_R32UI, side, side,
                             "vpl.shadow_resolution is %u", side);
    plan_straight(plan, use, side);
    lsf_scene_gpu_plan_triangles(plan);
    if (lsf_plan_find(plan, "scene.triangles")) {
        lsf_plan_buffer_add(plan, "vpl.large", plan->requirements.triangles * 4 * sizeof(uint32_t),
                            "triangles that the pipeline draws, at most all in four octants");
        lsf_plan_buffer_add(plan, "vpl.command", 4 * sizeof(uint32_t), "draws them");
    }
}

static bool create_buffers(lsf_vpl *pass, const lsf_plan *plan, lsf_error *error)
{
    lsf_context *context = pass->context;
    lsf_vpl_outputs *out = &pass->outputs;
    if (!lsf_plan_create_buffer(plan, context, "vpl.vpls", NULL, 0, &out->vpls, error) ||
        !lsf_buffer_textures_create(context, 1, &out->fetch, error))
        return false;
    glTextureBuffer(out->fetch, GL_RGBA32F, out->vpls);
    return lsf_plan_create_buffer(plan, context, "vpl.maps", NULL, 0, &out->maps, error) &&
           lsf_plan_create_buffer_if_planned(plan, context, "vpl.random", NULL,
                                             GL_DYNAMIC_STORAGE_BIT, &pass->random, error) &&
           lsf_plan_create_buffer_if_planned(plan, context, "vpl.large", NULL, 0, &pass->large,
                                             error) &&
           lsf_plan_create_buffer_if_planned(plan, context, "vpl.command", NULL,
                                             GL_DYNAMIC_STORAGE_BIT, &pass->command, error) &&
           lsf_plan_create_texture_if_planned(plan, context, "vpl.shadow_map", &out->shadow_map,
                                              error) &&
           lsf_plan_create_texture_if_planned(plan, context, "vpl.emitter_map", &out->emitter_map,
                                              error);
}

static bool create_straight(lsf_vpl *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/vpl_straight.vert.glsl",
                                         "passes/vpl_straight.frag.glsl"};
    static const char *const tint_files[5] = {"passes/vpl_straight.vert.glsl",
                                              "passes/vpl_straight_tint.frag.glsl"};
    lsf_context *context = pass->context;
    lsf_vpl_outputs *out = &pass->outputs;
    if (!lsf_plan_find_pass(plan, "vpl_straight"))
        return true;
    if (!lsf_plan_create_texture_if_planned(plan, context, "vpl.shadow_tint", &out->shadow_tint,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "vpl.emitter_tint", &out->emitter_tint,
                                            error))
        return false;
    const GLuint tints[2] = {out->shadow_tint, out->emitter_tint};
    for (int i = 0; i < 2; i++) {
        lsf_framebuffer_desc desc = {
            .label = "vpl_straight", .color_count = 1, .colors = {tints[i]}, .layer = -1};
        if (tints[i] &&
            !(pass->tint_framebuffers[i] = lsf_framebuffer_create(context, &desc, error)))
            return false;
    }
    pass->straight_program = lsf_plan_program(plan, context, "vpl_straight", files, error);
    pass->tint_program = lsf_plan_program(plan, context, "vpl_straight", tint_files, error);
    return pass->straight_program && pass->tint_program;
}

/* Program and timer of a pass; both stay 0, with success, when the plan does not list it. */
static bool create_placing(lsf_vpl *pass, const lsf_plan *plan, const char *name, GLuint *program,
                           lsf_timer **timer, lsf_error *error)
{
    const char *const files[5] = {strcmp(name, "vpl_draw") == 0 ? "passes/vpl_draw.comp.glsl"
                                                                : "passes/vpl_emitter.comp.glsl"};
    if (!lsf_plan_find_pass(plan, name))
        return true;
    *program = lsf_plan_program(plan, pass->context, name, files, error);
    *timer = *program ? lsf_timer_create(pass->context, name, error) : NULL;
    return *timer != NULL;
}

bool lsf_vpl_create(lsf_vpl *pass, lsf_context *context, const lsf_plan *plan,
                    const lsf_vpl_params *params, lsf_error *error)
{
    static const char *const small_files[5] = {"passes/vpl_small.comp.glsl"};
    static const char *const large_files[5] = {"passes/vpl_large.vert.glsl",
                                               "passes/vpl_large.frag.glsl"};
    static const char *const map_files[5] = {"passes/vpl_shadow_map.vert.glsl",
                                             "passes/vpl_shadow_map.frag.glsl"};
    *pass = (lsf_vpl){.context = context,
                      .masked = plan->requirements.masked || plan->requirements.blended,
                      .count = (uint32_t)params->count,
                      .first_emitter =
                          lsf_plan_find_pass(plan, "vpl_draw") ? (uint32_t)params->count : 0,
                      .shadow_resolution = (uint32_t)params->shadow_resolution};
    if (!create_buffers(pass, plan, error) ||
        !create_placing(pass, plan, "vpl_draw", &pass->draw_program, &pass->draw_timer, error) ||
        !create_placing(pass, plan, "vpl_emitter", &pass->emitter_program, &pass->emitter_timer,
                        error))
        return false;
    lsf_framebuffer_desc desc = {.label = "vpl_shadow_map",
                                 .layer = -1,
                                 .width = pass->shadow_resolution,
                                 .height = pass->shadow_resolution};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    glCreateVertexArrays(1, &pass->vertex_array);
    pass->small_program = lsf_plan_program(plan, context, "vpl_shadow_map", small_files, error);
    pass->large_program = lsf_plan_program(plan, context, "vpl_shadow_map", large_files, error);
    pass->map_program = lsf_plan_program(plan, context, "vpl_shadow_map", map_files, error);
    pass->map_timer = lsf_timer_create(context, "vpl_shadow_map", error);
    return pass->framebuffer && pass->small_program && pass->large_program && pass->map_program &&
           pass->map_timer && create_straight(pass, plan, error);
}

/* Of the map of a VPL about its normal, 0..1. */
static float rotation_of(const lsf_vpl *pass, const lsf_iteration *iteration, uint32_t vpl)
{
    lsf_iteration_number number = lsf_iteration_deal(iteration, vpl, pass->count);
    uint32_t seed = lsf_iteration_seed(iteration, LSF_PURPOSE_VPL_ROTATION);
    return lsf_unit_float(lsf_sobol_1d_bits(number.index, seed) ^ number.shift[0]);
}

/* The VPLs of all iterations are one low-discrepancy sequence. */
static lsf_vec4 random_of(const lsf_vpl *pass, const lsf_iteration *iteration, uint32_t vpl,
                          float light_probability)
{
    uint32_t point[2];
    lsf_iteration_sample_dealt(iteration, vpl, pass->count, LSF_PURPOSE_VPL_DIRECTION, point);
    return (lsf_vec4){lsf_unit_float(point[0]), lsf_unit_float(point[1]),
                      rotation_of(pass, iteration, vpl), light_probability};
}

void lsf_vpl_draw(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t first, uint32_t count,
                  float light_probability, const lsf_vpl_inputs *inputs)
{
    lsf_timer_begin(pass->draw_timer);
    lsf_vec4 random[GROUP_SIZE];
    for (uint32_t i = 0; i < count; i++) {
        random[i % GROUP_SIZE] = random_of(pass, iteration, first + i, light_probability);
        uint32_t filled = i % GROUP_SIZE + 1;
        if (filled == GROUP_SIZE || i + 1 == count)
            glNamedBufferSubData(pass->random,
                                 (GLintptr)((first + i + 1 - filled) * sizeof *random),
                                 (GLsizeiptr)(filled * sizeof *random), random);
    }
    lsf_shadow_bind(inputs->shadow);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VPL, pass->outputs.vpls);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_MAPS, pass->outputs.maps);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_RANDOM, pass->random);
    lsf_surface_maps_bind(inputs->seen);
    lsf_bind_texture(3, inputs->shadow->tint);
    lsf_bind_texture(LSF_UNIT_EMISSION, inputs->importance);
    if (inputs->sums)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_SUMS, inputs->sums);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT); /* shading has read the VPLs before */
    glUseProgram(pass->draw_program);
    glUniform2ui(0, first, count);
    glUniform2f(1, (float)pass->shadow_resolution, iteration->view.start.w);
    glDispatchCompute((count + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_timer_end(pass->draw_timer);
}

void lsf_vpl_emit(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index,
                  const lsf_emitter_sample *sample)
{
    const float *p = sample->position, *n = sample->normal, *l = sample->radiance;
    lsf_timer_begin(pass->emitter_timer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VPL, pass->outputs.vpls);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_MAPS, pass->outputs.maps);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT); /* as in lsf_vpl_draw */
    glUseProgram(pass->emitter_program);
    glUniform1ui(0, index);
    glUniform4f(1, p[0], p[1], p[2], rotation_of(pass, iteration, index - pass->first_emitter));
    glUniform4f(2, n[0], n[1], n[2], sample->density);
    glUniform4f(3, l[0], l[1], l[2], sample->weight_density);
    glUniform2f(4, (float)pass->shadow_resolution, iteration->view.start.w);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_timer_end(pass->emitter_timer);
}

static GLuint map_of(const lsf_vpl *pass, uint32_t index)
{
    return index < pass->first_emitter ? pass->outputs.shadow_map : pass->outputs.emitter_map;
}

lsf_shadow lsf_vpl_shadow(const lsf_vpl *pass, uint32_t index)
{
    const lsf_vpl_outputs *out = &pass->outputs;
    return (lsf_shadow){.depth = map_of(pass, index),
                        .tint = index < pass->first_emitter ? out->shadow_tint : out->emitter_tint,
                        .light = out->maps,
                        .offset = (GLintptr)index * MAP_STRIDE,
                        .size = sizeof(struct lsf_light_data)};
}

/* Small triangles by a compute shader, which lists the others for the pipeline. */
static void draw_triangles(lsf_vpl *pass, const lsf_iteration *iteration)
{
    static const uint32_t no_vertices[4] = {0, 1, 0, 0};
    const lsf_scene_gpu *scene = iteration->scene;
    glNamedBufferSubData(pass->command, 0, sizeof no_vertices, no_vertices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_LARGE, pass->large);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_COMMAND, pass->command);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_TRIANGLES, scene->triangles);
    glUseProgram(pass->small_program);
    glUniform1ui(0, scene->triangle_count);
    glDispatchCompute((scene->triangle_count + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glUseProgram(pass->large_program);
    glBindVertexArray(pass->vertex_array);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, pass->command);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    pass->counts[LSF_DRAW_TRIANGLES] += scene->triangle_count;
}

static void draw_octants(lsf_vpl *pass, const lsf_iteration *iteration, lsf_draw_mode mode)
{
    for (GLuint octant = 0; octant < 4; octant++) {
        glUniform1ui(0, octant);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, mode, NULL, pass->counts);
    }
}

static void clip_to_octants(void)
{
    for (GLenum plane = 0; plane < 2; plane++)
        glEnable(GL_CLIP_DISTANCE0 + plane);
}

/* What transmits and is there, into the map; then the tint of what is not, before what the map
 * shows. */
static void draw_straight(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index)
{
    static const GLfloat white[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    GLuint framebuffer = pass->tint_framebuffers[index >= pass->first_emitter];
    glUseProgram(pass->straight_program);
    lsf_iteration_set_chance(iteration, LSF_PURPOSE_STRAIGHT_VPL, index);
    draw_octants(pass, iteration, LSF_DRAW_TRANSMISSIVE);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_begin_fullscreen(framebuffer, pass->shadow_resolution, pass->shadow_resolution,
                         pass->tint_program);
    clip_to_octants();
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, white);
    lsf_blend_multiply(0);
    lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_VPL, index);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, map_of(pass, index));
    draw_octants(pass, iteration, LSF_DRAW_TRANSMISSIVE);
}

void lsf_vpl_shadow_map(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index)
{
    static const GLuint nothing = 0;
    const lsf_shadow shadow = lsf_vpl_shadow(pass, index);
    lsf_timer_begin(pass->map_timer);
    glBindBufferRange(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, shadow.light, shadow.offset,
                      shadow.size);
    /* Reads of the map that was here before come first. */
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glClearTexImage(shadow.depth, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
    glBindImageTexture(0, shadow.depth, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    lsf_begin_fullscreen(pass->framebuffer, pass->shadow_resolution, pass->shadow_resolution,
                         pass->map_program);
    clip_to_octants();
    bool listed = iteration->scene->triangle_count != 0;
    if (listed)
        draw_triangles(pass, iteration);
    glUseProgram(pass->map_program);
    lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_VPL, index);
    if (pass->masked || !listed)
        draw_octants(pass, iteration, listed ? LSF_DRAW_MASKED : LSF_DRAW_OPAQUE);
    if (pass->straight_program)
        draw_straight(pass, iteration, index);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_timer_end(pass->map_timer);
}

void lsf_vpl_destroy(lsf_vpl *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    for (int i = 0; i < 2; i++)
        lsf_framebuffer_destroy(pass->context, &pass->tint_framebuffers[i]);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow_tint);
    lsf_texture_destroy(pass->context, &pass->outputs.emitter_tint);
    glDeleteVertexArrays(1, &pass->vertex_array);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow_map);
    lsf_texture_destroy(pass->context, &pass->outputs.emitter_map);
    lsf_buffer_destroy(pass->context, &pass->large);
    lsf_buffer_destroy(pass->context, &pass->command);
    glDeleteTextures(1, &pass->outputs.fetch);
    lsf_buffer_destroy(pass->context, &pass->outputs.vpls);
    lsf_buffer_destroy(pass->context, &pass->outputs.maps);
    lsf_buffer_destroy(pass->context, &pass->random);
    lsf_timer_destroy(pass->draw_timer);
    lsf_timer_destroy(pass->emitter_timer);
    lsf_timer_destroy(pass->map_timer);
    memset(pass, 0, sizeof *pass);
}
