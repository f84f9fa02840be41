/* Small pictures by the bidirectional technique. */
#ifndef LSF_TESTS_PASSES_BIDIRECTIONAL_RIG_H
#define LSF_TESTS_PASSES_BIDIRECTIONAL_RIG_H

#include "render_gl.h"

/* For tests of what does not depend on the resolution of maps. */
#define SMALL_MAPS                                                                                 \
    "rsm.resolution=64", "vpl.shadow_resolution=64", "bundle.resolution=96",                       \
        "shadow.texels_per_pixel=4"
enum { SMALL_MAP_OPTIONS = 4 };

/* With small maps. Of more than 16 samples a quarter under LSF_TEST_QUICK. */
lsf_render_params bidirectional_params(uint32_t samples, uint32_t bounces);

#endif
