#include "scene/hierarchy.h"

#include <math.h>
#include <string.h>

/* Offsets of the parts of a node's local transform, which are kept where its matrix will be. */
enum { TRANSLATION = 0, ROTATION = 3, SCALE = 7 };

static void normalize_rotation(double q[4])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] = length > 0.0 ? q[i] / length : (i == 3 ? 1.0 : 0.0);
}

/* Shortest-arc spherical interpolation, glTF 2.0 appendix C.4. */
static void slerp(const float *a, const float *b, double t, double q[4])
{
    double from[4] = {a[0], a[1], a[2], a[3]}, to[4] = {b[0], b[1], b[2], b[3]};
    normalize_rotation(from);
    normalize_rotation(to);
    double dot = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
    double sign = dot < 0.0 ? -1.0 : 1.0;
    double angle = acos(fmin(fabs(dot), 1.0));
    /* Below this angle sin is linear to the last bit, and dividing by it would lose precision. */
    bool linear = angle < 1e-6;
    double s = sin(angle);
    double wa = linear ? 1.0 - t : sin((1.0 - t) * angle) / s;
    double wb = sign * (linear ? t : sin(t * angle) / s);
    for (int i = 0; i < 4; i++)
        q[i] = wa * from[i] + wb * to[i];
    normalize_rotation(q);
}

/* Cubic Hermite spline, glTF 2.0 appendix C.5: a key is in-tangent, value, out-tangent; `length`
 * is the time between the keys. */
static void hermite(const float *from, const float *to, uint32_t width, double t, double length,
                    double *value)
{
    double t2 = t * t, t3 = t2 * t;
    for (uint32_t i = 0; i < width; i++) {
        double v0 = from[width + i], b0 = from[2 * (size_t)width + i];
        double a1 = to[i], v1 = to[width + i];
        value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * v0 + length * (t3 - 2.0 * t2 + t) * b0 +
                   (3.0 * t2 - 2.0 * t3) * v1 + length * (t3 - t2) * a1;
    }
}

/* The last key at or before `time`; 0 when all are later. */
static uint32_t find_key(const lsf_curve *curve, double time)
{
    uint32_t low = 0, high = curve->key_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (curve->times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* `rotation`: the values are quaternions. */
static void sample(const lsf_curve *curve, bool rotation, double time, double *value)
{
    uint32_t width = curve->width;
    bool cubic = curve->interpolation == LSF_CUBIC;
    size_t stride = (size_t)width * (cubic ? 3 : 1);
    uint32_t key = find_key(curve, time);
    const float *from = curve->values + key * stride;
    double start = curve->times[key];

    bool held = key + 1 == curve->key_count || time <= start || curve->interpolation == LSF_STEP;
    if (held) {
        for (uint32_t i = 0; i < width; i++)
            value[i] = from[(cubic ? width : 0) + i];
    } else {
        const float *to = from + stride;
        double length = (double)curve->times[key + 1] - start;
        double t = (time - start) / length;
        if (cubic)
            hermite(from, to, width, t, length, value);
        else if (rotation)
            slerp(from, to, t, value);
        else
            for (uint32_t i = 0; i < width; i++)
                value[i] = (1.0 - t) * from[i] + t * to[i];
    }
    if (rotation)
        normalize_rotation(value);
}

void lsf_curve_sample(const lsf_curve *curve, double time, double *value)
{
    sample(curve, false, time, value);
}

static void compose(const double scratch[10], double matrix[16])
{
    const double *t = scratch + TRANSLATION, *q = scratch + ROTATION, *s = scratch + SCALE;
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double rotation[9] = {
        1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z),       2.0 * (x * z - w * y),
        2.0 * (x * y - w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x),
        2.0 * (x * z + w * y),       2.0 * (y * z - w * x),       1.0 - 2.0 * (x * x + y * y),
    };
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            matrix[4 * column + row] = rotation[3 * column + row] * s[column];
        matrix[4 * column + 3] = 0.0;
    }
    memcpy(matrix + 12, t, 3 * sizeof(double));
    matrix[15] = 1.0;
}

void lsf_multiply_affine(const double a[16], const double b[16], double result[16])
{
    for (int column = 0; column < 4; column++) {
        const double *v = b + 4 * column;
        for (int row = 0; row < 3; row++)
            result[4 * column + row] = a[row] * v[0] + a[4 + row] * v[1] + a[8 + row] * v[2] +
                                       (column == 3 ? a[12 + row] : 0.0);
        result[4 * column + 3] = column == 3 ? 1.0 : 0.0;
    }
}

static void begin_scratch(const lsf_node *node, double scratch[10])
{
    memcpy(scratch + TRANSLATION, node->translation, sizeof(node->translation));
    memcpy(scratch + ROTATION, node->rotation, sizeof(node->rotation));
    memcpy(scratch + SCALE, node->scale, sizeof(node->scale));
}

void lsf_node_matrix(const lsf_node *node, double matrix[16])
{
    double scratch[10];
    begin_scratch(node, scratch);
    if (node->has_matrix)
        memcpy(matrix, node->matrix, sizeof(node->matrix));
    else
        compose(scratch, matrix);
}

void lsf_scene_world_matrices(const lsf_scene *scene, double time, double *matrices)
{
    for (uint32_t i = 0; i < scene->node_count; i++)
        begin_scratch(&scene->nodes[i], matrices + (size_t)16 * i);
    for (uint32_t i = 0; i < scene->channel_count; i++) {
        const lsf_animation_channel *channel = &scene->channels[i];
        if (channel->path == LSF_PATH_WEIGHTS || scene->nodes[channel->node].has_matrix)
            continue;
        static const int offsets[] = {[LSF_PATH_TRANSLATION] = TRANSLATION,
                                      [LSF_PATH_ROTATION] = ROTATION,
                                      [LSF_PATH_SCALE] = SCALE};
        sample(&channel->curve, channel->path == LSF_PATH_ROTATION, time,
               matrices + (size_t)16 * channel->node + offsets[channel->path]);
    }
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const lsf_node *node = &scene->nodes[i];
        double *world = matrices + (size_t)16 * i;
        double local[16];
        if (node->has_matrix)
            memcpy(local, node->matrix, sizeof(local));
        else
            compose(world, local);
        if (node->parent == LSF_NONE)
            memcpy(world, local, sizeof(local));
        else
            lsf_multiply_affine(matrices + (size_t)16 * node->parent, local, world);
    }
}

void lsf_scene_weights(const lsf_scene *scene, double time, double *weights)
{
    for (uint32_t i = 0; i < scene->weight_count; i++)
        weights[i] = (double)scene->weights[i];
    for (uint32_t i = 0; i < scene->channel_count; i++) {
        const lsf_animation_channel *channel = &scene->channels[i];
        if (channel->path == LSF_PATH_WEIGHTS)
            sample(&channel->curve, false, time,
                   weights + scene->nodes[channel->node].first_weight + channel->first_weight);
    }
}

uint32_t lsf_scene_moments(const lsf_scene *scene, double *first, double *last)
{
    *first = *last = 0.0;
    for (uint32_t i = 0; i < scene->channel_count; i++) {
        const lsf_curve *curve = &scene->channels[i].curve;
        double from = (double)curve->times[0], to = (double)curve->times[curve->key_count - 1];
        *first = i == 0 ? from : fmin(*first, from);
        *last = i == 0 ? to : fmax(*last, to);
    }
    return *last > *first ? 65 : 1;
}

double lsf_moment(uint32_t index, uint32_t moments, double first, double last)
{
    double t = moments > 1 ? (double)index / (moments - 1) : 0.0;
    return first + t * (last - first);
}

void lsf_transform_point(const double matrix[16], const double point[3], double result[3])
{
    double x = point[0], y = point[1], z = point[2];
    for (int row = 0; row < 3; row++)
        result[row] =
            matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row];
}
