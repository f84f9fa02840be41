#include "tools/interrupt.h"

#include "base/base.h"
#include "tools/report.h"

#include <lightsheaf/image.h>

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t iterating, asked_to_stop;

static void on_signal(int number)
{
    if (iterating && !asked_to_stop) {
        asked_to_stop = 1;
        return;
    }
    lsf_image_save_abort();      /* the library's files */
    lsf_atomic_file_abort_all(); /* the command's own, such as --json */
    struct sigaction fatal = {.sa_handler = SIG_DFL};
    sigaction(number, &fatal, NULL);
    raise(number); /* blocked in its own handler: it arrives on return */
}

void lsf_interrupt_install(void)
{
    /* Writing beyond the limit on file sizes then fails with a cause. */
    signal(SIGXFSZ, SIG_IGN);
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    for (size_t i = 0; i < LSF_COUNT(numbers); i++) {
        struct sigaction before;
        /* nohup and background jobs of a shell without job control have them ignored */
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
    }
}

void lsf_interrupt_begin_iterations(void)
{
    iterating = 1;
}

void lsf_interrupt_end_iterations(void)
{
    iterating = 0;
}

bool lsf_interrupted(void)
{
    return asked_to_stop;
}

bool lsf_interrupt_progress(uint32_t done, uint32_t total, void *bar)
{
    lsf_progress_bar_draw(bar, done, total);
    return !lsf_interrupted();
}

bool lsf_interrupt_may_save(uint32_t samples, lsf_error *error)
{
    if (!lsf_interrupted() || samples > 0)
        return true;
    return lsf_error_set(error, LSF_ERROR_RENDER,
                         "interrupted before the first sample was done; nothing was written");
}
