#include "measure/convolve.h"

#include <string.h>

/* Apart, so that the compiler sees two rows that do not overlap, and makes vectors of them. */
static void add_scaled(float *restrict out, const float *restrict in, float weight, uint32_t count)
{
    for (uint32_t x = 0; x < count; x++)
        out[x] += weight * in[x];
}

/* The same of what `in` differs from `centre`. */
static void add_difference(float *restrict out, const float *restrict in,
                           const float *restrict centre, float weight, uint32_t count)
{
    for (uint32_t x = 0; x < count; x++)
        out[x] += weight * (in[x] - centre[x]);
}

static void add_row(float *out, const lsf_kernel *kernel, int k, const float *in,
                    const float *centre, uint32_t count)
{
    float weight = kernel->weights[k + kernel->radius];
    if (kernel->balanced)
        add_difference(out, in, centre, weight, count);
    else
        add_scaled(out, in, weight, count);
}

void lsf_convolve_rows(lsf_plane_size size, const lsf_kernel *kernel, const float *in, float *out,
                       float *padded)
{
    const int radius = kernel->radius;
    for (uint32_t y = 0; y < size.height; y++) {
        const float *row = in + (size_t)y * size.width;
        float *sums = out + (size_t)y * size.width;
        for (int k = 0; k < radius; k++) {
            padded[k] = row[0];
            padded[(uint32_t)radius + size.width + (uint32_t)k] = row[size.width - 1];
        }
        memcpy(padded + radius, row, size.width * sizeof *row);
        memset(sums, 0, size.width * sizeof *sums);
        for (int k = -radius; k <= radius; k++)
            add_row(sums, kernel, k, padded + radius + k, row, size.width);
    }
}

void lsf_convolve_columns(lsf_plane_size size, const lsf_kernel *kernel, const float *in,
                          float *out, bool add)
{
    for (uint32_t y = 0; y < size.height; y++) {
        const float *row = in + (size_t)y * size.width;
        float *sums = out + (size_t)y * size.width;
        if (!add)
            memset(sums, 0, size.width * sizeof *sums);
        for (int k = -kernel->radius; k <= kernel->radius; k++) {
            int64_t at = (int64_t)y + k;
            at = at < 0 ? 0 : at < size.height ? at : size.height - 1;
            add_row(sums, kernel, k, in + (size_t)at * size.width, row, size.width);
        }
    }
}
