#include "scene/pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "scene/hierarchy.h"

enum { MATRIX = 12 }; /* floats */

uint64_t lsf_pose_value_count(const lsf_scene *scene)
{
    return (uint64_t)scene->joint_count * MATRIX + scene->weight_count;
}

bool lsf_pose_is_same(const lsf_scene *scene, uint32_t deformer, const float *a, const float *b)
{
    const lsf_deformer *d = &scene->deformers[deformer];
    const lsf_node *node = &scene->nodes[d->node];
    size_t weights = (size_t)scene->joint_count * MATRIX + node->first_weight;
    if (memcmp(a + weights, b + weights, node->weight_count * sizeof *a) != 0)
        return false;
    if (d->skin == LSF_NONE)
        return true;
    const lsf_skin *skin = &scene->skins[d->skin];
    size_t first = (size_t)skin->first_joint * MATRIX;
    return memcmp(a + first, b + first, (size_t)skin->joint_count * MATRIX * sizeof *a) == 0;
}

/* --- values --- */

static double determinant(const double *m)
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
           m[8] * (m[1] * m[6] - m[2] * m[5]);
}

static void joint_to_scene(const lsf_joint *joint, const double *worlds, double matrix[16])
{
    double inverse_bind[16];
    for (int i = 0; i < 16; i++)
        inverse_bind[i] = (double)joint->inverse_bind[i];
    lsf_multiply_affine(worlds + (size_t)16 * joint->node, inverse_bind, matrix);
}

/* A frame at the first joint, so that floats lose nothing far from the origin, scaled to about
 * the size of the mesh, and mirrored where the first joint mirrors, so that triangles keep their
 * winding in it. */
static void make_frame(const lsf_scene *scene, const lsf_skin *skin, const double *worlds,
                       double frame[16])
{
    double matrix[16], largest = 0.0;
    for (uint32_t i = skin->joint_count; i-- > 0;) {
        joint_to_scene(&scene->joints[skin->first_joint + i], worlds, matrix);
        for (int k = 0; k < 11; k++)
            largest = k % 4 < 3 ? fmax(largest, fabs(matrix[k])) : largest;
    }
    int exponent = 0;
    if (largest > 0.0 && isfinite(largest))
        frexp(largest, &exponent);
    double scale = ldexp(1.0, exponent);
    const double *origin = worlds + (size_t)16 * scene->joints[skin->first_joint].node + 12;
    memset(frame, 0, 16 * sizeof *frame);
    frame[0] = determinant(matrix) < 0.0 ? -scale : scale;
    frame[5] = frame[10] = scale;
    memcpy(frame + 12, origin, 3 * sizeof *origin);
    frame[15] = 1.0;
}

static void find_values(lsf_pose *pose, const lsf_scene *scene, double time, const double *worlds)
{
    float *value = pose->values;
    for (uint32_t s = 0; s < scene->skin_count; s++) {
        const lsf_skin *skin = &scene->skins[s];
        double *frame = pose->frames[s], matrix[16];
        make_frame(scene, skin, worlds, frame);
        for (uint32_t i = 0; i < skin->joint_count; i++, value += MATRIX) {
            joint_to_scene(&scene->joints[skin->first_joint + i], worlds, matrix);
            for (int row = 0; row < 3; row++)
                for (int column = 0; column < 4; column++) {
                    double at = matrix[4 * column + row] - (column == 3 ? frame[12 + row] : 0.0);
                    value[4 * row + column] = (float)(at / frame[5 * row]);
                }
        }
    }
    lsf_scene_weights(scene, time, pose->weights);
    for (uint32_t i = 0; i < scene->weight_count; i++)
        value[i] = (float)pose->weights[i];
}

/* --- vertices --- */

typedef struct vertex {
    float position[3], normal[3], tangent[3];
} vertex;

static void add_deltas(float value[3], const float *deltas, const lsf_shape *shape,
                       const float *weights, uint32_t at)
{
    for (uint32_t t = 0; deltas && t < shape->target_count; t++) {
        const float *delta = deltas + 3 * ((size_t)t * shape->vertex_count + at);
        for (int c = 0; c < 3 && weights[t] != 0.0f; c++)
            value[c] += weights[t] * delta[c];
    }
}

static void morph(vertex *v, const lsf_shape *shape, const float *weights, uint32_t at)
{
    add_deltas(v->position, shape->position_deltas, shape, weights, at);
    add_deltas(v->normal, shape->normal_deltas, shape, weights, at);
    add_deltas(v->tangent, shape->tangent_deltas, shape, weights, at);
}

/* The mean of the matrices of the vertex's joints. */
static void blend_joints(double blended[MATRIX], const lsf_shape *shape, const float *palette,
                         uint32_t at)
{
    memset(blended, 0, MATRIX * sizeof *blended);
    for (uint32_t i = 0; i < shape->influences; i++) {
        size_t influence = (size_t)at * shape->influences + i;
        double weight = (double)shape->weights[influence];
        const float *matrix = palette + (size_t)MATRIX * shape->joints[influence];
        for (int k = 0; k < MATRIX && weight > 0.0; k++)
            blended[k] += weight * (double)matrix[k];
    }
}

static void store_unit(float out[3], const double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3 && length > 0.0; c++)
        out[c] = (float)(v[c] / length);
}

/* Transforms positions and tangents by the matrix, and normals by its cofactors: the inverse
 * transpose up to a factor. */
static void follow_joints(vertex *v, const double m[MATRIX])
{
    double position[3], normal[3], tangent[3];
    for (int row = 0; row < 3; row++) {
        const double *a = m + 4 * row;
        const double *b = m + 4 * ((row + 1) % 3), *c = m + 4 * ((row + 2) % 3);
        position[row] = a[3];
        normal[row] = tangent[row] = 0.0;
        for (int k = 0; k < 3; k++) {
            int p = (k + 1) % 3, q = (k + 2) % 3;
            position[row] += a[k] * (double)v->position[k];
            tangent[row] += a[k] * (double)v->tangent[k];
            normal[row] += (b[p] * c[q] - b[q] * c[p]) * (double)v->normal[k];
        }
    }
    for (int row = 0; row < 3; row++)
        v->position[row] = (float)position[row];
    store_unit(v->normal, normal);
    store_unit(v->tangent, tangent);
}

static void make_unit(float v[3], const float otherwise[3])
{
    const double wide[3] = {(double)v[0], (double)v[1], (double)v[2]};
    memcpy(v, otherwise, 3 * sizeof *v);
    store_unit(v, wide);
}

/* Every vertex belongs to one triangle; they are in the triangles' order. */
static void flatten(float *normals, const float *positions, uint32_t vertex_count)
{
    for (uint32_t i = 0; i + 2 < vertex_count; i += 3) {
        const float *p = positions + 3 * (size_t)i;
        double u[3], v[3], n[3];
        for (int c = 0; c < 3; c++) {
            u[c] = (double)p[3 + c] - (double)p[c];
            v[c] = (double)p[6 + c] - (double)p[c];
        }
        for (int c = 0; c < 3; c++) {
            int a = (c + 1) % 3, b = (c + 2) % 3;
            n[c] = u[a] * v[b] - u[b] * v[a];
        }
        for (int corner = 0; corner < 3; corner++)
            store_unit(normals + 3 * ((size_t)i + (size_t)corner), n);
    }
}

static void deform(lsf_pose *pose, const lsf_scene *scene, const lsf_deformer *deformer)
{
    const lsf_shape *shape = &scene->shapes[deformer->shape];
    const lsf_vertices *rest = &scene->vertices;
    const float *weights = pose->values + (size_t)MATRIX * scene->joint_count +
                           scene->nodes[deformer->node].first_weight;
    const float *palette =
        deformer->skin == LSF_NONE
            ? NULL
            : pose->values + (size_t)MATRIX * scene->skins[deformer->skin].first_joint;
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        size_t at = deformer->first_vertex + i;
        vertex v = {0};
        memcpy(v.position, rest->position + 3 * at, sizeof v.position);
        memcpy(v.normal, rest->normal + 3 * at, sizeof v.normal);
        if (rest->tangent)
            memcpy(v.tangent, rest->tangent + 4 * at, sizeof v.tangent);
        morph(&v, shape, weights, i);
        make_unit(v.normal, rest->normal + 3 * at);
        if (palette) {
            double matrix[MATRIX];
            blend_joints(matrix, shape, palette, i);
            follow_joints(&v, matrix);
        }
        memcpy(pose->vertices.position + 3 * at, v.position, sizeof v.position);
        memcpy(pose->vertices.normal + 3 * at, v.normal, sizeof v.normal);
        if (rest->tangent) {
            make_unit(v.tangent, rest->tangent + 4 * at);
            memcpy(pose->vertices.tangent + 4 * at, v.tangent, sizeof v.tangent);
        }
    }
    if (shape->flat)
        flatten(pose->vertices.normal + 3 * deformer->first_vertex,
                pose->vertices.position + 3 * deformer->first_vertex, shape->vertex_count);
}

static void find_bounds(const lsf_pose *pose, const lsf_scene *scene, lsf_primitive *primitive)
{
    bool finite = true;
    for (int c = 0; c < 3; c++) {
        primitive->bounds_min[c] = INFINITY;
        primitive->bounds_max[c] = -INFINITY;
    }
    for (uint32_t i = 0; i < primitive->index_count; i++) {
        const float *p = pose->vertices.position +
                         3 * (size_t)scene->indices[primitive->first_index + (uint64_t)i];
        for (int c = 0; c < 3; c++) {
            finite = finite && isfinite(p[c]);
            primitive->bounds_min[c] = fminf(primitive->bounds_min[c], p[c]);
            primitive->bounds_max[c] = fmaxf(primitive->bounds_max[c], p[c]);
        }
    }
    for (int c = 0; c < 3 && !finite; c++) {
        primitive->bounds_min[c] = -INFINITY;
        primitive->bounds_max[c] = INFINITY;
    }
}

/* --- the whole --- */

static float *copy_stream(const float *stream, uint64_t count, size_t width)
{
    float *copy = lsf_alloc(count, width * sizeof *copy);
    if (copy)
        memcpy(copy, stream, count * width * sizeof *copy);
    return copy;
}

static bool create(lsf_pose *pose, const lsf_scene *scene)
{
    uint64_t values = lsf_pose_value_count(scene);
    const lsf_vertices *rest = &scene->vertices;
    if (pose->primitives)
        return true;
    pose->positions = copy_stream(rest->position, rest->count, 3);
    pose->normals = copy_stream(rest->normal, rest->count, 3);
    pose->tangents = rest->tangent ? copy_stream(rest->tangent, rest->count, 4) : NULL;
    pose->bounded = lsf_alloc(scene->primitive_count, sizeof *pose->bounded);
    pose->values = lsf_alloc(values, sizeof *pose->values);
    pose->old_values = lsf_alloc(values, sizeof *pose->old_values);
    pose->frames = lsf_alloc(scene->skin_count, sizeof *pose->frames);
    pose->weights = lsf_alloc(scene->weight_count, sizeof *pose->weights);
    if (!pose->positions || !pose->normals || (rest->tangent && !pose->tangents) ||
        !pose->bounded || !pose->values || !pose->old_values || !pose->frames || !pose->weights) {
        lsf_pose_finish(pose);
        return false;
    }
    memcpy(pose->bounded, scene->primitives, scene->primitive_count * sizeof *pose->bounded);
    pose->vertices = *rest;
    pose->vertices.position = pose->positions;
    pose->vertices.normal = pose->normals;
    pose->vertices.tangent = pose->tangents;
    pose->primitives = pose->bounded;
    return true;
}

/* Whether a deformer's vertices already follow the values. */
static bool is_current(const lsf_pose *pose, const lsf_scene *scene, uint32_t deformer)
{
    return pose->posed && lsf_pose_is_same(scene, deformer, pose->values, pose->old_values);
}

bool lsf_pose_update(lsf_pose *pose, const lsf_scene *scene, double time, const double *worlds)
{
    if (scene->deformer_count == 0) {
        pose->vertices = scene->vertices;
        pose->primitives = scene->primitives;
        return true;
    }
    if (!create(pose, scene))
        return false;
    float *old = pose->values;
    pose->values = pose->old_values;
    pose->old_values = old;
    find_values(pose, scene, time, worlds);
    for (uint32_t i = 0; i < scene->deformer_count; i++)
        if (!is_current(pose, scene, i))
            deform(pose, scene, &scene->deformers[i]);
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        uint32_t deformer = scene->primitives[i].deformer;
        if (deformer != LSF_NONE && !is_current(pose, scene, deformer))
            find_bounds(pose, scene, &pose->bounded[i]);
    }
    pose->posed = true;
    return true;
}

void lsf_pose_finish(lsf_pose *pose)
{
    free(pose->positions);
    free(pose->normals);
    free(pose->tangents);
    free(pose->bounded);
    free(pose->values);
    free(pose->old_values);
    free(pose->frames);
    free(pose->weights);
    memset(pose, 0, sizeof *pose);
}

const double *lsf_pose_world(const lsf_pose *pose, const lsf_scene *scene, const double *worlds,
                             uint32_t instance)
{
    const lsf_instance *placed = &scene->instances[instance];
    uint32_t deformer = scene->primitives[placed->primitive].deformer;
    uint32_t skin = deformer == LSF_NONE ? LSF_NONE : scene->deformers[deformer].skin;
    return skin == LSF_NONE ? worlds + (size_t)16 * placed->node : pose->frames[skin];
}
