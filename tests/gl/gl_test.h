/* Helpers of the GL layer's tests. Every context fails on GL errors. */
#ifndef LSF_TESTS_GL_TEST_H
#define LSF_TESTS_GL_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "gl/gl.h"

/* NULL when the machine lacks this backend. */
static inline lsf_context *gl_test_open(lsf_backend backend, const char *shader_dir)
{
    lsf_context_params params = {LSF_CONTEXT_PARAMS_DEFAULTS};
    params.backend = backend;
    params.fail_on_gl_error = true;
    params.shader_dir = shader_dir;
    lsf_error error = {0};
    lsf_context *context = lsf_context_create(&params, &error);
    if (!context) {
        print_message("no context: %s\n", error.message);
        assert_int_equal(error.code, LSF_ERROR_NO_GL);
    }
    return context;
}

/* ... and then the test is skipped. */
static inline lsf_context *gl_test_context(lsf_backend backend, const char *shader_dir)
{
    lsf_context *context = gl_test_open(backend, shader_dir);
    if (!context)
        skip();
    return context;
}

static inline void gl_test_check(lsf_context *context)
{
    lsf_error error = {0};
    if (!lsf_context_check(context, &error))
        fail_msg("%s", error.message);
}

#endif
