/* Phong tessellation: round things get rounder, flat ones stay flat to the bit, nothing gapes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "build_scene.h"
#include "plan/plan.h"
#include "scene/tessellate.h"
#include "techniques/setup.h"

static lsf_scene *tessellate(const lsf_scene *scene, uint32_t factor, float shape)
{
    lsf_error error = {0};
    lsf_scene *fine = lsf_scene_tessellate(scene, factor, shape, &error);
    if (!fine)
        fail_msg("%s", error.message);
    return fine;
}

/* An icosahedron with the normals of the sphere around it. */
static lsf_scene *round_scene(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_sphere(scene, 0, false);
    memcpy(scene->vertices.normal, scene->vertices.position, 12 * scene->vertices.count);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    return scene;
}

/* A closed cylinder of 7 sides: its barrel has smooth normals and its caps have flat ones, so that
 * the rims bend one way on the barrel and not at all on the caps. */
static lsf_scene *barrel_scene(void)
{
    enum { SIDES = 7, BARREL = 6 * SIDES, CAP = 3 * (SIDES - 2) };
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    lsf_float3 low[SIDES], high[SIDES], barrel[BARREL], caps[2 * CAP];
    for (int i = 0; i < SIDES; i++) {
        float angle = 6.2831853f * (float)i / SIDES;
        low[i] = lsf_f3(cosf(angle), -0.3f, sinf(angle));
        high[i] = lsf_f3(0.7f * cosf(angle), 0.9f, 0.7f * sinf(angle));
    }
    for (int i = 0; i < SIDES; i++) {
        int next = (i + 1) % SIDES;
        const lsf_float3 quad[6] = {low[i], high[i], high[next], low[i], high[next], low[next]};
        memcpy(barrel + (size_t)6 * i, quad, sizeof quad);
    }
    for (int i = 1; i + 1 < SIDES; i++) {
        const lsf_float3 fans[6] = {low[0], low[i], low[i + 1], high[0], high[i + 1], high[i]};
        memcpy(caps + (size_t)6 * (i - 1), fans, sizeof fans);
    }
    build_triangles(scene, barrel, BARREL / 3);
    build_triangles(scene, caps, 2 * CAP / 3);
    for (int i = 0; i < BARREL; i++)
        lsf_f3_store(scene->vertices.normal + (size_t)3 * i,
                     lsf_f3_normalize(lsf_f3(barrel[i].x, 0.25f, barrel[i].z)));
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    return scene;
}

static float farthest_from_sphere(const lsf_scene *scene)
{
    float farthest = 0.0f;
    for (uint64_t i = 0; i < scene->index_count; i += 3) {
        lsf_float3 sum = {0};
        for (int k = 0; k < 3; k++)
            sum = lsf_f3_add(
                sum, lsf_f3_load(scene->vertices.position + 3 * (size_t)scene->indices[i + k]));
        float radius = sqrtf(lsf_f3_dot(sum, sum)) / 3.0f;
        farthest = fmaxf(farthest, fabsf(1.0f - radius));
    }
    return farthest;
}

static void round_things_get_rounder(void **unused)
{
    (void)unused;
    lsf_scene *scene = round_scene();
    float before = farthest_from_sphere(scene);
    lsf_scene *flat = tessellate(scene, 8, 0.0f);
    lsf_scene *bent = tessellate(scene, 8, 0.75f);
    /* A face's centre lies at r = .795 of the radius and its vertices 1 - r^2 above its
     * projections, which bends it to r (1 + shape (1 - r^2)) = 1.014; the middle of an edge goes
     * from .851 to 1.027. */
    assert_true(before > 0.2f);
    assert_true(farthest_from_sphere(flat) > 0.18f);
    assert_true(farthest_from_sphere(bent) < 0.03f);
    assert_int_equal(bent->index_count, 64 * scene->index_count);
    assert_int_equal(bent->requirements.triangles, 64 * 20);
    for (uint64_t i = 0; i < bent->vertices.count; i++) {
        lsf_float3 n = lsf_f3_load(bent->vertices.normal + 3 * i);
        assert_true(fabsf(lsf_f3_dot(n, n) - 1.0f) < 1e-6f);
    }
    lsf_scene_tessellated_destroy(flat);
    lsf_scene_tessellated_destroy(bent);
    destroy_scene(scene);
}

/* The formula as Boubekeur and Alexa write it, at every point of one triangle. */
static void points_are_those_of_the_paper(void **unused)
{
    (void)unused;
    enum { N = 5 };
    const double shape = 0.6;
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    const lsf_float3 p[3] = {{0, 0, 0}, {2, 0.1f, 0}, {0.3f, 1.5f, 0.4f}};
    const lsf_float3 n[3] = {lsf_f3_normalize(lsf_f3(-0.3f, 0, 1)),
                             lsf_f3_normalize(lsf_f3(0.5f, -0.2f, 1)),
                             lsf_f3_normalize(lsf_f3(0, 0.4f, 1))};
    build_triangles(scene, p, 1);
    for (int k = 0; k < 3; k++)
        lsf_f3_store(scene->vertices.normal + (size_t)3 * k, n[k]);
    finish_scene(scene);
    lsf_scene *fine = tessellate(scene, N, (float)shape);
    assert_int_equal(fine->vertices.count, (N + 1) * (N + 2) / 2);
    for (int i = 0; i <= N; i++)
        for (int j = 0; i + j <= N; j++) {
            float w[3] = {(float)(N - i - j) / N, (float)i / N, (float)j / N};
            lsf_float3 q = {0}, sum = {0};
            for (int k = 0; k < 3; k++)
                q = lsf_f3_mad(q, p[k], w[k]);
            for (int k = 0; k < 3; k++) {
                float height = lsf_f3_dot(lsf_f3_sub(q, p[k]), n[k]);
                sum = lsf_f3_mad(sum, lsf_f3_mad(q, n[k], -height), w[k]);
            }
            lsf_float3 wanted =
                lsf_f3_add(lsf_f3_scale(q, (float)(1 - shape)), lsf_f3_scale(sum, (float)shape));
            float nearest = INFINITY;
            for (uint64_t v = 0; v < fine->vertices.count; v++) {
                lsf_float3 d = lsf_f3_sub(lsf_f3_load(fine->vertices.position + 3 * v), wanted);
                nearest = fminf(nearest, lsf_f3_dot(d, d));
            }
            assert_true(sqrtf(nearest) < 1e-6f);
        }
    lsf_scene_tessellated_destroy(fine);
    destroy_scene(scene);
}

static void flat_things_stay_flat(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_floor(scene, 0.3f, 1.7f);
    build_quad(scene, lsf_f3(0.1f, 0.2f, 0.3f), lsf_f3(1.3f, 0.7f, 0.2f), lsf_f3(1.1f, 1.9f, 0.9f),
               lsf_f3(-0.1f, 1.4f, 1.0f));
    build_sphere(scene, 1, false); /* flat triangles */
    finish_scene(scene);
    lsf_scene *flat = tessellate(scene, 7, 0.0f);
    lsf_scene *bent = tessellate(scene, 7, 1.0f);
    assert_int_equal(flat->vertices.count, bent->vertices.count);
    assert_memory_equal(flat->vertices.position, bent->vertices.position,
                        12 * flat->vertices.count);
    for (uint32_t i = 0; i < bent->primitives[0].index_count; i++)
        assert_true(bent->vertices.position[3 * (size_t)bent->indices[i] + 1] == 0.3f);
    lsf_scene_tessellated_destroy(flat);
    lsf_scene_tessellated_destroy(bent);
    destroy_scene(scene);
}

typedef struct edge {
    float ends[6];
} edge;

static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(edge));
}

/* Every edge, as the bits of its ends, belongs to two triangles. */
static void assert_closed(const lsf_scene *scene)
{
    edge *edges = calloc(scene->index_count, sizeof *edges);
    assert_non_null(edges);
    for (uint64_t i = 0; i < scene->index_count; i++) {
        const float *a = scene->vertices.position + 3 * (size_t)scene->indices[i];
        const float *b =
            scene->vertices.position + 3 * (size_t)scene->indices[i % 3 == 2 ? i - 2 : i + 1];
        bool swap = memcmp(a, b, 12) > 0;
        for (int c = 0; c < 3; c++) { /* -0 is 0 */
            edges[i].ends[c] = (swap ? b : a)[c] + 0.0f;
            edges[i].ends[3 + c] = (swap ? a : b)[c] + 0.0f;
        }
    }
    qsort(edges, scene->index_count, sizeof *edges, compare_edges);
    for (uint64_t i = 0; i < scene->index_count; i += 2) {
        assert_memory_equal(&edges[i], &edges[i + 1], sizeof(edge));
        assert_true(i == 0 || memcmp(&edges[i], &edges[i - 1], sizeof(edge)) != 0);
    }
    free(edges);
}

static void no_gaps_open(void **unused)
{
    (void)unused;
    static const uint32_t factors[] = {2, 3, 8, LSF_TESSELLATE_MAX_FACTOR};
    lsf_scene *round = round_scene(), *barrel = barrel_scene();
    lsf_scene *box = build_scene();
    build_material(box, 1, 1, 1);
    build_box(box, lsf_f3(-0.1f, -0.7f, 0.3f), lsf_f3(0.9f, 0.4f, 0.77f), false);
    /* Barrel and caps belong to one mesh: their rims are one another's. */
    lsf_mesh mesh = {.primitive_count = 2};
    barrel->meshes = &mesh;
    barrel->mesh_count = 1;
    assert_closed(barrel);
    for (int i = 0; i < 4; i++) {
        const lsf_scene *scenes[] = {round, barrel, box};
        for (int k = 0; k < 3; k++) {
            lsf_scene *fine = tessellate(scenes[k], factors[i], 0.75f);
            assert_int_equal(fine->index_count, factors[i] * factors[i] * scenes[k]->index_count);
            assert_closed(fine);
            lsf_scene_tessellated_destroy(fine);
        }
    }
    barrel->meshes = NULL;
    destroy_scene(round);
    destroy_scene(barrel);
    destroy_scene(box);
}

/* A square with all streams, welded: old vertices keep their bits, new ones lie between. */
static void every_stream_is_carried(void **unused)
{
    (void)unused;
    enum { N = 4 };
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_floor(scene, 0.0f, 1.0f);
    lsf_vertices *v = &scene->vertices;
    v->tangent = calloc(v->count, 16);
    v->uv0 = calloc(v->count, 8);
    v->uv1 = calloc(v->count, 8);
    v->color = calloc(v->count, 16);
    for (uint64_t i = 0; i < v->count; i++) {
        const float *p = v->position + 3 * i;
        memcpy(v->tangent + 4 * i, (float[]){1, 0, 0, -1}, 16);
        memcpy(v->uv0 + 2 * i, (float[]){p[0] + 2, p[2]}, 8);
        memcpy(v->uv1 + 2 * i, (float[]){3 * p[2], 0.1f}, 8);
        memcpy(v->color + 4 * i, (float[]){p[0] * 0.5f + 0.5f, 0.3f, 1, 0.9f}, 16);
    }
    scene->indices[3] = 0; /* the two triangles share the diagonal */
    scene->indices[4] = 2;
    finish_scene(scene);
    lsf_scene *fine = tessellate(scene, N, 0.75f);
    /* The two vertices that nothing uses any more are gone. */
    assert_int_equal(fine->vertices.count, (N + 1) * (N + 1));
    assert_int_equal(fine->primitives[0].vertex_count, fine->vertices.count);
    for (uint64_t i = 0; i < fine->vertices.count; i++) {
        const float *p = fine->vertices.position + 3 * i;
        assert_memory_equal(fine->vertices.tangent + 4 * i, ((float[]){1, 0, 0, -1}), 16);
        assert_memory_equal(fine->vertices.uv0 + 2 * i, ((float[]){p[0] + 2, p[2]}), 8);
        assert_memory_equal(fine->vertices.uv1 + 2 * i, ((float[]){3 * p[2], 0.1f}), 8);
        assert_memory_equal(fine->vertices.color + 4 * i,
                            ((float[]){p[0] * 0.5f + 0.5f, 0.3f, 1, 0.9f}), 16);
    }
    for (uint64_t i = 0; i < fine->index_count; i++)
        assert_true(fine->indices[i] < fine->vertices.count);
    lsf_scene_tessellated_destroy(fine);
    destroy_scene(scene);
}

static void setup_with(lsf_setup *setup, const lsf_scene *scene, const char *option)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    lsf_error error = {0};
    params.options = &option;
    params.option_count = 1;
    if (!lsf_setup_init(setup, scene, &params, true, &error))
        fail_msg("%s", error.message);
}

static void plan_counts_the_new_triangles(void **unused)
{
    (void)unused;
    lsf_scene *scene = round_scene();
    lsf_setup setup;
    setup_with(&setup, scene, "tessellation.factor=1");
    assert_ptr_equal(setup.scene, scene);
    lsf_setup_finish(&setup);
    setup_with(&setup, scene, "tessellation.factor=3");
    assert_int_equal(lsf_plan_find(setup.plan, "scene.indices")->bytes, 9 * 4 * scene->index_count);
    assert_int_equal(lsf_plan_find(setup.plan, "scene.positions")->bytes,
                     12 * setup.scene->vertices.count);
    assert_int_equal(setup.plan->requirements.triangles, 180);
    /* The bent icosahedron is larger, and so may be its normalised space. */
    assert_true(setup.state.bounds_max[1] <= 1.0f);
    char *text = lsf_plan_describe(setup.plan, false);
    assert_non_null(strstr(text, "tessellation.factor=3: 20 triangles became 180"));
    free(text);
    lsf_setup_finish(&setup);
    destroy_scene(scene);
}

static void too_many_triangles_are_refused(void **unused)
{
    (void)unused;
    lsf_scene *scene = round_scene();
    scene->primitives[0].index_count = 3 << 24;
    lsf_error error = {0};
    assert_null(lsf_scene_tessellate(scene, 16, 0.75f, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    assert_non_null(strstr(error.message, "tessellation.factor=16"));
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_things_get_rounder),
        cmocka_unit_test(points_are_those_of_the_paper),
        cmocka_unit_test(flat_things_stay_flat),
        cmocka_unit_test(no_gaps_open),
        cmocka_unit_test(every_stream_is_carried),
        cmocka_unit_test(plan_counts_the_new_triangles),
        cmocka_unit_test(too_many_triangles_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
