#include "base/base.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode)    ? "a directory"
           : S_ISFIFO(mode) ? "a named pipe"
           : S_ISSOCK(mode) ? "a socket"
           : S_ISCHR(mode)  ? "a character device"
           : S_ISBLK(mode)  ? "a block device"
                            : "not a regular file";
}

static bool refuse_kind(const char *path, mode_t mode, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: is %s; give a regular file", path,
                         kind_of(mode));
}

static bool refuse_size(const char *path, uint64_t limit, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: is larger than the %llu bytes allowed here; give a smaller file, or "
                         "raise the memory limit if that is what allows no more",
                         path, (unsigned long long)limit);
}

/* Opening is what blocks on a FIFO and what can have effects on a device: the kind is looked at
 * before, and again afterwards in case the path was exchanged in between. */
static int open_regular(const char *path, struct stat *status, lsf_error *error)
{
    if (stat(path, status) != 0) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be read (%s); check path and permissions",
                      path, strerror(errno));
        return -1;
    }
    if (!S_ISREG(status->st_mode)) {
        refuse_kind(path, status->st_mode, error);
        return -1;
    }
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0 || fstat(file, status) != 0) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be opened (%s); check its permissions",
                      path, strerror(errno));
        if (file >= 0)
            close(file);
        return -1;
    }
    if (!S_ISREG(status->st_mode)) {
        refuse_kind(path, status->st_mode, error);
        close(file);
        return -1;
    }
    return file;
}

/* Reads on until the file ends or `most` bytes are there. */
static char *read_most(int file, uint64_t size, uint64_t most, const char *path, size_t *length,
                       lsf_error *error)
{
    void *bytes = NULL;
    uint64_t capacity = 0, count = 0;
    bool good = true;
    /* The size is a hint only: files in /proc say 0, and a file may grow while it is read. */
    uint64_t wanted = size + 1;
    while (good) {
        wanted = wanted < most ? wanted : most;
        if (!lsf_grow(&bytes, &capacity, wanted + 1, 1)) {
            good = lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for its %llu bytes",
                                 path, (unsigned long long)wanted);
            break;
        }
        uint64_t space = (capacity - 1 < most ? capacity - 1 : most) - count;
        ssize_t got = read(file, (char *)bytes + count, space);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            good = lsf_error_set(error, LSF_ERROR_FILE, "%s: reading failed (%s)", path,
                                 strerror(errno));
        if (got <= 0)
            break;
        count += (uint64_t)got;
        if (count + 1 == capacity)
            wanted = count + 65536;
    }
    if (!good) {
        free(bytes);
        return NULL;
    }
    ((char *)bytes)[count] = '\0';
    *length = (size_t)count;
    return bytes;
}

char *lsf_file_read_start(const char *path, uint64_t most, size_t *length, lsf_error *error)
{
    struct stat status;
    int file = open_regular(path, &status, error);
    if (file < 0)
        return NULL;
    char *bytes = read_most(file, (uint64_t)status.st_size, most, path, length, error);
    close(file);
    return bytes;
}

char *lsf_file_read(const char *path, uint64_t limit, size_t *length, lsf_error *error)
{
    struct stat status;
    int file = open_regular(path, &status, error);
    if (file < 0)
        return NULL;
    char *bytes = NULL;
    if ((uint64_t)status.st_size > limit)
        refuse_size(path, limit, error);
    else
        bytes = read_most(file, (uint64_t)status.st_size, limit + (limit < UINT64_MAX), path,
                          length, error);
    close(file);
    if (bytes && *length > limit) {
        refuse_size(path, limit, error);
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

char *lsf_file_read_standard_input(uint64_t limit, size_t *length, lsf_error *error)
{
    static const char name[] = "standard input";
    char *bytes = read_most(STDIN_FILENO, 65536, limit + (limit < UINT64_MAX), name, length, error);
    if (!bytes || *length <= limit)
        return bytes;
    refuse_size(name, limit, error);
    free(bytes);
    return NULL;
}

/* Whether the path is empty or absolute, or some component of it is "..". */
static bool leads_out(const char *path)
{
    if (path[0] == '\0' || path[0] == '/')
        return true;
    for (const char *part = path; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (part[0] == '.' && part[1] == '.' && (part[2] == '/' || part[2] == '\0'))
            return true;
    }
    return false;
}

bool lsf_path_is_absent(const char *folder, const char *relative)
{
    if (leads_out(relative))
        return false;
    char *joined = lsf_format("%s/%s", folder, relative);
    bool absent = joined && access(joined, F_OK) != 0 && errno == ENOENT;
    free(joined);
    return absent;
}

char *lsf_path_confine(const char *folder, const char *relative, lsf_error *error)
{
    if (leads_out(relative)) {
        lsf_error_set(error, LSF_ERROR_FILE,
                      "%s: leads out of the folder %s; use a path relative to that folder, without "
                      "\"..\"",
                      relative[0] ? relative : "(empty path)", folder);
        return NULL;
    }
    char *joined = lsf_format("%s/%s", folder, relative);
    char *root = joined ? realpath(folder, NULL) : NULL;
    char *target = root ? realpath(joined, NULL) : NULL;
    if (!target) {
        lsf_error_set(error, LSF_ERROR_FILE,
                      "%s: cannot be found (%s); put the file there or correct the path",
                      joined ? joined : relative, strerror(errno));
    } else {
        /* realpath has followed every symbolic link of both. */
        size_t length = strcmp(root, "/") == 0 ? 0 : strlen(root);
        if (strncmp(target, root, length) != 0 || target[length] != '/') {
            lsf_error_set(error, LSF_ERROR_FILE,
                          "%s: a symbolic link leads out of the folder %s; put the file itself "
                          "there",
                          joined, folder);
            free(target);
            target = NULL;
        }
    }
    free(joined);
    free(root);
    return target;
}
