/* Sandboxes in tests: shaders that are texts, pictures of few pixels. */
#ifndef LSF_TESTS_SANDBOX_RIG_H
#define LSF_TESTS_SANDBOX_RIG_H

#include "../passes/render_gl.h"

/* One context for all tests of a program. */
extern lsf_context *sandbox_context;
int sandbox_setup(void **state);
int sandbox_teardown(void **state);

/* 64 x 64 pixels of that text, called "test.frag". */
lsf_sandbox_params sandbox_params(const char *text);
/* Fails the test where it is refused. */
lsf_sandbox *sandbox_make(const lsf_scene *scene, const lsf_sandbox_params *params);
/* Runs frames 0 to count - 1 and reads the last one. Its bytes are those of its plan. */
lsf_image *sandbox_picture(const lsf_scene *scene, const lsf_sandbox_params *params,
                           uint32_t count);
/* The same of a text, with R, G and B of one pixel from the lower left corner. */
void sandbox_pixel(const lsf_scene *scene, const char *text, uint32_t count, uint32_t x, uint32_t y,
                   float rgb[3]);
void sandbox_assert_pixel(const lsf_scene *scene, const char *text, uint32_t count, uint32_t x,
                          uint32_t y, float r, float g, float b, float tolerance);
/* The message begins with `says`. */
void sandbox_refuse(const lsf_scene *scene, const lsf_sandbox_params *params, const char *says);

#endif
