#include "passes/light_importance.h"

#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

/* Sampled pixels along each side of the picture. */
enum { SIDE = 32 };

/* Software renders a command before it takes the next: there a measurement is known at once. A GPU
 * is given this many iterations, or frames, until the host waits for it. */
enum { LAG = LSF_LIGHT_IMPORTANCE_SLOTS - 1 };

void lsf_light_importance_plan(lsf_plan *plan, uint32_t light_count)
{
    if (light_count < 2) {
        lsf_plan_omit(plan, "light_importance", "there are no punctual lights to choose from");
        return;
    }
    uint64_t bytes = (uint64_t)light_count * sizeof(float);
    lsf_plan_pass_add(plan, "light_importance", "lights are chosen by what they do in view");
    lsf_plan_reads(plan, "direct_light");
    lsf_plan_switch_add(plan, "LSF_LIGHT_IMPORTANCE_SIDE", SIDE, "pixels along a side");
    lsf_plan_buffer_add(plan, "light_importance.before", SIDE * SIDE * sizeof(float),
                        "luminance of sampled pixels, without the light in turn");
    lsf_plan_buffer_add(plan, "light_importance.sums", bytes, "light in view, of each light");
    lsf_plan_buffer_add(plan, "light_importance.readback", LSF_LIGHT_IMPORTANCE_SLOTS * bytes,
                        "the same of the last frames, on its way to the host");
}

bool lsf_light_importance_create(lsf_light_importance *pass, lsf_context *context,
                                 const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/light_importance.comp.glsl"};
    const GLbitfield map = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const uint64_t bytes = lsf_plan_find(plan, "light_importance.readback")->bytes;
    *pass = (lsf_light_importance){.context = context};
    pass->light_count = (uint32_t)(bytes / (LSF_LIGHT_IMPORTANCE_SLOTS * sizeof(float)));
    for (uint32_t i = 0; i < LSF_LIGHT_IMPORTANCE_SLOTS; i++)
        pass->parts[i] = i;
    if (!lsf_plan_create_buffer(plan, context, "light_importance.before", NULL, 0, &pass->before,
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_importance.sums", NULL, 0, &pass->sums,
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_importance.readback", NULL, map,
                                &pass->readback, error))
        return false;
    pass->read = glMapNamedBufferRange(pass->readback, 0, (GLsizeiptr)bytes, map);
    if (!pass->read)
        return lsf_error_set(error, LSF_ERROR_RENDER, "light_importance.readback cannot be mapped");
    pass->program = lsf_plan_program(plan, context, "light_importance", files, error);
    pass->timer = pass->program ? lsf_timer_create(context, "light_importance", error) : NULL;
    return pass->timer != NULL;
}

void lsf_light_importance_run(lsf_light_importance *pass, const lsf_iteration *iteration,
                              uint32_t light, GLuint radiance)
{
    if (!pass->timer || iteration->done > 0)
        return;
    lsf_timer_begin(pass->timer);
    glUseProgram(pass->program);
    glUniform1ui(0, light);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, pass->before);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, pass->sums);
    lsf_bind_texture(0, radiance);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glDispatchCompute(1, 1, 1);
    lsf_timer_end(pass->timer);
}

/* Sends the sums to the host, into the part of the oldest measurement; those of the same iteration
 * where it is run again. */
static void send(lsf_light_importance *pass, uint32_t serial)
{
    lsf_light_importance_slot *newest = &pass->slots[0];
    const GLsizeiptr bytes = (GLsizeiptr)(pass->light_count * sizeof(float));
    if (!newest->measured || newest->serial != serial) {
        uint32_t part = pass->parts[LAG];
        glDeleteSync(pass->slots[LAG].sent);
        memmove(pass->slots + 1, pass->slots, LAG * sizeof *pass->slots);
        memmove(pass->parts + 1, pass->parts, LAG * sizeof *pass->parts);
        pass->parts[0] = part;
        *newest = (lsf_light_importance_slot){.serial = serial, .measured = true};
    }
    glDeleteSync(newest->sent);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(pass->sums, pass->readback, 0, pass->parts[0] * bytes, bytes);
    newest->sent = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

static void wait_for(lsf_light_importance_slot *slot)
{
    const GLuint64 second = UINT64_C(1000000000);
    while (slot->sent &&
           glClientWaitSync(slot->sent, GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(slot->sent);
    slot->sent = NULL;
}

const float *lsf_light_importance_read(lsf_light_importance *pass, const lsf_iteration *iteration)
{
    if (!pass->timer)
        return NULL;
    if (iteration->done == 0)
        send(pass, iteration->serial);
    uint32_t lag = lsf_context_get_info(pass->context).software ? 0 : LAG;
    uint32_t which = iteration->done >= lag ? 0 : lag;
    if (!pass->slots[which].measured)
        return NULL;
    wait_for(&pass->slots[which]);
    return pass->read + (size_t)pass->parts[which] * pass->light_count;
}

void lsf_light_importance_destroy(lsf_light_importance *pass)
{
    if (!pass->context)
        return;
    for (uint32_t i = 0; i < LSF_LIGHT_IMPORTANCE_SLOTS; i++)
        glDeleteSync(pass->slots[i].sent);
    lsf_buffer_destroy(pass->context, &pass->before);
    lsf_buffer_destroy(pass->context, &pass->sums);
    lsf_buffer_destroy(pass->context, &pass->readback);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
