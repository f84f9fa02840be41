#include "passes/vpl.h"

#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/light_data.h"
#include "shared/scene_data.h"

/* Purposes of its random numbers, past those of shadow maps. */
#define PURPOSE_DIRECTION 0x10000
#define PURPOSE_TURN 0x10001

/* Bytes from one VPL's map description to the next: a uniform buffer's offset is a multiple of at
 * most 256 (GL 4.5, table 23.64). The shader's array has the same stride. */
#define MAP_STRIDE 512
_Static_assert(sizeof(struct lsf_light_data) == MAP_STRIDE - 16, "see vpl_draw.comp.glsl");

#define GROUP_SIZE 64

/* Storage buffers of vpl_draw. */
#define BINDING_MAPS 2
#define BINDING_RANDOM 3
#define BINDING_SUMS 4

const lsf_option_row lsf_vpl_options[LSF_VPL_OPTION_COUNT] = {
    {"vpl.count", LSF_OPTION_INT, offsetof(lsf_vpl_params, count), 0, 4096, NULL, "",
     "virtual point lights an iteration; 0: none"},
    {"vpl.shadow_resolution", LSF_OPTION_INT, offsetof(lsf_vpl_params, shadow_resolution), 16, 4096,
     NULL, "texels", "side of a VPL's shadow map"},
};

void lsf_vpl_plan(lsf_plan *plan, const lsf_vpl_params *params)
{
    const lsf_requirements *r = &plan->requirements;
    uint64_t count = (uint64_t)params->count;
    uint32_t side = (uint32_t)params->shadow_resolution;
    bool gloss = r->specular && (r->anisotropic || r->glossy || r->variable_ior);
    lsf_plan_pass_add(plan, "vpl_draw", "%u virtual point lights", (unsigned)count);
    lsf_plan_switch_add(plan, "LSF_SPOT_LIGHT", r->spot_lights > 0, "there are spot lights (%u)",
                        r->spot_lights);
    lsf_plan_switch_add(plan, "LSF_DIRECTIONAL_LIGHT", r->directional_lights > 0,
                        "there are directional lights (%u)", r->directional_lights);
    lsf_plan_switch_add(plan, "LSF_EMISSION_ADAPTIVE",
                        lsf_plan_find_pass(plan, "reflective_shadow_map_pdf") != NULL,
                        "rsm.pdf is adaptive");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_GLOSS", gloss, "roughness or metallic vary");
    lsf_plan_buffer_add(plan, "vpl.vpls", count * sizeof(struct lsf_vpl_data), "vpl.count is %u",
                        (unsigned)count);
    lsf_plan_buffer_add(plan, "vpl.maps", count * MAP_STRIDE, "the projection of each one's map");
    lsf_plan_buffer_add(plan, "vpl.random", count * sizeof(lsf_vec4),
                        "what the host draws for each");
    lsf_plan_pass_add(plan, "vpl_shadow_map", "what each virtual point light sees");
    lsf_scene_gpu_mask_switches(plan);
    lsf_texture_desc desc = {NULL, GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, side, side, 1, 1};
    lsf_plan_texture_desc_add(plan, "vpl.shadow_depth", &desc, "vpl.shadow_resolution is %u", side);
    desc.internal_format = GL_RG16F;
    lsf_plan_texture_desc_add(plan, "vpl.shadow_gradient", &desc,
                              "the plane of each texel's surface");
}

bool lsf_vpl_create(lsf_vpl *pass, lsf_context *context, const lsf_plan *plan,
                    const lsf_vpl_params *params, lsf_error *error)
{
    static const char *const draw_files[5] = {"passes/vpl_draw.comp.glsl"};
    static const char *const map_files[5] = {"passes/vpl_shadow_map.vert.glsl",
                                             "passes/vpl_shadow_map.frag.glsl"};
    lsf_vpl_outputs *out = &pass->outputs;
    *pass = (lsf_vpl){.context = context,
                      .count = (uint32_t)params->count,
                      .shadow_resolution = (uint32_t)params->shadow_resolution};
    if (!lsf_plan_create_buffer(plan, context, "vpl.vpls", NULL, 0, &out->vpls, error) ||
        !lsf_plan_create_buffer(plan, context, "vpl.maps", NULL, 0, &out->maps, error) ||
        !lsf_plan_create_buffer(plan, context, "vpl.random", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &pass->random, error) ||
        !lsf_plan_create_texture(plan, context, "vpl.shadow_depth", &out->shadow_depth, error) ||
        !lsf_plan_create_texture(plan, context, "vpl.shadow_gradient", &out->shadow_gradient,
                                 error))
        return false;
    lsf_framebuffer_desc desc = {.label = "vpl_shadow_map",
                                 .color_count = 1,
                                 .colors = {out->shadow_gradient},
                                 .depth = out->shadow_depth,
                                 .layer = 0};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->draw_program = lsf_plan_program(plan, context, "vpl_draw", draw_files, error);
    pass->map_program = lsf_plan_program(plan, context, "vpl_shadow_map", map_files, error);
    pass->draw_timer = lsf_timer_create(context, "vpl_draw", error);
    pass->map_timer = lsf_timer_create(context, "vpl_shadow_map", error);
    return pass->framebuffer && pass->draw_program && pass->map_program && pass->draw_timer &&
           pass->map_timer;
}

/* The VPLs of all iterations are one low-discrepancy sequence. */
static lsf_vec4 random_of(const lsf_iteration *iteration, uint32_t index, float light_probability)
{
    float point[2];
    lsf_sobol_2d(index, lsf_iteration_seed(iteration, PURPOSE_DIRECTION), point);
    float turn = lsf_sobol_1d(index, lsf_iteration_seed(iteration, PURPOSE_TURN));
    return (lsf_vec4){point[0], point[1], turn, light_probability};
}

void lsf_vpl_draw(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t first, uint32_t count,
                  float light_probability, const lsf_vpl_inputs *inputs)
{
    lsf_timer_begin(pass->draw_timer);
    lsf_vec4 random[GROUP_SIZE];
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = iteration->index * pass->count + first + i;
        random[i % GROUP_SIZE] = random_of(iteration, index, light_probability);
        uint32_t filled = i % GROUP_SIZE + 1;
        if (filled == GROUP_SIZE || i + 1 == count)
            glNamedBufferSubData(pass->random,
                                 (GLintptr)((first + i + 1 - filled) * sizeof *random),
                                 (GLsizeiptr)(filled * sizeof *random), random);
    }
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, inputs->light_buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VPL, pass->outputs.vpls);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_MAPS, pass->outputs.maps);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_RANDOM, pass->random);
    glBindTextureUnit(0, inputs->depth);
    glBindTextureUnit(1, inputs->surface);
    glBindTextureUnit(2, inputs->gloss);
    glBindTextureUnit(LSF_UNIT_EMISSION, inputs->importance);
    if (inputs->sums)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_SUMS, inputs->sums);
    glUseProgram(pass->draw_program);
    glUniform2ui(0, first, count);
    glUniform1f(1, (float)pass->shadow_resolution);
    glDispatchCompute((count + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT);
    lsf_timer_end(pass->draw_timer);
}

static void bind_map(const lsf_vpl *pass, uint32_t index)
{
    glBindBufferRange(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, pass->outputs.maps,
                      (GLintptr)index * MAP_STRIDE, sizeof(struct lsf_light_data));
}

void lsf_vpl_shadow_map(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index)
{
    static const GLfloat zero[4] = {0};
    lsf_timer_begin(pass->map_timer);
    bind_map(pass, index);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->framebuffer);
    glViewport(0, 0, (GLsizei)pass->shadow_resolution, (GLsizei)pass->shadow_resolution);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_GREATER);
    for (GLenum plane = 0; plane < 3; plane++)
        glEnable(GL_CLIP_DISTANCE0 + plane);
    glClearNamedFramebufferfv(pass->framebuffer, GL_DEPTH, 0, zero);
    glUseProgram(pass->map_program);
    for (GLint octant = 0; octant < 4; octant++) {
        glUniform1i(0, octant);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_POSITIONS, NULL,
                           pass->counts);
    }
    for (GLenum plane = 0; plane < 3; plane++)
        glDisable(GL_CLIP_DISTANCE0 + plane);
    lsf_timer_end(pass->map_timer);
}

void lsf_vpl_bind(const lsf_vpl *pass, uint32_t index)
{
    bind_map(pass, index);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VPL, pass->outputs.vpls);
    glBindTextureUnit(LSF_UNIT_SHADOW_DEPTH, pass->outputs.shadow_depth);
    glBindTextureUnit(LSF_UNIT_SHADOW_GRADIENT, pass->outputs.shadow_gradient);
}

void lsf_vpl_destroy(lsf_vpl *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow_depth);
    lsf_texture_destroy(pass->context, &pass->outputs.shadow_gradient);
    lsf_buffer_destroy(pass->context, &pass->outputs.vpls);
    lsf_buffer_destroy(pass->context, &pass->outputs.maps);
    lsf_buffer_destroy(pass->context, &pass->random);
    lsf_timer_destroy(pass->draw_timer);
    lsf_timer_destroy(pass->map_timer);
    memset(pass, 0, sizeof *pass);
}
