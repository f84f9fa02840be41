/* Sides of voxels drawn by their radiance: how often each is drawn, and that cones find the same
 * light with draws as without, with less noise. */
#include <math.h>

#include "passes/voxel_draw.h"
#include "render_gl.h"
#include "shared/voxel_draw_data.h"

/* --- how often */

enum { WIDTH = 32, HEIGHT = 16, DEPTH = 16, BRICKS = WIDTH * HEIGHT * DEPTH / 64, SIDES = 2 };

typedef struct rig {
    lsf_context *context;
    lsf_plan *plan;
    lsf_voxel_draw draw;
    lsf_voxels voxels;
    GLuint radiance;
    float weights[SIDES][DEPTH][HEIGHT][WIDTH]; /* 0 where no voxel is */
    float pixels[SIDES][DEPTH][HEIGHT][WIDTH][4];
    uint32_t occupancy[DEPTH / 4][HEIGHT / 4][WIDTH / 2];
    struct lsf_voxel_brick_data list[BRICKS];
    uint32_t brick_count;
} rig;

static void create_textures(rig *r, uint32_t sides)
{
    lsf_error error = {0};
    const lsf_voxel_grid grid = {.resolution = WIDTH, .size = {WIDTH, HEIGHT, DEPTH}, .side = 1.0f};
    const struct lsf_voxel_grid_data data = {.size = {WIDTH, HEIGHT, DEPTH, 1.0f}};
    const lsf_texture_desc bits = {.target = GL_TEXTURE_3D,
                                   .internal_format = GL_R32UI,
                                   .width = WIDTH / 2,
                                   .height = HEIGHT / 4,
                                   .depth = DEPTH / 4,
                                   .levels = 1,
                                   .label = "occupancy"};
    lsf_voxel_draw_plan(r->plan, &grid, sides, false);
    lsf_voxel_texture_plan(r->plan, &grid, "radiance", GL_RGBA16F, sides, 1, "test");
    lsf_plan_buffer_add(r->plan, "grid", sizeof data, "test");
    lsf_plan_buffer_add(r->plan, "bricks", 4 * sizeof(uint32_t) + sizeof r->list, "test");
    if (!lsf_voxel_draw_create(&r->draw, r->context, r->plan, &error) ||
        !lsf_plan_create_texture(r->plan, r->context, "radiance", &r->radiance, &error) ||
        !lsf_plan_create_buffer(r->plan, r->context, "grid", &data, 0, &r->voxels.grid_buffer,
                                &error) ||
        !lsf_plan_create_buffer(r->plan, r->context, "bricks", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &r->voxels.bricks, &error) ||
        !(r->voxels.occupancy[0] = lsf_texture_create(r->context, &bits, &error)))
        fail_msg("%s", error.message);
}

/* A third of the voxels in two thirds of the bricks; one in a hundred shines 512 times as
 * bright as the rest, one in four not at all. */
static void fill(rig *r, uint32_t sides)
{
    srand(7);
    for (uint32_t z = 0; z < DEPTH; z++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                if ((x / 4 + y / 4 + z / 4) % 3 == 0 || rand() % 3 > 0)
                    continue;
                r->occupancy[z / 4][y / 4][x / 4 * 2 + z / 2 % 2] |=
                    1u << (x % 4 | y % 4 << 2 | z % 2 << 4);
                for (uint32_t side = 0; side < sides && rand() % 4 > 0; side++) {
                    float bright = (rand() % 100 == 0 ? 512.0f : 1.0f) * (float)(1 + rand() % 64);
                    for (int c = 0; c < 3; c++) /* whole numbers, which half floats hold */
                        r->pixels[side][z][y][x][c] = bright;
                    r->weights[side][z][y][x] = bright;
                }
            }
    for (uint32_t z = 0; z < DEPTH / 4; z++)
        for (uint32_t y = 0; y < HEIGHT / 4; y++)
            for (uint32_t x = 0; x < WIDTH / 4; x++) {
                struct lsf_voxel_brick_data brick = {.cell = x | y << 10 | z << 20,
                                                     .low = r->occupancy[z][y][2 * x],
                                                     .high = r->occupancy[z][y][2 * x + 1]};
                if (brick.low | brick.high)
                    r->list[r->brick_count++] = brick;
            }
    const uint32_t header[LSF_VOXEL_LIST_HEADER] = {LSF_VOXEL_LIST_ROW / LSF_VOXEL_GROUP_BRICKS, 1,
                                                    1, r->brick_count};
    glTextureSubImage3D(r->radiance, 0, 0, 0, 0, WIDTH, HEIGHT, (GLsizei)(DEPTH * sides), GL_RGBA,
                        GL_FLOAT, r->pixels);
    glTextureSubImage3D(r->voxels.occupancy[0], 0, 0, 0, 0, WIDTH / 2, HEIGHT / 4, DEPTH / 4,
                        GL_RED_INTEGER, GL_UNSIGNED_INT, r->occupancy);
    glNamedBufferSubData(r->voxels.bricks, 0, sizeof header, header);
    glNamedBufferSubData(r->voxels.bricks, sizeof header, sizeof r->list, r->list);
}

static void check(const rig *r, uint32_t sides)
{
    struct {
        float total, unused[LSF_VOXEL_DRAWS_HEADER - 1];
        uint32_t draws[LSF_VOXEL_DRAWS][2];
    } list;
    static uint32_t counts[SIDES][DEPTH][HEIGHT][WIDTH];
    memset(counts, 0, sizeof counts);
    glGetNamedBufferSubData(r->draw.list, 0, sizeof list, &list);
    for (uint32_t i = 0; i < LSF_VOXEL_DRAWS; i++) {
        uint32_t bits = list.draws[i][0];
        counts[bits >> LSF_VOXEL_DRAW_SLICE_SHIFT][bits >> 20 & 1023][bits >> 10 & 1023]
              [bits & 1023]++;
    }
    double total = 0.0;
    for (size_t i = 0; i < sizeof r->weights / sizeof(float); i++)
        total += (double)(&r->weights[0][0][0][0])[i];
    assert_true(fabs((double)list.total / total - 1.0) < 1e-5);
    for (size_t i = 0; i < sides * sizeof r->weights[0] / sizeof(float); i++) {
        double weight = (double)(&r->weights[0][0][0][0])[i];
        uint32_t count = (&counts[0][0][0][0])[i];
        /* One draw from each of as many parts: two of them at the borders may miss it. */
        assert_true(fabs(count - weight / total * LSF_VOXEL_DRAWS) < 2.01);
        assert_true(weight > 0.0 || count == 0);
    }
}

static void drawn_by_luminance(void **state)
{
    uint32_t sides = *(const uint32_t *)*state;
    rig *r = calloc(1, sizeof *r);
    r->plan = calloc(1, sizeof *r->plan);
    r->context = gl_test_context(gl_test_backend(), NULL);
    create_textures(r, sides);
    fill(r, sides);
    for (uint32_t i = 0; i < 3; i++) {
        const lsf_iteration iteration = {.index = i, .seed = 1};
        lsf_voxel_draw_begin(&r->draw);
        lsf_voxel_draw_run(&r->draw, &iteration, &r->voxels, r->radiance);
        check(r, sides);
    }
    lsf_voxel_draw_destroy(&r->draw);
    lsf_texture_destroy(r->context, &r->radiance);
    lsf_texture_destroy(r->context, &r->voxels.occupancy[0]);
    lsf_buffer_destroy(r->context, &r->voxels.grid_buffer);
    lsf_buffer_destroy(r->context, &r->voxels.bricks);
    gl_test_check(r->context);
    assert_int_equal(lsf_context_get_info(r->context).gl_bytes, 0);
    lsf_context_destroy(r->context);
    lsf_plan_destroy(r->plan);
    free(r);
}

/* --- the same light */

/* A room with a lamp close to its ceiling, whose bright spot lights the rest, a small emitting box
 * behind the camera, and a tent. */
static lsf_scene *room(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.6f, 0.5f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    const lsf_float3 tent[6] = {{-0.6f, -0.9f, -0.6f}, {-0.6f, -0.9f, 0.2f}, {0.0f, -0.2f, -0.2f},
                                {-0.6f, -0.9f, 0.2f},  {0.4f, -0.9f, 0.2f},  {0.0f, -0.2f, -0.2f}};
    build_triangles(scene, tent, 2);
    lsf_material *lamp = build_material(scene, 0, 0, 0);
    lamp->emission[0] = lamp->emission[2] = 4.0f;
    build_box(scene, lsf_f3(0.2f, -0.2f, 0.9f), lsf_f3(0.4f, 0, 0.97f), false);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.2f, 0.8f, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(scene);
    return scene;
}

enum { SIDE = 24 };

typedef struct technique {
    const char *name, *without, *with, *many;
    uint32_t samples; /* of pictures whose means are compared */
} technique;

static lsf_image *render_room(const lsf_scene *scene, const technique *t, const char *draws,
                              uint32_t samples, uint32_t seed)
{
    const char *const options[] = {"voxel.resolution=32", draws};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = t->name;
    params.samples = samples;
    params.seed = seed;
    params.bounces = 2;
    params.options = options;
    params.option_count = 2;
    return render_gl_from(scene, params, SIDE, lsf_f3(0.8f, 0, 0.9f), lsf_f3(-0.2f, -0.4f, -0.3f));
}

static double squared_difference(const lsf_image *a, const lsf_image *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++)
        for (size_t c = 0; c < 3; c++) {
            double d = (double)a->pixels[i * a->channel_count + c] -
                       (double)b->pixels[i * b->channel_count + c];
            sum += d * d;
        }
    return sum;
}

static void same_light_with_less_noise(void **state)
{
    const technique *t = *state;
    lsf_scene *scene = room();
    lsf_image *chance = render_room(scene, t, t->without, t->samples, 1);
    lsf_image *drawn = render_room(scene, t, t->many, t->samples, 2);
    double without[3], with[3], noise[2] = {0.0, 0.0};
    mean_rgb(chance, 0, without);
    mean_rgb(drawn, 0, with);
    for (int c = 0; c < 3; c++) {
        print_message("channel %d: %.5f by chance, %.5f with draws\n", c, without[c], with[c]);
        assert_true(fabs(with[c] / without[c] - 1.0) < 0.005);
    }
    for (uint32_t seed = 3; seed < 7; seed++) {
        lsf_image *few[2] = {render_room(scene, t, t->without, 4, seed),
                             render_room(scene, t, t->with, 4, seed)};
        for (int i = 0; i < 2; i++) {
            noise[i] += squared_difference(few[i], drawn);
            lsf_image_destroy(few[i]);
        }
    }
    print_message("squared error: %.4f by chance, %.4f with draws\n", noise[0], noise[1]);
    assert_true(noise[1] < 0.5 * noise[0]);
    lsf_image_destroy(chance);
    lsf_image_destroy(drawn);
    destroy_scene(scene);
}

int main(void)
{
    static uint32_t sides[] = {1, SIDES};
    static technique techniques[] = {
        {"cone", "cone.draws=0", "cone.draws=2", "cone.draws=4", 512},
        {"voxel_path", "voxel_path.draws=0", "voxel_path.draws=1", "voxel_path.draws=2", 512},
    };
    const struct CMUnitTest tests[] = {
        {"one side drawn by luminance", drawn_by_luminance, NULL, NULL, &sides[0]},
        {"two sides drawn by luminance", drawn_by_luminance, NULL, NULL, &sides[1]},
        {"cones find the same light", same_light_with_less_noise, NULL, NULL, &techniques[0]},
        {"paths find the same light", same_light_with_less_noise, NULL, NULL, &techniques[1]},
    };
    return cmocka_run_group_tests_name("drawn voxels", tests, NULL, NULL);
}
