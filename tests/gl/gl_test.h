/* Helpers of the GL layer's tests. Every context fails on GL errors. */
#ifndef LSF_TESTS_GL_TEST_H
#define LSF_TESTS_GL_TEST_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "gl/gl.h"
#include "shared/scene_data.h"

/* The backend of tests that need no certain one: OSMesa, as a machine for tests has no GPU. With
 * LSF_TEST_BACKEND=egl they run on a GPU. */
static inline lsf_backend gl_test_backend(void)
{
    const char *name = getenv("LSF_TEST_BACKEND");
    if (name && strcmp(name, "egl") != 0)
        fail_msg("LSF_TEST_BACKEND=%s: use egl, or leave it out", name);
    return name ? LSF_BACKEND_EGL : LSF_BACKEND_OSMESA;
}

/* GPUs keep none of a NaN's bits. */
static inline bool gl_test_same_float(float a, float b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* LSF_RASTER_STEP of shared/scene_data.h where the driver derives depths from moved vertices;
 * llvmpipe does not. */
static inline float gl_test_raster_step(void)
{
    return gl_test_backend() == LSF_BACKEND_OSMESA ? 0.0f : LSF_RASTER_STEP;
}

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
