#include "scene/mesh_frame.h"

#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static void edge(const float *from, const float *to, double result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = (double)to[i] - (double)from[i];
}

static bool normalize(double v[3])
{
    double length = sqrt(dot(v, v));
    if (!(length > 0.0) || !isfinite(length))
        return false;
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return true;
}

/* A vector perpendicular to a unit vector: its cross product with the axis that it is farthest
 * from. */
static void perpendicular(const double v[3], double result[3])
{
    int axis = fabs(v[0]) <= fabs(v[1]) && fabs(v[0]) <= fabs(v[2]) ? 0
               : fabs(v[1]) <= fabs(v[2])                           ? 1
                                                                    : 2;
    double other[3] = {axis == 0, axis == 1, axis == 2};
    cross(other, v, result);
    normalize(result);
}

void lsf_any_tangent(const float normal[3], float tangent[3])
{
    double n[3] = {normal[0], normal[1], normal[2]}, t[3];
    perpendicular(n, t);
    for (int i = 0; i < 3; i++)
        tangent[i] = (float)t[i];
}

void lsf_triangle_normal(const float *a, const float *b, const float *c, float normal[3])
{
    double ab[3], ac[3], bc[3], n[3];
    edge(a, b, ab);
    edge(a, c, ac);
    edge(b, c, bc);
    cross(ab, ac, n);
    if (!normalize(n)) {
        double *longest = dot(ab, ab) >= dot(ac, ac) ? ab : ac;
        longest = dot(longest, longest) >= dot(bc, bc) ? longest : bc;
        if (normalize(longest)) {
            perpendicular(longest, n);
        } else {
            n[0] = n[1] = 0.0;
            n[2] = 1.0;
        }
    }
    for (int i = 0; i < 3; i++)
        normal[i] = (float)n[i];
}

void lsf_flat_normals(const float *positions, uint64_t triangle_count, float *normals)
{
    for (uint64_t i = 0; i < triangle_count; i++) {
        const float *p = positions + 9 * i;
        float *n = normals + 9 * i;
        lsf_triangle_normal(p, p + 3, p + 6, n);
        memcpy(n + 3, n, 3 * sizeof(float));
        memcpy(n + 6, n, 3 * sizeof(float));
    }
}

bool lsf_make_unit(float vector[3], bool *off)
{
    double v[3] = {vector[0], vector[1], vector[2]};
    double length2 = dot(v, v);
    if (!normalize(v))
        return false;
    *off = fabs(length2 - 1.0) > 0.02;
    for (int i = 0; i < 3; i++)
        vector[i] = (float)v[i];
    return true;
}

static bool is_zero(const float v[3])
{
    return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
}

uint64_t lsf_unit_normals(float *normals, uint64_t count, lsf_frame_repairs *repairs)
{
    uint64_t zeros = 0;
    for (uint64_t i = 0; i < count; i++) {
        bool off = false;
        if (lsf_make_unit(normals + 3 * i, &off))
            repairs->normals_scaled += off;
        else
            zeros++;
    }
    repairs->normals_zero += zeros;
    return zeros;
}

void lsf_unit_tangents(const float *normals, float *tangents, uint64_t count,
                       lsf_frame_repairs *repairs)
{
    for (uint64_t i = 0; i < count; i++) {
        float *tangent = tangents + 4 * i;
        bool off = false;
        if (!lsf_make_unit(tangent, &off)) {
            lsf_any_tangent(normals + 3 * i, tangent);
            off = true;
        }
        repairs->tangents_scaled += off || (tangent[3] != 1.0f && tangent[3] != -1.0f);
        tangent[3] = tangent[3] < 0.0f ? -1.0f : 1.0f;
    }
}

/* Twice the area of the triangle, along its normal. */
static void area_vector(const float *positions, const uint32_t t[3], double result[3])
{
    double ab[3], ac[3];
    edge(positions + 3 * (size_t)t[0], positions + 3 * (size_t)t[1], ab);
    edge(positions + 3 * (size_t)t[0], positions + 3 * (size_t)t[2], ac);
    cross(ab, ac, result);
}

void lsf_replace_zero_normals(const float *positions, uint64_t vertex_count,
                              const uint32_t *indices, uint64_t index_count, float *normals)
{
    double *sums = lsf_alloc(vertex_count, 3 * sizeof(double));
    for (uint64_t i = 0; sums && i + 2 < index_count; i += 3) {
        const uint32_t *t = indices + i;
        double n[3];
        area_vector(positions, t, n);
        for (int corner = 0; corner < 3; corner++)
            for (int c = 0; c < 3; c++)
                sums[3 * (size_t)t[corner] + c] += n[c];
    }
    for (uint64_t i = 0; i < vertex_count; i++) {
        float *normal = normals + 3 * i;
        if (!is_zero(normal))
            continue;
        double n[3] = {0.0, 0.0, 1.0};
        if (sums && normalize(sums + 3 * i))
            memcpy(n, sums + 3 * i, sizeof(n));
        for (int c = 0; c < 3; c++)
            normal[c] = (float)n[c];
    }
    free(sums);
}

bool lsf_turn_normals(const float *positions, uint64_t vertex_count, const uint32_t *indices,
                      uint64_t index_count, float *normals, float *tangents,
                      lsf_frame_repairs *repairs)
{
    enum { AGREES = 1, OPPOSES = 2 };
    uint8_t *found = lsf_alloc(vertex_count, 1);
    for (uint64_t i = 0; found && i + 2 < index_count; i += 3) {
        const uint32_t *t = indices + i;
        double n[3];
        area_vector(positions, t, n);
        if (!normalize(n))
            continue;
        for (int corner = 0; corner < 3; corner++) {
            const float *of = normals + 3 * (size_t)t[corner];
            double normal[3] = {of[0], of[1], of[2]};
            found[t[corner]] |= dot(n, normal) < -0.5 ? OPPOSES : AGREES;
        }
    }
    for (uint64_t i = 0; found && i < vertex_count; i++) {
        if (found[i] != OPPOSES)
            continue;
        for (int c = 0; c < 3; c++)
            normals[3 * i + c] = -normals[3 * i + c];
        if (tangents)
            tangents[4 * i + 3] = -tangents[4 * i + 3];
        repairs->normals_turned++;
    }
    bool enough = found != NULL;
    free(found);
    return enough;
}

/* --- tangents --- */

/* Twice the signed area of the triangle in texture space, v pointing down: negative when the
 * texture is seen unmirrored from the front. */
static double uv_area(const float *uvs, const uint32_t t[3])
{
    const float *a = uvs + 2 * (size_t)t[0], *b = uvs + 2 * (size_t)t[1],
                *c = uvs + 2 * (size_t)t[2];
    double u1 = (double)b[0] - a[0], v1 = (double)b[1] - a[1];
    double u2 = (double)c[0] - a[0], v2 = (double)c[1] - a[1];
    return u1 * v2 - u2 * v1;
}

bool lsf_split_mirrored(const float *uvs, uint64_t vertex_count, uint32_t *indices,
                        uint64_t index_count, uint32_t **copied, uint64_t *copied_count)
{
    enum { PLAIN = 1, MIRRORED = 2 };
    *copied = NULL;
    *copied_count = 0;
    uint64_t capacity = 0;
    uint8_t *uses = lsf_alloc(vertex_count, 1);
    uint32_t *twins = lsf_alloc(vertex_count, sizeof(uint32_t)); /* 0: none yet, else index + 1 */
    bool good = uses && twins;
    for (uint64_t i = 0; good && i + 2 < index_count; i += 3) {
        double area = uv_area(uvs, indices + i);
        for (int corner = 0; corner < 3 && area != 0.0; corner++)
            uses[indices[i + corner]] |= area > 0.0 ? MIRRORED : PLAIN;
    }
    for (uint64_t i = 0; good && i + 2 < index_count; i += 3) {
        if (!(uv_area(uvs, indices + i) > 0.0))
            continue;
        for (int corner = 0; good && corner < 3; corner++) {
            uint32_t vertex = indices[i + corner];
            if (uses[vertex] != (PLAIN | MIRRORED))
                continue;
            if (!twins[vertex]) {
                void *list = *copied;
                good = vertex_count + *copied_count < UINT32_MAX - 1 &&
                       lsf_grow(&list, &capacity, *copied_count + 1, sizeof(uint32_t));
                *copied = list;
                if (!good)
                    break;
                (*copied)[*copied_count] = vertex;
                twins[vertex] = (uint32_t)*copied_count + 1;
                ++*copied_count;
            }
            /* Written last: uv_area of this triangle is read above. */
            indices[i + corner] = (uint32_t)(vertex_count + twins[vertex] - 1);
        }
    }
    free(uses);
    free(twins);
    return good;
}

/* Component of `v` in the plane perpendicular to the unit normal, made unit. */
static bool project(const double v[3], const double normal[3], double result[3])
{
    double along = dot(v, normal);
    for (int i = 0; i < 3; i++)
        result[i] = v[i] - along * normal[i];
    return normalize(result);
}

/* The direction of growing u, with the sign of the triangle's own orientation. */
static void u_direction(const float *positions, const float *uvs, const uint32_t t[3], double area,
                        double result[3])
{
    double e1[3], e2[3];
    edge(positions + 3 * (size_t)t[0], positions + 3 * (size_t)t[1], e1);
    edge(positions + 3 * (size_t)t[0], positions + 3 * (size_t)t[2], e2);
    double v0 = uvs[2 * (size_t)t[0] + 1];
    double v1 = uvs[2 * (size_t)t[1] + 1] - v0, v2 = uvs[2 * (size_t)t[2] + 1] - v0;
    for (int i = 0; i < 3; i++)
        result[i] = (area > 0.0 ? 1.0 : -1.0) * (v2 * e1[i] - v1 * e2[i]);
}

/* Angle of the triangle at a corner, measured in the tangent plane there. */
static double corner_angle(const float *positions, const uint32_t t[3], int corner,
                           const double normal[3])
{
    const float *p = positions + 3 * (size_t)t[corner];
    double a[3], b[3], pa[3], pb[3];
    edge(p, positions + 3 * (size_t)t[(corner + 1) % 3], a);
    edge(p, positions + 3 * (size_t)t[(corner + 2) % 3], b);
    if (!project(a, normal, pa) || !project(b, normal, pb))
        return 0.0;
    return acos(fmax(-1.0, fmin(1.0, dot(pa, pb))));
}

void lsf_make_tangents(const float *positions, const float *normals, const float *uvs,
                       uint64_t vertex_count, const uint32_t *indices, uint64_t index_count,
                       float *tangents)
{
    double *sums = lsf_alloc(vertex_count, 3 * sizeof(double));
    for (uint64_t i = 0; i < vertex_count; i++)
        tangents[4 * i + 3] = 1.0f;
    for (uint64_t i = 0; sums && uvs && i + 2 < index_count; i += 3) {
        const uint32_t *t = indices + i;
        double area = uv_area(uvs, t), direction[3];
        if (area == 0.0)
            continue;
        u_direction(positions, uvs, t, area, direction);
        for (int corner = 0; corner < 3; corner++) {
            const float *n = normals + 3 * (size_t)t[corner];
            double normal[3] = {n[0], n[1], n[2]}, projected[3];
            tangents[4 * (size_t)t[corner] + 3] = area < 0.0 ? 1.0f : -1.0f;
            if (!project(direction, normal, projected))
                continue;
            double angle = corner_angle(positions, t, corner, normal);
            for (int c = 0; c < 3; c++)
                sums[3 * (size_t)t[corner] + c] += angle * projected[c];
        }
    }
    for (uint64_t i = 0; i < vertex_count; i++) {
        const float *n = normals + 3 * i;
        double normal[3] = {n[0], n[1], n[2]}, tangent[3];
        if (!sums || !project(sums + 3 * i, normal, tangent))
            perpendicular(normal, tangent);
        for (int c = 0; c < 3; c++)
            tangents[4 * i + c] = (float)tangent[c];
    }
    free(sums);
}
