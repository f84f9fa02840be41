#include "techniques/bundle_directions.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/brdf.h"

#define PURPOSE_DIRECTION 0x30000

enum { CELLS_X = LSF_BUNDLE_CELLS_X, CELLS_Y = LSF_BUNDLE_CELLS_Y, CELLS = CELLS_X * CELLS_Y };

void lsf_bundle_directions_plan(lsf_plan *plan)
{
    if (plan->requirements.environment_map)
        lsf_plan_texture_add(plan, "bundle.pdf", GL_R32F, CELLS_X, CELLS_Y,
                             "bundles are drawn by the environment's light");
    else
        lsf_plan_omit(plan, "bundle.pdf", "no environment map: bundles are drawn uniformly");
}

static double cosine_of_edge(int row)
{
    return cos(M_PI * row / CELLS_Y);
}

static double solid_angle(int row)
{
    return 2.0 * M_PI / CELLS_X * (cosine_of_edge(row) - cosine_of_edge(row + 1));
}

/* Luminance of the map in each cell, averaged over points at least as close as its texels. */
static void average_cells(const lsf_environment *map, float *luminance)
{
    uint32_t nx = (map->width + CELLS_X - 1) / CELLS_X, ny = (map->height + CELLS_Y - 1) / CELLS_Y;
    for (uint32_t cell = 0; cell < CELLS; cell++) {
        double sum = 0.0;
        for (uint32_t j = 0; j < ny; j++)
            for (uint32_t i = 0; i < nx; i++) {
                double u = (cell % CELLS_X + (i + 0.5) / nx) / CELLS_X;
                double v = (cell / CELLS_X + (j + 0.5) / ny) / CELLS_Y;
                uint64_t x = (uint64_t)(u * map->width), y = (uint64_t)(v * map->height);
                const float *texel = map->texels + 3 * (y * map->width + x);
                sum += (double)lsf_f3_luminance(lsf_f3_load(texel));
            }
        luminance[cell] = (float)(sum / (nx * ny));
    }
}

/* The opposite of a cell. */
static uint32_t antipode(uint32_t cell)
{
    uint32_t x = cell % CELLS_X, y = cell / CELLS_X;
    return (CELLS_Y - 1 - y) * CELLS_X + (x + CELLS_X / 2) % CELLS_X;
}

bool lsf_bundle_directions_init(lsf_bundle_directions *directions,
                                const lsf_environment *environment, float environment_offset,
                                lsf_error *error)
{
    *directions = (lsf_bundle_directions){0};
    if (!environment->present || environment->width == 0)
        return true;
    float *light = lsf_alloc(CELLS, sizeof *light), *weights = lsf_alloc(CELLS, sizeof *weights);
    directions->pdf = lsf_alloc(CELLS, sizeof *directions->pdf);
    bool good = light && weights && directions->pdf;
    if (good) {
        double mean = 0.0, integral = 0.0;
        average_cells(environment, light);
        for (uint32_t i = 0; i < CELLS; i++)
            mean += (double)light[i] * solid_angle((int)(i / CELLS_X)) / (4.0 * M_PI);
        /* A black map leaves a uniform density. */
        double offset = mean > 0.0 ? (double)environment_offset * mean : 1.0;
        for (uint32_t i = 0; i < CELLS; i++) {
            double of_cell = ((double)light[i] + offset) * solid_angle((int)(i / CELLS_X));
            weights[i] = (float)(of_cell / offset); /* bright maps keep in range */
            integral += of_cell;
        }
        for (uint32_t i = 0; i < CELLS; i++)
            directions->pdf[i] =
                (float)(((double)light[i] + (double)light[antipode(i)] + 2.0 * offset) / integral);
        good = lsf_distribution_2d_init(&directions->cells, weights, CELLS_X, CELLS_Y);
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
static lsf_float3 direction_at(double x, double y)
{
    int row = (int)(y * CELLS_Y);
    double top = cosine_of_edge(row), bottom = cosine_of_edge(row + 1);
    double cosine = top + (y * CELLS_Y - row) * (bottom - top);
    double angle = 2.0 * M_PI * (x - 0.5), sine = sqrt(fmax(1.0 - cosine * cosine, 0.0));
    return lsf_f3_normalize(
        lsf_f3((float)(sine * cos(angle)), (float)cosine, (float)(sine * sin(angle))));
}

static uint32_t cell_of(lsf_float3 d)
{
    double u = 0.5 + atan2((double)d.z, (double)d.x) / (2.0 * M_PI);
    double v = atan2(hypot((double)d.x, (double)d.z), (double)d.y) / M_PI;
    int x = (int)(u * CELLS_X), y = (int)(v * CELLS_Y);
    x = x < 0 ? 0 : x >= CELLS_X ? CELLS_X - 1 : x;
    y = y < 0 ? 0 : y >= CELLS_Y ? CELLS_Y - 1 : y;
    return (uint32_t)(y * CELLS_X + x);
}

float lsf_bundle_directions_pdf(const lsf_bundle_directions *directions, lsf_float3 direction)
{
    return directions->pdf ? directions->pdf[cell_of(direction)] : 0.5f / LSF_PI;
}

void lsf_bundle_directions_draw(const lsf_bundle_directions *directions,
                                const lsf_iteration *iteration, uint32_t count, bool independent,
                                lsf_ray_bundle_direction *drawn)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits[2];
        uint32_t index = independent ? iteration->index : iteration->index * count + i;
        uint32_t purpose = PURPOSE_DIRECTION + (independent ? i : 0);
        lsf_iteration_sample(iteration, index, purpose, bits);
        lsf_float3 direction;
        drawn[i].pdf = 0.5f / LSF_PI;
        if (directions->pdf) {
            double x, y;
            lsf_distribution_2d_sample(&directions->cells, lsf_unit_double(bits[0]),
                                       lsf_unit_double(bits[1]), &x, &y);
            direction = direction_at(x, y);
            drawn[i].pdf = lsf_bundle_directions_pdf(directions, direction);
        } else {
            direction = lsf_sample_sphere(lsf_unit_float(bits[0]), lsf_unit_float(bits[1]));
        }
        lsf_f3_store(drawn[i].direction, direction);
    }
}
