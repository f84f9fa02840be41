#include "frame/coarse_grid.h"
#include "frame/purpose.h"

#include <math.h>

#include "math/sampling.h"
#include "shared/scene_data.h"

uint32_t lsf_coarse_grid_length(uint32_t length, float scale)
{
    uint32_t texels = (uint32_t)ceilf((float)length * scale);
    return texels < 1 ? 1 : texels < length ? texels : length;
}

bool lsf_coarse_grid_is_coarse(const lsf_plan *plan, uint32_t width, uint32_t height)
{
    return width != plan->width || height != plan->height;
}

void lsf_coarse_grid_switch(lsf_plan *plan, uint32_t width, uint32_t height)
{
    lsf_plan_switch_add(plan, "LSF_COARSE", lsf_coarse_grid_is_coarse(plan, width, height),
                        "light is traced at fewer places than there are pixels");
}

lsf_coarse_grid lsf_coarse_grid_at(const lsf_iteration *iteration, uint32_t width, uint32_t height)
{
    uint32_t bits[2];
    lsf_sobol_2d_bits(iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_COARSE_GRID),
                      bits);
    return (lsf_coarse_grid){
        .width = width,
        .height = height,
        .offset = {bits[0] >> 16, bits[1] >> 16},
        .coarse = lsf_coarse_grid_is_coarse(iteration->plan, width, height),
    };
}

void lsf_coarse_grid_set(const lsf_coarse_grid *grid)
{
    if (grid->coarse)
        glUniform4i(LSF_LOCATION_COARSE, (GLint)grid->width, (GLint)grid->height,
                    (GLint)grid->offset[0], (GLint)grid->offset[1]);
}
