#include "bidirectional_rig.h"

lsf_render_params bidirectional_params(uint32_t samples, uint32_t bounces)
{
    static const char *const options[] = {SMALL_MAPS};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "bidirectional";
    params.samples = getenv("LSF_TEST_QUICK") && samples > 16 ? samples / 4 : samples;
    params.bounces = bounces;
    params.options = options;
    params.option_count = SMALL_MAP_OPTIONS;
    return params;
}
