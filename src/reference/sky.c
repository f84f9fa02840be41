#include "reference/sky.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/environment.h"

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
            weights[(uint64_t)y * width + x] = solid_angle * lsf_environment_texel_luminance(environment, x, y);
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
    *direction = lsf_environment_direction(sky->environment, x, cos(M_PI * y));
    return solid_angle_pdf(pdf, sin(M_PI * y));
}

float lsf_reference_sky_pdf(const lsf_reference_sky *sky, lsf_float3 direction)
{
    double u, v;
    lsf_environment_place(sky->environment, direction, &u, &v);
    return solid_angle_pdf(lsf_distribution_2d_pdf(&sky->texels, u, v),
                           hypot(direction.x, direction.z));
}
