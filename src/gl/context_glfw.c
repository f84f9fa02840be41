/* A window through GLFW, loaded like the other backends so that nothing else needs a display. */
#include "gl/context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <dlfcn.h>
#include <stdlib.h>

static struct {
    int (*init)(void);
    int (*get_error)(const char **description);
    void (*window_hint)(int hint, int value);
    void (*default_window_hints)(void);
    GLFWwindow *(*create_window)(int width, int height, const char *title, GLFWmonitor *monitor,
                                 GLFWwindow *share);
    void (*destroy_window)(GLFWwindow *window);
    void (*make_context_current)(GLFWwindow *window);
    GLFWwindow *(*get_current_context)(void);
    GLFWglproc (*get_proc_address)(const char *name);
} glfw;

static bool load(lsf_error *error)
{
    static const char *const names[] = {"libglfw.so.3", "libglfw.so", NULL};
    static const struct {
        void **function;
        const char *name;
    } functions[] = {
        {(void **)&glfw.init, "glfwInit"},
        {(void **)&glfw.get_error, "glfwGetError"},
        {(void **)&glfw.window_hint, "glfwWindowHint"},
        {(void **)&glfw.default_window_hints, "glfwDefaultWindowHints"},
        {(void **)&glfw.create_window, "glfwCreateWindow"},
        {(void **)&glfw.destroy_window, "glfwDestroyWindow"},
        {(void **)&glfw.make_context_current, "glfwMakeContextCurrent"},
        {(void **)&glfw.get_current_context, "glfwGetCurrentContext"},
        {(void **)&glfw.get_proc_address, "glfwGetProcAddress"},
    };
    lsf_error reason = {0};
    void *library = lsf_library_open("LIGHTSHEAF_GLFW_LIBRARY", names, &reason);
    if (!library)
        return lsf_error_set(error, LSF_ERROR_NO_GL, "%.1000s (Debian: libglfw3)", reason.message);
    for (size_t i = 0; i < LSF_COUNT(functions); i++) {
        *functions[i].function = dlsym(library, functions[i].name);
        if (!*functions[i].function)
            return lsf_error_set(error, LSF_ERROR_NO_GL, "the library lacks %s", functions[i].name);
    }
    return true;
}

static bool fail(lsf_error *error, const char *what)
{
    const char *description = NULL;
    glfw.get_error(&description);
    return lsf_error_set(error, LSF_ERROR_NO_GL, "%s: %s", what,
                         description ? description : "no reason given");
}

/* GLFW stays initialised until the program ends: terminating it would close every window. */
static void *glfw_create(const lsf_context_params *params, lsf_error *error)
{
    if (!load(error))
        return NULL;
    if (!glfw.init()) {
        fail(error, "no display");
        return NULL;
    }
    GLFWwindow *window = NULL;
    for (int robust = 1; robust >= 0 && !window; robust--) {
        glfw.default_window_hints();
        glfw.window_hint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfw.window_hint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfw.window_hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfw.window_hint(GLFW_OPENGL_DEBUG_CONTEXT, params->debug);
        if (robust)
            glfw.window_hint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
        /* Passes draw to textures; the window only receives the finished picture. */
        glfw.window_hint(GLFW_DEPTH_BITS, 0);
        glfw.window_hint(GLFW_STENCIL_BITS, 0);
        window = glfw.create_window((int)params->window_width, (int)params->window_height,
                                    params->window_title ? params->window_title : "Lightsheaf",
                                    NULL, NULL);
    }
    if (!window) {
        fail(error, "no window with OpenGL 4.5 core");
        return NULL;
    }
    glfw.make_context_current(window);
    return window;
}

static bool glfw_is_current(void *platform)
{
    return glfw.get_current_context() == platform;
}

static bool glfw_make_current(void *platform, lsf_error *error)
{
    glfw.make_context_current(platform);
    return glfw_is_current(platform) || fail(error, "glfwMakeContextCurrent");
}

static void glfw_release(void *platform)
{
    (void)platform;
    glfw.make_context_current(NULL);
}

static void glfw_destroy(void *platform)
{
    glfw.destroy_window(platform);
}

static GLADapiproc glfw_get_proc_address(void *platform, const char *name)
{
    (void)platform;
    return glfw.get_proc_address(name);
}

const lsf_backend_ops lsf_backend_glfw = {
    .name = "glfw",
    .create = glfw_create,
    .destroy = glfw_destroy,
    .make_current = glfw_make_current,
    .is_current = glfw_is_current,
    .release = glfw_release,
    .get_proc_address = glfw_get_proc_address,
};
