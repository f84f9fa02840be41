/* Voxelisation against an exact triangle-box test in double precision: no voxel is missing, none is
 * there that no triangle touches, and every run gives the same bits. */
#include <math.h>

#include "voxel_rig.h"

/* What rounding may do to the distance between a triangle and a voxel: positions are 32-bit floats
 * in a grid of up to 512 voxels. A voxel must be set when a triangle touches it, and may be when
 * one comes this close. [voxels] */
#define ROUNDING (1.0 / 1024.0)

/* --- the exact test: 13 axes that may separate a triangle from a box --- */

typedef struct triangle {
    double p[3][3]; /* [voxels] */
} triangle;

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool separates(const double axis[3], const triangle *t, const double center[3], double half)
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < 3; i++) {
        double from_center[3];
        for (int k = 0; k < 3; k++)
            from_center[k] = t->p[i][k] - center[k];
        low = fmin(low, dot(axis, from_center));
        high = fmax(high, dot(axis, from_center));
    }
    double reach = half * (fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]));
    return low > reach || high < -reach;
}

static bool touches(const triangle *t, const double center[3], double half)
{
    double edges[3][3], normal[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            edges[i][k] = t->p[(i + 1) % 3][k] - t->p[i][k];
    cross(edges[0], edges[1], normal);
    if (separates(normal, t, center, half))
        return false;
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {i == 0, i == 1, i == 2};
        if (separates(axis, t, center, half))
            return false;
        for (int edge = 0; edge < 3; edge++) {
            double both[3];
            cross(axis, edges[edge], both);
            if (separates(both, t, center, half))
                return false;
        }
    }
    return true;
}

/* Of the voxels about a triangle, those it touches get bit 0, those it nearly touches bit 1. Along
 * the normal's longest axis only those about the plane are looked at. */
static void mark(const voxel_rig *v, const triangle *t, uint8_t *marks)
{
    double edges[2][3], normal[3];
    int low[3], high[3];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++)
            edges[i][k] = t->p[i + 1][k] - t->p[0][k];
    cross(edges[0], edges[1], normal);
    if (dot(normal, normal) == 0.0)
        return; /* shows nothing */
    int axis = fabs(normal[0]) >= fabs(normal[1]) && fabs(normal[0]) >= fabs(normal[2]) ? 0
               : fabs(normal[1]) >= fabs(normal[2])                                     ? 1
                                                                                        : 2;
    int u = (axis + 1) % 3, w = (axis + 2) % 3;
    for (int k = 0; k < 3; k++) {
        low[k] = (int)floor(fmin(t->p[0][k], fmin(t->p[1][k], t->p[2][k])) - ROUNDING) - 1;
        high[k] = (int)floor(fmax(t->p[0][k], fmax(t->p[1][k], t->p[2][k])) + ROUNDING) + 1;
    }
    int at[3];
    for (at[u] = low[u]; at[u] <= high[u]; at[u]++)
        for (at[w] = low[w]; at[w] <= high[w]; at[w]++) {
            double middle = t->p[0][axis] - (normal[u] * (at[u] + 0.5 - t->p[0][u]) +
                                             normal[w] * (at[w] + 0.5 - t->p[0][w])) /
                                                normal[axis];
            int first = (int)fmax(low[axis], floor(middle) - 2);
            int last = (int)fmin(high[axis], floor(middle) + 2);
            for (at[axis] = first; at[axis] <= last; at[axis]++) {
                const double center[3] = {at[0] + 0.5, at[1] + 0.5, at[2] + 0.5};
                if (!touches(t, center, 0.5 + ROUNDING))
                    continue;
                for (int k = 0; k < 3; k++)
                    assert_in_range(at[k], 0, v->grid.size[k] - 1);
                marks[at[0] +
                      (size_t)v->grid.size[0] * (size_t)(at[1] + (int)v->grid.size[1] * at[2])] |=
                    touches(t, center, 0.5) ? 3 : 2;
            }
        }
}

static uint8_t *exact_voxels(const voxel_rig *v)
{
    const lsf_scene *scene = v->setup.scene;
    struct lsf_voxel_grid_data grid = lsf_voxel_grid_data(&v->grid, &v->iteration);
    const float *origin = &grid.origin.x;
    uint8_t *marks = calloc(voxel_rig_voxel_count(v), 1);
    for (uint32_t i = 0; i < v->setup.state.instance_count; i++) {
        const lsf_instance_state *instance = &v->setup.state.instances[i];
        const lsf_primitive *primitive = &scene->primitives[instance->primitive];
        triangle t;
        for (uint32_t k = 0; k < primitive->index_count; k++) {
            const float *p =
                scene->vertices.position + 3 * (size_t)scene->indices[primitive->first_index + k];
            for (int row = 0; row < 3; row++) {
                const float *m = instance->transform + 4 * row;
                double position = (double)m[0] * (double)p[0] + (double)m[1] * (double)p[1] +
                                  (double)m[2] * (double)p[2] + (double)m[3];
                t.p[k % 3][row] = (position - (double)origin[row]) / (double)grid.origin.w;
            }
            if (k % 3 == 2)
                mark(v, &t, marks);
        }
    }
    return marks;
}

static void compare(const char *name, const lsf_scene *scene, int32_t resolution,
                    lsf_voxelize_method method)
{
    voxel_rig v;
    voxel_rig_init(&v, scene, resolution, method, true, 0);
    /* The second one finds what the first one left. */
    voxel_rig_run(&v, 0);
    voxel_rig_run(&v, 1);
    uint8_t *set = voxel_rig_read_occupancy(&v), *marks = exact_voxels(&v);
    size_t missing = 0, excess = 0, exact = 0;
    for (size_t i = 0; i < voxel_rig_voxel_count(&v); i++) {
        exact += marks[i] & 1;
        missing += marks[i] & 1 && !set[i];
        excess += set[i] && !marks[i];
    }
    print_message("%s, %d voxels, %s: %zu touched, %zu missing, %zu in excess\n", name, resolution,
                  method == LSF_VOXELIZE_RASTER ? "raster" : "compute", exact, missing, excess);
    assert_true(exact > 0);
    assert_int_equal(missing, 0);
    assert_int_equal(excess, 0);
    free(set);
    free(marks);
    voxel_rig_finish(&v);
}

static void compare_methods(const char *name, const lsf_scene *scene, int32_t resolution)
{
    compare(name, scene, resolution, LSF_VOXELIZE_COMPUTE);
    compare(name, scene, resolution, LSF_VOXELIZE_RASTER);
}

static void compare_sizes(const char *name, const lsf_scene *scene)
{
    compare_methods(name, scene, 32);
    if (getenv("LSF_TEST_QUICK"))
        return;
    compare_methods(name, scene, 128);
    compare(name, scene, 256, LSF_VOXELIZE_COMPUTE);
}

/* A small linear congruential generator: the same numbers everywhere. */
static float random_float(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static lsf_float3 random_point(uint32_t *state, float size)
{
    float x = random_float(state), y = random_float(state), z = random_float(state);
    return lsf_f3((x - 0.5f) * size, (y - 0.5f) * size, (z - 0.5f) * size);
}

/* Triangles of all sizes: slivers, axis-aligned ones, ones without area, and whatever comes. */
static lsf_scene *soup(uint32_t count)
{
    lsf_scene *scene = build_scene();
    lsf_float3 *corners = malloc(3 * count * sizeof *corners);
    uint32_t state = 7;
    for (uint32_t i = 0; i < count; i++) {
        lsf_float3 *c = corners + 3 * i;
        float size = powf(2.0f, -6.0f * random_float(&state));
        lsf_float3 center = random_point(&state, 2.0f - size);
        for (int k = 0; k < 3; k++)
            c[k] = lsf_f3_mad(center, random_point(&state, size), 1.0f);
        if (i % 4 == 1) /* a sliver */
            c[2] = lsf_f3_mad(c[0], lsf_f3_sub(c[1], c[0]), random_float(&state)),
            c[2].x += 1e-4f * size;
        if (i % 4 == 2) /* along an axis */
            c[1].y = c[2].y = c[0].y;
        if (i % 64 == 3) /* no area */
            c[2] = c[1];
    }
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_triangles(scene, corners, count);
    free(corners);
    finish_gl_scene(scene);
    return scene;
}

static void soup_of_triangles(void **unused)
{
    (void)unused;
    lsf_scene *scene = soup(getenv("LSF_TEST_QUICK") ? 1000 : 10000);
    compare_methods("soup", scene, 32);
    compare_methods("soup", scene, 128);
    destroy_scene(scene);
}

static void shared_scene(const char *name)
{
    const char *root = getenv("LSF_SHARED");
    char path[512];
    lsf_error error = {0};
    snprintf(path, sizeof path, "%s/scenes/%s", root ? root : "", name);
    FILE *file = root ? fopen(path, "rb") : NULL;
    if (!file)
        skip();
    fclose(file);
    lsf_scene *scene = lsf_scene_load(path, NULL, &error);
    if (!scene)
        fail_msg("%s", error.message);
    compare_sizes(name, scene);
    lsf_scene_destroy(scene);
}

static void cornell(void **unused)
{
    (void)unused;
    shared_scene("cornell/cornell_point.gltf");
}

static void atrium(void **unused)
{
    (void)unused;
    shared_scene("atrium/atrium_point.gltf");
}

static void bunny(void **unused)
{
    (void)unused;
    shared_scene("stanford_bunny/stanford_bunny.gltf");
}

/* Walls whose planes are the borders between voxels touch both sides. */
static void plane_on_a_border(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-7, -7, -7), lsf_f3(7, 7, 7), true);
    build_floor(scene, 1.0f, 3.0f);
    finish_gl_scene(scene);
    voxel_rig v;
    voxel_rig_init(&v, scene, 16, LSF_VOXELIZE_COMPUTE, false, 0);
    voxel_rig_run(&v, 0);
    uint8_t *set = voxel_rig_read_occupancy(&v);
    /* A voxel is 1 wide, the floor lies between those of y = 8 and y = 9. */
    for (uint32_t y = 2; y < 14; y++)
        assert_int_equal(set[8 + 16 * (y + 16 * 8)], y == 8 || y == 9);
    free(set);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

/* One triangle along an axis has no extent along it. */
static void flat_scene(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    const lsf_float3 corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    build_triangles(scene, corners, 1);
    finish_gl_scene(scene);
    for (int32_t resolution = 1; resolution <= 256; resolution *= 4)
        compare_methods("one triangle", scene, resolution);
    destroy_scene(scene);
}

static void ten_runs(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    lsf_scene *scene = soup(2000);
    uint32_t *first[2] = {NULL};
    for (int turn = 0; turn < 10; turn++) {
        voxel_rig v;
        setenv("LP_NUM_THREADS", threads[turn % 3], 1);
        voxel_rig_init(&v, scene, 64, turn % 2 ? LSF_VOXELIZE_RASTER : LSF_VOXELIZE_COMPUTE, true,
                       0);
        voxel_rig_run(&v, 0);
        uint32_t *now[2] = {voxel_rig_read_texture(v.outputs->point, voxel_rig_voxel_count(&v)),
                            voxel_rig_read_texture(v.outputs->normal, voxel_rig_voxel_count(&v))};
        uint8_t *set = voxel_rig_read_occupancy(&v);
        for (int i = 0; i < 2; i++) {
            for (size_t k = 0; k < voxel_rig_voxel_count(&v); k++)
                now[i][k] = set[k] ? now[i][k] : 0;
            if (turn == 0)
                first[i] = now[i];
            else
                assert_memory_equal(first[i], now[i], 4 * voxel_rig_voxel_count(&v));
            if (turn > 0)
                free(now[i]);
        }
        free(set);
        voxel_rig_finish(&v);
    }
    unsetenv("LP_NUM_THREADS");
    free(first[0]);
    free(first[1]);
    destroy_scene(scene);
}

/* --- what moves --- */

static void move_to(voxel_rig *v, double time)
{
    lsf_error error = {0};
    const lsf_view_params view = {.time = time, .fov_y = NAN, .aspect = 1.0f};
    if (!lsf_state_update(&v->setup.state, v->setup.scene, &view, &error))
        fail_msg("%s", error.message);
}

/* A room in which a box slides along. */
static lsf_scene *sliding_box(void)
{
    static const float places[6] = {0.0f, 0.0f, 0.0f, 0.4f, 0.1f, 0.013f};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_material(scene, 0.9f, 0.1f, 0.1f);
    lsf_node *box = build_box(scene, lsf_f3(-0.5f, -1, -0.3f), lsf_f3(0, 0.1f, 0.3f), false);
    build_channel(scene, (uint32_t)(box - scene->nodes), LSF_PATH_TRANSLATION, places,
                  sizeof places);
    finish_gl_scene(scene);
    scene->requirements.moving = true; /* nodes made by hand carry no mesh to find */
    return scene;
}

/* Moved step by step, the grid is the same as one made where the box ends; only the box is
 * voxelised again, and nothing where it rests. */
static void moving_box(void **unused)
{
    (void)unused;
    lsf_scene *scene = sliding_box();
    voxel_rig stepped, fresh;
    voxel_rig_init(&stepped, scene, 64, LSF_VOXELIZE_COMPUTE, false, LSF_VOXEL_SIDES_SURFACE);
    voxel_rig_init(&fresh, scene, 64, LSF_VOXELIZE_COMPUTE, false, LSF_VOXEL_SIDES_SURFACE);
    for (uint32_t i = 0; i <= 4; i++) {
        move_to(&stepped, 0.25 * i);
        voxel_rig_run(&stepped, i);
        assert_true(stepped.outputs->changed);
    }
    const uint64_t *counts = lsf_voxelize_counts(stepped.pass);
    assert_int_equal(counts[LSF_VOXELIZE_TRIANGLES], 12 + 5 * 12);
    voxel_rig_run(&stepped, 5);
    assert_false(stepped.outputs->changed);
    assert_int_equal(counts[LSF_VOXELIZE_TRIANGLES], 12 + 5 * 12);
    move_to(&fresh, 1.0);
    voxel_rig_run(&fresh, 5);
    size_t count = voxel_rig_voxel_count(&fresh);
    voxel_rig *const rigs[2] = {&stepped, &fresh};
    uint8_t *set[2];
    uint32_t *albedo[2];
    float *radiance[2];
    for (int i = 0; i < 2; i++) {
        voxel_rig_bind(rigs[i]);
        set[i] = voxel_rig_read_occupancy(rigs[i]);
        albedo[i] = voxel_rig_read_texture(rigs[i]->outputs->albedo, count);
        radiance[i] = voxel_rig_read_radiance(rigs[i]);
    }
    assert_memory_equal(set[0], set[1], count);
    for (size_t i = 0; i < count; i++)
        assert_true(!set[0][i] || albedo[0][i] == albedo[1][i]);
    assert_memory_equal(radiance[0], radiance[1], 2 * count * 16);
    for (int i = 0; i < 2; i++) {
        free(set[i]);
        free(albedo[i]);
        free(radiance[i]);
    }
    voxel_rig_finish(&stepped);
    voxel_rig_finish(&fresh);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soup_of_triangles),
        cmocka_unit_test(cornell),
        cmocka_unit_test(atrium),
        cmocka_unit_test(bunny),
        cmocka_unit_test(plane_on_a_border),
        cmocka_unit_test(flat_scene),
        cmocka_unit_test(ten_runs),
        cmocka_unit_test(moving_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
