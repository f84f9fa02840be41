#include "io/image_module.h"

#include <dlfcn.h>
#include <pthread.h>

const lsf_image_module *lsf_image_module_get(lsf_error *error)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    static const lsf_image_module *loaded;

    pthread_mutex_lock(&mutex);
    if (!loaded) {
        double start = lsf_now();
        void *module = lsf_module_open("lightsheaf-openimageio",
                                       "reading and writing images needs it: install the package "
                                       "libopenimageio2.4, or build with libopenimageio-dev",
                                       error);
        if (module) {
            loaded = dlsym(module, "lsf_openimageio");
            if (!loaded)
                lsf_error_set(error, LSF_ERROR_FILE,
                              "module lightsheaf-openimageio is of another version; install the "
                              "one that belongs to this library");
            lsf_log(LSF_LOG_DEBUG, "loaded OpenImageIO in %.0f ms", 1e3 * (lsf_now() - start));
        }
    }
    const lsf_image_module *result = loaded;
    pthread_mutex_unlock(&mutex);
    return result;
}
