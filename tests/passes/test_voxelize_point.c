/* The surface that a voxel keeps is the one nearest to its centre, at the nearest point of it,
 * against closest points on triangles in double precision; with the normals of its plane and of its
 * shading, and with what is beside it.
 */
#include <math.h>

#include "passes/voxelize_parts.h"
#include "voxel_rig.h"

typedef struct point3 {
    double x, y, z;
} point3;

static point3 along(point3 p, point3 v, double t)
{
    return (point3){p.x + t * v.x, p.y + t * v.y, p.z + t * v.z};
}

static point3 between(point3 a, point3 b)
{
    return (point3){b.x - a.x, b.y - a.y, b.z - a.z};
}

static double dot(point3 a, point3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* By the region of the triangle's plane that p is over: of a corner, of an edge, or of the inside.
 */
static point3 closest_point(point3 a, point3 b, point3 c, point3 p)
{
    point3 ab = between(a, b), ac = between(a, c), bc = between(b, c);
    double at_a[2] = {dot(ab, between(a, p)), dot(ac, between(a, p))};
    double at_b[2] = {dot(ab, between(b, p)), dot(ac, between(b, p))};
    double at_c[2] = {dot(ab, between(c, p)), dot(ac, between(c, p))};
    if (at_a[0] <= 0 && at_a[1] <= 0)
        return a;
    if (at_b[0] >= 0 && at_b[1] <= at_b[0])
        return b;
    if (at_c[1] >= 0 && at_c[0] <= at_c[1])
        return c;
    /* Areas over the edges, twice the triangle's side lengths. */
    double over_ab = at_a[0] * at_b[1] - at_b[0] * at_a[1];
    double over_ac = at_c[0] * at_a[1] - at_a[0] * at_c[1];
    double over_bc = at_b[0] * at_c[1] - at_c[0] * at_b[1];
    if (over_ab <= 0 && at_a[0] >= 0 && at_b[0] <= 0)
        return along(a, ab, at_a[0] / dot(ab, ab));
    if (over_ac <= 0 && at_a[1] >= 0 && at_c[1] <= 0)
        return along(a, ac, at_a[1] / dot(ac, ac));
    if (over_bc <= 0)
        return along(b, bc, dot(bc, between(b, p)) / dot(bc, bc));
    double sum = over_ab + over_ac + over_bc;
    return along(along(a, ab, over_ac / sum), ac, over_ab / sum);
}

static double clamp_unit(double x)
{
    return fmin(fmax(x, 0.0), 1.0);
}

enum { MOST = 16 };

typedef struct shapes {
    lsf_float3 corners[3 * MOST];
    uint32_t count;
} shapes;

/* Corners in voxels. */
static void to_grid(const voxel_rig *v, const shapes *s, point3 corners[3 * MOST])
{
    const struct lsf_voxel_grid_data grid = lsf_voxel_grid_data(&v->grid, &v->iteration);
    const lsf_state *state = &v->setup.state;
    for (uint32_t i = 0; i < 3 * s->count; i++) {
        const lsf_float3 *p = &s->corners[i];
        const double at[3] = {(double)p->x, (double)p->y, (double)p->z};
        double q[3];
        for (int axis = 0; axis < 3; axis++)
            q[axis] =
                ((at[axis] - state->center[axis]) * state->scale - (double)(&grid.origin.x)[axis]) /
                (double)grid.origin.w;
        corners[i] = (point3){q[0], q[1], q[2]};
    }
}

/* How far the point kept in a voxel is from the nearest point, in the voxel, of a triangle that may
 * have won. None that is sure to touch the voxel, as its nearest point is within, is nearer by more
 * than a bid's step. */
static double point_error(const shapes *s, const point3 *corners, point3 cell, uint32_t bits)
{
    const double step = 1e-3;
    point3 center = along(cell, (point3){1, 1, 1}, 0.5);
    point3 kept = {(bits & 1023u) / 1023.0, (bits >> 10 & 1023u) / 1023.0,
                   (bits >> 20 & 1023u) / 1023.0};
    point3 nearest[MOST];
    double distance[MOST], least = INFINITY, error = INFINITY;
    for (uint32_t i = 0; i < s->count; i++) {
        const point3 *c = corners + 3 * (size_t)i;
        nearest[i] = closest_point(c[0], c[1], c[2], center);
        point3 way = between(nearest[i], center);
        distance[i] = sqrt(dot(way, way));
        if (fmax(fabs(way.x), fmax(fabs(way.y), fabs(way.z))) <= 0.5)
            least = fmin(least, distance[i]);
    }
    for (uint32_t i = 0; i < s->count; i++) {
        if (distance[i] > least + step)
            continue;
        point3 in = between(cell, nearest[i]);
        point3 off = between(kept, (point3){clamp_unit(in.x), clamp_unit(in.y), clamp_unit(in.z)});
        error = fmin(error, sqrt(dot(off, off)));
    }
    return error;
}

static void check_points(const char *name, const shapes *s, int32_t resolution)
{
    point3 corners[3 * MOST];
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_triangles(scene, s->corners, s->count);
    finish_gl_scene(scene);
    voxel_rig v;
    voxel_rig_init(&v, scene, resolution, LSF_VOXELIZE_COMPUTE, true, 0);
    voxel_rig_run(&v, 0);
    to_grid(&v, s, corners);
    uint8_t *set = voxel_rig_read_occupancy(&v);
    uint32_t *points = voxel_rig_read_texture(v.outputs->point, voxel_rig_voxel_count(&v));
    uint32_t found = 0;
    double worst = 0.0;
    for (uint32_t z = 0, i = 0; z < v.grid.size[2]; z++)
        for (uint32_t y = 0; y < v.grid.size[1]; y++)
            for (uint32_t x = 0; x < v.grid.size[0]; x++, i++) {
                if (!set[i])
                    continue;
                found++;
                worst = fmax(worst, point_error(s, corners, (point3){x, y, z}, points[i]));
            }
    print_message("%s: %u voxels, points at most %g voxel off\n", name, found, worst);
    assert_true(found > 100);
    /* Of 1/1023 along each axis half is rounding. */
    assert_true(worst < 2e-3);
    free(set);
    free(points);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

/* Long and narrow, two of them side by side in one plane. */
static void long_triangles(void **unused)
{
    (void)unused;
    const shapes one = {{{0, 0, 0}, {100, 0, 0}, {30, 4, 0}}, 1};
    const shapes two = {
        {{0, 0, 0}, {100, 0, 0}, {30, 4, 0}, {0, -1.3f, 0}, {100, -0.6f, 0}, {0, -0.6f, 0}}, 2};
    check_points("100 x 4", &one, 102);
    check_points("100 x 4 beside another", &two, 102);
}

static float random_float(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static void any_triangles(void **unused)
{
    (void)unused;
    uint32_t state = 3;
    for (int turn = 0; turn < 4; turn++) {
        shapes s = {.count = MOST};
        for (uint32_t i = 0; i < 3 * s.count; i++) {
            float x = random_float(&state), y = random_float(&state), z = random_float(&state);
            s.corners[i] = lsf_f3(x, y, turn % 2 ? 0.05f * z : z);
        }
        check_points("any", &s, 40);
    }
}

/* --- normals --- */

/* Unit, from octahedral 2 x 12 bits. */
static lsf_float3 unpack_normal(uint32_t bits)
{
    float x = (float)(bits & 4095u) / 2047.0f - 1.0f,
          y = (float)(bits >> 12 & 4095u) / 2047.0f - 1.0f;
    float z = 1.0f - fabsf(x) - fabsf(y), fold = fmaxf(-z, 0.0f);
    return lsf_f3_normalize(lsf_f3(x > 0 ? x - fold : x + fold, y > 0 ? y - fold : y + fold, z));
}

static void check_normals(lsf_scene *scene, lsf_float3 plane, lsf_float3 shading, bool bent)
{
    finish_gl_scene(scene);
    assert_int_equal(scene->requirements.smooth, bent);
    voxel_rig v;
    voxel_rig_init(&v, scene, 32, LSF_VOXELIZE_COMPUTE, true, 0);
    voxel_rig_run(&v, 0);
    size_t count = voxel_rig_voxel_count(&v);
    uint8_t *set = voxel_rig_read_occupancy(&v);
    uint32_t *normals = voxel_rig_read_texture(v.outputs->normal, count);
    uint32_t *bends = NULL;
    if (bent)
        bends = voxel_rig_read_texture(v.outputs->shading, count);
    else
        assert_int_equal(v.outputs->shading, 0);
    uint32_t found = 0;
    for (size_t i = 0; i < count; i++) {
        if (!set[i])
            continue;
        found++;
        assert_true(lsf_f3_dot(unpack_normal(normals[i]), plane) > 0.999998f);
        assert_int_equal(normals[i] >> 24, 0); /* all beside it are in its plane */
        assert_true(!bent || lsf_f3_dot(unpack_normal(bends[i]), shading) > 0.999998f);
    }
    assert_true(found > 100);
    free(set);
    free(normals);
    free(bends);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

/* A square with its own normals, and with normals that lean by 30 degrees. */
static void normals_of_plane_and_shading(void **unused)
{
    (void)unused;
    const lsf_float3 up = lsf_f3(0, 1, 0), leaning = lsf_f3(0.5f, 0.8660254f, 0);
    for (int bent = 0; bent < 2; bent++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 0.5f, 0.5f, 0.5f);
        build_floor(scene, 0.0f, 1.0f);
        for (uint64_t i = 0; bent && i < scene->vertices.count; i++)
            memcpy(scene->vertices.normal + 3 * i, &leaning, sizeof leaning);
        check_normals(scene, up, leaning, bent);
    }
}

/* A floor and a wall whose edge is on both fronts: voxels along it know, and all others have only
 * their own plane beside them. */
static void edge_of_two_planes(void **unused)
{
    (void)unused;
    const shapes corner = {{{0, 0, 0},
                            {0, 0, 1},
                            {1, 0, 1},
                            {0, 0, 0},
                            {1, 0, 1},
                            {1, 0, 0},
                            {0, 0, 0},
                            {0, 1, 0},
                            {0, 1, 1},
                            {0, 0, 0},
                            {0, 1, 1},
                            {0, 0, 1}},
                           4};
    point3 corners[3 * MOST];
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_triangles(scene, corner.corners, corner.count);
    finish_gl_scene(scene);
    voxel_rig v;
    voxel_rig_init(&v, scene, 32, LSF_VOXELIZE_COMPUTE, true, 0);
    voxel_rig_run(&v, 0);
    to_grid(&v, &corner, corners);
    uint8_t *set = voxel_rig_read_occupancy(&v);
    uint32_t *normals = voxel_rig_read_texture(v.outputs->normal, voxel_rig_voxel_count(&v));
    uint32_t edges = 0;
    for (uint32_t z = 0, i = 0; z < v.grid.size[2]; z++)
        for (uint32_t y = 0; y < v.grid.size[1]; y++)
            for (uint32_t x = 0; x < v.grid.size[0]; x++, i++) {
                double off = fmax(fabs(x + 0.5 - corners[0].x), fabs(y + 0.5 - corners[0].y));
                if (!set[i])
                    continue;
                /* Each lies in front of the other (2), never behind it (3). */
                assert_true(normals[i] >> 30 != 3u);
                assert_true(off < 2.0 || normals[i] >> 24 == 0);
                edges += normals[i] >> 30 == 2u;
            }
    print_message("%u voxels along the edge\n", edges);
    assert_in_range(edges, 30, 90);
    free(set);
    free(normals);
    voxel_rig_finish(&v);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_triangles),
        cmocka_unit_test(any_triangles),
        cmocka_unit_test(normals_of_plane_and_shading),
        cmocka_unit_test(edge_of_two_planes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
