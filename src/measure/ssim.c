#include "measure/ssim.h"

#include <math.h>
#include <stdlib.h>

enum { RADIUS = 5, WINDOW = 2 * RADIUS + 1 };

/* Weighted sums over a window: the weights of compared pixels, then their x, y, x^2, y^2, xy. */
enum { WEIGHT, X, Y, XX, YY, XY, MOMENTS };

typedef struct picture {
    const float *x, *y;
    const uint8_t *compared;
    uint32_t width, height;
    double kernel[WINDOW];
} picture;

/* `row` takes MOMENTS values for each pixel of row `py`. */
static void blur_along_row(const picture *p, uint32_t py, double *row)
{
    const size_t start = (size_t)py * p->width;
    for (uint32_t px = 0; px < p->width; px++) {
        double sums[MOMENTS] = {0};
        for (int k = -RADIUS; k <= RADIUS; k++) {
            int64_t at = (int64_t)px + k;
            if (at < 0 || at >= p->width || !p->compared[start + (size_t)at])
                continue;
            double weight = p->kernel[k + RADIUS];
            double x = p->x[start + (size_t)at], y = p->y[start + (size_t)at];
            sums[WEIGHT] += weight;
            sums[X] += weight * x;
            sums[Y] += weight * y;
            sums[XX] += weight * x * x;
            sums[YY] += weight * y * y;
            sums[XY] += weight * x * y;
        }
        for (int m = 0; m < MOMENTS; m++)
            row[(size_t)px * MOMENTS + (size_t)m] = sums[m];
    }
}

static double similarity(const double sums[MOMENTS])
{
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double mean_x = sums[X] / sums[WEIGHT], mean_y = sums[Y] / sums[WEIGHT];
    double variance_x = sums[XX] / sums[WEIGHT] - mean_x * mean_x;
    double variance_y = sums[YY] / sums[WEIGHT] - mean_y * mean_y;
    double covariance = sums[XY] / sums[WEIGHT] - mean_x * mean_y;
    return (2.0 * mean_x * mean_y + c1) * (2.0 * covariance + c2) /
           ((mean_x * mean_x + mean_y * mean_y + c1) * (variance_x + variance_y + c2));
}

/* Sum of the similarities along row `py`, and their count. `rows` holds the blurred rows
 * py - RADIUS .. py + RADIUS, each at its number modulo WINDOW. */
static double sum_row(const picture *p, uint32_t py, const double *rows, uint64_t *count)
{
    uint32_t border_x = p->width < WINDOW ? 0 : RADIUS;
    double sum = 0.0;
    for (uint32_t px = border_x; px < p->width - border_x; px++) {
        if (!p->compared[(size_t)py * p->width + px])
            continue;
        double sums[MOMENTS] = {0};
        for (int k = -RADIUS; k <= RADIUS; k++) {
            int64_t at = (int64_t)py + k;
            if (at < 0 || at >= p->height)
                continue;
            const double *row = rows + ((size_t)(at % WINDOW) * p->width + px) * MOMENTS;
            for (int m = 0; m < MOMENTS; m++)
                sums[m] += p->kernel[k + RADIUS] * row[m];
        }
        sum += similarity(sums);
        ++*count;
    }
    return sum;
}

double lsf_ssim(const float *x, const float *y, const uint8_t *compared, uint32_t width,
                uint32_t height)
{
    picture p = {.x = x, .y = y, .compared = compared, .width = width, .height = height};
    double total = 0.0;
    for (int k = -RADIUS; k <= RADIUS; k++)
        total += p.kernel[k + RADIUS] = exp(-0.5 * k * k / (1.5 * 1.5));
    for (int k = 0; k < WINDOW; k++)
        p.kernel[k] /= total;
    double *rows = lsf_alloc((uint64_t)width * WINDOW, MOMENTS * sizeof *rows);
    if (!rows)
        return NAN;

    uint32_t border_y = height < WINDOW ? 0 : RADIUS;
    double sum = 0.0;
    uint64_t count = 0;
    for (uint32_t py = 0; py < height + RADIUS; py++) {
        if (py < height)
            blur_along_row(&p, py, rows + (size_t)(py % WINDOW) * width * MOMENTS);
        if (py >= RADIUS + border_y && py - RADIUS < height - border_y)
            sum += sum_row(&p, py - RADIUS, rows, &count);
    }
    free(rows);
    return count ? sum / (double)count : NAN;
}
