#include "io/mesh_modules.h"

#include <dlfcn.h>
#include <pthread.h>

/* The table of functions that the module exports under `symbol`, kept in *loaded. */
static const void *get(const char *name, const char *symbol, const char *hint, const void **loaded,
                       lsf_error *error)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    if (!*loaded) {
        void *module = lsf_module_open(name, hint, error);
        if (module) {
            *loaded = dlsym(module, symbol);
            if (!*loaded)
                lsf_error_set(error, LSF_ERROR_FILE,
                              "module %s is of another version; install the one that belongs to "
                              "this library",
                              name);
        }
    }
    const void *result = *loaded;
    pthread_mutex_unlock(&mutex);
    return result;
}

const lsf_draco_module *lsf_draco_module_get(lsf_error *error)
{
    static const void *loaded;
    return get("lightsheaf-draco", "lsf_draco",
               "install the package libdraco7, build with libdraco-dev, or export the file without "
               "mesh compression",
               &loaded, error);
}

const lsf_meshopt_module *lsf_meshopt_module_get(lsf_error *error)
{
    static const void *loaded;
    return get("lightsheaf-meshopt", "lsf_meshopt",
               "install the package libmeshoptimizer2d, build with libmeshoptimizer-dev, or export "
               "the file without mesh compression",
               &loaded, error);
}
