#include "techniques/bundle_directions.h"
#include "frame/purpose.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "scene/environment.h"
#include "shared/brdf.h"

static uint32_t cells_around(uint32_t map_width)
{
    return map_width + map_width % 2;
}

void lsf_bundle_directions_plan(lsf_plan *plan)
{
    const lsf_plan_resource *map = lsf_plan_find(plan, "scene.environment");
    if (map)
        lsf_plan_texture_add(plan, "bundle.pdf", GL_R32F, cells_around(map->texture.width),
                             map->texture.height, "bundles are drawn by the environment's light");
    else
        lsf_plan_omit(plan, "bundle.pdf", "no environment map: bundles are drawn uniformly");
}

static double cosine_of_edge(const lsf_bundle_directions *d, uint32_t row)
{
    return cos(M_PI * row / d->height);
}

static double solid_angle(const lsf_bundle_directions *d, uint32_t row)
{
    return lsf_environment_cell_solid_angle(d->width, d->height, row);
}

/* Luminance of the map about the middle of a cell, which is turned with the map. */
static float cell_luminance(const lsf_bundle_directions *d, const lsf_environment *map,
                            uint32_t column, uint32_t row)
{
    double u = (column + 0.5) / d->width + (double)map->u_offset;
    u -= floor(u);
    uint32_t x = (uint32_t)(u * map->width);
    return lsf_environment_texel_luminance(map, x < map->width ? x : 0, row);
}

/* The opposite of a cell. */
static uint32_t antipode(const lsf_bundle_directions *d, uint32_t column, uint32_t row)
{
    return (d->height - 1 - row) * d->width + (column + d->width / 2) % d->width;
}

/* Fills the density of each cell, its luminance, and the weight by which it is drawn. */
static void fill(lsf_bundle_directions *directions, const lsf_environment *environment,
                 float environment_offset, float *light, float *weights)
{
    uint32_t width = directions->width, height = directions->height;
    double mean = 0.0, integral = 0.0;
    for (uint32_t y = 0, i = 0; y < height; y++) {
        double share = solid_angle(directions, y) / (4.0 * M_PI);
        for (uint32_t x = 0; x < width; x++, i++) {
            light[i] = cell_luminance(directions, environment, x, y);
            mean += (double)light[i] * share;
        }
    }
    /* A black map leaves a uniform density. */
    double offset = mean > 0.0 ? (double)environment_offset * mean : 1.0;
    for (uint32_t y = 0, i = 0; y < height; y++) {
        double angle = solid_angle(directions, y);
        for (uint32_t x = 0; x < width; x++, i++) {
            double of_cell = ((double)light[i] + offset) * angle;
            weights[i] = (float)(of_cell / offset); /* keeps bright maps in the range of floats */
            integral += of_cell;
        }
    }
    for (uint32_t y = 0, i = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++, i++)
            directions->pdf[i] =
                (float)(((double)light[i] + (double)light[antipode(directions, x, y)] +
                         2.0 * offset) /
                        integral);
}

bool lsf_bundle_directions_init(lsf_bundle_directions *directions,
                                const lsf_environment *environment, float environment_offset,
                                lsf_error *error)
{
    *directions = (lsf_bundle_directions){0};
    if (!environment->present || environment->width == 0)
        return true;
    directions->width = cells_around(environment->width);
    directions->height = environment->height;
    uint32_t width = directions->width, count = width * directions->height;
    float *light = lsf_alloc(count, sizeof *light), *weights = lsf_alloc(count, sizeof *weights);
    directions->pdf = lsf_alloc(count, sizeof *directions->pdf);
    bool good = light && weights && directions->pdf;
    if (good) {
        fill(directions, environment, environment_offset, light, weights);
        good = lsf_distribution_2d_init(&directions->cells, weights, width, directions->height);
    }
    free(light);
    free(weights);
    if (good)
        return true;
    lsf_bundle_directions_finish(directions);
    return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the environment's density");
}

void lsf_bundle_directions_finish(lsf_bundle_directions *directions)
{
    lsf_distribution_2d_finish(&directions->cells);
    free(directions->pdf);
    *directions = (lsf_bundle_directions){0};
}

/* u = 0.5 + atan(z, x) / 2 pi, v = acos(y) / pi, as in lib/environment.glsl; over a cell uniform in
 * angle and cosine, that is in solid angle. */
static lsf_float3 direction_at(const lsf_bundle_directions *d, double x, double y)
{
    uint32_t row = (uint32_t)(y * d->height);
    double top = cosine_of_edge(d, row), bottom = cosine_of_edge(d, row + 1);
    double cosine = top + (y * d->height - row) * (bottom - top);
    double angle = 2.0 * M_PI * (x - 0.5), sine = sqrt(fmax(1.0 - cosine * cosine, 0.0));
    return lsf_f3_normalize(
        lsf_f3((float)(sine * cos(angle)), (float)cosine, (float)(sine * sin(angle))));
}

static uint32_t cell_along(double fraction, uint32_t count)
{
    double i = fraction * count;
    return i <= 0.0 ? 0 : i >= count ? count - 1 : (uint32_t)i;
}

float lsf_bundle_directions_pdf(const lsf_bundle_directions *directions, lsf_float3 d)
{
    if (!directions->pdf)
        return 0.5f / LSF_PI;
    double u = 0.5 + atan2((double)d.z, (double)d.x) / (2.0 * M_PI);
    double v = atan2(hypot((double)d.x, (double)d.z), (double)d.y) / M_PI;
    return directions->pdf[cell_along(v, directions->height) * directions->width +
                           cell_along(u, directions->width)];
}

void lsf_bundle_directions_draw(const lsf_bundle_directions *directions,
                                const lsf_iteration *iteration, uint32_t count, bool independent,
                                lsf_ray_bundle_direction *drawn)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits[2];
        if (independent)
            lsf_iteration_sample(iteration, iteration->index, LSF_PURPOSE_BUNDLE_DIRECTION + i,
                                 bits);
        else
            lsf_iteration_sample_dealt(iteration, i, count, LSF_PURPOSE_BUNDLE_DIRECTION, bits);
        lsf_float3 direction;
        drawn[i].pdf = 0.5f / LSF_PI;
        if (directions->pdf) {
            double x, y;
            lsf_distribution_2d_sample(&directions->cells, lsf_unit_double(bits[0]),
                                       lsf_unit_double(bits[1]), &x, &y);
            direction = direction_at(directions, x, y);
            drawn[i].pdf = lsf_bundle_directions_pdf(directions, direction);
        } else {
            direction = lsf_sample_sphere(lsf_unit_float(bits[0]), lsf_unit_float(bits[1]));
        }
        lsf_f3_store(drawn[i].direction, direction);
    }
}
