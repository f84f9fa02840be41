#include "easel/process.h"

#include "base/base.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* The environment with the mark of a worker; its array is to be freed. */
static char **marked_environment(void)
{
    size_t count = 0;
    while (environ[count])
        count++;
    char **marked = lsf_alloc(count + 2, sizeof *marked);
    if (marked) {
        memcpy(marked, environ, count * sizeof *marked);
        marked[count] = (char *)LSF_EASEL_WORKER "=1";
    }
    return marked;
}

/* The new program gets the socket and the memory under agreed numbers. */
static int spawn(lsf_easel_process *process, char *const *command, int other_end)
{
    posix_spawn_file_actions_t actions;
    char **environment = marked_environment();
    if (!environment)
        return ENOMEM;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, other_end, LSF_EASEL_SOCKET);
    posix_spawn_file_actions_adddup2(&actions, process->pixels, LSF_EASEL_PIXELS);
    int failed = posix_spawn(&process->id, "/proc/self/exe", &actions, NULL, command, environment);
    posix_spawn_file_actions_destroy(&actions);
    free(environment);
    if (failed)
        process->id = 0;
    return failed;
}

bool lsf_easel_process_start(lsf_easel_process *process, char *const *command, lsf_error *error)
{
    int ends[2];
    *process = (lsf_easel_process){.socket = -1, .pixels = -1};
    process->pixels = memfd_create("lightsheaf-pixels", MFD_CLOEXEC);
    if (process->pixels < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no process for the shader: %s",
                             strerror(errno));
    process->socket = ends[0];
    int failed = spawn(process, command, ends[1]);
    close(ends[1]);
    return !failed || lsf_error_set(error, LSF_ERROR_RENDER, "no process for the shader: %s",
                                    strerror(failed));
}

void lsf_easel_process_end(lsf_easel_process *process)
{
    if (process->id > 0) {
        kill(process->id, SIGKILL);
        waitpid(process->id, NULL, 0);
    }
    if (process->mapped)
        munmap(process->mapped, process->mapped_bytes);
    if (process->socket >= 0)
        close(process->socket);
    if (process->pixels >= 0)
        close(process->pixels);
    *process = (lsf_easel_process){.socket = -1, .pixels = -1};
}

static bool map_pixels(lsf_easel_process *process, size_t bytes)
{
    if (bytes <= process->mapped_bytes)
        return true;
    if (process->mapped)
        munmap(process->mapped, process->mapped_bytes);
    process->mapped = NULL;
    process->mapped_bytes = 0;
    if (ftruncate(process->pixels, (off_t)bytes) != 0)
        return false;
    void *mapped = mmap(NULL, bytes, PROT_READ, MAP_SHARED, process->pixels, 0);
    if (mapped == MAP_FAILED)
        return false;
    process->mapped = mapped;
    process->mapped_bytes = bytes;
    return true;
}

bool lsf_easel_process_ask(lsf_easel_process *process, const lsf_easel_request *request,
                           lsf_error *error)
{
    if (!map_pixels(process, (size_t)request->width * request->height * 3))
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory for a picture of %ux%u pixels",
                             request->width, request->height);
    process->asked = true;
    process->since = lsf_now();
    /* Whether it arrived is told by the answer. */
    (void)!send(process->socket, request, sizeof *request, MSG_NOSIGNAL);
    return true;
}

static lsf_easel_news gone(lsf_easel_process *process, lsf_error *error)
{
    int status = 0;
    waitpid(process->id, &status, 0);
    process->id = 0;
    if (WIFSIGNALED(status))
        lsf_error_set(error, LSF_ERROR_RENDER,
                      "the process of the shader was ended by the signal: %s",
                      strsignal(WTERMSIG(status)));
    else
        lsf_error_set(error, LSF_ERROR_RENDER, "the process of the shader ended");
    lsf_easel_process_end(process);
    return LSF_EASEL_GONE;
}

lsf_easel_news lsf_easel_process_poll(lsf_easel_process *process, double seconds,
                                      lsf_easel_answer *answer, lsf_error *error)
{
    struct pollfd ready = {.fd = process->socket, .events = POLLIN};
    if (process->socket < 0 || poll(&ready, 1, (int)(seconds * 1e3)) <= 0)
        return LSF_EASEL_NOTHING;
    if (recv(process->socket, answer, sizeof *answer, 0) != (ssize_t)sizeof *answer)
        return gone(process, error);
    process->asked = false;
    return LSF_EASEL_ANSWER;
}
