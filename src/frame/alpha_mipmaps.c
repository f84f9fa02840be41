#include "frame/alpha_mipmaps.h"

#include <math.h>

#include "base/base.h"

typedef struct level {
    uint32_t width, height;
    const float *texels;
} level;

static uint32_t half(uint32_t size)
{
    return size > 1 ? size / 2 : 1;
}

/* Adds a texel of level 0, its colour weighed by alpha; of others, whose colours are weighed
 * already. */
static void add(float sum[4], const float *texel, bool weighed, float share)
{
    float weight = weighed ? share : share * texel[3];
    for (int c = 0; c < 3; c++)
        sum[c] += weight * texel[c];
    sum[3] += share * texel[3];
}

/* The mean over the texel's part of the finer level, which ends within texels where sizes are odd.
 */
static void average(float out[4], const level *finer, bool weighed, const level *coarser,
                    uint32_t x, uint32_t y)
{
    float width = (float)finer->width / (float)coarser->width;
    float height = (float)finer->height / (float)coarser->height;
    float left = width * (float)x, top = height * (float)y;
    float sum[4] = {0};
    for (uint32_t v = (uint32_t)top; v < finer->height && (float)v < top + height; v++)
        for (uint32_t u = (uint32_t)left; u < finer->width && (float)u < left + width; u++) {
            float across = fminf((float)u + 1, left + width) - fmaxf((float)u, left);
            float down = fminf((float)v + 1, top + height) - fmaxf((float)v, top);
            add(sum, finer->texels + 4 * ((uint64_t)v * finer->width + u), weighed, across * down);
        }
    for (int c = 0; c < 4; c++)
        out[c] = sum[c] / (width * height);
}

static void divide_by_alpha(float *texels, const level *l, const level *coarser)
{
    for (uint32_t y = 0; y < l->height; y++)
        for (uint32_t x = 0; x < l->width; x++, texels += 4) {
            uint32_t u = x / 2 < coarser->width ? x / 2 : coarser->width - 1;
            uint32_t v = y / 2 < coarser->height ? y / 2 : coarser->height - 1;
            const float *behind = coarser->texels + 4 * ((uint64_t)v * coarser->width + u);
            for (int c = 0; c < 3; c++)
                texels[c] = texels[3] > 0.0f ? texels[c] / texels[3] : behind[c];
        }
}

float *lsf_alpha_mipmaps_create(const float *texels, uint32_t width, uint32_t height)
{
    level levels[32] = {{width, height, texels}};
    uint32_t last = 0;
    uint64_t begins[32] = {0}, count = 0;
    for (; levels[last].width > 1 || levels[last].height > 1; last++) {
        level next = {half(levels[last].width), half(levels[last].height), NULL};
        levels[last + 1] = next;
        begins[last + 1] = 4 * count;
        count += (uint64_t)next.width * next.height;
    }
    float *all = lsf_alloc(count, 4 * sizeof *all);
    for (uint32_t i = 1; all && i <= last; i++) {
        float *out = all + begins[i];
        levels[i].texels = out;
        for (uint32_t y = 0; y < levels[i].height; y++)
            for (uint32_t x = 0; x < levels[i].width; x++, out += 4)
                average(out, &levels[i - 1], i > 1, &levels[i], x, y);
    }
    /* From the coarsest on, so that transparent texels take a colour that is complete. */
    for (uint32_t i = last; all && i > 0; i--)
        divide_by_alpha(all + begins[i], &levels[i], &levels[i < last ? i + 1 : last]);
    return all;
}
