#include "scene/default_lamp.h"

#include <math.h>

#include "math/sampling.h"

#define DARK_SHARE_MAX 0.25f

/* Directions in which each point looks for the sky: LSF_OPEN_SKY_MIN is between 2 and 3 of them. */
#define DIRECTIONS 64

/* Places tried for the lamp, along each axis, and points, about, that are asked whether they see
 * one. */
#define PLACES 16
#define ASKED 128

/* Points that see too little of the sky. */
typedef struct dark_points {
    const lsf_occupancy *occupancy;
    uint32_t count;
    lsf_seen_point points[LSF_SEEN_SIDE * LSF_SEEN_SIDE];
} dark_points;

static bool is_dark(const lsf_occupancy *occupancy, const lsf_seen_point *point, uint32_t seed)
{
    lsf_basis basis = lsf_basis_about(point->normal);
    uint32_t open = 0;
    for (uint32_t i = 0; i < DIRECTIONS; i++) {
        float u[2];
        lsf_sobol_2d(i, seed, u);
        lsf_float3 to = lsf_basis_to_world(&basis, lsf_sample_cosine_hemisphere(u[0], u[1]));
        open += !lsf_occupancy_blocks(occupancy, point->position, to, INFINITY);
    }
    return (float)open < LSF_OPEN_SKY_MIN * DIRECTIONS;
}

/* What is shown without light is never dark. */
static void find_dark(dark_points *dark, const lsf_state *state, const lsf_seen *seen)
{
    dark->occupancy = &seen->occupancy;
    dark->count = 0;
    for (uint32_t i = 0; i < seen->count; i++) {
        const lsf_seen_point *point = &seen->points[i];
        if (!state->animated.materials[point->material].unlit &&
            is_dark(&seen->occupancy, point, i))
            dark->points[dark->count++] = *point;
    }
}

/* The cosine at the point towards `place`, 0 where something is in between. */
static float cosine_seen(const lsf_occupancy *occupancy, const lsf_seen_point *point,
                         lsf_float3 place, float *distance)
{
    lsf_float3 to = lsf_f3_sub(place, point->position);
    *distance = lsf_f3_length(to);
    to = lsf_f3_scale(to, 1.0f / *distance);
    float cosine = lsf_f3_dot(to, point->normal);
    if (!(cosine > 0.0f) || lsf_occupancy_blocks(occupancy, point->position, to, *distance))
        return 0.0f;
    return cosine;
}

/* Whether no surface lies within two cells along any axis: a lamp beside one lights little else. */
static bool is_free(const lsf_occupancy *occupancy, lsf_float3 place)
{
    for (int axis = 0; axis < 3; axis++) {
        lsf_float3 along = lsf_f3(axis == 0, axis == 1, axis == 2);
        /* The first and last one and a half cells do not count. */
        lsf_float3 from = lsf_f3_mad(place, along, -3.5f * occupancy->cell);
        if (lsf_occupancy_blocks(occupancy, from, along, 7.0f * occupancy->cell))
            return false;
    }
    return true;
}

/* The place whose light meets the points most squarely, near or far: a lamp is to light all of
 * them, not one of them much. False if none sees any. */
static bool find_place(const dark_points *dark, lsf_float3 *best)
{
    const lsf_occupancy *occupancy = dark->occupancy;
    float most = 0.0f, size = occupancy->cell * LSF_OCCUPANCY_CELLS / PLACES;
    for (uint32_t i = 0; i < PLACES * PLACES * PLACES; i++) {
        lsf_float3 cell = lsf_f3((float)(i % PLACES) + 0.5f, (float)(i / PLACES % PLACES) + 0.5f,
                                 (float)(i / PLACES / PLACES) + 0.5f);
        lsf_float3 place = lsf_f3_mad(occupancy->origin, cell, size);
        if (!is_free(occupancy, place))
            continue;
        float sum = 0.0f, distance;
        for (uint32_t p = 0; p < dark->count; p += 1 + dark->count / ASKED)
            sum += cosine_seen(occupancy, &dark->points[p], place, &distance);
        if (sum > most) {
            most = sum;
            *best = place;
        }
    }
    return most > 0.0f;
}

/* The median of cos / r^2 over the points that see the lamp, normalised units: a point's irradiance
 * by a lamp of intensity 1. */
static float median_response(const dark_points *dark, lsf_float3 lamp)
{
    float responses[LSF_SEEN_SIDE * LSF_SEEN_SIDE], distance;
    uint32_t lit = 0;
    for (uint32_t p = 0; p < dark->count; p++) {
        float cosine = cosine_seen(dark->occupancy, &dark->points[p], lamp, &distance);
        if (cosine > 0.0f)
            responses[lit++] = cosine / (distance * distance);
    }
    return lsf_seen_median(responses, lit);
}

lsf_default_lamp lsf_default_lamp_place(const lsf_state *state, const lsf_seen *seen,
                                        double irradiance)
{
    lsf_default_lamp lamp = {0};
    dark_points dark;
    lsf_float3 place;
    find_dark(&dark, state, seen);
    if (!((float)dark.count > DARK_SHARE_MAX * (float)seen->count) || !find_place(&dark, &place))
        return lamp;
    double unit = state->scale, response = (double)median_response(&dark, place);
    const float at[3] = {place.x, place.y, place.z};
    lamp.present = true;
    lamp.intensity = (float)(irradiance / (response * unit * unit));
    for (int axis = 0; axis < 3; axis++)
        lamp.position[axis] = state->center[axis] + (double)at[axis] / unit;
    return lamp;
}
