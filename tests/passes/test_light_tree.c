/* The tree over a cloud of VPLs, against one that the processor builds, and against the leaves
 * themselves. */
#include <math.h>

#include "base/base.h"
#include "light_tree_rig.h"
#include "math/vector.h"
#include "octahedral.h"
#include "techniques/setup.h"

typedef struct tree_case {
    const char *name;
    cloud_kind kind;
    uint32_t count;
} tree_case;

static const tree_case cases[] = {
    {"none", CLOUD_DEAD, 1},          {"all dead", CLOUD_DEAD, 1000},
    {"one", CLOUD_ROOM, 1},           {"two", CLOUD_ROOM, 2},
    {"three", CLOUD_ROOM, 3},         {"a room", CLOUD_ROOM, 5000},
    {"one place", CLOUD_POINT, 1000}, {"one normal", CLOUD_PLANE, 1000},
    {"one VPL", CLOUD_SAME, 1000},    {"one of them bright", CLOUD_BRIGHT, 1000},
    {"damaged", CLOUD_DAMAGED, 2500},
};

typedef struct rig {
    lsf_context *context;
    lsf_scene *scene;
    lsf_setup setup;
    lsf_iteration iteration;
    lsf_light_tree tree;
    GLuint cloud;
} rig;

static void rig_begin(rig *r, uint32_t count, bool covariance)
{
    lsf_error error = {0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    const lsf_light_tree_params tree = {LSF_LIGHT_TREE_PARAMS_DEFAULTS, .covariance = covariance};
    memset(r, 0, sizeof *r);
    r->context = gl_test_context(gl_test_backend(), NULL);
    r->scene = build_scene();
    build_corner(r->scene);
    finish_gl_scene(r->scene);
    if (!lsf_setup_begin(&r->setup, r->scene, &params, true, &error))
        fail_msg("%s", error.message);
    lsf_light_tree_plan(r->setup.plan, &tree, count, "cloud");
    r->iteration.state = &r->setup.state;
    if (!lsf_light_tree_create(&r->tree, r->context, r->setup.plan, &tree, count, &error))
        fail_msg("%s", error.message);
}

static read_tree rig_run(rig *r, const struct lsf_vpl_record *records)
{
    lsf_error error = {0};
    lsf_buffer_destroy(r->context, &r->cloud);
    r->cloud = lsf_buffer_create(r->context, "cloud", r->tree.capacity * sizeof *records, records,
                                 0, &error);
    if (!r->cloud)
        fail_msg("%s", error.message);
    lsf_light_tree_run(&r->tree, &r->iteration, r->cloud);
    return read_tree_of(&r->tree);
}

static void rig_end(rig *r)
{
    lsf_buffer_destroy(r->context, &r->cloud);
    lsf_light_tree_destroy(&r->tree);
    lsf_setup_finish(&r->setup);
    gl_test_check(r->context);
    assert_int_equal(lsf_context_get_info(r->context).gl_bytes, 0);
    lsf_context_destroy(r->context);
    lsf_scene_destroy(r->scene);
}

/* --- codes -------------------------------------------------------------------------------------
 */

typedef struct code_bounds {
    float low[3], side;
} code_bounds;

static code_bounds bounds_of(const struct lsf_vpl_record *records, uint32_t count)
{
    code_bounds b = {{INFINITY, INFINITY, INFINITY}, 0.0f};
    float high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3 && cloud_shines(&records[i]); axis++) {
            float p = (&records[i].position.x)[axis];
            b.low[axis] = fminf(b.low[axis], p);
            high[axis] = fmaxf(high[axis], p);
        }
    for (int axis = 0; axis < 3; axis++)
        b.side = fmaxf(b.side, high[axis] - b.low[axis]);
    return b;
}

/* The cell of a Morton code holds the position. Materials are glossy: the first of its 30 bits
 * tells those that have a lobe, and the last one, of z, is left out for it. */
static void check_code(uint64_t code, const struct lsf_vpl_record *r, const code_bounds *b)
{
    uint64_t place = (code >> 33 & 0x1fffffffu) << 1;
    assert_int_equal(code >> 62 & 1, r->depth_and_lobe > LSF_VPL_DEPTH_MASK);
    for (int axis = 0; axis < 3; axis++) {
        uint32_t cell = 0;
        for (int bit = 0; bit < 10; bit++)
            cell |= (uint32_t)(place >> (3 * bit + 2 - axis) & 1) << bit;
        float width = b->side / 1024.0f, p = (&r->position.x)[axis] - b->low[axis];
        float cells = axis == 2 ? 2.0f : 1.0f;
        assert_true(p >= ((float)cell - 1e-3f) * width &&
                    p <= ((float)cell + cells + 1e-3f) * width);
    }
    lsf_float3 n = octahedral_decode(r->normal);
    uint32_t octant = (uint32_t)(code >> 30) & 7u;
    assert_int_equal(octant, (n.x < 0.0f ? 4 : 0) | (n.y < 0.0f ? 2 : 0) | (n.z < 0.0f ? 1 : 0));
}

/* In order; returns them, of those that shine. */
static uint64_t *check_codes(const rig *r, const struct lsf_vpl_record *records, uint32_t live)
{
    uint32_t n = r->tree.capacity;
    uint32_t(*words)[2] = calloc(n, sizeof *words);
    uint64_t *codes = calloc(n, sizeof *codes);
    code_bounds bounds = bounds_of(records, n);
    assert_true(words && codes);
    glGetNamedBufferSubData(r->tree.codes[1], 0, (GLsizeiptr)(n * sizeof *words), words);
    for (uint32_t i = 0; i < n; i++) {
        codes[i] = (uint64_t)words[i][0] << 32 | words[i][1];
        assert_true(i == 0 || codes[i] > codes[i - 1]);
        uint32_t id = words[i][1] & ((1u << LSF_LIGHT_TREE_ID_BITS) - 1u);
        assert_true(id < n && cloud_shines(&records[id]) == (i < live));
        if (i < live)
            check_code(codes[i], &records[id], &bounds);
    }
    free(words);
    return codes;
}

/* Codes that differ little stand for normals that differ little: 8 * 64 triangles cover the sphere.
 */
static void test_normals(void **state)
{
    (void)state;
    enum { COUNT = 16384, CODES = 512 };
    static rig r;
    struct lsf_vpl_record *records = cloud_make(CLOUD_POINT, COUNT, 3);
    rig_begin(&r, COUNT, false);
    read_tree read = rig_run(&r, records);
    uint64_t *codes = check_codes(&r, records, COUNT);
    uint32_t used[CODES] = {0};
    lsf_float3 first[CODES];
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t code = (uint32_t)(codes[i] >> 24) & (CODES - 1);
        lsf_float3 n = octahedral_decode(records[codes[i] & 0xffffff].normal);
        if (used[code]++ == 0)
            first[code] = n;
        assert_true(lsf_f3_dot(n, first[code]) > cosf(0.32f));
    }
    for (uint32_t code = 0; code < CODES; code++)
        assert_true(used[code] > COUNT / CODES / 4 && used[code] < 3 * COUNT / CODES);
    free(codes);
    read_tree_free(&read);
    free(records);
    rig_end(&r);
}

/* --- the tree ----------------------------------------------------------------------------------
 */

/* What a node should be, in double precision. */
typedef struct sums {
    double light, position[3], moment[3][3]; /* moments about the origin, by light */
    double intensity[3], similarity;
    float low[3], high[3];
    uint32_t normal, count;
    lsf_float3 n;
} sums;

typedef struct oracle {
    const struct lsf_vpl_record *records;
    const read_tree *read;
    const uint64_t *codes;
    bool covariance;
    uint32_t seen; /* leaves, in the order of codes */
    double worst_moment;
} oracle;

static sums leaf_sums(const struct lsf_vpl_record *r)
{
    sums s = {.light = (double)cloud_luminance(r->intensity),
              .similarity = 1.0,
              .normal = r->normal,
              .count = 1,
              .n = octahedral_decode(r->normal)};
    for (int a = 0; a < 3; a++) {
        double p = (double)(&r->position.x)[a];
        s.low[a] = s.high[a] = (&r->position.x)[a];
        s.position[a] = s.light * p;
        s.intensity[a] = (double)(&r->intensity.x)[a];
        for (int b = 0; b < 3; b++)
            s.moment[a][b] = s.light * p * (double)(&r->position.x)[b];
    }
    return s;
}

/* The mean normal, by the children's own, and the product of similarities. */
static void merge_normals(sums *s, const sums *a, const sums *b, uint32_t stored)
{
    double q = b->light / (a->light + b->light);
    lsf_float3 mean =
        lsf_f3_add(lsf_f3_scale(a->n, (float)(1.0 - q)), lsf_f3_scale(b->n, (float)q));
    double cosine = a->normal == b->normal ? 1.0 : (double)lsf_f3_dot(a->n, b->n);
    s->similarity = a->similarity * b->similarity * fmin(fmax(cosine, 0.0), 1.0);
    s->normal = stored;
    s->n = octahedral_decode(stored);
    if (lsf_f3_length(mean) > 1e-3f)
        assert_true(lsf_f3_dot(lsf_f3_normalize(mean), s->n) > 1.0f - 1e-6f);
}

static sums merge_sums(const sums *a, const sums *b, uint32_t normal)
{
    sums s = {.light = a->light + b->light, .count = a->count + b->count};
    for (int i = 0; i < 3; i++) {
        s.position[i] = a->position[i] + b->position[i];
        s.intensity[i] = a->intensity[i] + b->intensity[i];
        s.low[i] = fminf(a->low[i], b->low[i]);
        s.high[i] = fmaxf(a->high[i], b->high[i]);
        for (int k = 0; k < 3; k++)
            s.moment[i][k] = a->moment[i][k] + b->moment[i][k];
    }
    merge_normals(&s, a, b, normal);
    return s;
}

static void assert_close(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.9g instead of %.9g, which differs by more than %g", a, b, tolerance);
}

static double covariance_of(const sums *s, int a, int b)
{
    return s->moment[a][b] / s->light - s->position[a] / s->light * (s->position[b] / s->light);
}

/* Variances along three axes of all that is below the node. */
static void check_spread(oracle *o, const struct lsf_light_tree_node *node, const sums *s)
{
    static const int rows[3] = {0, 0, 1}, columns[3] = {1, 2, 2};
    if (o->covariance) {
        for (int i = 0; i < 3; i++) {
            assert_close((double)(&node->variance.x)[i], covariance_of(s, i, i), 1e-6);
            assert_close((double)(&node->covariance.x)[i], covariance_of(s, rows[i], columns[i]),
                         1e-6);
        }
        return;
    }
    const lsf_basis f = lsf_basis_about(s->n);
    const lsf_float3 axes[3] = {f.t, f.b, f.n};
    for (int i = 0; i < 3; i++) {
        double expected = 0.0;
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                expected +=
                    (double)(&axes[i].x)[a] * (double)(&axes[i].x)[b] * covariance_of(s, a, b);
        double got = (double)(&node->variance.x)[i];
        /* Where planes turn, what is not along an axis is lost on the way up; the sum is kept. */
        if (s->similarity == 1.0)
            assert_close(got, expected, 1e-6);
        else if (node->usable)
            o->worst_moment = fmax(o->worst_moment, fabs(got - expected));
    }
}

static void check_node(oracle *o, const struct lsf_light_tree_node *node, const sums *s)
{
    double trace = 0.0, kept = 0.0;
    for (int i = 0; i < 3; i++) {
        assert_close((double)(&node->position.x)[i], s->position[i] / s->light, 2e-6);
        assert_close((double)(&node->intensity.x)[i], s->intensity[i], 1e-5 * s->intensity[i]);
        assert_true((&node->low.x)[i] == s->low[i] && (&node->high.x)[i] == s->high[i]);
        trace += covariance_of(s, i, i);
        kept += (double)(&node->variance.x)[i];
    }
    assert_close(kept, trace, 1e-6);
    /* Each merge rounds. */
    assert_close((double)node->similarity, s->similarity, 2.4e-7 * (double)s->count);
    assert_int_equal(node->count, s->count);
    check_spread(o, node, s);
}

/* Of the codes that a node is over, those of the first half lack the highest bit in which any
 * differ. */
static uint32_t split_of(const oracle *o, uint32_t first, uint32_t last)
{
    uint64_t differ = o->codes[first] ^ o->codes[last];
    int bit = 63 - __builtin_clzll(differ);
    uint32_t at = first;
    while (!(o->codes[at + 1] >> bit & 1))
        at++;
    return at;
}

static sums walk(oracle *o, uint32_t link, uint32_t first, uint32_t last)
{
    if (link & LSF_LIGHT_TREE_LEAF) {
        uint32_t id = link & ~LSF_LIGHT_TREE_LEAF;
        assert_int_equal(first, last);
        assert_int_equal(o->seen++, first);
        assert_int_equal(o->codes[first] & ((1u << LSF_LIGHT_TREE_ID_BITS) - 1u), id);
        return leaf_sums(&o->records[id]);
    }
    const struct lsf_light_tree_node *node = &o->read->nodes[link];
    uint32_t middle = split_of(o, first, last);
    sums a = walk(o, node->left, first, middle), b = walk(o, node->right, middle + 1, last);
    sums s = merge_sums(&a, &b, node->normal);
    check_node(o, node, &s);
    const uint32_t children[2] = {node->left, node->right};
    for (int i = 0; i < 2; i++)
        if (!(children[i] & LSF_LIGHT_TREE_LEAF))
            assert_true(node->similarity <= o->read->nodes[children[i]].similarity);
    return s;
}

static void check_tree(const rig *r, const tree_case *c, const struct lsf_vpl_record *records,
                       const read_tree *read, bool covariance)
{
    uint32_t live = 0;
    for (uint32_t i = 0; i < c->count; i++)
        live += cloud_shines(&records[i]);
    assert_int_equal(read->data.live, live);
    uint64_t *codes = check_codes(r, records, live);
    oracle o = {records, read, codes, covariance, 0, 0.0};
    if (live == 0)
        assert_int_equal(read->data.root, LSF_LIGHT_TREE_NONE);
    else
        walk(&o, read->data.root, 0, live - 1);
    assert_int_equal(o.seen, live);
    print_message("%s: %u of %u shine; variances of usable nodes are off by %g at most\n", c->name,
                  live, c->count, o.worst_moment);
    free(codes);
}

static void test_trees(void **state)
{
    (void)state;
    static rig r;
    for (size_t i = 0; i < 2 * LSF_COUNT(cases); i++) {
        const tree_case *c = &cases[i / 2];
        rig_begin(&r, c->count, i % 2);
        struct lsf_vpl_record *records = cloud_make(c->kind, c->count, 5);
        read_tree read = rig_run(&r, records);
        check_tree(&r, c, records, &read, i % 2);
        read_tree_free(&read);
        free(records);
        rig_end(&r);
    }
}

/* --- the same again ----------------------------------------------------------------------------
 */

static void test_same_bits(void **state)
{
    (void)state;
    enum { COUNT = 5000 };
    static const char *const threads[] = {"0", "1", "8"};
    struct lsf_vpl_record *records = cloud_make(CLOUD_ROOM, COUNT, 5);
    struct lsf_vpl_record *others = cloud_make(CLOUD_DAMAGED, COUNT, 6);
    read_tree first = {0};
    for (size_t i = 0; i < LSF_COUNT(threads); i++) {
        static rig r;
        setenv("LP_NUM_THREADS", threads[i], 1);
        rig_begin(&r, COUNT, false);
        read_tree other = rig_run(&r, others), read = rig_run(&r, records);
        if (i == 0)
            first = read;
        assert_memory_equal(&read.data, &first.data, sizeof read.data);
        assert_memory_equal(read.nodes, first.nodes, (COUNT - 1) * sizeof *read.nodes);
        assert_memory_equal(read.areas, first.areas, COUNT * sizeof *read.areas);
        read_tree_free(&other);
        if (i > 0)
            read_tree_free(&read);
        rig_end(&r);
    }
    unsetenv("LP_NUM_THREADS");
    read_tree_free(&first);
    free(records);
    free(others);
}

/* --- areas -------------------------------------------------------------------------------------
 */

/* VPLs evenly on a square stand for a part of it each, in the mean. */
static void test_areas(void **state)
{
    (void)state;
    enum { COUNT = 4000 };
    static rig r;
    struct lsf_vpl_record *records = cloud_make(CLOUD_PLANE, COUNT, 5);
    const double square = 1.0 * 0.3;
    for (int covariance = 0; covariance < 2; covariance++) {
        rig_begin(&r, COUNT, covariance);
        read_tree read = rig_run(&r, records);
        double sum = 0.0;
        for (uint32_t i = 0; i < COUNT; i++)
            sum += 3.14159265 * (double)read.areas[i];
        print_message("%d VPLs on %g stand for %g together\n", COUNT, square, sum);
        assert_true(sum > 0.7 * square && sum < 1.4 * square);
        read_tree_free(&read);
        rig_end(&r);
    }
    free(records);
}

int main(int argc, char **argv)
{
    /* With a number, a room of as many, and how long its tree takes. */
    if (argc > 1) {
        static rig r;
        const tree_case c = {"a room", CLOUD_ROOM, (uint32_t)atoi(argv[1])};
        struct lsf_vpl_record *records = cloud_make(c.kind, c.count, 5);
        rig_begin(&r, c.count, false);
        for (int i = 0; i < 4; i++) {
            read_tree read = rig_run(&r, records);
            if (i == 0)
                check_tree(&r, &c, records, &read, false);
            read_tree_free(&read);
        }
        printf("sort %.1f ms, tree %.1f ms\n", lsf_timer_milliseconds(r.tree.sort_timer) / 4.0,
               lsf_timer_milliseconds(r.tree.timer) / 4.0);
        rig_end(&r);
        free(records);
        return 0;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_normals), cmocka_unit_test(test_trees),
                                       cmocka_unit_test(test_same_bits),
                                       cmocka_unit_test(test_areas)};
    return cmocka_run_group_tests_name("light_tree", tests, NULL, NULL);
}
