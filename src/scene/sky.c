#include "scene/sky.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "math/sampling.h"
#include "scene/environment.h"
#include "shared/brdf.h"

double lsf_sky_fluence(const lsf_environment *environment)
{
    uint32_t width = environment->width, height = environment->height;
    if (!environment->present)
        return 0.0;
    if (width == 0)
        return 4.0 * M_PI * (double)lsf_f3_luminance(lsf_f3_load(environment->radiance));
    double sum = 0.0;
    for (uint32_t y = 0; y < height; y++) {
        double row = 0.0;
        for (uint32_t x = 0; x < width; x++)
            row += (double)lsf_f3_luminance(
                lsf_f3_load(environment->texels + 3 * ((uint64_t)y * width + x)));
        sum += row * lsf_environment_cell_solid_angle(width, height, y);
    }
    return sum;
}

static double solid_angle(const lsf_environment *map, uint64_t texel)
{
    return lsf_environment_cell_solid_angle(map->width, map->height,
                                            (uint32_t)(texel / map->width));
}

/* 1/2 over an integral; 0 where that is. */
static float half_over(double integral)
{
    return integral > 0.0 ? (float)(0.5 / integral) : 0.0f;
}

/* Fills `pdf`, and `weights` with the probability of each texel; a black map is uniform. */
static void fill(lsf_sky *sky, float *weights)
{
    const lsf_environment *map = sky->environment;
    uint64_t count = (uint64_t)map->width * map->height;
    double whole = 0.0, held = 0.0;
    for (uint64_t i = 0; i < count; i++) {
        sky->pdf[i] = lsf_environment_texel_luminance(map, (uint32_t)(i % map->width),
                                                      (uint32_t)(i / map->width));
        whole += (double)sky->pdf[i] * solid_angle(map, i);
    }
    sky->mean = (float)(whole / (4.0 * M_PI));
    for (uint64_t i = 0; i < count; i++)
        held += (double)fminf(sky->pdf[i], sky->mean) * solid_angle(map, i);
    sky->whole = half_over(whole);
    sky->held = half_over(held);
    for (uint64_t i = 0; i < count; i++) {
        float l = sky->pdf[i];
        sky->pdf[i] = whole > 0.0 ? sky->whole * l + sky->held * fminf(l, sky->mean)
                                  : 0.25f / LSF_PI;
        weights[i] = sky->pdf[i] * (float)solid_angle(map, i);
    }
}

bool lsf_sky_init(lsf_sky *sky, const lsf_environment *environment)
{
    *sky = (lsf_sky){.environment = environment};
    if (environment->width == 0) {
        sky->mean = lsf_f3_luminance(lsf_f3_load(environment->radiance));
        sky->whole = sky->held = half_over(lsf_sky_fluence(environment));
        return true;
    }
    uint64_t count = (uint64_t)environment->width * environment->height;
    float *weights = lsf_alloc(count, sizeof *weights);
    sky->pdf = lsf_alloc(count, sizeof *sky->pdf);
    bool good = weights && sky->pdf;
    if (good) {
        fill(sky, weights);
        good = lsf_distribution_2d_init(&sky->cells, weights, environment->width,
                                        environment->height);
    }
    free(weights);
    if (!good)
        lsf_sky_finish(sky);
    return good;
}

void lsf_sky_finish(lsf_sky *sky)
{
    lsf_distribution_2d_finish(&sky->cells);
    free(sky->pdf);
    *sky = (lsf_sky){0};
}

/* Within a texel, uniform in angle and in cosine, that is in solid angle. */
lsf_float3 lsf_sky_sample(const lsf_sky *sky, const double u[2], float *pdf)
{
    if (!sky->pdf) {
        *pdf = 0.25f / LSF_PI;
        return lsf_sample_sphere((float)u[0], (float)u[1]);
    }
    const lsf_environment *map = sky->environment;
    double x, y;
    lsf_distribution_2d_sample(&sky->cells, u[0], u[1], &x, &y);
    uint32_t column = (uint32_t)(x * map->width), row = (uint32_t)(y * map->height);
    double top = cos(M_PI * row / map->height), bottom = cos(M_PI * (row + 1) / map->height);
    *pdf = sky->pdf[(uint64_t)row * map->width + column];
    return lsf_environment_direction(map, x, top + (y * map->height - row) * (bottom - top));
}

float lsf_sky_density(const lsf_sky *sky, lsf_float3 radiance)
{
    float luminance = lsf_f3_luminance(radiance);
    return sky->whole * luminance + sky->held * fminf(luminance, sky->mean);
}
