#include "techniques/defaults.h"

#include <math.h>

#include "base/base.h"

/* Iterations up to which patterns of 4 and of 3 pixels a side pay in any picture, and one of any
 * size; beyond, the picture without converges faster. In pictures of so many pixels the maps of 16
 * samples take less than the pixels do. src/passes/light_filter.md has the measurements. */
enum { PATTERN_4 = 4, PATTERN_3 = 8, PATTERN_ANY = 128, PATTERN_4_PIXELS = 1 << 17 };

bool lsf_stands_in_the_open(const lsf_setup *setup)
{
    const lsf_requirements *r = &setup->scene->requirements;
    const lsf_state *state = &setup->state;
    bool outside = false;
    for (int axis = 0; axis < 3; axis++)
        outside = outside || state->camera.start[axis] < state->reach_min[axis] ||
                  state->camera.start[axis] > state->reach_max[axis];
    return r->environment && state->light_count == 0 && outside;
}

/* Up to this many triangles, as in Cornell boxes, maps for all samples of a pattern cost little. */
enum { FEW_TRIANGLES = 1024 };

/* Whether all pixels should take the same samples. In the open little light bounces, directions of
 * the environment find the rest, a filter would only blur it, and each sample of a pattern draws
 * all triangles. */
bool lsf_shares_samples(const lsf_setup *setup)
{
    return lsf_stands_in_the_open(setup) && setup->scene->requirements.triangles > FEW_TRIANGLES;
}

/* The default of interleave.size: the fewer iterations, the more samples in each. */
static int32_t choose_interleave(const lsf_setup *setup)
{
    const lsf_render_params *params = &setup->params;
    bool limited = isfinite(params->time_limit);
    if (params->raw || (params->samples > PATTERN_ANY && !limited) || lsf_shares_samples(setup))
        return 1;
    bool large = (uint64_t)params->width * params->height >= PATTERN_4_PIXELS && !limited;
    if (params->samples <= PATTERN_4 || large)
        return 4;
    return params->samples <= PATTERN_3 ? 3 : 2;
}

/* Pixels of which a first iteration fits into the time limit. On a GPU all of them do. */
static double pixels_in_time(const lsf_setup *setup)
{
    if (!setup->software)
        return INFINITY;
    const lsf_technique *technique = lsf_technique_find(setup->params.technique);
    double points = technique ? (double)technique->points_per_second : 0.0;
    return (points > 0.0 ? points : 0x1p18) * setup->params.time_limit;
}

bool lsf_hurries(const lsf_setup *setup)
{
    const lsf_render_params *params = &setup->params;
    return !params->raw && (double)params->width * params->height > pixels_in_time(setup);
}

/* The finer the grid, the smaller its bias, the fewer iterations fit into the time, and the more
 * noise they leave. The best of measured grids grows with the time to this power (docs/voxels.md
 * has the measurements). */
uint32_t lsf_default_voxels(const lsf_setup *setup)
{
    enum { STEP = 16, FEWEST = 32 };
    const lsf_render_params *params = &setup->params;
    const lsf_technique *technique = lsf_technique_find(params->technique);
    bool limited = setup->software && isfinite(params->time_limit) && !params->raw;
    if (!limited || !technique || technique->voxels_in_a_second == 0)
        return LSF_VOXEL_RESOLUTION;
    double wanted = technique->voxels_in_a_second * pow(params->time_limit, 0.4);
    return STEP * (uint32_t)round(fmin(fmax(wanted, FEWEST), LSF_VOXEL_RESOLUTION) / STEP);
}

/* Texels along the side of a map: `side` up to so many iterations. A map's bias shrinks with its
 * texels, and no iteration takes it away. The more of them take the noise away, the narrower the
 * texels: as the fourth root of their number, for which drawing a map takes up to its square root
 * more time. A time limit is assumed to leave room for two iterations a second, as many as software
 * OpenGL does of a small picture. */
static int32_t map_side(const lsf_setup *setup, int side, int iterations, int most)
{
    enum { STEP = 16, ITERATIONS_A_SECOND = 2 };
    const lsf_render_params *params = &setup->params;
    double expected = params->samples == UINT32_MAX ? 0.0 : (double)params->samples;
    if (isfinite(params->time_limit))
        expected = fmin(params->samples, ITERATIONS_A_SECOND * params->time_limit);
    double wanted = side * pow(fmax(expected / iterations, 1.0), 0.25);
    return STEP * (int32_t)round(fmin(wanted, most) / STEP);
}

void lsf_default_maps(lsf_setup *setup)
{
    lsf_pass_params *params = &setup->pass_params;
    if (params->ray_bundle.resolution == 0)
        params->ray_bundle.resolution = map_side(setup, 256, 32, 768);
    params->reflective_shadow_map.cube_resolution =
        map_side(setup, 64, 16, LSF_REFLECTIVE_SHADOW_MAP_RESOLUTION);
}

/* The default of sparse.grid: as fine as the first iteration fits into a time limit. */
static int32_t choose_grid(const lsf_setup *setup)
{
    const lsf_technique *technique = lsf_technique_find(setup->params.technique);
    double points = (double)setup->params.width * setup->params.height;
    bool sparse = technique && technique->points_per_second > 0.0f && lsf_hurries(setup);
    int32_t logarithm = 0;
    for (; sparse && logarithm < 4 && points > pixels_in_time(setup); logarithm++)
        points /= 4.0;
    return logarithm + 1;
}

void lsf_default_points(lsf_setup *setup)
{
    lsf_pass_params *params = &setup->pass_params;
    if (params->sparse.grid == 0) {
        params->sparse.grid = choose_grid(setup);
        params->sparse.chosen = params->sparse.grid > 1;
    }
    if (setup->asked.sparse.interleave == 0) /* left to each plan */
        params->sparse.interleave = choose_interleave(setup);
}

/* Samples of a point in an iteration without a time limit. */
enum { POINT_SAMPLES = 4 };

/* The same with one. A point of pixels_in_time has one sample; further samples may take half of
 * the time of such points. */
static int32_t samples_in_time(const lsf_setup *setup)
{
    double pixels = (double)setup->params.width * setup->params.height;
    double points = pixels / exp2(2.0 * (setup->pass_params.sparse.grid - 1));
    return (int32_t)fmin(fmax(0.5 * pixels_in_time(setup) / points, 1.0), POINT_SAMPLES);
}

/* Paths through glass cannot be fewer: they choose at each surface where to go on. */
void lsf_default_point_samples(lsf_setup *setup)
{
    int32_t *cloud = &setup->pass_params.light_tree_sample.samples;
    lsf_voxel_path_params *paths = &setup->pass_params.voxel_path;
    if (*cloud == 0)
        *cloud = samples_in_time(setup);
    if (paths->max_samples == 0) {
        int32_t most =
            setup->scene->requirements.transmissive ? POINT_SAMPLES : samples_in_time(setup);
        paths->max_samples = most > paths->min_samples ? most : paths->min_samples;
    }
}

/* Whether each pixel traces light of its own, so that there is no pattern of samples to remove. */
static bool traces_pixels(const lsf_setup *setup)
{
    const lsf_technique *technique = lsf_technique_find(setup->params.technique);
    return technique && technique->traces_pixels;
}

void lsf_default_filter_steps(lsf_setup *setup)
{
    enum { PERIOD_4 = 2, NEIGHBOURS_ACROSS = 16 };
    const lsf_render_params *params = &setup->params;
    int32_t *most = &setup->pass_params.light_filter.steps, grid = setup->pass_params.sparse.grid;
    int32_t steps = traces_pixels(setup) || grid > PERIOD_4 ? grid : PERIOD_4;
    uint32_t side = params->width < params->height ? params->width : params->height;
    while (steps < *most && side >> steps >= NEIGHBOURS_ACROSS)
        steps++;
    if (steps < *most)
        *most = steps;
}

/* Whether one sample point of a pixel can gather what bounces for all of them. */
static bool can_share_pixels(const lsf_setup *setup, const lsf_technique *technique)
{
    const lsf_pass_params *pass_params = &setup->pass_params;
    return technique && !(setup->params.aovs & LSF_AOV_MOTION) && setup->plan->stride == 1 &&
           !pass_params->sparse.outliers && !lsf_blur_wanted(&pass_params->blur);
}

/* Whether two points along a pixel's side pay. After few iterations most of the noise is that of
 * edges and textures, which one point a pixel and iteration shows jagged; and where each pixel
 * traces light, further points cost little. */
static bool points_pay(const lsf_setup *setup, const lsf_technique *technique)
{
    enum { FEW = 2, FEW_TRACED = 8, MOST_PIXELS = 1 << 20 }; /* a pixel takes 0.3 KiB more */
    const lsf_render_params *params = &setup->params;
    bool traced = technique->traces_pixels;
    if (!technique->bounces || (uint64_t)params->width * params->height > MOST_PIXELS)
        return false;
    return isfinite(params->time_limit) ? traced : params->samples <= (traced ? FEW_TRACED : FEW);
}

enum { LONGEST_SIDE = 4 };

/* Sample points of a pixel take the noise off edges and textures. They cost little beside maps that
 * draw twice as many triangles as there are points, and beside light that bounces, which is
 * gathered at one of them. */
uint32_t lsf_default_pixel_side(const lsf_setup *setup, const lsf_technique *technique)
{
    const lsf_plan *plan = setup->plan;
    int32_t wanted = setup->pass_params.gbuffer.side;
    if (!can_share_pixels(setup, technique))
        return 1;
    if (wanted > 0)
        return 1u << (wanted - 1);
    bool moves = setup->params.present && setup->params.temporal; /* frames of a window */
    if (setup->params.raw || moves)
        return 1;
    uint64_t drawn = plan->sky_lights * plan->requirements.triangles;
    uint64_t pixels = (uint64_t)plan->width * plan->height;
    uint32_t side = points_pay(setup, technique) ? 2 : 1;
    while (side < LONGEST_SIDE && 8 * side * side * pixels <= drawn)
        side *= 2;
    return side;
}
