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

/* 1/2 over an integral; 0 where that is. */
static float half_over(double integral)
{
    return integral > 0.0 ? (float)(0.5 / integral) : 0.0f;
}

/* A black map is uniform. */
static void fill(lsf_sky *sky)
{
    const lsf_environment *map = sky->environment;
    uint64_t width = map->width;
    double whole = lsf_sky_fluence(map), held = 0.0;
    sky->mean = (float)(whole / (4.0 * M_PI));
    for (uint32_t y = 0; y < map->height; y++) {
        double solid_angle = lsf_environment_cell_solid_angle(map->width, map->height, y);
        for (uint64_t i = y * width; i < (y + 1) * width; i++) {
            sky->weights[i] = lsf_f3_luminance(lsf_f3_load(map->texels + 3 * i));
            held += (double)fminf(sky->weights[i], sky->mean) * solid_angle;
        }
    }
    sky->whole = half_over(whole);
    sky->held = half_over(held);
    for (uint32_t y = 0; y < map->height; y++) {
        float solid_angle = (float)lsf_environment_cell_solid_angle(map->width, map->height, y);
        for (uint64_t i = y * width; i < (y + 1) * width; i++) {
            float density = whole > 0.0 ? sky->whole * sky->weights[i] +
                                              sky->held * fminf(sky->weights[i], sky->mean)
                                        : 0.25f / LSF_PI;
            sky->weights[i] = density * solid_angle;
            sky->sum += (double)sky->weights[i];
        }
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
    uint32_t width = environment->width, height = environment->height;
    sky->weights = lsf_alloc((uint64_t)width * height, sizeof *sky->weights);
    if (sky->weights) {
        fill(sky);
        if (lsf_distribution_2d_init(&sky->texels, sky->weights, width, height))
            return true;
    }
    lsf_sky_finish(sky);
    return false;
}

void lsf_sky_finish(lsf_sky *sky)
{
    lsf_distribution_2d_finish(&sky->texels);
    free(sky->weights);
    *sky = (lsf_sky){0};
}

/* From a uniform number to one whose density is a tent over (-1, 1). */
static double tent(double u)
{
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 * (1.0 - u));
}

/* Interpolation is a sum of tents about the texels' centres: one is drawn, then a place in it. What
 * reaches beyond a pole is turned back, where the map repeats its last row. */
lsf_float3 lsf_sky_sample(const lsf_sky *sky, const double u[2], float *pdf)
{
    if (!sky->weights) {
        *pdf = 0.25f / LSF_PI;
        return lsf_sample_sphere((float)u[0], (float)u[1]);
    }
    const lsf_environment *map = sky->environment;
    double x, y;
    lsf_distribution_2d_sample(&sky->texels, u[0], u[1], &x, &y);
    x *= map->width;
    y *= map->height;
    x = floor(x) + 0.5 + tent(x - floor(x));
    y = fabs(floor(y) + 0.5 + tent(y - floor(y)));
    y = fmin(y, 2.0 * map->height - y);
    lsf_float3 direction =
        lsf_environment_direction(map, x / map->width, cos(M_PI * y / map->height));
    *pdf = lsf_sky_pdf(sky, direction);
    return direction;
}

static double weight_at(const lsf_sky *sky, int64_t x, int64_t y)
{
    int64_t width = sky->environment->width, height = sky->environment->height;
    y = y < 0 ? 0 : y >= height ? height - 1 : y;
    return (double)sky->weights[y * width + (x + width) % width];
}

/* du dv = d omega / (2 pi^2 sin theta) */
float lsf_sky_pdf(const lsf_sky *sky, lsf_float3 direction)
{
    if (!sky->weights)
        return 0.25f / LSF_PI;
    const lsf_environment *map = sky->environment;
    double u, v, texels = (double)map->width * map->height;
    lsf_environment_uv(map, direction, &u, &v);
    double x = u * map->width - 0.5, y = v * map->height - 0.5;
    int64_t left = (int64_t)floor(x), top = (int64_t)floor(y);
    double tx = x - (double)left, ty = y - (double)top;
    double upper = (1.0 - tx) * weight_at(sky, left, top) + tx * weight_at(sky, left + 1, top);
    double lower =
        (1.0 - tx) * weight_at(sky, left, top + 1) + tx * weight_at(sky, left + 1, top + 1);
    /* Nearer to a pole than any row's middle, the last row's weight stands for less. */
    double sine = fmax(hypot((double)direction.x, (double)direction.z), 1e-9);
    return (float)(((1.0 - ty) * upper + ty * lower) * texels /
                   (sky->sum * 2.0 * M_PI * M_PI * sine));
}

float lsf_sky_density(const lsf_sky *sky, lsf_float3 radiance)
{
    float luminance = lsf_f3_luminance(radiance);
    return sky->whole * luminance + sky->held * fminf(luminance, sky->mean);
}
