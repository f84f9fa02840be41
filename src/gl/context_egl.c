/* EGL without a window system: a device of EGL_EXT_device_enumeration, or Mesa's surfaceless
 * platform. There is no default framebuffer. */
#include "gl/context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEVICES_MAX 32

typedef struct egl_functions {
    PFNEGLGETPROCADDRESSPROC get_proc_address;
    PFNEGLQUERYSTRINGPROC query_string;
    PFNEGLGETERRORPROC get_error;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLBINDAPIPROC bind_api;
    PFNEGLCHOOSECONFIGPROC choose_config;
    PFNEGLCREATECONTEXTPROC create_context;
    PFNEGLDESTROYCONTEXTPROC destroy_context;
    PFNEGLMAKECURRENTPROC make_current;
    PFNEGLGETCURRENTCONTEXTPROC get_current_context;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
    PFNEGLQUERYDEVICESEXTPROC query_devices;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string;
} egl_functions;

/* State of the library, shared by all contexts of all threads. */
static egl_functions egl;
static pthread_mutex_t egl_lock = PTHREAD_MUTEX_INITIALIZER; /* of writing it */

typedef struct egl_platform {
    EGLDisplay display;
    EGLContext context;
} egl_platform;

/* One way to get a display. */
typedef struct candidate {
    EGLenum platform;
    void *native;
    bool software;
    char name[64];
} candidate;

static bool load(lsf_error *error)
{
    egl_functions found = {0};
    static const char *const names[] = {"libEGL.so.1", "libEGL.so", NULL};
    const struct {
        void **function;
        const char *name;
    } functions[] = {
        {(void **)&found.get_proc_address, "eglGetProcAddress"},
        {(void **)&found.query_string, "eglQueryString"},
        {(void **)&found.get_error, "eglGetError"},
        {(void **)&found.initialize, "eglInitialize"},
        {(void **)&found.bind_api, "eglBindAPI"},
        {(void **)&found.choose_config, "eglChooseConfig"},
        {(void **)&found.create_context, "eglCreateContext"},
        {(void **)&found.destroy_context, "eglDestroyContext"},
        {(void **)&found.make_current, "eglMakeCurrent"},
        {(void **)&found.get_current_context, "eglGetCurrentContext"},
    };
    void *library = lsf_library_open("LIGHTSHEAF_EGL_LIBRARY", names, error);
    if (!library)
        return false;
    for (size_t i = 0; i < LSF_COUNT(functions); i++) {
        *functions[i].function = dlsym(library, functions[i].name);
        if (!*functions[i].function)
            return lsf_error_set(error, LSF_ERROR_NO_GL, "the library lacks %s", functions[i].name);
    }
    found.get_platform_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)found.get_proc_address("eglGetPlatformDisplayEXT");
    found.query_devices = (PFNEGLQUERYDEVICESEXTPROC)found.get_proc_address("eglQueryDevicesEXT");
    found.query_device_string =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)found.get_proc_address("eglQueryDeviceStringEXT");
    if (!found.get_platform_display)
        return lsf_error_set(error, LSF_ERROR_NO_GL, "EGL_EXT_platform_base is missing");
    /* Another thread that renders reads this table meanwhile: entries that stay the same are not
     * written. */
    pthread_mutex_lock(&egl_lock);
    if (memcmp(&egl, &found, sizeof egl) != 0)
        egl = found;
    pthread_mutex_unlock(&egl_lock);
    return true;
}

/* Whether a space-separated list of extensions names this one. */
static bool has_extension(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return true;
    return false;
}

/* Hardware devices, Mesa's surfaceless platform and software devices, in the order in which they
 * are tried. */
static size_t list_candidates(candidate candidates[static DEVICES_MAX + 1])
{
    const char *client = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint device_count = 0;
    if (!egl.query_devices || !has_extension(client, "EGL_EXT_platform_device") ||
        !egl.query_devices(DEVICES_MAX, devices, &device_count))
        device_count = 0;

    size_t count = 0;
    for (int software = 0; software < 2; software++) {
        for (EGLint i = 0; i < device_count; i++) {
            const char *extensions = egl.query_device_string
                                         ? egl.query_device_string(devices[i], EGL_EXTENSIONS)
                                         : NULL;
            if (has_extension(extensions, "EGL_MESA_device_software") != (bool)software)
                continue;
            candidates[count] = (candidate){EGL_PLATFORM_DEVICE_EXT, devices[i], software, ""};
            snprintf(candidates[count].name, sizeof candidates[count].name, "device %d%s", i,
                     software ? " (software)" : "");
            count++;
        }
        if (!software && has_extension(client, "EGL_MESA_platform_surfaceless"))
            candidates[count++] = (candidate){EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY,
                                              false, "surfaceless platform"};
    }
    return count;
}

/* Context attributes, from the most wanted to the least acceptable. */
static EGLContext create_context(EGLDisplay display, EGLConfig config, bool debug)
{
    enum {
        ROBUST_ACCESS = 2,
        RESET_NOTIFICATION = 1,
    };
    static const int robustness[] = {ROBUST_ACCESS | RESET_NOTIFICATION, RESET_NOTIFICATION, 0};
    for (int with_debug = debug; with_debug >= 0; with_debug--) {
        for (size_t i = 0; i < LSF_COUNT(robustness); i++) {
            EGLint attributes[16] = {
                EGL_CONTEXT_MAJOR_VERSION,       4,
                EGL_CONTEXT_MINOR_VERSION,       5,
                EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
            size_t used = 6;
            if (with_debug) {
                attributes[used++] = EGL_CONTEXT_OPENGL_DEBUG;
                attributes[used++] = EGL_TRUE;
            }
            if (robustness[i] & ROBUST_ACCESS) {
                attributes[used++] = EGL_CONTEXT_OPENGL_ROBUST_ACCESS;
                attributes[used++] = EGL_TRUE;
            }
            if (robustness[i] & RESET_NOTIFICATION) {
                attributes[used++] = EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY;
                attributes[used++] = EGL_LOSE_CONTEXT_ON_RESET;
            }
            attributes[used] = EGL_NONE;
            EGLContext context = egl.create_context(display, config, EGL_NO_CONTEXT, attributes);
            if (context != EGL_NO_CONTEXT)
                return context;
        }
    }
    return EGL_NO_CONTEXT;
}

static bool egl_make_current(void *platform, lsf_error *error)
{
    egl_platform *self = platform;
    if (!egl.bind_api(EGL_OPENGL_API) ||
        !egl.make_current(self->display, EGL_NO_SURFACE, EGL_NO_SURFACE, self->context))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "eglMakeCurrent failed (EGL error 0x%04x)",
                             (unsigned)egl.get_error());
    return true;
}

static bool egl_is_current(void *platform)
{
    return egl.get_current_context() == ((egl_platform *)platform)->context;
}

/* The display is left initialised: eglTerminate would end every context on it, another's too, and
 * EGL hands out the same display when it is asked for again. */
static bool open_candidate(const candidate *from, bool debug, egl_platform *self, lsf_error *error)
{
    self->context = EGL_NO_CONTEXT;
    self->display = egl.get_platform_display(from->platform, from->native, NULL);
    if (self->display == EGL_NO_DISPLAY)
        return lsf_error_set(error, LSF_ERROR_NO_GL, "no display (EGL error 0x%04x)",
                             (unsigned)egl.get_error());
    if (!egl.initialize(self->display, NULL, NULL))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "eglInitialize failed (EGL error 0x%04x)",
                             (unsigned)egl.get_error());
    const char *extensions = egl.query_string(self->display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context"))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "EGL_KHR_surfaceless_context is missing");
    if (!egl.bind_api(EGL_OPENGL_API))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "the driver has OpenGL ES only");

    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!has_extension(extensions, "EGL_KHR_no_config_context")) {
        static const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                        EGL_NONE};
        EGLint count = 0;
        if (!egl.choose_config(self->display, wanted, &config, 1, &count) || count == 0)
            return lsf_error_set(error, LSF_ERROR_NO_GL, "no configuration renders OpenGL");
    }
    self->context = create_context(self->display, config, debug);
    if (self->context == EGL_NO_CONTEXT)
        return lsf_error_set(error, LSF_ERROR_NO_GL,
                             "no OpenGL 4.5 core context (EGL error 0x%04x)",
                             (unsigned)egl.get_error());
    if (!egl_make_current(self, error)) {
        egl.destroy_context(self->display, self->context);
        return false;
    }
    return true;
}

static void *egl_create(const lsf_context_params *params, lsf_error *error)
{
    egl_platform *self = lsf_alloc(1, sizeof *self);
    if (!self) {
        lsf_error_set(error, LSF_ERROR_NO_GL, "out of memory");
        return NULL;
    }
    if (!load(error)) {
        free(self);
        return NULL;
    }
    candidate candidates[DEVICES_MAX + 1];
    size_t count = list_candidates(candidates);
    lsf_string reasons = {0};
    bool made = false;
    for (size_t i = 0; i < count && !made; i++) {
        lsf_error reason = {0};
        made = open_candidate(&candidates[i], params->debug, self, &reason);
        if (!made)
            lsf_string_add(&reasons, "%s%s: %s", i ? "; " : "", candidates[i].name, reason.message);
        else
            lsf_log(LSF_LOG_DEBUG, "EGL: %s", candidates[i].name);
    }
    if (!made) {
        lsf_error_set(error, LSF_ERROR_NO_GL, "%s",
                      reasons.text ? reasons.text
                                   : "it offers neither devices nor the surfaceless platform");
        free(self);
        self = NULL;
    }
    free(reasons.text);
    return self;
}

static void egl_release(void *platform)
{
    egl_platform *self = platform;
    egl.make_current(self->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static void egl_destroy(void *platform)
{
    egl_platform *self = platform;
    egl.destroy_context(self->display, self->context);
    free(self);
}

static GLADapiproc egl_get_proc_address(void *platform, const char *name)
{
    (void)platform;
    return (GLADapiproc)egl.get_proc_address(name);
}

const lsf_backend_ops lsf_backend_egl = {
    .name = "egl",
    .create = egl_create,
    .destroy = egl_destroy,
    .make_current = egl_make_current,
    .is_current = egl_is_current,
    .release = egl_release,
    .get_proc_address = egl_get_proc_address,
};
