#include "passes/light_importance.h"

#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

/* Sampled pixels along each side of the picture. */
enum { SIDE = 32 };

/* Iterations of a frame, or frames, that a GPU has before the host waits for a measurement. To wait
 * for software, which renders on the same processor, costs nothing. */
enum { LAG = LSF_LIGHT_IMPORTANCE_SLOTS - 1 };

void lsf_light_importance_plan(lsf_plan *plan, uint32_t light_count)
{
    if (light_count < 2) {
        lsf_plan_omit(plan, "light_importance",
                      "fewer than two punctual lights: there is no choice");
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

/* The slot of the frame that came `frames` before the newest. */
static uint32_t slot_before(const lsf_light_importance *pass, uint32_t frames)
{
    return (pass->newest + LSF_LIGHT_IMPORTANCE_SLOTS - frames) % LSF_LIGHT_IMPORTANCE_SLOTS;
}

/* Sends the sums to the host. An iteration that is run again keeps its slot. */
static void send(lsf_light_importance *pass, uint32_t serial)
{
    const GLsizeiptr bytes = (GLsizeiptr)(pass->light_count * sizeof(float));
    if (pass->slots[pass->newest].serial != serial)
        pass->newest = (pass->newest + 1) % LSF_LIGHT_IMPORTANCE_SLOTS;
    lsf_light_importance_slot *slot = &pass->slots[pass->newest];
    glDeleteSync(slot->sent); /* NULL is ignored */
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(pass->sums, pass->readback, 0, (GLintptr)pass->newest * bytes, bytes);
    slot->sent = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    slot->serial = serial;
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
    uint32_t slot = slot_before(pass, iteration->done >= lag ? 0 : lag);
    if (pass->slots[slot].serial == 0)
        return NULL;
    wait_for(&pass->slots[slot]);
    return pass->read + (size_t)slot * pass->light_count;
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
