/* Small pictures by each technique, with options that bring in every pass, for spies (gl_spy.h). */
#ifndef LSF_TESTS_SPIED_PICTURES_H
#define LSF_TESTS_SPIED_PICTURES_H

#include "render_gl.h"

/* Renders each: calls `start` in its context, before the renderer exists, and `end` before the
 * renderer is destroyed. */
void spy_on_pictures(void (*start)(void), void (*end)(const lsf_renderer *renderer));

#endif
