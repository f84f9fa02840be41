#include "frame/sparse_grid.h"

#include "math/sampling.h"
#include "shared/scene_data.h"

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Number of points along an axis. */
static uint32_t points(uint32_t length, uint32_t stride)
{
    return (length + stride - 1) / stride;
}

uint32_t lsf_sparse_grid_finest(uint32_t stride, uint32_t iterations)
{
    for (uint32_t left = iterations; stride > 1 && left > stride * stride; stride /= 2)
        left -= iterations == UINT32_MAX ? 0 : stride * stride;
    return stride;
}

bool lsf_sparse_grid_is_sparse(const lsf_plan *plan)
{
    return plan->stride > 1;
}

void lsf_sparse_grid_points(const lsf_plan *plan, uint32_t size[2])
{
    uint32_t finest = plan->stride > 1 ? plan->finest_stride : 1;
    size[0] = points(plan->seen_width, finest);
    size[1] = points(plan->seen_height, finest);
}

bool lsf_sparse_grid_is_of_pixels(const lsf_plan *plan)
{
    return plan->pixel_side > 1;
}

void lsf_sparse_grid_texture_size(const lsf_plan *plan, uint32_t size[2])
{
    lsf_sparse_grid_points(plan, size);
    if (plan->stride <= 1 || lsf_sparse_grid_is_of_pixels(plan))
        return;
    /* Two layers of stride 2 may be one row higher than one layer of stride 1. */
    uint32_t layered = plan->finest_stride > 1 ? plan->finest_stride : 2;
    uint32_t rows = 2 * points(plan->seen_height, layered);
    size[1] = rows > size[1] ? rows : size[1];
}

void lsf_sparse_grid_switch(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_SPARSE", lsf_sparse_grid_is_sparse(plan),
                        "indirect light is gathered at fewer points than there are pixels");
}

void lsf_interleave_switch(lsf_plan *plan, uint32_t size)
{
    if (size > 1)
        plan->interleave = size;
    lsf_plan_switch_add(plan, "LSF_INTERLEAVE", size > 1,
                        "pixels take different samples in a pattern of interleave.size");
}

void lsf_sparse_grid_pixel_switch(lsf_plan *plan)
{
    if (lsf_sparse_grid_is_of_pixels(plan))
        lsf_plan_switch_add(plan, "LSF_PIXEL_SIDE", (int)plan->pixel_side,
                            "a pixel has as many sample points along each side");
}

/* The i-th position in a square whose width is a power of two: after each 4^k of them the
 * positions form a regular grid. */
static void position_in_square(uint32_t i, uint32_t side, uint32_t position[2])
{
    position[0] = position[1] = 0;
    for (uint32_t half = side / 2; half > 0; half /= 2, i /= 4) {
        position[0] += (i & 1 ? half : 0);
        position[1] += ((i ^ i >> 1) & 1 ? half : 0); /* the diagonal neighbour comes second */
    }
}

lsf_sparse_grid lsf_sparse_grid_at(const lsf_plan *plan, uint32_t done, uint32_t index,
                                   uint32_t seed)
{
    uint32_t stride = plan->stride > 1 ? plan->stride : 1;
    for (uint32_t before = done; stride > 1 && stride > plan->finest_stride; stride /= 2) {
        if (before < stride * stride)
            break;
        before -= stride * stride;
    }
    lsf_sparse_grid grid = {.stride = stride,
                            .width = points(plan->seen_width, stride),
                            .height = points(plan->seen_height, stride),
                            .layers = stride > 1 ? 2 : 1};
    if (lsf_sparse_grid_is_of_pixels(plan)) {
        /* By any rule of its number a place within the pixel would keep to a part of the
         * sequences by which light is sampled. */
        uint32_t number = lsf_hash(seed, index);
        grid.layers = 1;
        grid.phase[0] = number % stride;
        grid.phase[1] = number / stride % stride;
        return grid;
    }
    position_in_square(index % (stride * stride), stride, grid.phase);
    grid.phase[0] = (grid.phase[0] ^ (seed & (stride - 1))) % least(stride, plan->seen_width);
    grid.phase[1] =
        (grid.phase[1] ^ (seed >> 16 & (stride - 1))) % least(stride, plan->seen_height);
    return grid;
}

void lsf_sparse_grid_set(const lsf_plan *plan, const lsf_sparse_grid *grid)
{
    if (!lsf_sparse_grid_is_sparse(plan))
        return;
    glUniform4i(LSF_LOCATION_SPARSE_GRID, (GLint)grid->width, (GLint)grid->height,
                (GLint)grid->phase[0], (GLint)grid->phase[1]);
    glUniform2i(LSF_LOCATION_SPARSE_SHAPE, (GLint)grid->stride, (GLint)grid->layers);
}
