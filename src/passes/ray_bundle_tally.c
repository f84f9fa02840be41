/* Counts the nodes that were needed: the GPU drops the pictures of iterations whose nodes did
 * not fit; the host learns of it later and makes more space. Neither waits for the other until
 * the picture is read. */
#include <string.h>

#include "passes/ray_bundle_parts.h"
#include "shared/scene_data.h"

void lsf_ray_bundle_tally_plan(lsf_plan *plan)
{
    const uint64_t bytes = sizeof(struct lsf_bundle_status);
    lsf_plan_buffer_add(plan, "ray_bundle.status", bytes, "how many nodes there are, and had room");
    lsf_plan_buffer_add(plan, "ray_bundle.readback", bytes, "the same, on its way to the host");
}

bool lsf_ray_bundle_tally_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/ray_bundle_tally.comp.glsl"};
    const struct lsf_bundle_status empty = {0};
    const GLbitfield map = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    if (!lsf_plan_create_buffer(plan, pass->context, "ray_bundle.status", &empty, 0, &pass->status,
                                error) ||
        !lsf_plan_create_buffer(plan, pass->context, "ray_bundle.readback", &empty, map,
                                &pass->readback, error))
        return false;
    pass->read = glMapNamedBufferRange(pass->readback, 0, sizeof empty, map);
    if (!pass->read)
        return lsf_error_set(error, LSF_ERROR_RENDER, "the ray-bundles' account cannot be mapped");
    glCreateQueries(GL_SAMPLES_PASSED, 1, &pass->samples_query);
    pass->tally_program = lsf_plan_program(plan, pass->context, "ray_bundle_build", files, error);
    return pass->tally_program != 0;
}

static void tally(const lsf_ray_bundle *pass, bool iteration_ends, uint32_t iterations_done)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_BUNDLE_STATUS, pass->status);
    glUseProgram(pass->tally_program);
    glUniform1ui(0, pass->capacity);
    glUniform1i(1, iteration_ends);
    glUniform1ui(2, iterations_done);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glDispatchCompute(1, 1, 1);
    /* Searches fetch nodes through buffer textures. */
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_QUERY_BUFFER_BARRIER_BIT);
}

void lsf_ray_bundle_tally_build(const lsf_ray_bundle *pass)
{
    glGetQueryBufferObjectui64v(pass->samples_query, pass->status, GL_QUERY_RESULT,
                                offsetof(struct lsf_bundle_status, drawn_low));
    tally(pass, false, 0);
}

/* Sends the counts to the host. */
static void send(lsf_ray_bundle *pass)
{
    glCopyNamedBufferSubData(pass->status, pass->readback, 0, 0, sizeof(struct lsf_bundle_status));
    pass->sent = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void lsf_ray_bundle_end(lsf_ray_bundle *pass, const lsf_iteration *iteration)
{
    tally(pass, true, iteration->serial);
    if (!pass->sent)
        send(pass);
}

GLuint lsf_ray_bundle_gate(const lsf_ray_bundle *pass)
{
    return pass->status;
}

/* Reads the counts that have arrived. With `wait`, those of all bundles that were built. */
static bool receive(lsf_ray_bundle *pass, bool wait, struct lsf_bundle_status *status)
{
    const GLuint64 second = UINT64_C(1000000000);
    if (wait) {
        glDeleteSync(pass->sent);
        send(pass);
    }
    if (!pass->sent)
        return false;
    GLenum state;
    do
        state = glClientWaitSync(pass->sent, GL_SYNC_FLUSH_COMMANDS_BIT, wait ? second : 0);
    while (wait && state == GL_TIMEOUT_EXPIRED);
    if (state == GL_TIMEOUT_EXPIRED)
        return false;
    glDeleteSync(pass->sent);
    pass->sent = NULL;
    memcpy(status, pass->read, sizeof *status);
    return true;
}

bool lsf_ray_bundle_settle(lsf_ray_bundle *pass, const lsf_iteration *iteration, bool wait,
                           uint32_t *iterations_done)
{
    static const GLuint zero = 0;
    struct lsf_bundle_status status;
    lsf_error error = {0};
    if (!receive(pass, wait, &status))
        return true;
    pass->counts[LSF_RAY_BUNDLE_NODES] = (uint64_t)status.nodes_high << 32 | status.nodes_low;
    pass->counts[LSF_RAY_BUNDLE_OVERFLOW] =
        (uint64_t)status.chained_high << 32 | status.chained_low;
    if (status.needed <= pass->capacity)
        return true;
    pass->counts[LSF_RAY_BUNDLE_REGROWN]++;
    glClearNamedBufferSubData(pass->status, GL_R32UI, offsetof(struct lsf_bundle_status, needed), 4,
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glClearNamedBufferSubData(pass->status, GL_R32UI,
                              offsetof(struct lsf_bundle_status, first_needed), 4, GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    *iterations_done = status.iterations_done;
    /* What later iterations needed depends on when the host learned of it, and would on the texels
     * in use, and with them on the picture. */
    if (lsf_ray_bundle_nodes_grow(pass, iteration->plan, status.first_needed, &error))
        return false;
    lsf_context_fail(pass->context, &error);
    return true;
}

void lsf_ray_bundle_tally_destroy(lsf_ray_bundle *pass)
{
    glDeleteSync(pass->sent);
    lsf_buffer_destroy(pass->context, &pass->status);
    lsf_buffer_destroy(pass->context, &pass->readback);
    glDeleteQueries(1, &pass->samples_query);
}
