/* The resources that a plan lists, on the GPU. */
#ifndef LSF_FRAME_RESOURCES_H
#define LSF_FRAME_RESOURCES_H

#include "plan/plan.h"

/* Creates those textures that are listed in `pass`; the others stay 0. */
bool lsf_plan_create_textures(const lsf_plan *plan, lsf_context *context,
                              const lsf_texture_row *rows, size_t count, void *pass,
                              lsf_error *error);
void lsf_textures_destroy(lsf_context *context, const lsf_texture_row *rows, size_t count,
                          void *pass);

/* Creates the texture, which is an error when the plan does not list it. */
bool lsf_plan_create_texture(const lsf_plan *plan, lsf_context *context, const char *name,
                             GLuint *texture, lsf_error *error);
/* The same for a buffer; `data` holds the planned bytes or is NULL. */
bool lsf_plan_create_buffer(const lsf_plan *plan, lsf_context *context, const char *name,
                            const void *data, GLbitfield flags, GLuint *buffer, lsf_error *error);
/* For resources that only some plans list: the name stays 0, with success, when it is not
 * listed. */
bool lsf_plan_create_texture_if_planned(const lsf_plan *plan, lsf_context *context,
                                        const char *name, GLuint *texture, lsf_error *error);
bool lsf_plan_create_buffer_if_planned(const lsf_plan *plan, lsf_context *context, const char *name,
                                       const void *data, GLbitfield flags, GLuint *buffer,
                                       lsf_error *error);
/* Replaces the buffer by one of `bytes`, without its contents, and lists it with that size; for
 * buffers whose size is known only while rendering. On failure *buffer is 0. */
bool lsf_plan_resize_buffer(lsf_plan *plan, lsf_context *context, const char *name, uint64_t bytes,
                            GLbitfield flags, GLuint *buffer, lsf_error *error);
/* Compiles `files` (up to five, NULL-terminated) with the pass's switches. 0 on failure. */
GLuint lsf_plan_program(const lsf_plan *plan, lsf_context *context, const char *pass,
                        const char *const files[5], lsf_error *error);

/* Refuses a plan that the device cannot hold, naming the smallest change that would fit. */
bool lsf_plan_check(const lsf_plan *plan, const lsf_context *context, lsf_error *error);

#endif
