/* Ray-bundles: lists that hold every fragment, and searches that find the nearest, whatever the
 * order. */
#include <math.h>

#include "bundle_rig.h"
#include "shared/scene_data.h"

static const float eye[3] = {0.3f, 0.5f, 2.9f}, target[3] = {0, 0, 0};
static const lsf_float3 along = {0.48f, 0.64f, 0.6f};

static lsf_render_params view_params(uint32_t width, uint32_t height)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    params.width = width;
    params.height = height;
    params.camera_position = eye;
    params.camera_target = target;
    params.fov_y = 50.0f;
    return params;
}

static lsf_ray_bundle_params bundle_params(int32_t resolution, lsf_ray_bundle_raster raster)
{
    lsf_ray_bundle_params params = {LSF_RAY_BUNDLE_PARAMS_DEFAULTS};
    params.resolution = resolution;
    params.raster = raster;
    return params;
}

/* A room with a sphere in it, whose triangles are small. */
static lsf_scene *room(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-1.5f, -1.5f, -3), lsf_f3(1.5f, 1.5f, 3), true);
    build_material(scene, 0.9f, 0.2f, 0.1f);
    build_sphere(scene, 4, false);
    finish_gl_scene(scene);
    return scene;
}

static uint64_t count_of(const bundle_rig *rig, int which)
{
    return lsf_ray_bundle_counts(rig->bundle)[which];
}

/* Rays in a box seen from inside, which may not be the whole scene, meet its far walls, at a
 * distance in closed form. */
static void check_box(const lsf_scene *scene, lsf_ray_bundle_window window)
{
    const lsf_render_params view = view_params(64, 48);
    lsf_ray_bundle_params params = bundle_params(256, LSF_RAY_BUNDLE_RASTER_COMPUTE);
    params.window = window;
    bundle_rig rig;
    bundle_rig_run(&rig, scene, &view, &params, along, false);
    uint32_t right = 0, seen = 0;
    for (uint32_t y = 0; y < rig.height; y++)
        for (uint32_t x = 0; x < rig.width; x++) {
            lsf_float3 p, n;
            if (!bundle_rig_origin(&rig, x, y, &p, &n))
                continue;
            seen++;
            float sign = lsf_f3_dot(n, along) > 0.0f ? 1.0f : -1.0f, expected = INFINITY;
            const float at[3] = {p.x, p.y, p.z};
            const float ray[3] = {sign * along.x, sign * along.y, sign * along.z};
            const lsf_instance_state *box = &rig.setup.state.instances[0];
            const float *high = box->bounds_max, *low = box->bounds_min;
            float size = high[0] - low[0];
            for (int axis = 0; axis < 3; axis++) {
                float wall = ray[axis] > 0.0f ? high[axis] : low[axis];
                float t = (wall - at[axis]) / ray[axis];
                expected = t > 1e-4f * size ? fminf(expected, t) : expected;
            }
            uint32_t node;
            float distance = bundle_rig_distance(&rig, x, y, &node);
            right += fabsf(distance - expected) < 0.01f * expected + 0.01f * size;
        }
    print_message("%u of %u right\n", right, seen);
    /* Those in the texel along an edge may see the wrong one of its two walls. */
    assert_true(seen == rig.width * rig.height && right > 0.99 * seen);
    bundle_rig_finish(&rig);
}

static void box_from_inside(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-1, -1, -3), lsf_f3(1, 1, 3), true);
    finish_gl_scene(scene);
    check_box(scene, LSF_RAY_BUNDLE_WINDOW_AUTO);
    destroy_scene(scene);
}

/* A triangle that makes a box's scene a thousand times as large, in any direction, takes no texels
 * from the box, whether bundles hold all of the scene or what is seen. */
static void box_beside_a_stray_triangle(void **unused)
{
    (void)unused;
    static const lsf_float3 places[] = {{2000, 0, 0}, {-900, 1900, 0}, {1300, -1100, 1500}};
    for (int i = 0; i < 3; i++)
        for (int window = LSF_RAY_BUNDLE_WINDOW_VISIBLE; window <= LSF_RAY_BUNDLE_WINDOW_SCENE;
             window++) {
            const lsf_float3 p = places[i];
            const lsf_float3 stray[3] = {
                p, {p.x + 1e-3f, p.y, p.z}, {p.x, p.y + 1e-3f, p.z + 1e-3f}};
            lsf_scene *scene = build_scene();
            build_material(scene, 0.5f, 0.5f, 0.5f);
            build_box(scene, lsf_f3(-1, -1, -3), lsf_f3(1, 1, 3), true);
            build_triangles(scene, stray, 1);
            finish_gl_scene(scene);
            check_box(scene, (lsf_ray_bundle_window)window);
            destroy_scene(scene);
        }
}

/* Rays go as far as they went before what is empty was taken out of the map. */
static void across_a_gap(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    for (int wall = 0; wall < 2; wall++) {
        float z = wall ? 700.0f : 0.0f, half = wall ? 10.0f : 4.0f;
        const lsf_float3 corners[6] = {{-half, -half, z}, {half, -half, z}, {half, half, z},
                                       {-half, -half, z}, {half, half, z},  {-half, half, z}};
        build_triangles(scene, corners, 2);
    }
    finish_gl_scene(scene);
    const lsf_render_params view = view_params(32, 32);
    lsf_ray_bundle_params params = bundle_params(128, LSF_RAY_BUNDLE_RASTER_COMPUTE);
    bundle_rig rig;
    bundle_rig_run(&rig, scene, &view, &params, lsf_f3(0, 0, -1), false);
    assert_true(rig.data.range.y < 0.1f);
    for (uint32_t i = 0; i < 32 * 32; i++) {
        uint32_t node;
        float distance = bundle_rig_distance(&rig, i % 32, i / 32, &node);
        assert_true(fabsf(distance / (700.0f * (float)rig.setup.state.scale) - 1.0f) < 1e-5f);
    }
    bundle_rig_finish(&rig);
    destroy_scene(scene);
}

/* Both ways to rasterise put the same number of fragments into every texel; in sum it is what
 * GL_SAMPLES_PASSED counts; and rays meet the same. */
static void rasters_agree(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    const lsf_render_params view = view_params(80, 60);
    bundle_rig rigs[2];
    uint32_t *keys[2];
    for (int i = 0; i < 2; i++) {
        const lsf_ray_bundle_params params =
            bundle_params(200, i == 0 ? LSF_RAY_BUNDLE_RASTER_GL : LSF_RAY_BUNDLE_RASTER_COMPUTE);
        bundle_rig_run(&rigs[i], scene, &view, &params, along, false);
        keys[i] = bundle_rig_array(&rigs[i], LSF_RAY_BUNDLE_KEYS);
        uint64_t sum = 0;
        for (uint32_t t = 0; t < 200 * 200; t++)
            sum += keys[i][4 * t];
        assert_int_equal(sum, count_of(&rigs[i], LSF_RAY_BUNDLE_NODES));
    }
    for (uint32_t t = 0; t < 200 * 200; t++)
        assert_int_equal(keys[0][4 * t], keys[1][4 * t]);
    uint32_t different = 0;
    for (uint32_t y = 0; y < 60; y++)
        for (uint32_t x = 0; x < 80; x++) {
            uint32_t nodes[2];
            float a = bundle_rig_distance(&rigs[0], x, y, &nodes[0]);
            float b = bundle_rig_distance(&rigs[1], x, y, &nodes[1]);
            different += !(fabsf(a - b) <= 1e-3f) && (isfinite(a) || isfinite(b));
        }
    print_message("%u rays differ\n", different);
    /* Slopes are derivatives of interpolated depth there, and of the triangle's plane here: rays
     * may fall on different sides of the tolerance that tells their own surface. */
    assert_true(different <= 80 * 60 / 200);
    for (int i = 0; i < 2; i++) {
        free(keys[i]);
        bundle_rig_finish(&rigs[i]);
    }
    destroy_scene(scene);
}

static float half_of(uint32_t bits)
{
    return (float)(int8_t)bits / (128.0f - fabsf((float)(int8_t)bits));
}

/* The key of a texel's `i`-th fragment; `link` walks the chain. */
static uint32_t key_of(uint32_t *const arrays[], const lsf_ray_bundle_params *params,
                       uint32_t texel, uint32_t i, uint32_t *link)
{
    uint32_t texels = (uint32_t)lsf_ray_bundle_texels(params), place = i + 1;
    uint32_t slices = (uint32_t)lsf_ray_bundle_slices(params);
    if (i < slices)
        return arrays[LSF_RAY_BUNDLE_KEYS][((place >> 2) * texels + texel) * 4 + (place & 3)];
    *link = i == slices ? arrays[LSF_RAY_BUNDLE_HEADS][LSF_BUNDLE_COUNTERS + texel]
                        : arrays[LSF_RAY_BUNDLE_CHAIN][2 * *link + 1];
    return arrays[LSF_RAY_BUNDLE_CHAIN][2 * *link];
}

/* Tiles of 8 x 8. */
static uint32_t texel_at(const lsf_ray_bundle_params *params, uint32_t x, uint32_t y)
{
    uint32_t tiles = ((uint32_t)params->resolution + 7) / 8;
    return (y / 8 * tiles + x / 8) * 64 + y % 8 * 8 + x % 8;
}

/* Distance of the nearest plane among a texel's, by trying them all. */
static float brute_force(const bundle_rig *rig, uint32_t *const arrays[],
                         const lsf_ray_bundle_params *params, lsf_float3 p, lsf_float3 n,
                         float *from_border)
{
    const struct lsf_bundle_data *b = &rig->data;
    float side = (float)params->resolution;
    float x = lsf_f3_dot(p, lsf_f3_load(&b->right.x)), y = lsf_f3_dot(p, lsf_f3_load(&b->up.x));
    float place[2] = {((x - b->window.x) / b->window.z * 0.5f + 0.5f) * side,
                      ((y - b->window.y) / b->window.w * 0.5f + 0.5f) * side};
    float texel[2] = {2.0f * b->window.z / side, 2.0f * b->window.w / side};
    float off[2] = {place[0] - floorf(place[0]) - 0.5f, place[1] - floorf(place[1]) - 0.5f};
    *from_border = 0.5f - fmaxf(fabsf(off[0]), fabsf(off[1]));
    float sign = lsf_f3_dot(n, lsf_f3_load(&b->forward.x)) > 0.0f ? 1.0f : -1.0f;
    float z = lsf_f3_dot(p, lsf_f3_load(&b->forward.x)) - b->range.x;
    float tolerance =
        LSF_BUNDLE_SELF_TEXELS * fmaxf(texel[0], texel[1]) + 0.5f * b->range.y / 65535.0f;
    uint32_t at = texel_at(params, (uint32_t)place[0], (uint32_t)place[1]);
    float nearest = INFINITY;
    for (uint32_t i = 0, link = 0; i < arrays[LSF_RAY_BUNDLE_KEYS][4 * at]; i++) {
        uint32_t key = key_of(arrays, params, at, i, &link);
        float slope[2] = {half_of(key >> 8), half_of(key)};
        float depth = (float)(key >> 16) / 65535.0f * b->range.y + slope[0] * off[0] * texel[0] +
                      slope[1] * off[1] * texel[1];
        float distance = sign * (depth - z);
        float steep = 1.0f + slope[0] * slope[0] + slope[1] * slope[1];
        if (distance > 0.0f && distance * distance > tolerance * tolerance * steep)
            nearest = fminf(nearest, distance);
    }
    return nearest;
}

/* The search finds what trying every node of the texel finds, in slices and in chains. */
static void search_is_brute_force(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    const lsf_render_params view = view_params(96, 64);
    static const int32_t slices[] = {15, 2, 0};
    for (int i = 0; i < 3; i++) {
        lsf_ray_bundle_params params = bundle_params(124, LSF_RAY_BUNDLE_RASTER_COMPUTE);
        params.slices = slices[i];
        bundle_rig rig;
        bundle_rig_run(&rig, scene, &view, &params, along, false);
        uint32_t *arrays[LSF_RAY_BUNDLE_ARRAYS] = {NULL};
        for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++)
            if (rig.bundle->slots[0].arrays[array])
                arrays[array] = bundle_rig_array(&rig, array);
        uint32_t wrong = 0;
        for (uint32_t y = 0; y < rig.height; y++)
            for (uint32_t x = 0; x < rig.width; x++) {
                lsf_float3 p, n;
                uint32_t node;
                float border;
                assert_true(bundle_rig_origin(&rig, x, y, &p, &n));
                float found = bundle_rig_distance(&rig, x, y, &node);
                float expected = brute_force(&rig, arrays, &params, p, n, &border);
                bool same = (isinf(found) && isinf(expected)) || fabsf(found - expected) < 1e-4f;
                wrong += !same && border > 1e-3f; /* rounding may choose the next texel */
            }
        print_message("%d slices: %u wrong, %llu nodes, %llu of them chained\n", slices[i], wrong,
                      (unsigned long long)count_of(&rig, LSF_RAY_BUNDLE_NODES),
                      (unsigned long long)count_of(&rig, LSF_RAY_BUNDLE_OVERFLOW));
        /* Rounding at the tolerance, too. */
        assert_true(wrong <= rig.width * rig.height / 1000);
        for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++)
            free(arrays[array]);
        bundle_rig_finish(&rig);
    }
    destroy_scene(scene);
}

/* All hits of a run, by what tells them apart; four words a pixel, to be freed. */
static uint32_t *hits_of(const lsf_scene *scene, const lsf_ray_bundle_params *params,
                         uint64_t counts[LSF_RAY_BUNDLE_COUNTS])
{
    const lsf_render_params view = view_params(64, 48);
    bundle_rig rig;
    bundle_rig_run(&rig, scene, &view, params, along, false);
    uint32_t *surfaces = bundle_rig_array(&rig, LSF_RAY_BUNDLE_SURFACES);
    uint32_t *words = malloc(64 * 48 * 4 * sizeof *words);
    for (uint32_t pixel = 0; pixel < 64 * 48; pixel++)
        bundle_rig_hit_words(&rig, surfaces, pixel, words + 4 * (size_t)pixel);
    memcpy(counts, lsf_ray_bundle_counts(rig.bundle), LSF_RAY_BUNDLE_COUNTS * sizeof *counts);
    free(surfaces);
    bundle_rig_finish(&rig);
    return words;
}

#define HIT_BYTES (64 * 48 * 4 * sizeof(uint32_t))

/* Too little room by one node, twice and a hundredfold: the same hits as with ample room. */
static void capacity_grows(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    for (int raster = 0; raster < 2; raster++) {
        lsf_ray_bundle_params params = bundle_params(64, (lsf_ray_bundle_raster)raster);
        uint64_t counts[LSF_RAY_BUNDLE_COUNTS];
        params.slices = 0;
        params.capacity = 32.0f;
        uint32_t *ample = hits_of(scene, &params, counts);
        double needed = (double)counts[LSF_RAY_BUNDLE_OVERFLOW];
        assert_true(counts[LSF_RAY_BUNDLE_REGROWN] == 0 && needed > 1000.0);
        const double rooms[] = {needed, needed - 1.0, needed / 2.0, needed / 100.0};
        for (int i = 0; i < 4; i++) {
            params.capacity = (float)(floor(rooms[i]) / (64.0 * 64.0));
            uint32_t *hits = hits_of(scene, &params, counts);
            assert_int_equal(counts[LSF_RAY_BUNDLE_REGROWN], i == 0 ? 0 : 1);
            assert_memory_equal(hits, ample, HIT_BYTES);
            free(hits);
        }
        free(ample);
    }
    destroy_scene(scene);
}

/* Without surfaces, rays go as far. */
static void distances_alone(void **unused)
{
    (void)unused;
    lsf_scene *scene = room();
    const lsf_render_params view = view_params(64, 48);
    const lsf_ray_bundle_params params = bundle_params(100, LSF_RAY_BUNDLE_RASTER_COMPUTE);
    bundle_rig rigs[2];
    for (int i = 0; i < 2; i++)
        bundle_rig_run(&rigs[i], scene, &view, &params, along, i == 1);
    for (uint32_t i = 0; i < 64 * 48; i++)
        assert_int_equal(rigs[0].hits[2 * i], rigs[1].hits[2 * i]);
    assert_int_equal(rigs[1].bundle->slots[0].arrays[LSF_RAY_BUNDLE_SURFACES], 0);
    for (int i = 0; i < 2; i++)
        bundle_rig_finish(&rigs[i]);
    destroy_scene(scene);
}

static void threads_change_nothing(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    lsf_scene *scene = room();
    lsf_ray_bundle_params params = bundle_params(100, LSF_RAY_BUNDLE_RASTER_COMPUTE);
    params.slices = 0;
    uint32_t *hits[3];
    uint64_t counts[LSF_RAY_BUNDLE_COUNTS];
    for (int i = 0; i < 3; i++) {
        setenv("LP_NUM_THREADS", threads[i], 1);
        hits[i] = hits_of(scene, &params, counts);
        assert_memory_equal(hits[i], hits[0], HIT_BYTES);
    }
    unsetenv("LP_NUM_THREADS");
    for (int i = 0; i < 3; i++)
        free(hits[i]);
    destroy_scene(scene);
}

/* Walls that coincide, of different colours, in either order: the same one is met. */
static void coinciding_surfaces(void **unused)
{
    (void)unused;
    uint32_t *hits[2];
    uint64_t counts[LSF_RAY_BUNDLE_COUNTS];
    for (int order = 0; order < 2; order++) {
        lsf_scene *scene = build_scene();
        for (int i = 0; i < 3; i++) {
            float color = 0.2f + 0.3f * (float)(order == 0 ? i : 2 - i);
            build_material(scene, color, 1.0f - color, 0.5f);
            build_box(scene, lsf_f3(-1.5f, -1.5f, -3), lsf_f3(1.5f, 1.5f, 3), true);
        }
        finish_gl_scene(scene);
        const lsf_ray_bundle_params params = bundle_params(100, LSF_RAY_BUNDLE_RASTER_COMPUTE);
        hits[order] = hits_of(scene, &params, counts);
        destroy_scene(scene);
    }
    assert_memory_equal(hits[0], hits[1], HIT_BYTES);
    free(hits[0]);
    free(hits[1]);
}

/* Thousands of layers in every texel: each ray meets the layer next to the one it left. */
static void thousands_of_layers(void **unused)
{
    (void)unused;
    enum { LAYERS = 3000 };
    lsf_float3 *corners = malloc(3 * LAYERS * sizeof *corners);
    for (int i = 0; i < LAYERS; i++) {
        float z = -2.0f * (float)i / LAYERS;
        corners[3 * i] = lsf_f3(-4, -4, z);
        corners[3 * i + 1] = lsf_f3(8, -4, z);
        corners[3 * i + 2] = lsf_f3(-4, 8, z);
    }
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_triangles(scene, corners, LAYERS);
    free(corners);
    finish_gl_scene(scene);
    /* The eye is between two layers of the middle. */
    const float position[3] = {0.3f, 0.5f, -1.0003f}, below[3] = {0.3f, 0.5f, -2};
    lsf_render_params view = view_params(16, 16);
    view.camera_position = position;
    view.camera_target = below;
    const lsf_ray_bundle_params params = bundle_params(16, LSF_RAY_BUNDLE_RASTER_COMPUTE);
    bundle_rig rig;
    bundle_rig_run(&rig, scene, &view, &params, lsf_f3(0, 0, -1), false);
    uint64_t nodes = count_of(&rig, LSF_RAY_BUNDLE_NODES);
    assert_int_equal(nodes, 16 * 16 * LAYERS);
    assert_int_equal(count_of(&rig, LSF_RAY_BUNDLE_OVERFLOW), nodes - 16 * 16 * 15);
    float spacing = 2.0f / LAYERS * (float)rig.setup.state.scale;
    for (uint32_t i = 0; i < 16 * 16; i++) {
        uint32_t node;
        float distance = bundle_rig_distance(&rig, i % 16, i / 16, &node);
        assert_true(fabsf(distance / spacing - 1.0f) < 0.1f); /* 16 bits of depth */
    }
    bundle_rig_finish(&rig);
    destroy_scene(scene);
}

static void empty_and_flat(void **unused)
{
    (void)unused;
    uint64_t counts[LSF_RAY_BUNDLE_COUNTS];
    const lsf_float3 corners[3] = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    for (int kind = 0; kind < 2; kind++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 1, 1, 1);
        if (kind == 1)
            build_triangles(scene, corners, 1);
        finish_gl_scene(scene);
        for (int window = 1; window <= 2; window++) {
            lsf_ray_bundle_params params = bundle_params(16, LSF_RAY_BUNDLE_RASTER_COMPUTE);
            params.window = window;
            uint32_t *hits = hits_of(scene, &params, counts);
            for (uint32_t i = 0; i < 64 * 48; i++)
                assert_int_equal(hits[4 * i], 0);
            assert_true(kind == 0 ? counts[LSF_RAY_BUNDLE_NODES] == 0
                                  : counts[LSF_RAY_BUNDLE_NODES] > 0);
            free(hits);
        }
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_from_inside),       cmocka_unit_test(box_beside_a_stray_triangle),
        cmocka_unit_test(across_a_gap),          cmocka_unit_test(rasters_agree),
        cmocka_unit_test(search_is_brute_force), cmocka_unit_test(capacity_grows),
        cmocka_unit_test(distances_alone),       cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(coinciding_surfaces),   cmocka_unit_test(thousands_of_layers),
        cmocka_unit_test(empty_and_flat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
