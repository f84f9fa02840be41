/* Removes the empty space between a scene's islands from a bundle's map, along each of its axes. */
#include <math.h>
#include <stdlib.h>

#include "passes/ray_bundle_parts.h"

/* What is left of a gap: a part of all that lies about gaps, which costs the rest little
 * resolution; in texels of a map over all of the scene, so that what lies on both sides stays apart
 * in it, and is farther along the bundle than a ray's own surface; and far more than rounding. */
#define LEFT_SHARE (1.0f / 16.0f)
#define LEFT_TEXELS 4.0f
#define LEFT_LENGTH 1e-6f

typedef struct interval {
    float low, high;
} interval;

static int by_low(const void *a, const void *b)
{
    float left = ((const interval *)a)->low, right = ((const interval *)b)->low;
    return (left > right) - (left < right);
}

/* The intervals that islands cover along an axis, in ascending order and merged. Returns their
 * number. */
static uint32_t cover(const lsf_islands *islands, lsf_float3 axis, interval pieces[LSF_ISLANDS_MAX])
{
    uint32_t last = 0;
    for (uint32_t i = 0; i < islands->count; i++)
        lsf_island_bounds_along(islands->bounds[i], axis, &pieces[i].low, &pieces[i].high);
    qsort(pieces, islands->count, sizeof *pieces, by_low);
    for (uint32_t i = 1; i < islands->count; i++)
        if (pieces[i].low <= pieces[last].high)
            pieces[last].high = fmaxf(pieces[last].high, pieces[i].high);
        else
            pieces[++last] = pieces[i];
    return last + 1;
}

/* Of each gap `share` of what is covered is left, and `least` at least. Sets low and high to the
 * bounds of what is left in all. */
static void close_along(const lsf_islands *islands, lsf_float3 axis, float share, float least,
                        lsf_vec4 *starts, lsf_vec4 *lengths, float *low, float *high)
{
    interval pieces[LSF_ISLANDS_MAX];
    float start[LSF_ISLANDS_MAX - 1] = {0}, length[LSF_ISLANDS_MAX - 1] = {0};
    uint32_t count = cover(islands, axis, pieces), found = 0;
    float covered = 0.0f, taken = 0.0f;
    for (uint32_t i = 0; i < count; i++)
        covered += pieces[i].high - pieces[i].low;
    float left = fmaxf(share * covered, least);
    for (uint32_t i = 0; i + 1 < count; i++) {
        float gap = pieces[i + 1].low - pieces[i].high - left;
        if (gap <= left)
            continue;
        start[found] = pieces[i].high + 0.5f * left;
        length[found++] = gap;
        taken += gap;
    }
    *starts = (lsf_vec4){start[0], start[1], start[2], start[3]};
    *lengths = (lsf_vec4){length[0], length[1], length[2], length[3]};
    *low = pieces[0].low;
    *high = pieces[count - 1].high - taken;
}

lsf_ray_bundle_gaps lsf_ray_bundle_close_gaps(const lsf_islands *islands, const lsf_float3 axes[3],
                                              float texels, float low[3], float high[3])
{
    lsf_ray_bundle_gaps gaps;
    float share = fmaxf(LEFT_SHARE, LEFT_TEXELS / texels), texel = 0.0f;
    for (int axis = 0; axis < 2; axis++) {
        close_along(islands, axes[axis], share, LEFT_LENGTH, &gaps.starts[axis],
                    &gaps.lengths[axis], &low[axis], &high[axis]);
        texel = fmaxf(texel, (high[axis] - low[axis]) / texels);
    }
    close_along(islands, axes[2], LEFT_SHARE, fmaxf(LEFT_TEXELS * texel, LEFT_LENGTH),
                &gaps.starts[2], &gaps.lengths[2], &low[2], &high[2]);
    return gaps;
}
