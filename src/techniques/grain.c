#include "techniques/grain.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"

/* Number of rows of pixels that are read, each of them whole. */
#define MAX_ROWS 64

static int ascending(const void *a, const void *b)
{
    float left = *(const float *)a, right = *(const float *)b;
    return (left > right) - (left < right);
}

/* Depth from the view's start; see lsf_view_data. */
static float view_depth(const lsf_iteration *iteration, float depth)
{
    const struct lsf_view_data *v = &iteration->view;
    if (iteration->plan->orthographic)
        return (depth - v->depth.y) / v->depth.x;
    return (v->depth.y - depth * v->depth.w) / (depth - v->depth.x);
}

/* The median view depth of the points on some of the picture's rows; NAN: nothing is visible, or
 * no memory is left. */
static float median_depth(const lsf_iteration *iteration, GLuint texture)
{
    uint32_t width = iteration->plan->seen_width, height = iteration->plan->seen_height;
    uint32_t rows = height < MAX_ROWS ? height : MAX_ROWS;
    uint64_t count = 0;
    float median = NAN, *depths = lsf_alloc((uint64_t)rows * width, sizeof *depths);
    for (uint32_t row = 0; depths && row < rows; row++) {
        float *first = depths + count;
        glGetTextureSubImage(texture, 0, 0, (GLint)((2 * (uint64_t)row + 1) * height / (2 * rows)),
                             0, (GLsizei)width, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                             (GLsizei)(width * sizeof *depths), first);
        for (uint32_t x = 0; x < width; x++)
            if (first[x] != 0.0f)
                depths[count++] = view_depth(iteration, first[x]);
    }
    if (count > 0) {
        qsort(depths, count, sizeof *depths, ascending);
        median = depths[count / 2];
    }
    free(depths);
    return median;
}

static float length_at(lsf_vec4 start, lsf_vec4 forward, float depth)
{
    return lsf_f3_length(lsf_f3_mad(lsf_f3_load(&start.x), lsf_f3_load(&forward.x), depth));
}

void lsf_grain_check(const lsf_iteration *iteration, GLuint depth)
{
    const lsf_plan *plan = iteration->plan;
    const struct lsf_view_data *v = &iteration->view;
    if (!(plan->grain.width > 0.0f) || depth == 0)
        return;
    float at = median_depth(iteration, depth);
    float seen = 2.0f * fminf(length_at(v->start_dx, v->forward_dx, at),
                              length_at(v->start_dy, v->forward_dy, at));
    if (!(seen < LSF_GRAIN_CELLS * plan->grain.width))
        return;
    double scale = (double)v->depth.z;
    lsf_log(LSF_LOG_WARNING,
            "%s is %.3g wide, for one %s holds the whole scene, and the picture shows %.3g at the "
            "depth of half of what it sees: light that bounces may be off by 5 %% and more; raise "
            "%s, or leave out what lies far away%s",
            plan->grain.cell, (double)plan->grain.width * scale, plan->grain.of,
            (double)seen * scale, plan->grain.option, plan->grain.instead);
}
