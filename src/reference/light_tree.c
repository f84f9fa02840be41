#include "reference/light_tree.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/light_bounds.h"
#include "shared/light.h"

#define BINS 12

/* Bounds in the form that drawing needs at each step. A node's first child follows it. */
struct lsf_light_node {
    lsf_float3 middle, half; /* of the box */
    float radius2;           /* of the bounding sphere */
    lsf_float3 axis;
    float cos_spread, sin_spread, cos_emission;
    float intensity, range;
    bool two_sided;
    uint32_t parent; /* of the root: itself */
    uint32_t second; /* the other child; of a leaf, its light */
    uint32_t lights; /* below; 1: a leaf */
};

/* Largest depth of the tree: enough for 2^32 lights, three times as deep as with halving. */
#define DEEPEST 128

/* --- building */

typedef struct builder {
    lsf_light_tree *tree;
    const lsf_light_bounds *lights;
    uint32_t *order;          /* of lights, by node */
    lsf_light_bounds *bounds; /* of each node */
    uint32_t node_count;
    int deepest; /* depth beyond which lights are halved by number */
} builder;

static float center(const lsf_light_bounds *b, int axis)
{
    return 0.5f * b->low[axis] + 0.5f * b->high[axis];
}

typedef struct split {
    int axis;         /* negative: there is none */
    float low, scale; /* maps to bins: scale * (center - low) */
    int bin;          /* the last one of the first child */
} split;

static int bin_of(const split *s, const lsf_light_bounds *light)
{
    int bin = (int)(s->scale * (center(light, s->axis) - s->low));
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

/* Computes the costs of both sides of each border between bins along the axis. */
static void try_axis(const builder *b, uint32_t first, uint32_t count, split s, float narrow,
                     float *least, split *best)
{
    lsf_light_bounds bins[BINS], before[BINS];
    bool filled[BINS] = {false}, any[BINS] = {false};
    for (uint32_t i = first; i < first + count; i++) {
        const lsf_light_bounds *light = &b->lights[b->order[i]];
        int bin = bin_of(&s, light);
        bins[bin] = filled[bin] ? lsf_light_bounds_union(&bins[bin], light) : *light;
        filled[bin] = true;
    }
    for (int i = 0; i < BINS; i++) {
        bool was = i > 0 && any[i - 1];
        any[i] = was || filled[i];
        if (filled[i])
            before[i] = was ? lsf_light_bounds_union(&before[i - 1], &bins[i]) : bins[i];
        else if (was)
            before[i] = before[i - 1];
    }
    lsf_light_bounds after = {.intensity = 0.0f};
    bool some = false;
    for (int i = BINS - 1; i > 0; i--) {
        if (filled[i])
            after = some ? lsf_light_bounds_union(&after, &bins[i]) : bins[i];
        some |= filled[i];
        if (!some || !any[i - 1])
            continue;
        float cost =
            narrow * (lsf_light_bounds_cost(&before[i - 1]) + lsf_light_bounds_cost(&after));
        if (best->axis >= 0 && !(cost < *least))
            continue;
        *least = cost;
        *best = s;
        best->bin = i - 1;
    }
}

/* Lights that are all at the same position have no split. */
static split find_split(const builder *b, uint32_t first, uint32_t count)
{
    float low[3], high[3], widest = 0.0f, least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = INFINITY;
        high[axis] = -INFINITY;
        for (uint32_t i = first; i < first + count; i++) {
            low[axis] = fminf(low[axis], center(&b->lights[b->order[i]], axis));
            high[axis] = fmaxf(high[axis], center(&b->lights[b->order[i]], axis));
        }
        widest = fmaxf(widest, high[axis] - low[axis]);
    }
    split best = {.axis = -1};
    for (int axis = 0; axis < 3; axis++) {
        float width = high[axis] - low[axis], scale = (float)BINS / width;
        if (width > 0.0f && isfinite(scale))
            try_axis(b, first, count, (split){axis, low[axis], scale, 0}, widest / width, &least,
                     &best);
    }
    return best;
}

static uint32_t partition(const builder *b, uint32_t first, uint32_t count, const split *s)
{
    uint32_t i = first, j = first + count;
    while (i < j) {
        uint32_t light = b->order[i];
        if (bin_of(s, &b->lights[light]) <= s->bin) {
            i++;
        } else {
            b->order[i] = b->order[--j];
            b->order[j] = light;
        }
    }
    return i - first;
}

static void fill_node(lsf_light_node *node, const lsf_light_bounds *b)
{
    lsf_float3 low = lsf_f3_load(b->low), high = lsf_f3_load(b->high);
    node->middle = lsf_f3_scale(lsf_f3_add(low, high), 0.5f);
    node->half = lsf_f3_sub(high, node->middle);
    node->radius2 = lsf_f3_dot(node->half, node->half);
    node->axis = lsf_f3_load(b->axis);
    node->cos_spread = b->cos_spread;
    node->sin_spread = sqrtf(fmaxf(1.0f - b->cos_spread * b->cos_spread, 0.0f));
    node->cos_emission = b->cos_emission;
    node->intensity = b->intensity;
    node->range = b->range;
    node->two_sided = b->two_sided;
}

static uint32_t build(builder *b, uint32_t parent, uint32_t first, uint32_t count, int depth)
{
    uint32_t index = b->node_count++;
    lsf_light_node *node = &b->tree->nodes[index];
    *node = (lsf_light_node){.parent = parent, .lights = count};
    if (count == 1) {
        node->second = b->order[first];
        b->bounds[index] = b->lights[node->second];
        fill_node(node, &b->bounds[index]);
        b->tree->leaves[node->second] = index;
        return index;
    }
    split s = {.axis = -1};
    if (depth < b->deepest)
        s = find_split(b, first, count);
    uint32_t half = s.axis >= 0 ? partition(b, first, count, &s) : count / 2;
    uint32_t one = build(b, index, first, half, depth + 1);
    uint32_t two = build(b, index, first + half, count - half, depth + 1);
    node->second = two;
    b->bounds[index] = lsf_light_bounds_union(&b->bounds[one], &b->bounds[two]);
    fill_node(node, &b->bounds[index]);
    return index;
}

/* Intensities are relative to all lights, so that neither bright nor dark scenes overflow. */
static double total_intensity(const lsf_light_bounds *lights, uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        sum += (double)lights[i].intensity;
    return sum;
}

bool lsf_light_tree_init(lsf_light_tree *tree, const lsf_light_bounds *lights, uint32_t count)
{
    *tree = (lsf_light_tree){.light_count = count};
    double total = total_intensity(lights, count);
    uint32_t shining = 0;
    builder b = {.tree = tree, .deepest = 2};
    lsf_light_bounds *relative = lsf_alloc(count, sizeof *relative);
    b.lights = relative;
    b.order = lsf_alloc(count, sizeof *b.order);
    tree->leaves = lsf_alloc(count, sizeof *tree->leaves);
    bool ok = relative != NULL && b.order != NULL && tree->leaves != NULL;
    for (uint32_t i = 0; ok && i < count; i++) {
        tree->leaves[i] = LSF_NO_LEAF;
        relative[i] = lights[i];
        relative[i].intensity = total > 0.0 ? (float)((double)lights[i].intensity / total) : 0.0f;
        if (relative[i].intensity > 0.0f)
            b.order[shining++] = i;
    }
    if (ok && shining > 0) {
        for (uint32_t n = shining; n > 1; n /= 2)
            b.deepest += 2;
        tree->nodes = lsf_alloc(2 * (uint64_t)shining - 1, sizeof *tree->nodes);
        b.bounds = lsf_alloc(2 * (uint64_t)shining - 1, sizeof *b.bounds);
        ok = tree->nodes != NULL && b.bounds != NULL;
    }
    if (ok && shining > 0)
        build(&b, 0, 0, shining, 0);
    free(relative);
    free(b.order);
    free(b.bounds);
    if (!ok)
        lsf_light_tree_finish(tree);
    return ok;
}

void lsf_light_tree_finish(lsf_light_tree *tree)
{
    free(tree->nodes);
    free(tree->leaves);
    *tree = (lsf_light_tree){0};
}

/* --- drawing */

static float above(float x, float least)
{
    return x > least ? x : least;
}

static float sine_of(float cosine)
{
    return sqrtf(above(1.0f - cosine * cosine, 0.0f));
}

static bool out_of_range(const lsf_light_node *n, lsf_float3 to_receiver)
{
    if (isinf(n->range))
        return false;
    float x = above(fabsf(to_receiver.x) - n->half.x, 0.0f),
          y = above(fabsf(to_receiver.y) - n->half.y, 0.0f);
    float z = above(fabsf(to_receiver.z) - n->half.z, 0.0f);
    return x * x + y * y + z * z > n->range * n->range;
}

/* Cosine of the angle between the axis and `to_receiver`, less the spread of both. */
static float emitted_cosine(const lsf_light_node *n, lsf_float3 to_receiver, float cos_size,
                            float sin_size)
{
    if (n->cos_spread == -1.0f)
        return 1.0f;
    float cosine = lsf_f3_dot(n->axis, to_receiver);
    if (n->two_sided)
        cosine = fabsf(cosine);
    if (cosine >= n->cos_spread)
        return 1.0f;
    float sine = sine_of(cosine), rest = cosine * n->cos_spread + sine * n->sin_spread;
    float rest_sine = sine * n->cos_spread - cosine * n->sin_spread;
    return rest >= cos_size ? 1.0f : rest * cos_size + rest_sine * sin_size;
}

/* Largest cosine between the receiver's normal and a direction to the group. */
static float received_cosine(const lsf_light_receiver *receiver, lsf_float3 to_receiver,
                             float cos_size, float sin_size)
{
    lsf_float3 n = receiver->normal;
    if (n.x == 0.0f && n.y == 0.0f && n.z == 0.0f)
        return 1.0f;
    float cosine = -lsf_f3_dot(n, to_receiver);
    if (receiver->both_sides)
        cosine = fabsf(cosine);
    return cosine >= cos_size ? 1.0f : cosine * cos_size + sine_of(cosine) * sin_size;
}

/* Approximate irradiance from the group: its intensity times the largest possible cosines at
 * either end, over the squared distance to its centre, or to its border from within. 0 only
 * where it can send no light. */
static float importance(const lsf_light_node *n, const lsf_light_receiver *receiver)
{
    lsf_float3 to_receiver = lsf_f3_sub(receiver->position, n->middle);
    float distance2 = lsf_f3_dot(to_receiver, to_receiver);
    if (!(distance2 > n->radius2))
        return n->intensity / above(n->radius2, LSF_LIGHT_DISTANCE2_MIN);
    if (out_of_range(n, to_receiver))
        return 0.0f;
    float sin2 = n->radius2 / distance2;
    float sin_size = sqrtf(sin2), cos_size = sqrtf(1.0f - sin2);
    to_receiver = lsf_f3_scale(to_receiver, 1.0f / sqrtf(distance2));
    float received = received_cosine(receiver, to_receiver, cos_size, sin_size);
    if (received <= -LSF_LIGHT_ROUNDING)
        return 0.0f;
    float emitted = emitted_cosine(n, to_receiver, cos_size, sin_size);
    if (emitted <= n->cos_emission - LSF_LIGHT_ROUNDING)
        return 0.0f;
    return n->intensity * above(emitted, LSF_LIGHT_ROUNDING) * above(received, LSF_LIGHT_ROUNDING) /
           above(distance2, LSF_LIGHT_DISTANCE2_MIN);
}

/* Number of draws that a node passes to each child; where that is a single one for both, a
 * random choice. */
typedef struct shares {
    uint32_t most[2];
    float probability[2];
} shares;

static uint32_t child(const lsf_light_tree *tree, uint32_t node, int which)
{
    return which == 0 ? node + 1 : tree->nodes[node].second;
}

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* False: neither child can send light. */
static bool share_out(const lsf_light_tree *tree, const lsf_light_receiver *receiver, uint32_t node,
                      uint32_t most, shares *out)
{
    const lsf_light_node *one = &tree->nodes[child(tree, node, 0)];
    const lsf_light_node *two = &tree->nodes[child(tree, node, 1)];
    /* The two triangles of a single quadrilateral have the same weight from everywhere. */
    bool pair = tree->nodes[0].lights == 2;
    float first = pair ? one->intensity : importance(one, receiver);
    float second = pair ? two->intensity : importance(two, receiver);
    if (!(first + second > 0.0f))
        return false;
    float scale = 1.0f / (first + second);
    *out = (shares){{most, most}, {first * scale, second * scale}};
    if (most == 1 || first == 0.0f || second == 0.0f)
        return true;
    /* Each child gets at least one draw, and none more than it has lights. */
    uint32_t wanted = (uint32_t)(out->probability[0] * (float)most + 0.5f);
    wanted = smaller(wanted < 1 ? 1 : wanted, most - 1);
    wanted = smaller(wanted, one->lights);
    uint32_t rest = smaller(most - wanted, two->lights);
    wanted = smaller(most - rest, one->lights);
    *out = (shares){{wanted, rest}, {1.0f, 1.0f}};
    return true;
}

/* Descends from a node from which a single light is drawn. False: none can send light. */
static bool descend(const lsf_light_tree *tree, const lsf_light_receiver *receiver, uint32_t node,
                    lsf_light_choice *choice)
{
    choice->probability = 1.0f;
    while (tree->nodes[node].lights > 1) {
        shares s;
        if (!share_out(tree, receiver, node, 1, &s))
            return false;
        double first = (double)s.probability[0], u = choice->u[0];
        int which = u < first ? 0 : 1;
        u = (which == 0 ? u : u - first) / (double)s.probability[which];
        choice->u[0] = fmin(u, 1.0 - 0x1p-53);
        choice->probability *= s.probability[which];
        node = child(tree, node, which);
    }
    choice->light = tree->nodes[node].second;
    return choice->probability > 0.0f;
}

/* Random numbers belong to the node, so that they do not depend on what other groups have drawn. */
static void begin_choice(lsf_light_choice *choice, lsf_light_numbers numbers, uint32_t node)
{
    uint32_t bits[2];
    lsf_sobol_2d_bits(numbers.sample, lsf_hash(numbers.seed, node), bits);
    choice->u[0] = lsf_unit_double(bits[0]);
    choice->u[1] = lsf_unit_double(bits[1]);
}

/* Appends to `choices`, of which there are `count`. */
static uint32_t draw(const lsf_light_tree *tree, const lsf_light_receiver *receiver, uint32_t node,
                     uint32_t most, lsf_light_numbers numbers, lsf_light_choice *choices,
                     uint32_t count)
{
    uint32_t lights = tree->nodes[node].lights;
    most = smaller(most, lights);
    if (most == 1) {
        begin_choice(&choices[count], numbers, node);
        return count + descend(tree, receiver, node, &choices[count]);
    }
    shares s;
    if (!share_out(tree, receiver, node, most, &s))
        return count;
    for (int i = 0; i < 2; i++)
        if (s.probability[i] > 0.0f)
            count = draw(tree, receiver, child(tree, node, i), s.most[i], numbers, choices, count);
    return count;
}

/* With few lights each is drawn by itself, without a descent; each still has random numbers for
 * its position. */
static bool asks_all(const lsf_light_tree *tree, uint32_t most)
{
    return most > 1 && tree->nodes[0].lights <= most;
}

uint32_t lsf_light_tree_draw(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                             uint32_t most, lsf_light_numbers numbers, lsf_light_choice *choices)
{
    if (tree->nodes == NULL)
        return 0;
    if (!asks_all(tree, most))
        return draw(tree, receiver, 0, most, numbers, choices, 0);
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2 * tree->nodes[0].lights - 1; i++)
        if (tree->nodes[i].lights == 1)
            choices[count++] = (lsf_light_choice){.light = tree->nodes[i].second, .probability = 1};
    return count;
}

float lsf_light_tree_probability(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                                 uint32_t most, uint32_t light)
{
    if (tree->nodes == NULL || tree->leaves[light] == LSF_NO_LEAF)
        return 0.0f;
    if (asks_all(tree, most))
        return 1.0f;
    uint32_t path[DEEPEST], length = 0;
    for (uint32_t node = tree->leaves[light]; node != 0; node = tree->nodes[node].parent)
        path[length++] = node;
    float probability = 1.0f;
    uint32_t node = 0;
    while (length > 0) {
        shares s;
        most = smaller(most, tree->nodes[node].lights);
        if (!share_out(tree, receiver, node, most, &s))
            return 0.0f;
        uint32_t next = path[--length];
        int which = next == node + 1 ? 0 : 1;
        probability *= s.probability[which];
        most = s.most[which];
        node = next;
    }
    return probability;
}
