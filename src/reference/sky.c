#include "reference/sky.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"

static lsf_float3 texel(const lsf_environment *map, int64_t x, int64_t y)
{
    x = (x + map->width) % map->width;
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    return lsf_f3_load(map->texels + 3 * ((uint64_t)y * map->width + (uint64_t)x));
}

/* The mean of the bilinear radiance's luminance over one texel, exactly: along each axis the
 * texel itself weighs 3/4 and its neighbours 1/8 each. It vanishes only where the radiance does. */
static float mean_luminance(const lsf_environment *map, uint32_t x, uint32_t y)
{
    static const float weights[3] = {0.125f, 0.75f, 0.125f};
    float sum = 0.0f;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++)
            sum += weights[j + 1] * weights[i + 1] *
                   lsf_f3_luminance(texel(map, (int64_t)x + i, (int64_t)y + j));
    return sum;
}

bool lsf_reference_sky_init(lsf_reference_sky *sky, const lsf_environment *environment,
                            lsf_error *error)
{
    memset(sky, 0, sizeof *sky);
    sky->environment = environment;
    if (!environment->present || environment->width == 0)
        return true;
    uint32_t width = environment->width, height = environment->height;
    float *weights = lsf_alloc((uint64_t)width * height, sizeof *weights);
    for (uint32_t y = 0; weights != NULL && y < height; y++) {
        float solid_angle = (float)sin(M_PI * (y + 0.5) / height);
        for (uint32_t x = 0; x < width; x++)
            weights[(uint64_t)y * width + x] = solid_angle * mean_luminance(environment, x, y);
    }
    bool ok = weights != NULL && lsf_distribution_2d_init(&sky->texels, weights, width, height);
    free(weights);
    if (!ok)
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for a %u x %u environment's distribution", width,
                             height);
    sky->sampled = sky->texels.rows.sum > 0.0;
    return true;
}

void lsf_reference_sky_finish(lsf_reference_sky *sky)
{
    lsf_distribution_2d_finish(&sky->texels);
    memset(sky, 0, sizeof *sky);
}

/* Position on the map, 0..1. The angle from the pole comes from atan2, for acos loses half of its
 * digits there. */
static void direction_to_map(lsf_float3 d, double *u, double *v)
{
    *u = 0.5 + atan2(d.z, d.x) / (2.0 * M_PI);
    *v = atan2(hypot(d.x, d.z), d.y) / M_PI;
}

lsf_float3 lsf_reference_sky_radiance(const lsf_reference_sky *sky, lsf_float3 direction)
{
    const lsf_environment *map = sky->environment;
    if (!map->present)
        return lsf_f3(0.0f, 0.0f, 0.0f);
    if (map->width == 0)
        return lsf_f3_load(map->radiance);
    double u, v;
    direction_to_map(direction, &u, &v);
    double x = u * map->width - 0.5, y = v * map->height - 0.5;
    int64_t left = (int64_t)floor(x), top = (int64_t)floor(y);
    float tx = (float)(x - (double)left), ty = (float)(y - (double)top);
    lsf_float3 upper =
        lsf_f3_mad(lsf_f3_scale(texel(map, left, top), 1.0f - tx), texel(map, left + 1, top), tx);
    lsf_float3 lower = lsf_f3_mad(lsf_f3_scale(texel(map, left, top + 1), 1.0f - tx),
                                  texel(map, left + 1, top + 1), tx);
    return lsf_f3_mad(lsf_f3_scale(upper, 1.0f - ty), lower, ty);
}

/* du dv = d omega / (2 pi^2 sin theta) */
static float solid_angle_pdf(double map_pdf, double sin_theta)
{
    return sin_theta > 0.0 ? (float)(map_pdf / (2.0 * M_PI * M_PI * sin_theta)) : 0.0f;
}

float lsf_reference_sky_sample(const lsf_reference_sky *sky, const double u[2],
                               lsf_float3 *direction)
{
    double x, y;
    double pdf = lsf_distribution_2d_sample(&sky->texels, u[0], u[1], &x, &y);
    double theta = M_PI * y, phi = 2.0 * M_PI * (x - 0.5);
    double sin_theta = sin(theta);
    *direction =
        lsf_f3((float)(sin_theta * cos(phi)), (float)cos(theta), (float)(sin_theta * sin(phi)));
    return solid_angle_pdf(pdf, sin_theta);
}

float lsf_reference_sky_pdf(const lsf_reference_sky *sky, lsf_float3 direction)
{
    double u, v;
    direction_to_map(direction, &u, &v);
    return solid_angle_pdf(lsf_distribution_2d_pdf(&sky->texels, u, v),
                           hypot(direction.x, direction.z));
}
