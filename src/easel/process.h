/* The process that runs the shader, as the window sees it. */
#ifndef LSF_EASEL_PROCESS_H
#define LSF_EASEL_PROCESS_H

#include "easel/easel.h"
#include "easel/protocol.h"

#include <sys/types.h>

typedef struct lsf_easel_process {
    pid_t id;     /* 0: there is none */
    int socket;   /* -1: none */
    int pixels;   /* file of the memory that both have */
    bool asked;   /* an answer is awaited */
    double since; /* when it was asked for, by lsf_now */
    uint8_t *mapped;
    size_t mapped_bytes;
} lsf_easel_process;

bool lsf_easel_process_start(lsf_easel_process *process, char *const *command, lsf_error *error);
/* Ends it, whatever it does. */
void lsf_easel_process_end(lsf_easel_process *process);

/* Makes space for the request's pixels and sends it. */
bool lsf_easel_process_ask(lsf_easel_process *process, const lsf_easel_request *request,
                           lsf_error *error);

typedef enum lsf_easel_news { LSF_EASEL_NOTHING, LSF_EASEL_ANSWER, LSF_EASEL_GONE } lsf_easel_news;

/* Waits up to `seconds` for the answer. Gone: `error` says what the process died of. */
lsf_easel_news lsf_easel_process_poll(lsf_easel_process *process, double seconds,
                                      lsf_easel_answer *answer, lsf_error *error);

#endif
