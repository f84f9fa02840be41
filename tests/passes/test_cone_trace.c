/* Cones through voxels: the pyramid against the CPU, the set, closed forms, extremes. */
#include <math.h>

#include "frame/cone.h"
#include "passes/voxel_mip.h"
#include "render_gl.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

/* --- the pyramid */

#define WIDTH 32u
#define HEIGHT 16u
#define DEPTH 16u

typedef struct pyramid {
    lsf_context *context;
    lsf_plan *plan;
    lsf_voxel_grid grid;
    lsf_voxel_mip mip;
    GLuint radiance, grid_buffer, bricks[2];
    uint32_t sides;
} pyramid;

static size_t texels(const pyramid *p, uint32_t level)
{
    return (size_t)(WIDTH >> level) * (HEIGHT >> level) * (DEPTH >> level) * p->sides;
}

static float *at(const pyramid *p, float *data, uint32_t level, uint32_t side, uint32_t x,
                 uint32_t y, uint32_t z)
{
    size_t width = WIDTH >> level, height = HEIGHT >> level, depth = DEPTH >> level;
    (void)p;
    return data + (((side * depth + z) * height + y) * width + x) * 4;
}

/* Radiance in every other brick, those of one parity. */
static void fill(pyramid *p, uint32_t parity, GLuint bricks)
{
    float *data = calloc(texels(p, 0), 4 * sizeof(float));
    uint32_t header[LSF_VOXEL_LIST_HEADER] = {LSF_VOXEL_LIST_ROW / LSF_VOXEL_GROUP_BRICKS, 1, 1, 0};
    struct lsf_voxel_brick_data list[WIDTH * HEIGHT * DEPTH / 64];
    srand(parity);
    for (uint32_t z = 0; z < DEPTH; z++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                if ((x / 4 + y / 4 + z / 4) % 2 != parity)
                    continue;
                if (x % 4 == 0 && y % 4 == 0 && z % 4 == 0)
                    list[header[3]++] =
                        (struct lsf_voxel_brick_data){.cell = x / 4 | y / 4 << 10 | z / 4 << 20,
                                                      .low = UINT32_MAX,
                                                      .high = UINT32_MAX,
                                                      .sides = (1u << p->sides) - 1};
                for (uint32_t side = 0; side < p->sides && rand() % 2; side++) {
                    float *texel = at(p, data, 0, side, x, y, z);
                    texel[3] = (float)(rand() % 256) / 255.0f;
                    for (int c = 0; c < 3; c++)
                        texel[c] = texel[3] * (float)(rand() % 256) / 64.0f;
                }
            }
    glTextureSubImage3D(p->radiance, 0, 0, 0, 0, WIDTH, HEIGHT, (GLsizei)(DEPTH * p->sides),
                        GL_RGBA, GL_FLOAT, data);
    glNamedBufferSubData(bricks, 0, sizeof header, header);
    glNamedBufferSubData(bricks, sizeof header, (GLsizeiptr)(header[3] * sizeof *list), list);
    free(data);
}

static void pyramid_create(pyramid *p, uint32_t sides)
{
    lsf_error error = {0};
    *p = (pyramid){.sides = sides, .plan = calloc(1, sizeof(lsf_plan))};
    p->context = gl_test_context(gl_test_backend(), NULL);
    p->grid = (lsf_voxel_grid){.resolution = WIDTH, .size = {WIDTH, HEIGHT, DEPTH}, .side = 1.0f};
    const struct lsf_voxel_grid_data data = {.size = {WIDTH, HEIGHT, DEPTH, 1.0f}};
    lsf_voxel_mip_plan(p->plan, sides);
    lsf_voxel_texture_plan(p->plan, &p->grid, "radiance", GL_RGBA16F, sides, LSF_VOXEL_LEVELS,
                           "test");
    lsf_plan_buffer_add(p->plan, "grid", sizeof data, "test");
    lsf_plan_buffer_add(p->plan, "bricks", 4096, "test");
    if (!lsf_voxel_mip_create(&p->mip, p->context, p->plan, &p->grid, sides, &error) ||
        !lsf_plan_create_texture(p->plan, p->context, "radiance", &p->radiance, &error) ||
        !lsf_plan_create_buffer(p->plan, p->context, "grid", &data, 0, &p->grid_buffer, &error))
        fail_msg("%s", error.message);
    for (int i = 0; i < 2; i++)
        if (!lsf_plan_create_buffer(p->plan, p->context, "bricks", NULL, GL_DYNAMIC_STORAGE_BIT,
                                    &p->bricks[i], &error))
            fail_msg("%s", error.message);
    for (GLint level = 0; level < LSF_VOXEL_LEVELS; level++)
        glClearTexImage(p->radiance, level, GL_RGBA, GL_FLOAT, NULL);
}

static void pyramid_finish(pyramid *p)
{
    lsf_voxel_mip_destroy(&p->mip);
    lsf_texture_destroy(p->context, &p->radiance);
    lsf_buffer_destroy(p->context, &p->grid_buffer);
    lsf_buffer_destroy(p->context, &p->bricks[0]);
    lsf_buffer_destroy(p->context, &p->bricks[1]);
    gl_test_check(p->context);
    assert_int_equal(lsf_context_get_info(p->context).gl_bytes, 0);
    lsf_context_destroy(p->context);
    lsf_plan_destroy(p->plan);
}

/* The texel from the eight below it, as the page has it. */
static void expected_texel(const pyramid *p, float *finer, uint32_t level, uint32_t side,
                           const uint32_t cell[3], double sum[4])
{
    uint32_t axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int c = 0; c < 4; c++)
        sum[c] = 0.0;
    for (uint32_t pair = 0; pair < 4; pair++) {
        uint32_t near[3] = {2 * cell[0], 2 * cell[1], 2 * cell[2]}, far[3];
        near[u] += pair % 2;
        near[v] += pair / 2;
        memcpy(far, near, sizeof far);
        (side % 2 ? near : far)[axis] += 1;
        const float *n = at(p, finer, level - 1, side, near[0], near[1], near[2]);
        const float *f = at(p, finer, level - 1, side, far[0], far[1], far[2]);
        for (int c = 0; c < 4; c++)
            sum[c] += p->sides == 1 ? ((double)n[c] + (double)f[c]) / 8.0
                                    : ((double)n[c] + (1.0 - (double)n[3]) * (double)f[c]) / 4.0;
    }
}

static void check_pyramid(const pyramid *p)
{
    float *finer = malloc(texels(p, 0) * 16), *coarser = malloc(texels(p, 1) * 16);
    glGetTextureImage(p->radiance, 0, GL_RGBA, GL_FLOAT, (GLsizei)(texels(p, 0) * 16), finer);
    for (uint32_t level = 1; level < LSF_VOXEL_LEVELS; level++) {
        glGetTextureImage(p->radiance, (GLint)level, GL_RGBA, GL_FLOAT,
                          (GLsizei)(texels(p, level) * 16), coarser);
        for (uint32_t side = 0; side < p->sides; side++)
            for (uint32_t z = 0; z < DEPTH >> level; z++)
                for (uint32_t y = 0; y < HEIGHT >> level; y++)
                    for (uint32_t x = 0; x < WIDTH >> level; x++) {
                        const uint32_t cell[3] = {x, y, z};
                        double sum[4];
                        expected_texel(p, finer, level, side, cell, sum);
                        const float *found = at(p, coarser, level, side, x, y, z);
                        for (int c = 0; c < 4; c++) /* half floats, twice rounded */
                            assert_true(fabs(sum[c] - (double)found[c]) <= 2e-3 * sum[c] + 1e-6);
                    }
        memcpy(finer, coarser, texels(p, level) * 16);
    }
    free(finer);
    free(coarser);
}

/* Filled, and once more with other bricks, so that what was there has to go. */
static void levels(void **state)
{
    pyramid p;
    pyramid_create(&p, *(const uint32_t *)*state);
    fill(&p, 0, p.bricks[0]);
    lsf_voxels voxels = {.grid_buffer = p.grid_buffer,
                         .bricks = p.bricks[0],
                         .previous_bricks = p.bricks[0],
                         .changed = true};
    lsf_voxel_mip_run(&p.mip, &voxels, p.radiance);
    check_pyramid(&p);
    fill(&p, 1, p.bricks[1]);
    voxels.bricks = p.bricks[1];
    lsf_voxel_mip_run(&p.mip, &voxels, p.radiance);
    check_pyramid(&p);
    pyramid_finish(&p);
}

/* --- the set */

/* Moments of the cosine-weighted hemisphere, of which all shares are 1 / count. */
static void set(void **state)
{
    (void)state;
    for (uint32_t count = 1; count <= LSF_CONE_MAX; count++) {
        double z = 0.0, z2 = 0.0;
        for (int i = 0; i < 256; i++) {
            lsf_vec4 cones[LSF_CONE_MAX];
            lsf_cone_set(count, ((float)i + 0.5f) / 256.0f, cones);
            for (uint32_t c = 0; c < count; c++) {
                double x = (double)cones[c].x, y = (double)cones[c].y, h = (double)cones[c].z;
                assert_true(fabs(x * x + y * y + h * h - 1.0) < 1e-5 && h > 0.0);
                assert_true(cones[c].w > 0.0f && isfinite(cones[c].w));
                z += h / (256.0 * count);
                z2 += h * h / (256.0 * count);
            }
        }
        assert_true(fabs(z - 2.0 / 3.0) < 1e-4);
        assert_true(fabs(z2 - 0.5) < 1e-4);
    }
}

/* Rounding puts no direction on the horizon. Its density would be 0, and 0 / 0 of an environment
 * that is found in no other way would make pixels that are not a number. */
static void none_on_the_horizon(void **state)
{
    (void)state;
    for (uint32_t count = 1; count <= LSF_CONE_MAX; count++) {
        lsf_vec4 cones[LSF_CONE_MAX];
        lsf_cone_set(count, 0x1.fffffep-1f, cones);
        assert_true(cones[count - 1].z > 0.0f);
    }
}

/* --- closed forms */

static const char *const small_grid[] = {"voxel.resolution=64"};

static lsf_render_params cone_params(void)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "cone";
    params.width = params.height = 16;
    params.samples = 16;
    params.options = small_grid;
    params.option_count = 1;
    return params;
}

static double mean_of(const lsf_image *image, uint32_t channel)
{
    double sum = 0.0;
    uint64_t pixels = (uint64_t)image->width * image->height;
    for (uint64_t i = 0; i < pixels; i++) {
        assert_true(isfinite(image->pixels[i * image->channel_count + channel]));
        sum += (double)image->pixels[i * image->channel_count + channel];
    }
    return sum / (double)pixels;
}

/* Radiance of a place on the floor, seen through a needle from the side. */
static double floor_radiance(const lsf_scene *scene, float x, uint32_t samples,
                             const char *const *options, uint32_t option_count)
{
    const float eye[3] = {x, 0.9f, 0.6f}, target[3] = {x, 0.0f, 0.0f};
    lsf_render_params params = cone_params();
    params.width = params.height = 4;
    params.samples = samples;
    params.options = options;
    params.option_count = option_count;
    params.fov_y = 0.5f;
    params.camera_position = eye;
    params.camera_target = target;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    double mean = mean_of(image, 0);
    lsf_image_destroy(image);
    return mean;
}

static lsf_scene *under_white_sky(float albedo)
{
    lsf_scene *scene = build_scene();
    build_material(scene, albedo, albedo, albedo);
    build_floor(scene, 0.0f, 1.0f);
    scene->diffuse_only = true;
    build_environment(scene, 1.0f);
    return scene;
}

/* E = pi L of a constant environment. */
static void constant_environment(void **state)
{
    (void)state;
    lsf_scene *scene = under_white_sky(0.5f);
    finish_gl_scene(scene);
    double found = floor_radiance(scene, 0.1f, 64, small_grid, 1);
    print_message("constant environment: %.5f of what arrives\n", found / 0.5);
    assert_true(fabs(found / 0.5 - 1.0) < 1e-3);
    destroy_scene(scene);
}

/* A black wall that is long and high hides half of what a point at its foot sees. */
static void half_space(void **state)
{
    static const char *const fine[] = {"voxel.resolution=64"};
    (void)state;
    lsf_scene *scene = under_white_sky(0.5f);
    build_material(scene, 0.0f, 0.0f, 0.0f);
    build_quad(scene, lsf_f3(-0.5f, 0, 1), lsf_f3(-0.5f, 0, -1), lsf_f3(-0.5f, 1, -1),
               lsf_f3(-0.5f, 1, 1));
    finish_gl_scene(scene);
    for (int i = 0; i < 3; i++) {
        float distance = 0.125f * (float)(1 << i);
        /* A strip without end of height 1 seen edge on from its foot: (1 - cos) / 2; its length of
         * 2 takes the least away. */
        double d = (double)distance;
        double a = atan2(1.0, d), b = atan2(1.0, hypot(1.0, d));
        double hidden = (a - d / hypot(1.0, d) * b) / (double)LSF_PI;
        double found = floor_radiance(scene, -0.5f + distance, 16, fine, 1) / 0.5;
        print_message("%.3f from a wall: %.4f of the sky, and %.4f in truth\n", d, found,
                      1.0 - hidden);
        assert_true(fabs(found - (1.0 - hidden)) < 0.02);
    }
    destroy_scene(scene);
}

/* --- rules */

static lsf_scene *room(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.6f, 0.5f, 0.4f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_material(scene, 0.3f, 0.5f, 0.6f)->roughness = 0.3f;
    build_box(scene, lsf_f3(-0.4f, -1, -0.5f), lsf_f3(0.2f, 0, 0.1f), false);
    lsf_material *lamp = build_material(scene, 0, 0, 0);
    lamp->emission[0] = lamp->emission[1] = 2.0f;
    build_box(scene, lsf_f3(0.3f, 0.8f, 0.3f), lsf_f3(0.6f, 0.9f, 0.6f), false);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 0.5f, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render_room(const lsf_scene *scene, const char *const *options,
                              uint32_t option_count)
{
    const float eye[3] = {0.7f, 0.3f, 0.9f}, target[3] = {0, -0.3f, 0};
    lsf_render_params params = cone_params();
    params.width = 33;
    params.height = 21;
    params.samples = 2;
    params.bounces = 3;
    params.options = options;
    params.option_count = option_count;
    params.camera_position = eye;
    params.camera_target = target;
    return render_gl(gl_test_backend(), scene, &params);
}

static void same_bits_again(void **state)
{
    (void)state;
    static const char *const threads[] = {"0", "1", "8"};
    static const char *const options[] = {"voxel.resolution=40", "sparse.grid=2"};
    lsf_scene *scene = room();
    lsf_image *images[3];
    for (int i = 0; i < 3; i++) {
        setenv("LP_NUM_THREADS", threads[i], 1);
        images[i] = render_room(scene, options, 2);
        assert_memory_equal(images[0]->pixels, images[i]->pixels,
                            (size_t)33 * 21 * images[i]->channel_count * sizeof(float));
    }
    unsetenv("LP_NUM_THREADS");
    assert_true(mean_of(images[0], 0) > 0.0);
    for (int i = 0; i < 3; i++)
        lsf_image_destroy(images[i]);
    destroy_scene(scene);
}

/* Grids of one voxel, of 16, and isotropic ones give pictures. */
static void grids(void **state)
{
    (void)state;
    static const char *const options[][3] = {
        {"voxel.resolution=1", "cone.count=1", "cone.step=2"},
        {"voxel.resolution=16", "cone.count=32", "cone.offset=0"},
        {"voxel.resolution=24", "cone.sealed=false", "cone.offset=1"},
        {"voxel.resolution=32", "cone.sides=isotropic", "cone.rotate=false"},
        {"voxel.resolution=32", "cone.distance=0", "cone.jitter=false"},
        {"voxel.resolution=32", "voxel.jitter=false", "sparse.grid=16"},
    };
    lsf_scene *scene = room();
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        lsf_image *image = render_room(scene, options[i], 3);
        assert_true(mean_of(image, 0) > 0.0);
        lsf_image_destroy(image);
    }
    destroy_scene(scene);
}

/* No triangle at all; one without any extent along an axis, far thinner than a voxel. */
static void empty_and_flat_scenes(void **state)
{
    (void)state;
    lsf_render_params params = cone_params();
    lsf_scene *empty = build_scene();
    empty->environment = (lsf_environment){.present = true, .radiance = {0.5f, 0.5f, 0.5f}};
    build_light(empty, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(empty);
    lsf_image *image = render_gl(gl_test_backend(), empty, &params);
    assert_true(image->pixels[0] == 0.5f);
    lsf_image_destroy(image);
    destroy_scene(empty);

    const lsf_float3 corners[3] = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    const float eye[3] = {0, 1, 0.5f}, target[3] = {0, 0, 0.1f};
    lsf_scene *flat = build_scene();
    build_material(flat, 1, 1, 1);
    build_triangles(flat, corners, 1);
    build_light(flat, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(flat);
    params.bounces = 2;
    params.camera_position = eye;
    params.camera_target = target;
    image = render_gl(gl_test_backend(), flat, &params);
    assert_true(mean_of(image, 0) > 0.0);
    lsf_image_destroy(image);
    destroy_scene(flat);
}

/* A sphere of velvet under a uniform environment: cones and paths find the same light of its sheen,
 * its lobe and its cloth. */
static void sheen_counts_once(void **unused)
{
    (void)unused;
    static const char *const techniques[2] = {"cone", "voxel_path"};
    double rgb[2][3];
    lsf_scene *scene = build_scene();
    lsf_material *velvet = build_material(scene, 0.1f, 0.1f, 0.1f);
    velvet->roughness = 0.6f;
    velvet->sheen_roughness = 0.5f;
    velvet->sheen_color[0] = velvet->sheen_color[1] = velvet->sheen_color[2] = 0.9f;
    build_sphere(scene, 3, false);
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    for (int t = 0; t < 2; t++) {
        static const char *const coarse[] = {"voxel.resolution=32"};
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.technique = techniques[t];
        params.samples = 32;
        params.fov_y = 20.0f; /* nothing but the sphere */
        params.options = coarse;
        params.option_count = 1;
        lsf_image *image = render_gl_from(scene, params, 16, lsf_f3(0, 0, 4), lsf_f3(0, 0, 0));
        mean_rgb(image, 0, rgb[t]);
        lsf_image_destroy(image);
    }
    destroy_scene(scene);
    print_message("velvet: %.4f by cones, %.4f by paths\n", rgb[0][1], rgb[1][1]);
    assert_true(fabs(rgb[0][1] / rgb[1][1] - 1.0) <= 0.02);
}

int main(void)
{
    static uint32_t sides[] = {1, LSF_VOXEL_SIDES_AXES};
    const struct CMUnitTest tests[] = {
        {"isotropic levels", levels, NULL, NULL, &sides[0]},
        {"anisotropic levels", levels, NULL, NULL, &sides[1]},
        cmocka_unit_test(set),
        cmocka_unit_test(none_on_the_horizon),
        cmocka_unit_test(constant_environment),
        cmocka_unit_test(half_space),
        cmocka_unit_test(same_bits_again),
        cmocka_unit_test(grids),
        cmocka_unit_test(empty_and_flat_scenes),
        cmocka_unit_test(sheen_counts_once),
    };
    return cmocka_run_group_tests_name("cone tracing", tests, NULL, NULL);
}
