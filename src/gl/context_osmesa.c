/* OSMesa: Mesa in software, into memory. Only its functions' facts are declared here, because its
 * header wants the system's GL headers, which glad replaces. */
#include "gl/context.h"

#include <dlfcn.h>
#include <stdlib.h>

#define OSMESA_FORMAT 0x22
#define OSMESA_DEPTH_BITS 0x30
#define OSMESA_STENCIL_BITS 0x31
#define OSMESA_ACCUM_BITS 0x32
#define OSMESA_PROFILE 0x33
#define OSMESA_CORE_PROFILE 0x34
#define OSMESA_CONTEXT_MAJOR_VERSION 0x36
#define OSMESA_CONTEXT_MINOR_VERSION 0x37

/* The default framebuffer, which no pass draws to. */
#define DUMMY_SIZE 4

typedef struct osmesa_platform {
    void *handle;
    void *(*create)(const int *attributes, void *share);
    void (*destroy)(void *context);
    GLboolean (*make_current)(void *context, void *buffer, GLenum type, GLsizei width,
                              GLsizei height);
    void *(*get_current_context)(void);
    GLADapiproc (*get_proc_address)(const char *name);
    uint32_t dummy[DUMMY_SIZE * DUMMY_SIZE];
} osmesa_platform;

static bool load(osmesa_platform *osmesa, lsf_error *error)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", NULL};
    void *library = lsf_library_open("LIGHTSHEAF_OSMESA_LIBRARY", names, error);
    if (!library)
        return false;
    *(void **)&osmesa->create = dlsym(library, "OSMesaCreateContextAttribs");
    *(void **)&osmesa->destroy = dlsym(library, "OSMesaDestroyContext");
    *(void **)&osmesa->make_current = dlsym(library, "OSMesaMakeCurrent");
    *(void **)&osmesa->get_current_context = dlsym(library, "OSMesaGetCurrentContext");
    *(void **)&osmesa->get_proc_address = dlsym(library, "OSMesaGetProcAddress");
    if (!osmesa->create || !osmesa->destroy || !osmesa->make_current ||
        !osmesa->get_current_context || !osmesa->get_proc_address)
        return lsf_error_set(error, LSF_ERROR_NO_GL,
                             "the library lacks OSMesaCreateContextAttribs or another function");
    return true;
}

static bool osmesa_make_current(void *platform, lsf_error *error)
{
    osmesa_platform *osmesa = platform;
    if (!osmesa->make_current(osmesa->handle, osmesa->dummy, GL_UNSIGNED_BYTE, DUMMY_SIZE,
                              DUMMY_SIZE))
        return lsf_error_set(error, LSF_ERROR_NO_GL, "OSMesaMakeCurrent failed");
    return true;
}

static bool osmesa_is_current(void *platform)
{
    const osmesa_platform *osmesa = platform;
    return osmesa->get_current_context() == osmesa->handle;
}

static void osmesa_release(void *platform)
{
    osmesa_platform *osmesa = platform;
    osmesa->make_current(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
}

static void osmesa_destroy(void *platform)
{
    osmesa_platform *osmesa = platform;
    if (osmesa->handle)
        osmesa->destroy(osmesa->handle);
    free(osmesa);
}

static void *osmesa_create(const lsf_context_params *params, lsf_error *error)
{
    (void)params; /* Mesa gives debug messages in any context, once they are enabled */
    osmesa_platform *osmesa = lsf_alloc(1, sizeof *osmesa);
    if (!osmesa) {
        lsf_error_set(error, LSF_ERROR_NO_GL, "out of memory");
        return NULL;
    }
    static const int attributes[] = {OSMESA_FORMAT,
                                     GL_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     0,
                                     OSMESA_STENCIL_BITS,
                                     0,
                                     OSMESA_ACCUM_BITS,
                                     0,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     4,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     5,
                                     0};
    if (!load(osmesa, error))
        goto fail;
    osmesa->handle = osmesa->create(attributes, NULL);
    if (!osmesa->handle) {
        lsf_error_set(error, LSF_ERROR_NO_GL, "no OpenGL 4.5 core context; Mesa is too old");
        goto fail;
    }
    if (!osmesa_make_current(osmesa, error))
        goto fail;
    return osmesa;
fail:
    osmesa_destroy(osmesa);
    return NULL;
}

static GLADapiproc osmesa_get_proc_address(void *platform, const char *name)
{
    return ((osmesa_platform *)platform)->get_proc_address(name);
}

const lsf_backend_ops lsf_backend_osmesa = {
    .name = "osmesa",
    .create = osmesa_create,
    .destroy = osmesa_destroy,
    .make_current = osmesa_make_current,
    .is_current = osmesa_is_current,
    .release = osmesa_release,
    .get_proc_address = osmesa_get_proc_address,
};
