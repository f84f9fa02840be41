/* A temporary folder with the files that a script writes. */
#ifndef LSF_TESTS_GLTF_FOLDER_H
#define LSF_TESTS_GLTF_FOLDER_H

#include "base/base.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Which script: gltf_files.py unless the includer names another one. */
#ifndef GLTF_SCRIPT
#define GLTF_SCRIPT "gltf_files.py"
#endif

static char gltf_folder[] = "/tmp/lightsheaf-gltf-XXXXXX";

static void ignore_message(lsf_log_level level, const char *message, void *user)
{
    (void)level;
    (void)message;
    (void)user;
}

static int make_gltf_folder(void **state)
{
    (void)state;
    lsf_log_set_handler(ignore_message, NULL);
    const char *root = getenv("LSF_SOURCE_ROOT");
    if (!mkdtemp(gltf_folder))
        return -1;
    char *command =
        lsf_format("python3 -B '%s/tests/io/%s' '%s'", root ? root : ".", GLTF_SCRIPT, gltf_folder);
    int status = command ? system(command) : -1;
    free(command);
    return status;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *place)
{
    (void)status;
    (void)type;
    (void)place;
    return remove(path);
}

static int remove_gltf_folder(void **state)
{
    (void)state;
    return nftw(gltf_folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

#endif
