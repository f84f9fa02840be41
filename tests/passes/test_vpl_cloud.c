/* The flux of clouds of VPLs against closed forms, by how often the light was reflected. */
#include <math.h>
#include <string.h>

#include "passes/reflective_shadow_map.h"
#include "passes/voxelize.h"
#include "passes/vpl_cloud.h"
#include "render_gl.h"
#include "shared/light.h"
#include "shared/vpl_record.h"
#include "techniques/light_picks.h"
#include "techniques/setup.h"

enum { BOUNCES = 4, COUNT = 40000, RESOLUTION = 128 };

typedef struct cloud_rig {
    lsf_context *context;
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    lsf_voxelize *voxelize;
    lsf_reflective_shadow_map rsm;
    lsf_light_picks picks;
    lsf_vpl_cloud_use use;
    lsf_vpl_cloud cloud;
    struct lsf_vpl_record *records; /* of the last run */
    uint32_t count;
} cloud_rig;

static void require(bool ok, const lsf_error *error)
{
    if (!ok)
        fail_msg("%s", error->message);
}

static lsf_voxel_grid plan_all(cloud_rig *rig, const lsf_vpl_cloud_params *params)
{
    const lsf_pass_params *p = &rig->setup.pass_params;
    lsf_plan *plan = rig->setup.plan;
    const lsf_voxel_grid_use use = {.bytes = lsf_voxelize_bytes(plan, true), .sides = 1};
    lsf_voxel_grid_params grid_params = p->voxel_grid;
    grid_params.resolution = RESOLUTION;
    lsf_voxel_grid grid = lsf_voxel_grid_fit(&grid_params, &rig->setup.state, &use);
    lsf_voxel_grid_set_unit(&grid, rig->setup.scene, &rig->setup.state);
    lsf_voxelize_plan(plan, &p->voxelize, &grid);
    if (rig->use.lights)
        lsf_reflective_shadow_map_plan(
            plan, &p->reflective_shadow_map, &rig->setup.state,
            &(lsf_reflective_shadow_map_use){.sky = plan->sky_lights > 0});
    lsf_vpl_cloud_plan(plan, params, &rig->use);
    return grid;
}

static void init(cloud_rig *rig, const lsf_scene *scene, int32_t directions)
{
    lsf_error error = {0};
    const lsf_vpl_cloud_params params = {.count = COUNT, .directions = directions};
    lsf_render_params render = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = BOUNCES};
    render.technique = "bidirectional";
    render.width = render.height = 16;
    *rig = (cloud_rig){.context = gl_test_context(gl_test_backend(), NULL)};
    require(lsf_setup_begin(&rig->setup, scene, &render, true, &error), &error);
    lsf_plan *plan = rig->setup.plan;
    const lsf_state *state = &rig->setup.state;
    rig->use = (lsf_vpl_cloud_use){.lights = state->light_count > 0 || plan->sky_lights > 0,
                                   .emitters = scene->requirements.emissive,
                                   .bounces = BOUNCES};
    lsf_voxel_grid grid = plan_all(rig, &params);
    require(lsf_scene_gpu_create(&rig->scene, rig->context, plan, scene, state, NULL, &error) &&
                lsf_iteration_create(&rig->iteration, rig->context, plan, &rig->scene, state, NULL,
                                     7, &error) &&
                lsf_voxelize_create(&rig->voxelize, rig->context, plan,
                                    &rig->setup.pass_params.voxelize, &grid, scene, &error) &&
                (!rig->use.lights ||
                 (lsf_reflective_shadow_map_create(&rig->rsm, rig->context, plan, &error) &&
                  lsf_light_picks_init(&rig->picks, plan, scene, state, plan->sky_lights > 0,
                                       &error))) &&
                lsf_vpl_cloud_create(&rig->cloud, rig->context, plan, &params, &rig->use, scene,
                                     state, &error),
            &error);
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, lsf_plan_bytes(plan));
    rig->count = lsf_vpl_cloud_records(&rig->cloud.shape);
    assert_true(rig->count <= COUNT);
    rig->records = calloc(rig->count, sizeof *rig->records);
}

static void draw_light(cloud_rig *rig, uint32_t light)
{
    const lsf_reflective_shadow_map_outputs *out = &rig->rsm.outputs;
    lsf_vpl_cloud_run run =
        lsf_vpl_cloud_deal(&rig->cloud, &rig->iteration, &rig->picks.distribution, light);
    if (run.count == 0)
        return;
    lsf_reflective_shadow_map_run(&rig->rsm, &rig->iteration, light, NULL);
    const lsf_vpl_cloud_inputs inputs = {&out->shadow, &out->seen, out->importance, out->sums};
    lsf_vpl_cloud_light(&rig->cloud, &rig->iteration, &run, &inputs);
}

static void run(cloud_rig *rig, uint32_t index)
{
    lsf_iteration_begin(&rig->iteration, index);
    const lsf_voxels *voxels = lsf_voxelize_run(rig->voxelize, &rig->iteration);
    lsf_vpl_cloud_begin(&rig->cloud, &rig->iteration, rig->picks.power);
    for (uint32_t i = 0; rig->use.lights && i < rig->iteration.light_count; i++)
        draw_light(rig, i);
    lsf_vpl_cloud_bounce(&rig->cloud, &rig->iteration, voxels);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(rig->cloud.records, 0, (GLsizeiptr)(rig->count * sizeof *rig->records),
                            rig->records);
    gl_test_check(rig->context);
}

static void finish(cloud_rig *rig)
{
    lsf_vpl_cloud_destroy(&rig->cloud);
    lsf_light_picks_finish(&rig->picks);
    lsf_reflective_shadow_map_destroy(&rig->rsm);
    lsf_voxelize_destroy(rig->voxelize);
    lsf_iteration_destroy(&rig->iteration);
    lsf_scene_gpu_destroy(&rig->scene);
    lsf_setup_finish(&rig->setup);
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, 0);
    lsf_context_destroy(rig->context);
    free(rig->records);
}

/* Flux by depth and channel, pi times the sum of intensities, as the scene has it: light of a
 * scene scaled by s is scaled by s^2. */
typedef double fluxes[BOUNCES + 1][3];

static void add_flux(const cloud_rig *rig, double weight, fluxes flux)
{
    double unscale = weight * M_PI / (rig->setup.state.scale * rig->setup.state.scale);
    for (uint32_t i = 0; i < rig->count; i++) {
        const struct lsf_vpl_record *r = &rig->records[i];
        uint32_t depth = r->depth_and_lobe & LSF_VPL_DEPTH_MASK;
        assert_true(depth <= BOUNCES);
        flux[depth][0] += unscale * (double)r->intensity.x;
        flux[depth][1] += unscale * (double)r->intensity.y;
        flux[depth][2] += unscale * (double)r->intensity.z;
    }
}

/* Points that begin paths must not lose them: the second vertex is always looked for. */
static uint32_t live_vertices(const cloud_rig *rig, uint32_t vertex)
{
    const lsf_vpl_cloud_shape *shape = &rig->cloud.shape;
    uint32_t live = 0;
    for (uint32_t i = 0; i < shape->paths; i++)
        live += rig->records[shape->points + vertex * shape->paths + i].intensity.x > 0.0f;
    return live;
}

/* The mean over iterations. */
static void flux_of(const lsf_scene *scene, uint32_t iterations, fluxes flux)
{
    cloud_rig rig;
    memset(flux, 0, sizeof(fluxes));
    init(&rig, scene, 0);
    for (uint32_t i = 0; i < iterations; i++) {
        run(&rig, i);
        add_flux(&rig, 1.0 / iterations, flux);
    }
    finish(&rig);
}

static void expect(const char *what, const fluxes flux, int depth, const double expected[3],
                   double tolerance)
{
    for (int c = 0; c < 3; c++) {
        print_message("%s, depth %d: %.6g of %.6g\n", what, depth, flux[depth][c], expected[c]);
        assert_true(fabs(flux[depth][c] - expected[c]) <= tolerance * expected[c]);
    }
}

static const double albedo[3] = {0.8, 0.6, 0.4};

static lsf_scene *closed_box(void)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_box(scene, lsf_f3(-1, -0.8f, -1), lsf_f3(1, 0.8f, 1), true);
    return scene;
}

/* No path leaves, and none meets anything else: what is reflected k times is rho^k of what the
 * light sends out. Up to the second vertex nothing is left to chance, but that a voxel's colour has
 * 11 bits, of the square root. */
static void check_furnace(const char *what, const lsf_scene *scene, double sent)
{
    fluxes flux;
    flux_of(scene, 1, flux);
    for (int depth = 1; depth <= BOUNCES; depth++) {
        double expected[3];
        for (int c = 0; c < 3; c++)
            expected[c] = sent * pow(albedo[c], depth);
        expect(what, (const double(*)[3])flux, depth, expected,
               depth == 1   ? 1e-4
               : depth == 2 ? 2e-3
                            : 0.02);
    }
}

static void closed_box_keeps_the_flux_of_lights(void **unused)
{
    (void)unused;
    lsf_scene *scene = closed_box();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.2f, 0.3f, -0.1f), lsf_f3(0, -1, 0), 3.0f);
    finish_gl_scene(scene);
    check_furnace("point", scene, 12.0 * M_PI);
    destroy_scene(scene);

    scene = closed_box();
    lsf_light *spot =
        build_light(scene, LSF_LIGHT_SPOT, lsf_f3(0.2f, 0.3f, -0.1f), lsf_f3(0.3f, -1, 0.1f), 3.0f);
    spot->inner_cone = 0.3f;
    spot->outer_cone = 0.8f;
    finish_gl_scene(scene);
    /* The ramp a^2 over the cosine, from 1 at the inner cone to 0 at the outer one, integrates to
     * a third of its width. */
    double inner = cos(0.3), outer = cos(0.8);
    check_furnace("spot", scene, 3.0 * 2.0 * M_PI * (1.0 - inner + (inner - outer) / 3.0));
    destroy_scene(scene);
}

/* Lights of very different power together: each has its share of the paths. */
static void lights_add_up(void **unused)
{
    (void)unused;
    lsf_scene *scene = closed_box();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.2f, 0.3f, -0.1f), lsf_f3(0, -1, 0), 3.0f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-0.5f, 0.1f, 0.4f), lsf_f3(0, -1, 0), 3e-4f);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-0.5f, 0.1f, 0.4f), lsf_f3(0, -1, 0), 300.0f);
    finish_gl_scene(scene);
    check_furnace("three lights", scene, 4.0 * M_PI * 303.0003);
    destroy_scene(scene);
}

/* The sun over a floor of 2 x 2: E cos rho A; nothing is met beyond. */
static void sun_on_a_floor(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 1.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.6f, -0.8f, 0.0f), 2.0f);
    finish_gl_scene(scene);
    fluxes flux;
    flux_of(scene, 4, flux);
    double expected[3];
    for (int c = 0; c < 3; c++)
        expected[c] = 2.0 * 0.8 * 4.0 * albedo[c];
    expect("sun", (const double(*)[3])flux, 1, expected, 0.01);
    for (int depth = 2; depth <= BOUNCES; depth++)
        assert_true(flux[depth][0] == 0.0);
    destroy_scene(scene);
}

static lsf_scene *floor_under_a_sky(void)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 1.0f);
    build_environment(scene, 0.5f);
    return scene;
}

/* Both sides of a floor under a uniform environment receive pi L. */
static void environment_on_a_floor(void **unused)
{
    (void)unused;
    lsf_scene *scene = floor_under_a_sky();
    finish_gl_scene(scene);
    fluxes flux;
    flux_of(scene, 16, flux);
    double expected[3];
    for (int c = 0; c < 3; c++)
        expected[c] = 2.0 * M_PI * 0.5 * 4.0 * albedo[c];
    expect("environment", (const double(*)[3])flux, 1, expected, 0.02);
    destroy_scene(scene);
}

/* Irradiance on both sides of a floor by the lights of the iteration that have paths, those of the
 * environment in the place of all its directions. */
static double irradiance_of_dealt(const cloud_rig *rig, uint32_t *maps)
{
    uint32_t directions = rig->setup.plan->sky_lights;
    uint32_t first = rig->iteration.light_count - directions;
    double sum = 0.0;
    for (uint32_t i = 0; i < rig->iteration.light_count; i++) {
        const lsf_light_state *light = &rig->iteration.lights[i];
        lsf_vpl_cloud_run dealt =
            lsf_vpl_cloud_deal(&rig->cloud, &rig->iteration, &rig->picks.distribution, i);
        double stands_for = i < first ? 1.0 : (double)directions / rig->cloud.directions;
        if (dealt.count > 0)
            sum += stands_for * (double)light->intensity[0] * fabs(light->direction[1]);
        *maps += dealt.count > 0;
    }
    return sum;
}

/* Some directions of the environment stand for all, in the mean over iterations; a lamp has its own
 * paths beside them. */
static void some_directions_stand_for_all(void **unused)
{
    (void)unused;
    enum { ITERATIONS = 16384 };
    for (int32_t directions = 1; directions <= 3; directions++) {
        cloud_rig rig;
        lsf_scene *scene = floor_under_a_sky();
        build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 1.0f);
        finish_gl_scene(scene);
        init(&rig, scene, directions);
        for (uint32_t i = 0; i < 3; i++) {
            uint32_t maps = 0;
            fluxes flux = {{0}};
            run(&rig, i);
            add_flux(&rig, 1.0, flux);
            double expected[3], irradiance = irradiance_of_dealt(&rig, &maps);
            assert_int_equal(maps, directions + 1);
            for (int c = 0; c < 3; c++)
                expected[c] = irradiance * 4.0 * albedo[c];
            expect("dealt", (const double(*)[3])flux, 1, expected, 0.01);
        }
        double mean = 0.0;
        uint32_t maps = 0;
        for (uint32_t i = 0; i < ITERATIONS; i++) {
            lsf_iteration_begin(&rig.iteration, i);
            mean += irradiance_of_dealt(&rig, &maps) / ITERATIONS;
        }
        print_message("%d of %u directions: irradiance %.4f of %.4f\n", directions,
                      rig.setup.plan->sky_lights, mean, M_PI + 1.0);
        assert_true(fabs(mean / (M_PI + 1.0) - 1.0) < 0.01);
        finish(&rig);
        destroy_scene(scene);
    }
}

static lsf_scene *emissive_square(bool double_sided)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    lsf_material *m = build_material(scene, 0.8f, 0.6f, 0.4f);
    m->double_sided = double_sided;
    m->emission[0] = 2.0f;
    m->emission[1] = 3.0f;
    m->emission[2] = 5.0f;
    build_quad(scene, lsf_f3(-0.5f, 1, -0.5f), lsf_f3(0.5f, 1, -0.5f), lsf_f3(0.5f, 1, 0.5f),
               lsf_f3(-0.5f, 1, 0.5f));
    build_material(scene, 0.8f, 0.6f, 0.4f);
    build_floor(scene, 0.0f, 1.0f);
    return scene;
}

/* pi L A from each side; of what its lower side sends out, the floor receives its form factor: that
 * of a square of 1 x 1 in the middle above one of 2 x 2, at the distance 1. */
static void emissive_square_shines(void **unused)
{
    (void)unused;
    for (int sides = 1; sides <= 2; sides++) {
        lsf_scene *scene = emissive_square(sides == 2);
        finish_gl_scene(scene);
        fluxes flux;
        flux_of(scene, 2, flux);
        const double expected[3] = {sides * M_PI * 2.0, sides * M_PI * 3.0, sides * M_PI * 5.0};
        expect(sides == 1 ? "one side" : "two sides", (const double(*)[3])flux, 0, expected, 1e-4);
        /* By quadrature: 1 / (pi A) integral over both of cos cos / r^2. */
        double factor = 0.0;
        for (int i = 0; i < 32 * 32; i++)
            for (int k = 0; k < 32 * 32; k++) {
                double x = (i % 32 + 0.5) / 32 - 0.5 - ((k % 32 + 0.5) / 16 - 1.0);
                double z = (i / 32 + 0.5) / 32 - 0.5 - ((k / 32 + 0.5) / 16 - 1.0);
                double r2 = 1.0 + x * x + z * z;
                factor += 4.0 / (32.0 * 32.0 * 32.0 * 32.0) / (M_PI * r2 * r2);
            }
        for (int c = 0; c < 3; c++) {
            double onto = factor * M_PI * (double[]){2.0, 3.0, 5.0}[c] * albedo[c];
            print_message("floor: %.4g of %.4g\n", flux[1][c], onto);
            assert_true(fabs(flux[1][c] / onto - 1.0) < 0.03);
        }
        destroy_scene(scene);
    }
}

/* A closed box that emits: pi L A, and rho^k of it. */
static void emissive_furnace(void **unused)
{
    (void)unused;
    lsf_scene *scene = closed_box();
    for (int c = 0; c < 3; c++)
        scene->materials[0].emission[c] = 0.25f;
    finish_gl_scene(scene);
    fluxes flux;
    flux_of(scene, 1, flux);
    double sent = M_PI * 0.25 * (2.0 * 4.0 + 4.0 * 2.0 * 1.6);
    for (int depth = 0; depth <= BOUNCES; depth++) {
        double expected[3];
        for (int c = 0; c < 3; c++)
            expected[c] = sent * pow(albedo[c], depth);
        expect("emissive box", (const double(*)[3])flux, depth, expected,
               depth == 0   ? 1e-4
               : depth == 1 ? 2e-3
                            : 0.02);
    }
    destroy_scene(scene);
}

/* VPLs lie on the walls; the same iteration gives the same bits. */
static void records_lie_on_surfaces(void **unused)
{
    (void)unused;
    lsf_scene *scene = closed_box();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.2f, 0.3f, -0.1f), lsf_f3(0, -1, 0), 3.0f);
    finish_gl_scene(scene);
    cloud_rig rig;
    init(&rig, scene, 0);
    run(&rig, 3);
    const lsf_state *state = &rig.setup.state;
    const double half[3] = {1.0, 0.8, 1.0};
    /* No corner is farther than 2 from the light, and a texel of a cube's face as wide as that
     * times 2 / texels. */
    double off = (double)gl_test_raster_step() * 2.0 * (double)rig.rsm.outputs.light.map_shape.w *
                 2.0 * sqrt(2.0);
    uint32_t live = 0;
    for (uint32_t i = 0; i < rig.count; i++) {
        const struct lsf_vpl_record *r = &rig.records[i];
        double to_wall = INFINITY;
        if (r->intensity.x == 0.0f)
            continue;
        live++;
        for (int axis = 0; axis < 3; axis++) {
            double p = (double)(&r->position.x)[axis] / state->scale + state->center[axis];
            to_wall = fmin(to_wall, fabs(half[axis] - fabs(p)));
        }
        /* A voxel's point is kept to a 1023rd of its side, the grid has 32 of them along the box.
         */
        assert_true(to_wall < (r->depth_and_lobe == 1 ? 1e-5 + off : 2.0 / 32 / 256));
    }
    assert_int_equal(live_vertices(&rig, 0), rig.cloud.shape.paths);
    /* Some 2 in 10,000 rays slip through between the voxels of two walls. */
    assert_true(live_vertices(&rig, 1) >= rig.cloud.shape.paths - rig.cloud.shape.paths / 1000);
    assert_true(live > rig.count / 2);
    struct lsf_vpl_record *before = rig.records;
    rig.records = calloc(rig.count, sizeof *rig.records);
    run(&rig, 3);
    assert_memory_equal(before, rig.records, rig.count * sizeof *before);
    free(before);
    finish(&rig);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_box_keeps_the_flux_of_lights),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(sun_on_a_floor),
        cmocka_unit_test(environment_on_a_floor),
        cmocka_unit_test(some_directions_stand_for_all),
        cmocka_unit_test(emissive_square_shines),
        cmocka_unit_test(emissive_furnace),
        cmocka_unit_test(records_lie_on_surfaces),
    };
    return cmocka_run_group_tests_name("vpl_cloud", tests, NULL, NULL);
}
