#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/half.h"
#include "passes/denoise_parts.h"

const lsf_option_row lsf_denoise_options[LSF_DENOISE_OPTION_COUNT] = {
    {"denoise.processor", LSF_OPTION_ENUM, offsetof(lsf_denoise_params, processor), 0, 0,
     "auto|gl|cpu", "",
     "processor that runs the network of light_filter.kind=network; auto: the CPU if OpenGL is "
     "software and the module for it is installed"},
};

#define AT(member) offsetof(lsf_denoise, member)

static const lsf_texture_row textures[] = {
    {"denoise.diffuse", GL_RGBA32F, AT(light[0]), 0, "light without tint, from the network"},
    {"denoise.specular", GL_RGBA32F, AT(light[1]), LSF_TEXTURE_SPECULAR, "the same of lobes"},
};

static uint32_t padded(uint32_t size, const lsf_net *net)
{
    uint32_t step = net ? lsf_net_granularity(net) : 1;
    return (size + step - 1) / step * step;
}

static uint32_t tiles(uint32_t size)
{
    return (size + LSF_DENOISE_TILE - 1) / LSF_DENOISE_TILE;
}

static void plan_network(lsf_plan *plan, const lsf_net *net, uint32_t width, uint32_t height)
{
    lsf_denoise_layout *layout = lsf_alloc(1, sizeof *layout);
    if (!layout) {
        plan->failed = true;
        return;
    }
    bool recurrent = plan->temporal && net->recurrent;
    lsf_denoise_layout_make(layout, net, width, height, recurrent);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->width, plan->height);
    lsf_plan_buffer_add(plan, "denoise.weights", layout->weight_bytes, "of the network");
    lsf_plan_buffer_add(plan, "denoise.features", layout->chain.shared_bytes,
                        "what its layers make, each while it is needed");
    for (int i = 0; i < 2 && recurrent; i++)
        lsf_plan_buffer_add(plan, i ? "denoise.state_1" : "denoise.state_0",
                            layout->chain.state_bytes, "what it keeps from frame to frame");
    free(layout);
}

void lsf_denoise_plan(lsf_plan *plan, const lsf_net *net)
{
    uint32_t width = padded(plan->width, net), height = padded(plan->height, net);
    uint64_t groups = (uint64_t)tiles(plan->width) * tiles(plan->height);
    if (net)
        lsf_plan_pass_add(plan, "denoise", "a network of %u stages%s%s goes on from filtered light",
                          net->stages, plan->weights ? " from " : "",
                          plan->weights ? plan->weights : "");
    else
        lsf_plan_pass_add(plan, "denoise", "records what a network would be given");
    lsf_plan_reads(plan, "view light_mean light_filter");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_buffer_add(plan, "denoise.exchange",
                        (uint64_t)width * height * LSF_DENOISE_INPUT_GROUPS * 2 * LSF_DENOISE_GROUP,
                        "what goes into the network, then what comes out of it");
    lsf_plan_buffer_add(plan, "denoise.partial", groups * LSF_DENOISE_SUMS * 4 * sizeof(float),
                        "sums over %d x %d pixels", LSF_DENOISE_TILE, LSF_DENOISE_TILE);
    lsf_plan_buffer_add(plan, "denoise.total", 2 * LSF_DENOISE_SUMS * 4 * sizeof(float),
                        "sums over the picture");
    if (net)
        plan_network(plan, net, width, height);
}

static bool create_programs(lsf_denoise *pass, const lsf_plan *plan, lsf_error *error)
{
    bool runs = pass->net, by_gl = pass->layout;
    const struct {
        const char *file;
        GLuint *program;
        bool used;
    } rows[] = {
        {"passes/denoise_scale.comp.glsl", &pass->scale, true},
        {"passes/denoise_total.comp.glsl", &pass->total_program, true},
        {"passes/denoise_input.comp.glsl", &pass->input, true},
        {"passes/denoise_convolve.comp.glsl", &pass->convolve, by_gl},
        {"passes/denoise_double.comp.glsl", &pass->twice, by_gl},
        {"passes/denoise_apply.comp.glsl", &pass->apply, runs},
        {"passes/denoise_gain.comp.glsl", &pass->gain, runs},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        const char *const files[5] = {rows[i].file};
        if (rows[i].used &&
            !(*rows[i].program = lsf_plan_program(plan, pass->context, "denoise", files, error)))
            return false;
    }
    return true;
}

/* Where the CPU is to run the network: with success also where it is not. */
static bool create_processor(lsf_denoise *pass, lsf_denoise_processor processor, lsf_error *error)
{
    bool software = lsf_context_get_info(pass->context).software;
    if (processor == LSF_DENOISE_GL || (processor == LSF_DENOISE_AUTO && !software))
        return true;
    lsf_error missing = {0};
    pass->module = lsf_denoiser_module_get(&missing);
    if (!pass->module) {
        if (processor == LSF_DENOISE_CPU)
            return lsf_error_set(error, missing.code, "denoise.processor=cpu: %s", missing.message);
        lsf_log(LSF_LOG_INFO, "the network runs in software OpenGL, slowly: %s", missing.message);
        return true;
    }
    uint64_t pixels = (uint64_t)pass->width * pass->height;
    pass->host_input = lsf_alloc(pixels * LSF_NET_INPUTS, sizeof *pass->host_input);
    pass->host_output = lsf_alloc(pixels * LSF_NET_OUTPUTS, sizeof *pass->host_output);
    if (!pass->host_input || !pass->host_output)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the network");
    pass->processor =
        pass->module->create(pass->net, pass->width, pass->height, pass->recurrent, error);
    return pass->processor != NULL;
}

static bool check_blocks(const lsf_denoise *pass, lsf_error *error)
{
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    return pass->layout->largest <= (uint64_t)most ||
           lsf_error_set(error, LSF_ERROR_RENDER,
                         "light_filter.kind=network at %ux%u: a layer takes %.0f MiB, and this "
                         "OpenGL reads %.0f MiB at once; use a smaller resolution, or "
                         "denoise.processor=cpu",
                         pass->width, pass->height, (double)pass->layout->largest / 1048576.0,
                         (double)most / 1048576.0);
}

static bool create_network(lsf_denoise *pass, const lsf_plan *plan, lsf_error *error)
{
    lsf_denoise_layout *layout = pass->layout = lsf_alloc(1, sizeof *layout);
    if (!layout)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the network");
    lsf_denoise_layout_make(layout, pass->net, pass->width, pass->height, pass->recurrent);
    if (!check_blocks(pass, error))
        return false;
    float *weights = lsf_denoise_pack_weights(layout);
    bool good = weights || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the network");
    good = good && lsf_plan_create_buffer(plan, pass->context, "denoise.weights", weights, 0,
                                          &pass->weights, error);
    free(weights);
    return good &&
           lsf_plan_create_buffer(plan, pass->context, "denoise.features", NULL, 0, &pass->features,
                                  error) &&
           lsf_plan_create_buffer_if_planned(plan, pass->context, "denoise.state_0", NULL, 0,
                                             &pass->states[0], error) &&
           lsf_plan_create_buffer_if_planned(plan, pass->context, "denoise.state_1", NULL, 0,
                                             &pass->states[1], error);
}

static void leave_out(lsf_plan *plan)
{
    static const char *const names[] = {"denoise.weights", "denoise.features", "denoise.state_0",
                                        "denoise.state_1"};
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        lsf_plan_leave_out(plan, names[i], "the CPU runs the network");
}

bool lsf_denoise_create(lsf_denoise *pass, lsf_context *context, lsf_plan *plan,
                        const lsf_denoise_params *params, const lsf_net *net, lsf_error *error)
{
    *pass = (lsf_denoise){.context = context,
                          .net = net,
                          .width = padded(plan->width, net),
                          .height = padded(plan->height, net),
                          .recurrent = plan->temporal && net && net->recurrent};
    if (!lsf_plan_create_buffer(plan, context, "denoise.exchange", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &pass->exchange, error) ||
        !lsf_plan_create_buffer(plan, context, "denoise.partial", NULL, 0, &pass->partial, error) ||
        !lsf_plan_create_buffer(plan, context, "denoise.total", NULL, 0, &pass->total, error) ||
        !lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error))
        return false;
    if (net && (!create_processor(pass, (lsf_denoise_processor)params->processor, error) ||
                (!pass->processor && !create_network(pass, plan, error))))
        return false;
    if (pass->processor)
        leave_out(plan);
    if (!create_programs(pass, plan, error))
        return false;
    pass->timer = lsf_timer_create(context, "denoise", error);
    return pass->timer != NULL;
}

void lsf_denoise_begin(lsf_denoise *pass, bool cut)
{
    bool kept = pass->recurrent && !cut && pass->fresh;
    if (kept && pass->processor)
        pass->module->keep(pass->processor);
    if (kept) {
        GLuint before = pass->states[0];
        pass->states[0] = pass->states[1];
        pass->states[1] = before;
    }
    pass->kept = kept;
    pass->fresh = false;
}

/* --- runs --- */

static void bind_pair(GLuint unit, const GLuint pair[2])
{
    lsf_bind_texture(unit, pair[0]);
    if (pair[1])
        lsf_bind_texture(unit + 1, pair[1]);
}

static void bind_light(const lsf_denoise_inputs *inputs)
{
    bind_pair(2, inputs->light);
    bind_pair(4, inputs->filtered);
}

static void bind(GLuint binding, GLuint buffer)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

static void dispatch(uint32_t width, uint32_t height, uint32_t depth)
{
    glDispatchCompute(tiles(width), tiles(height), depth);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
}

/* Adds up what the work groups have, into a set of totals. */
static void add_up(const lsf_denoise *pass, const lsf_plan *plan, GLuint set)
{
    glUseProgram(pass->total_program);
    glUniform1ui(0, tiles(plan->width) * tiles(plan->height));
    glUniform1ui(1, set);
    dispatch(1, 1, 1);
}

/* Sets what goes into the network. */
static void give(const lsf_denoise *pass, const lsf_plan *plan, const lsf_denoise_inputs *inputs)
{
    bind_light(inputs);
    lsf_bind_texture(0, inputs->mean);
    bind(LSF_BINDING_DENOISE_PARTIAL, pass->partial);
    bind(LSF_BINDING_DENOISE_TOTAL, pass->total);
    bind(LSF_BINDING_DENOISE_TARGET, pass->exchange);
    glUseProgram(pass->scale);
    dispatch(plan->width, plan->height, 1);
    add_up(pass, plan, LSF_DENOISE_SUM_SCALE);
    if (inputs->specular_factor)
        lsf_bind_texture(6, inputs->specular_factor);
    glUseProgram(pass->input);
    glUniform2ui(0, pass->width, pass->height);
    dispatch(pass->width, pass->height, 1);
}

static void bind_map(const lsf_denoise *pass, GLuint binding, uint32_t map, bool before)
{
    const lsf_net_map *entry = &pass->layout->chain.maps[map];
    GLuint buffer = entry->home == LSF_NET_OUTSIDE ? pass->exchange
                    : entry->home == LSF_NET_STATE ? pass->states[before ? 0 : 1]
                                                   : pass->features;
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer, (GLintptr)entry->offset,
                      (GLsizeiptr)lsf_denoise_map_bytes(entry));
}

static void run_step(const lsf_denoise *pass, uint32_t i)
{
    const lsf_net_chain *chain = &pass->layout->chain;
    const lsf_net_step *step = &chain->steps[i];
    const lsf_denoise_weights *weights = &pass->layout->weights[i];
    const lsf_net_map *source = &chain->maps[step->source], *target = &chain->maps[i + 1];
    bool doubles = step->layer->side == 2,
         reads_beside = step->beside && (!step->kept || pass->kept);
    glUseProgram(doubles ? pass->twice : pass->convolve);
    bind_map(pass, LSF_BINDING_DENOISE_TARGET, i + 1, false);
    bind_map(pass, LSF_BINDING_DENOISE_SOURCE, step->source, false);
    /* Nothing of it is read where there is nothing beside. */
    bind_map(pass, LSF_BINDING_DENOISE_SOURCE + 1, reads_beside ? step->beside : step->source,
             reads_beside && step->kept);
    const lsf_net_map *size = doubles ? source : target;
    uint32_t targets = lsf_denoise_groups(target->features);
    glUniform2ui(0, size->width, size->height);
    glUniform4ui(1, lsf_denoise_groups(source->features),
                 reads_beside ? lsf_denoise_groups(step->beside_features) : 0, weights->groups,
                 targets);
    glUniform1ui(2, weights->first_weight);
    glUniform1ui(3, weights->first_bias);
    glUniform1f(4, step->last || doubles ? 1.0f : pass->net->leak);
    if (!doubles)
        glUniform1i(5, step->pooled);
    /* Of what doubles, a work group has half as many pixels to a side. */
    uint32_t share = doubles ? 2 : 1;
    dispatch(size->width * share, size->height * share, targets);
}

static void run_by_gl(const lsf_denoise *pass)
{
    bind(LSF_BINDING_DENOISE_WEIGHTS, pass->weights);
    for (uint32_t i = 0; i < pass->layout->chain.step_count; i++)
        run_step(pass, i);
}

static void unpack(const uint16_t *maps, float *values, uint32_t count, size_t pixels)
{
    for (uint32_t c = 0; c < count; c++) {
        const uint16_t *group = maps + c / LSF_DENOISE_GROUP * pixels * LSF_DENOISE_GROUP;
        for (size_t i = 0; i < pixels; i++)
            values[c * pixels + i] =
                lsf_half_to_float(group[i * LSF_DENOISE_GROUP + c % LSF_DENOISE_GROUP]);
    }
}

static void pack(uint16_t *maps, const float *values, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++)
        for (uint32_t c = 0; c < LSF_NET_OUTPUTS; c++)
            maps[i * LSF_DENOISE_GROUP + c] = lsf_float_to_half(
                fminf(fmaxf(values[c * pixels + i], -LSF_HALF_MOST), LSF_HALF_MOST));
}

static bool run_by_cpu(const lsf_denoise *pass, lsf_error *error)
{
    size_t pixels = (size_t)pass->width * pass->height,
           texel = LSF_DENOISE_GROUP * sizeof(uint16_t);
    uint16_t *maps = lsf_alloc(pixels * LSF_DENOISE_INPUT_GROUPS, texel);
    if (!maps)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the network");
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(pass->exchange, 0,
                            (GLsizeiptr)(pixels * LSF_DENOISE_INPUT_GROUPS * texel), maps);
    unpack(maps, pass->host_input, LSF_NET_INPUTS, pixels);
    bool good =
        pass->module->run(pass->processor, pass->host_input, pass->host_output, pass->kept, error);
    if (good) {
        pack(maps, pass->host_output, pixels);
        glNamedBufferSubData(pass->exchange, 0, (GLsizeiptr)(pixels * texel), maps);
    }
    free(maps);
    return good;
}

/* Turns what the network says into light. */
static void take(const lsf_denoise *pass, const lsf_plan *plan, const lsf_denoise_inputs *inputs)
{
    bind_light(inputs);
    bind_pair(7, inputs->factors);
    bind(LSF_BINDING_DENOISE_PARTIAL, pass->partial);
    bind(LSF_BINDING_DENOISE_TOTAL, pass->total);
    bind(LSF_BINDING_DENOISE_SOURCE, pass->exchange);
    for (GLuint i = 0; i < 2; i++)
        if (pass->light[i])
            glBindImageTexture(i, pass->light[i], 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glUseProgram(pass->apply);
    glUniform1ui(0, pass->width);
    dispatch(plan->width, plan->height, 1);
    add_up(pass, plan, LSF_DENOISE_SUM_GAIN);
    glUseProgram(pass->gain);
    dispatch(plan->width, plan->height, 1);
}

void lsf_denoise_run(lsf_denoise *pass, const lsf_iteration *iteration,
                     const lsf_denoise_inputs *inputs)
{
    lsf_error error = {0};
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    give(pass, plan, inputs);
    bool good = lsf_denoise_record(pass, plan, inputs, &error);
    if (good && pass->layout)
        run_by_gl(pass);
    else if (good && pass->processor)
        good = run_by_cpu(pass, &error);
    if (!good)
        lsf_context_fail(pass->context, &error);
    else if (pass->net)
        take(pass, plan, inputs);
    pass->fresh = good;
    lsf_timer_end(pass->timer);
}

void lsf_denoise_destroy(lsf_denoise *pass)
{
    if (!pass->context)
        return;
    if (pass->module)
        pass->module->destroy(pass->processor);
    free(pass->host_input);
    free(pass->host_output);
    free(pass->layout);
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    GLuint *buffers[] = {&pass->exchange, &pass->features, &pass->states[0], &pass->states[1],
                         &pass->weights,  &pass->partial,  &pass->total};
    for (size_t i = 0; i < LSF_COUNT(buffers); i++)
        lsf_buffer_destroy(pass->context, buffers[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
