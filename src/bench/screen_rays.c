#include "bench/screen_rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"

/* Pixels along a side of a tile: packets of rays stay close together. */
#define TILE 8u

/* As unpackSnorm2x16 and octahedral_decode of lib/octahedral.glsl. */
static lsf_float3 decode_octahedral(uint32_t bits)
{
    float x = fmaxf((float)(int16_t)(bits & 0xffffu) / 32767.0f, -1.0f);
    float y = fmaxf((float)(int16_t)(bits >> 16) / 32767.0f, -1.0f);
    float z = 1.0f - fabsf(x) - fabsf(y);
    if (z >= 0.0f)
        return lsf_f3_normalize(lsf_f3(x, y, z));
    return lsf_f3_normalize(
        lsf_f3(copysignf(1.0f - fabsf(y), x), copysignf(1.0f - fabsf(x), y), z));
}

static lsf_float3 affine(lsf_vec4 start, lsf_vec4 dx, lsf_vec4 dy, float x, float y)
{
    return lsf_f3(start.x + x * dx.x + y * dy.x, start.y + x * dx.y + y * dy.y,
                  start.z + x * dx.z + y * dy.z);
}

/* position_from_depth(sample_ndc(pixel), depth) of lib/view.glsl. */
static lsf_float3 position_at(const struct lsf_view_data *view, bool orthographic, uint32_t x,
                              uint32_t y, float depth)
{
    float u = ((float)x + 0.5f) * (2.0f * view->size.z) - 1.0f + view->jitter.x;
    float v = ((float)y + 0.5f) * (2.0f * view->size.w) - 1.0f + view->jitter.y;
    float distance = orthographic
                         ? (depth - view->depth.y) / view->depth.x
                         : (view->depth.y - depth * view->depth.w) / (depth - view->depth.x);
    return lsf_f3_mad(affine(view->start, view->start_dx, view->start_dy, u, v),
                      affine(view->forward, view->forward_dx, view->forward_dy, u, v), distance);
}

static void add_tile(lsf_screen_rays *rays, const lsf_iteration *iteration, const float *depths,
                     const uint32_t *surfaces, uint32_t x0, uint32_t y0)
{
    const lsf_plan *plan = iteration->plan;
    for (uint32_t y = y0; y < y0 + TILE && y < plan->height; y++)
        for (uint32_t x = x0; x < x0 + TILE && x < plan->width; x++) {
            uint32_t pixel = y * plan->width + x;
            if (depths[pixel] == 0.0f)
                continue;
            lsf_screen_point *point = &rays->points[rays->count++];
            point->pixel = pixel;
            lsf_f3_store(point->position,
                         position_at(&iteration->view, plan->orthographic, x, y, depths[pixel]));
            lsf_f3_store(point->normal, decode_octahedral(surfaces[4 * (size_t)pixel]));
        }
}

bool lsf_screen_rays_init(lsf_screen_rays *rays, const lsf_iteration *iteration, GLuint depth,
                          GLuint surface, lsf_error *error)
{
    const lsf_plan *plan = iteration->plan;
    uint64_t pixels = (uint64_t)plan->width * plan->height;
    *rays = (lsf_screen_rays){0};
    if (pixels > INT32_MAX / 16)
        return lsf_error_set(error, LSF_ERROR_USAGE, "resolution %u,%u: too large to read back",
                             plan->width, plan->height);
    float *depths = lsf_alloc(pixels, sizeof *depths);
    uint32_t *surfaces = lsf_alloc(pixels, 4 * sizeof *surfaces);
    rays->points = lsf_alloc(pixels, sizeof *rays->points);
    rays->rays = lsf_alloc(pixels, sizeof *rays->rays);
    rays->pixels = lsf_alloc(pixels, sizeof *rays->pixels);
    bool good = depths && surfaces && rays->points && rays->rays && rays->pixels;
    if (good) {
        glGetTextureImage(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, (GLsizei)(pixels * 4), depths);
        glGetTextureImage(surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, (GLsizei)(pixels * 16),
                          surfaces);
        for (uint32_t y = 0; y < plan->height; y += TILE)
            for (uint32_t x = 0; x < plan->width; x += TILE)
                add_tile(rays, iteration, depths, surfaces, x, y);
    } else {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the rays of %ux%u pixels",
                      plan->width, plan->height);
    }
    free(depths);
    free(surfaces);
    return good;
}

void lsf_screen_rays_aim(lsf_screen_rays *rays, const float direction[3])
{
    lsf_float3 along = lsf_f3_load(direction);
    uint64_t count = 0;
    for (int side = 0; side < 2; side++)
        for (uint64_t i = 0; i < rays->count; i++) {
            const lsf_screen_point *point = &rays->points[i];
            bool front = lsf_f3_dot(lsf_f3_load(point->normal), along) > 0.0f;
            if (front != (side == 0))
                continue;
            lsf_reference_ray *ray = &rays->rays[count];
            rays->pixels[count++] = point->pixel;
            memcpy(ray->origin, point->position, sizeof ray->origin);
            lsf_f3_store(ray->direction, lsf_f3_scale(along, front ? 1.0f : -1.0f));
        }
}

void lsf_screen_rays_finish(lsf_screen_rays *rays)
{
    free(rays->points);
    free(rays->rays);
    free(rays->pixels);
    *rays = (lsf_screen_rays){0};
}
