#include "base/base.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The temporaries that are open now. A signal handler may read it at any time: a slot's path is
 * complete before its state says OPEN, and is not touched until the state has left OPEN. */
enum { SLOT_FREE, SLOT_CLAIMED, SLOT_OPEN };

static struct {
    atomic_int state;
    char path[PATH_MAX];
} slots[32];

static int register_temporary(const char *path)
{
    size_t size = strlen(path) + 1;
    for (size_t i = 0; size <= PATH_MAX && i < LSF_COUNT(slots); i++) {
        int expected = SLOT_FREE;
        if (!atomic_compare_exchange_strong(&slots[i].state, &expected, SLOT_CLAIMED))
            continue;
        memcpy(slots[i].path, path, size);
        atomic_store(&slots[i].state, SLOT_OPEN);
        return (int)i;
    }
    return -1;
}

static void forget_temporary(const char *path)
{
    for (size_t i = 0; i < LSF_COUNT(slots); i++)
        if (atomic_load(&slots[i].state) == SLOT_OPEN && strcmp(slots[i].path, path) == 0)
            atomic_store(&slots[i].state, SLOT_FREE);
}

void lsf_atomic_file_abort_all(void)
{
    for (size_t i = 0; i < LSF_COUNT(slots); i++)
        if (atomic_load(&slots[i].state) == SLOT_OPEN)
            unlink(slots[i].path);
}

static bool write_error(lsf_error *error, const char *path, int cause)
{
    const char *remedy = "";
    if (cause == ENOSPC || cause == EDQUOT)
        remedy = "; free some space or write elsewhere";
    else if (cause == EFBIG)
        remedy = "; raise the limit on file sizes (ulimit -f)";
    else if (cause == EACCES || cause == EPERM || cause == EROFS)
        remedy = "; choose a folder that you may write to";
    else if (cause == ENOENT || cause == ENOTDIR)
        remedy = "; create the folder first";
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot write: %s%s", path, strerror(cause),
                         remedy);
}

/* Devices, FIFOs and sockets cannot be replaced by a rename, and /dev/stdout may lead to a file
 * that the shell holds open: these are written in place. */
static bool is_written_in_place(const char *path, const struct stat *status)
{
    return !S_ISREG(status->st_mode) || strncmp(path, "/dev/", 5) == 0 ||
           strncmp(path, "/proc/", 6) == 0;
}

/* Makes the temporary beside `path`, under a short name so that a long file name still fits. */
static bool make_temporary(lsf_atomic_file *file, lsf_error *error)
{
    static atomic_uint counter;
    const char *slash = strrchr(file->path, '/');
    int folder_length = slash ? (int)(slash - file->path) + 1 : 0;
    for (int attempt = 0; attempt < 100; attempt++) {
        file->temporary_path = lsf_format("%.*s.lightsheaf-%ld-%u.tmp", folder_length, file->path,
                                          (long)getpid(), atomic_fetch_add(&counter, 1));
        if (!file->temporary_path)
            return lsf_error_set(error, LSF_ERROR_FILE, "%s: out of memory", file->path);
        int slot = register_temporary(file->temporary_path);
        if (slot < 0) {
            free(file->temporary_path);
            file->temporary_path = NULL;
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: cannot write: the path is too long, or more than %zu files "
                                 "are being written at once",
                                 file->path, LSF_COUNT(slots));
        }
        int descriptor = open(file->temporary_path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        int cause = errno;
        if (descriptor >= 0) {
            close(descriptor);
            return true;
        }
        forget_temporary(file->temporary_path);
        free(file->temporary_path);
        file->temporary_path = NULL;
        if (cause != EEXIST)
            return write_error(error, file->path, cause);
    }
    return write_error(error, file->path, EEXIST);
}

bool lsf_atomic_file_begin(lsf_atomic_file *file, const char *path, lsf_error *error)
{
    *file = (lsf_atomic_file){0};
    if (path[0] == '\0')
        return lsf_error_set(error, LSF_ERROR_FILE, "cannot write: the file name is empty");

    struct stat status;
    bool exists = stat(path, &status) == 0;
    bool in_place = exists && is_written_in_place(path, &status);
    if (exists && S_ISDIR(status.st_mode))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: cannot write: it is a folder; name a file in it", path);
    if (exists && access(path, W_OK) != 0)
        return write_error(error, path, errno);
    if (!exists && lstat(path, &status) == 0)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: cannot write: it is a symbolic link that leads nowhere; "
                             "remove it",
                             path);

    /* A link stays a link: the file that it leads to is replaced. */
    file->path = exists && !in_place ? realpath(path, NULL) : strdup(path);
    if (in_place)
        file->temporary_path = strdup(path);
    if (!file->path || (in_place && !file->temporary_path)) {
        lsf_atomic_file_abort(file);
        return write_error(error, path, ENOMEM);
    }
    if (in_place || make_temporary(file, error))
        return true;
    lsf_atomic_file_abort(file);
    return false;
}

static bool synchronise(const char *path)
{
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    bool done = fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
    int cause = errno;
    close(descriptor);
    errno = cause;
    return done;
}

static void release(lsf_atomic_file *file)
{
    free(file->path);
    free(file->temporary_path);
    *file = (lsf_atomic_file){0};
}

bool lsf_atomic_file_commit(lsf_atomic_file *file, lsf_error *error)
{
    bool in_place = strcmp(file->path, file->temporary_path) == 0;
    if (!in_place &&
        (!synchronise(file->temporary_path) || rename(file->temporary_path, file->path) != 0)) {
        write_error(error, file->path, errno);
        lsf_atomic_file_abort(file);
        return false;
    }
    forget_temporary(file->temporary_path);
    release(file);
    return true;
}

void lsf_atomic_file_abort(lsf_atomic_file *file)
{
    if (file->temporary_path && strcmp(file->path, file->temporary_path) != 0) {
        unlink(file->temporary_path);
        forget_temporary(file->temporary_path);
    }
    release(file);
}

static bool write_all(int descriptor, const char *bytes, size_t length)
{
    while (length > 0) {
        ssize_t written = write(descriptor, bytes, length);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        bytes += written;
        length -= (size_t)written;
    }
    return true;
}

bool lsf_file_can_write(const char *path, lsf_error *error)
{
    lsf_atomic_file file;
    if (strcmp(path, "-") == 0)
        return true;
    if (!lsf_atomic_file_begin(&file, path, error))
        return false;
    lsf_atomic_file_abort(&file);
    return true;
}

bool lsf_file_write(const char *path, const void *bytes, size_t length, lsf_error *error)
{
    if (strcmp(path, "-") == 0) {
        fflush(stdout);
        return write_all(STDOUT_FILENO, bytes, length) ||
               write_error(error, "standard output", errno);
    }

    lsf_atomic_file file;
    if (!lsf_atomic_file_begin(&file, path, error))
        return false;
    int descriptor = open(file.temporary_path, O_WRONLY | O_CLOEXEC);
    bool written = descriptor >= 0 && write_all(descriptor, bytes, length);
    int cause = errno;
    /* Network file systems report a full disk only here. */
    if (descriptor >= 0 && close(descriptor) != 0 && written) {
        written = false;
        cause = errno;
    }
    if (!written) {
        write_error(error, path, cause);
        lsf_atomic_file_abort(&file);
        return false;
    }
    return lsf_atomic_file_commit(&file, error);
}
