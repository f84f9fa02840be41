#include "base/base.h"
#include "base/module_dir.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where a module lies beside the library or the executable: installed, or in the build folder
 * (the library is in src/, the command in the top folder or in src/tools/). */
static const char *const subfolders[] = {
    "",    "lightsheaf/", "src/",      "src/io/", "src/reference/", "src/denoiser/",
    "io/", "reference/",  "denoiser/", "../io/",  "../reference/",  "../denoiser/"};

/* Opens folder/name.so when it is there. A module that exists but does not load (a missing
 * library, mostly) leaves the loader's message in `cause`. */
static void *try_open(const char *folder, size_t folder_length, const char *subfolder,
                      const char *name, lsf_string *cause)
{
    char *path = lsf_format("%.*s/%s%s.so", (int)folder_length, folder, subfolder, name);
    void *module = NULL;
    if (path && access(path, R_OK) == 0) {
        module = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
        if (!module && cause->length == 0)
            lsf_string_add(cause, "%s", dlerror());
    }
    free(path);
    return module;
}

static void *try_beside(const char *file, const char *name, lsf_string *cause)
{
    char real[PATH_MAX];
    if (!strchr(file, '/') || !realpath(file, real))
        return NULL;
    size_t folder_length = (size_t)(strrchr(real, '/') - real);
    void *module = NULL;
    for (size_t i = 0; !module && i < LSF_COUNT(subfolders); i++)
        module = try_open(real, folder_length, subfolders[i], name, cause);
    return module;
}

static void *try_environment(const char *name, lsf_string *cause)
{
    void *module = NULL;
    const char *folders = getenv("LIGHTSHEAF_MODULE_DIR");
    while (!module && folders && *folders) {
        size_t length = strcspn(folders, ":");
        module = try_open(folders, length, "", name, cause);
        folders += length + (folders[length] == ':');
    }
    return module;
}

void *lsf_module_open(const char *name, const char *hint, lsf_error *error)
{
    lsf_string cause = {0};
    void *module = try_environment(name, &cause);
    Dl_info self;
    if (!module && dladdr(subfolders, &self) && self.dli_fname)
        module = try_beside(self.dli_fname, name, &cause);
    if (!module)
        module = try_beside("/proc/self/exe", name, &cause);
    if (!module)
        module = try_open(LSF_MODULE_DIR, strlen(LSF_MODULE_DIR), "", name, &cause);
    if (!module)
        lsf_error_set(error, LSF_ERROR_FILE, "module %s %s%s; %s", name,
                      cause.length ? "does not load: " : "is not installed",
                      cause.length ? cause.text : "", hint);
    free(cause.text);
    return module;
}

const void *lsf_module_table(const char *name, const char *symbol, const char *hint,
                             const void **loaded, lsf_error *error)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    if (!*loaded) {
        double start = lsf_now();
        void *module = lsf_module_open(name, hint, error);
        if (module) {
            *loaded = dlsym(module, symbol);
            if (!*loaded)
                lsf_error_set(error, LSF_ERROR_FILE,
                              "module %s is of another version; install the one that belongs to "
                              "this library",
                              name);
            lsf_log(LSF_LOG_DEBUG, "loaded %s in %.0f ms", name, 1e3 * (lsf_now() - start));
        }
    }
    const void *result = *loaded;
    pthread_mutex_unlock(&mutex);
    return result;
}
