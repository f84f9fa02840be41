#include "gl/context.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define INSTALL_ADVICE                                                                             \
    "On Debian: apt-get install libegl1 libgl1-mesa-dri (EGL, a GPU or software), or "             \
    "libosmesa6 (software)"

/* The context that this library made current last on this thread. Another backend's context is
 * released before one is bound. Whether it is still current, the platform knows. */
static _Thread_local lsf_context *current_context;

void *lsf_library_open(const char *variable, const char *const *names, lsf_error *error)
{
    const char *chosen = secure_getenv(variable);
    const char *only[] = {chosen, NULL};
    bool from_variable = chosen && *chosen;
    void *library = NULL;
    const char *reason = NULL;
    for (const char *const *name = from_variable ? only : names; *name && !library; name++) {
        library = dlopen(*name, RTLD_NOW | RTLD_LOCAL);
        if (!library)
            reason = dlerror();
    }
    if (!library)
        lsf_error_set(error, LSF_ERROR_NO_GL, "%s%s%s", from_variable ? variable : "",
                      from_variable ? ": " : "", reason ? reason : "no library");
    return library;
}

static GLADapiproc load_function(void *user, const char *name)
{
    const lsf_context *context = user;
    return context->ops->get_proc_address(context->platform, name);
}

static bool load_functions(lsf_context *context, lsf_error *error)
{
    int version = gladLoadGLContextUserPtr(&context->functions, load_function, context);
    if (version == 0)
        return lsf_error_set(error, LSF_ERROR_NO_GL,
                             "%s: the driver's functions were not found, or no memory is left",
                             context->ops->name);
    if (version < GLAD_MAKE_VERSION(4, 5))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "%s: the driver gives OpenGL %d.%d, not 4.5",
                             context->ops->name, GLAD_VERSION_MAJOR(version),
                             GLAD_VERSION_MINOR(version));
    return true;
}

static void set_current(lsf_context *context)
{
    current_context = context;
    glad_current = context ? &context->functions : NULL;
}

/* A context that the application has made current since then belongs to the application. */
static void release_current(void)
{
    if (current_context && current_context->ops->is_current(current_context->platform))
        current_context->ops->release(current_context->platform);
    set_current(NULL);
}

static const lsf_backend_ops *backend_ops(lsf_backend backend)
{
    switch (backend) {
    case LSF_BACKEND_EGL:
        return &lsf_backend_egl;
    case LSF_BACKEND_OSMESA:
        return &lsf_backend_osmesa;
    case LSF_BACKEND_GLFW:
        return &lsf_backend_glfw;
    case LSF_BACKEND_AUTO:
        break;
    }
    return NULL;
}

/* LSF_BACKEND_AUTO can be decided by the environment, for programs that offer no option. */
static bool resolve_backend(lsf_backend *backend, lsf_error *error)
{
    const char *value = secure_getenv("LIGHTSHEAF_BACKEND");
    if (*backend == LSF_BACKEND_AUTO && value && *value && strcmp(value, "auto")) {
        static const lsf_backend choices[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA,
                                              LSF_BACKEND_GLFW};
        for (size_t i = 0; i < LSF_COUNT(choices); i++) {
            if (!strcmp(value, backend_ops(choices[i])->name)) {
                *backend = choices[i];
                return true;
            }
        }
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "LIGHTSHEAF_BACKEND=%s: not a backend; use auto, egl, osmesa or glfw",
                             value);
    }
    if (*backend != LSF_BACKEND_AUTO && !backend_ops(*backend))
        return lsf_error_set(error, LSF_ERROR_USAGE, "backend %d does not exist", (int)*backend);
    return true;
}

static bool create_platform(lsf_context *context, const lsf_context_params *params,
                            lsf_backend backend, lsf_error *error)
{
    /* EGL tries hardware before software by itself. */
    static const lsf_backend_ops *const automatic[] = {&lsf_backend_egl, &lsf_backend_osmesa};
    const lsf_backend_ops *one[] = {backend_ops(backend)};
    const lsf_backend_ops *const *candidates = one[0] ? one : automatic;
    size_t count = one[0] ? 1 : LSF_COUNT(automatic);

    lsf_string reasons = {0};
    for (size_t i = 0; i < count && !context->platform; i++) {
        lsf_error reason = {0};
        context->ops = candidates[i];
        context->platform = context->ops->create(params, &reason);
        if (context->platform && !load_functions(context, &reason)) {
            context->ops->release(context->platform);
            context->ops->destroy(context->platform);
            context->platform = NULL;
        }
        if (!context->platform)
            lsf_string_add(&reasons, "%s  %s: %s", reasons.length ? "\n" : "", context->ops->name,
                           reason.message);
    }
    if (!context->platform)
        lsf_error_set(error, LSF_ERROR_NO_GL,
                      "no OpenGL 4.5 context could be made. Tried:\n%.3000s\n%s",
                      reasons.text ? reasons.text : "", INSTALL_ADVICE);
    else if (reasons.length)
        lsf_log(LSF_LOG_INFO, "OpenGL falls back to %s, because:\n%s", context->ops->name,
                reasons.text);
    free(reasons.text);
    return context->platform != NULL;
}

static bool is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "lavapipe",
                                        "Software Rasterizer"};
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        if (strcasestr(renderer, names[i]))
            return true;
    return false;
}

static char *copy_gl_string(GLenum name)
{
    const GLubyte *text = glGetString(name);
    return strdup(text ? (const char *)text : "unknown");
}

/* The context is current. A wrapped one keeps the application's settings for debug messages. */
static bool initialise(lsf_context *context, const lsf_context_params *params, lsf_error *error)
{
    context->vendor = copy_gl_string(GL_VENDOR);
    context->renderer = copy_gl_string(GL_RENDERER);
    context->version = copy_gl_string(GL_VERSION);
    context->shader_dir = params->shader_dir ? strdup(params->shader_dir) : NULL;
    if (!context->vendor || !context->renderer || !context->version ||
        (params->shader_dir && !context->shader_dir))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while making a GL context");
    context->software = is_software(context->renderer);
    GLint strategy = GL_NO_RESET_NOTIFICATION;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    context->robust = strategy == GL_LOSE_CONTEXT_ON_RESET;
    context->fail_on_gl_error = params->fail_on_gl_error;
    /* Some drivers leave an error behind for queries of the loader or of the strategy. */
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; i++)
        ;
    if (context->wrapped)
        lsf_state_count_bindings(context);
    else
        lsf_debug_install(context, params->debug || params->fail_on_gl_error);
    lsf_state_set_conventions();
    glCreateVertexArrays(1, &context->empty_vertex_array);
    lsf_log(LSF_LOG_DEBUG, "OpenGL by %s: %s, %s, %s%s%s", context->ops->name, context->vendor,
            context->renderer, context->version, context->software ? ", software" : "",
            context->robust ? ", robust" : "");
    return true;
}

lsf_context *lsf_context_create(const lsf_context_params *params, lsf_error *error)
{
    static const lsf_context_params defaults = {LSF_CONTEXT_PARAMS_DEFAULTS};
    if (!params)
        params = &defaults;
    lsf_backend backend = params->backend;
    if (!resolve_backend(&backend, error))
        return NULL;
    lsf_context *context = lsf_alloc(1, sizeof *context);
    if (!context) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while making a GL context");
        return NULL;
    }
    /* fail_on_gl_error needs the messages of a debug context. */
    lsf_context_params wanted = *params;
    wanted.debug = params->debug || params->fail_on_gl_error;
    double start = lsf_now();
    lsf_turn_begin();
    release_current();
    if (!create_platform(context, &wanted, backend, error)) {
        free(context);
        context = NULL;
    } else {
        set_current(context);
        if (!initialise(context, params, error)) {
            lsf_context_destroy(context);
            context = NULL;
        }
    }
    lsf_turn_end();
    if (context)
        lsf_log(LSF_LOG_DEBUG, "context made in %.1f ms", (lsf_now() - start) * 1e3);
    return context;
}

/* The version, and a profile without the fixed-function pipeline, which has more state than is
 * handled here. */
static bool check_wrapped(lsf_error *error)
{
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    return (profile & GL_CONTEXT_CORE_PROFILE_BIT) ||
           lsf_error_set(error, LSF_ERROR_NO_GL,
                         "the application's context is not of OpenGL's core profile; ask for that "
                         "when making it");
}

lsf_context *lsf_context_wrap(const lsf_context_wrap_params *params, lsf_error *error)
{
    lsf_context_params own = {LSF_CONTEXT_PARAMS_DEFAULTS};
    if (!params || !params->get_proc_address) {
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "lsf_context_wrap_params.get_proc_address is missing: it finds the functions "
                      "of the application's context");
        return NULL;
    }
    lsf_context *context = lsf_alloc(1, sizeof *context);
    lsf_context_wrap_params *platform = lsf_alloc(1, sizeof *platform);
    if (!context || !platform) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while wrapping a GL context");
        free(context);
        free(platform);
        return NULL;
    }
    *platform = *params;
    own.shader_dir = params->shader_dir;
    *context = (lsf_context){.ops = &lsf_backend_wrap, .platform = platform, .wrapped = true};
    release_current();
    bool good = context->ops->make_current(platform, error) && load_functions(context, error);
    if (good)
        set_current(context);
    if (!good || !check_wrapped(error) || !initialise(context, &own, error)) {
        lsf_context_destroy(context);
        return NULL;
    }
    lsf_state_reset(context);
    return context;
}

void lsf_context_destroy(lsf_context *context)
{
    if (!context)
        return;
    lsf_turn_begin();
    if (context->functions.GetString && lsf_context_make_current(context, NULL)) {
        for (uint64_t i = 0; i < context->program_count; i++)
            glDeleteProgram(context->programs[i].program);
        glDeleteVertexArrays(1, &context->empty_vertex_array);
        if (context->allocation_count)
            lsf_log(LSF_LOG_DEBUG, "%llu GL objects of %llu bytes outlived their owners",
                    (unsigned long long)context->allocation_count,
                    (unsigned long long)context->gl_bytes);
    }
    if (current_context == context)
        release_current();
    context->ops->destroy(context->platform);
    lsf_turn_end();
    free(context->programs);
    free(context->allocations);
    free(context->shader_dir);
    free(context->vendor);
    free(context->renderer);
    free(context->version);
    free(context);
}

bool lsf_context_make_current(lsf_context *context, lsf_error *error)
{
    if (!lsf_given(context, "context", error))
        return false;
    if (current_context != context)
        release_current();
    if (!context->ops->is_current(context->platform) &&
        !context->ops->make_current(context->platform, error))
        return false;
    set_current(context);
    return true;
}

/* Transform feedback would capture the library's draws, and its buffer bindings cannot be
 * changed meanwhile. */
static bool check_entry(lsf_error *error)
{
    GLboolean active = GL_FALSE, paused = GL_FALSE;
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    glGetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    return !active || paused ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "transform feedback is active in the application's context; end or pause "
                         "it first");
}

static bool prepare(lsf_context *context, lsf_error *error)
{
    if (!lsf_context_make_current(context, error))
        return false;
    if (context->wrapped && context->entered == 0) {
        if (!check_entry(error))
            return false;
        lsf_state_reset(context);
        lsf_state_set_conventions();
    }
    return true;
}

lsf_context *lsf_context_enter(lsf_context *context, lsf_error *error)
{
    bool turns = context && context->software;
    if (turns)
        lsf_turn_begin();
    if (prepare(context, error)) {
        context->entered++;
        return context;
    }
    if (turns)
        lsf_turn_end();
    return NULL;
}

void lsf_context_leave(lsf_context **entered)
{
    lsf_context *context = *entered;
    if (!context)
        return;
    if (--context->entered == 0 && context->wrapped)
        lsf_state_reset(context);
    if (context->software)
        lsf_turn_end();
}

void lsf_context_pause(const lsf_context *context)
{
    if (!context->software)
        return;
    lsf_turn_end();
    lsf_turn_begin();
}

bool lsf_context_release_current(lsf_context *context, lsf_error *error)
{
    if (!lsf_given(context, "context", error))
        return false;
    if (current_context != context)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the context is not current on this thread; release it on the thread "
                             "that used it last");
    if (context->software)
        lsf_turn_begin();
    glFlush();
    release_current();
    if (context->software)
        lsf_turn_end();
    return true;
}

static const char *reset_description(GLenum status)
{
    switch (status) {
    case GL_GUILTY_CONTEXT_RESET:
        return "this program's work hung or crashed the GPU";
    case GL_INNOCENT_CONTEXT_RESET:
        return "another program's work hung or crashed the GPU";
    default:
        return "the GPU was reset";
    }
}

void lsf_context_fail(lsf_context *context, const lsf_error *error)
{
    if (!context->failure.code)
        context->failure = *error;
}

bool lsf_context_check(lsf_context *context, lsf_error *error)
{
    if (!lsf_given(context, "context", error))
        return false;
    if (context->entered == 0 && !lsf_context_make_current(context, error))
        return false;
    GLenum status = context->robust ? glGetGraphicsResetStatus() : GL_NO_ERROR;
    if (status != GL_NO_ERROR)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "the OpenGL context was lost: %s. Make a new one, with fewer samples "
                             "or a lower resolution if it happens again",
                             reset_description(status));
    lsf_debug_take_errors(context);
    if (context->failure.code) {
        lsf_error failure = context->failure;
        context->failure = (lsf_error){0};
        return lsf_error_set(error, failure.code, "%s", failure.message);
    }
    bool failed = context->fail_on_gl_error && context->error_seen;
    context->error_seen = false;
    if (failed)
        return lsf_error_set(error, LSF_ERROR_RENDER, "OpenGL reported: %s", context->first_error);
    return true;
}

lsf_context_info lsf_context_get_info(const lsf_context *context)
{
    if (!context)
        return (lsf_context_info){0};
    return (lsf_context_info){
        .backend = context->ops->name,
        .vendor = context->vendor,
        .renderer = context->renderer,
        .version = context->version,
        .software = context->software,
        .robust = context->robust,
        .gl_bytes = context->gl_bytes,
        .gl_bytes_peak = context->gl_bytes_peak,
    };
}

void lsf_context_restart_peak(lsf_context *context)
{
    if (context)
        context->gl_bytes_peak = context->gl_bytes;
}
