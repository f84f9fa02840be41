/* A context that the application made, and keeps. */
#include "gl/context.h"

#include <stdlib.h>

static bool wrap_make_current(void *platform, lsf_error *error)
{
    const lsf_context_wrap_params *application = platform;
    return !application->make_current || application->make_current(application->user) ||
           lsf_error_set(error, LSF_ERROR_NO_GL,
                         "the application could not make its context "
                         "current (lsf_context_wrap_params.make_current)");
}

/* Only the application knows whether its context is current: it is asked each time. */
static bool wrap_is_current(void *platform)
{
    (void)platform;
    return false;
}

static void wrap_release(void *platform)
{
    (void)platform;
}

static GLADapiproc wrap_get_proc_address(void *platform, const char *name)
{
    const lsf_context_wrap_params *application = platform;
    return (GLADapiproc)application->get_proc_address(application->user, name);
}

const lsf_backend_ops lsf_backend_wrap = {
    .name = "application",
    .destroy = free,
    .make_current = wrap_make_current,
    .is_current = wrap_is_current,
    .release = wrap_release,
    .get_proc_address = wrap_get_proc_address,
};
