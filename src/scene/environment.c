#include "scene/environment.h"

#include <math.h>

static lsf_float3 texel(const lsf_environment *map, int64_t x, int64_t y)
{
    x = (x + map->width) % map->width;
    y = y < 0 ? 0 : y >= map->height ? map->height - 1 : y;
    return lsf_f3_load(map->texels + 3 * ((uint64_t)y * map->width + (uint64_t)x));
}

void lsf_environment_rotate(lsf_environment *environment, float rotation)
{
    double rotations = (double)rotation / 360.0;
    environment->rotation = rotation;
    environment->u_offset = (float)(rotations - floor(rotations));
}

/* The angle from the zenith comes from atan2: acos would lose half of its digits there. */
void lsf_environment_uv(const lsf_environment *environment, lsf_float3 direction, double *u,
                        double *v)
{
    double x = (double)direction.x, y = (double)direction.y, z = (double)direction.z;
    *u = 0.5 + atan2(z, x) / (2.0 * M_PI) + (double)environment->u_offset;
    *u -= floor(*u);
    *v = atan2(hypot(x, z), y) / M_PI;
}

lsf_float3 lsf_environment_direction(const lsf_environment *environment, double u,
                                     double zenith_cosine)
{
    double angle = 2.0 * M_PI * (u - 0.5 - (double)environment->u_offset);
    double sine = sqrt(fmax(1.0 - zenith_cosine * zenith_cosine, 0.0));
    return lsf_f3_normalize(
        lsf_f3((float)(sine * cos(angle)), (float)zenith_cosine, (float)(sine * sin(angle))));
}

lsf_float3 lsf_environment_radiance(const lsf_environment *environment, lsf_float3 direction)
{
    const lsf_environment *map = environment;
    if (!map->present)
        return lsf_f3(0.0f, 0.0f, 0.0f);
    if (map->width == 0)
        return lsf_f3_load(map->radiance);
    double u, v;
    lsf_environment_uv(map, direction, &u, &v);
    double x = u * map->width - 0.5, y = v * map->height - 0.5;
    int64_t left = (int64_t)floor(x), top = (int64_t)floor(y);
    float tx = (float)(x - (double)left), ty = (float)(y - (double)top);
    lsf_float3 upper =
        lsf_f3_mad(lsf_f3_scale(texel(map, left, top), 1.0f - tx), texel(map, left + 1, top), tx);
    lsf_float3 lower = lsf_f3_mad(lsf_f3_scale(texel(map, left, top + 1), 1.0f - tx),
                                  texel(map, left + 1, top + 1), tx);
    return lsf_f3_mad(lsf_f3_scale(upper, 1.0f - ty), lower, ty);
}

/* Weights of the mean along each axis: 3/4 for the texel, 1/8 for each neighbour. */
float lsf_environment_texel_luminance(const lsf_environment *environment, uint32_t x, uint32_t y)
{
    static const float weights[3] = {0.125f, 0.75f, 0.125f};
    float sum = 0.0f;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++)
            sum += weights[j + 1] * weights[i + 1] *
                   lsf_f3_luminance(texel(environment, (int64_t)x + i, (int64_t)y + j));
    return sum;
}

double lsf_environment_cell_solid_angle(uint32_t width, uint32_t height, uint32_t row)
{
    return 2.0 * M_PI / width * (cos(M_PI * row / height) - cos(M_PI * (row + 1) / height));
}
