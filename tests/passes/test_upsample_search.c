/* Upsampling on surfaces made by hand. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "passes/upsample_search.h"
#include "surface_rig.h"

typedef struct rig {
    surface_rig s;
    uint32_t width, height; /* of the grid */
    lsf_upsample_search_params params;
    lsf_upsample_search pass;
    GLuint irradiance, specular;
    float *in, *out; /* irradiance, four floats a texel or pixel; specular is 3 times it */
} rig;

static void rig_begin_view(rig *r, uint32_t width, uint32_t height, uint32_t coarse_width,
                           uint32_t coarse_height, bool orthographic)
{
    lsf_error error = {0};
    memset(r, 0, sizeof *r);
    r->width = coarse_width;
    r->height = coarse_height;
    r->params = (lsf_upsample_search_params){LSF_UPSAMPLE_SEARCH_PARAMS_DEFAULTS};
    surface_rig_begin(&r->s, width, height, orthographic);
    lsf_upsample_search_plan(r->s.setup.plan, &r->params, coarse_width, coarse_height);
    surface_rig_start(&r->s);
    if (!lsf_upsample_search_create(&r->pass, r->s.context, r->s.setup.plan, &r->params, &error))
        fail_msg("%s", error.message);
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, coarse_width, coarse_height);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, coarse_width, coarse_height);
    r->in = calloc(coarse_width * coarse_height, 4 * sizeof *r->in);
    r->out = calloc(width * height, 4 * sizeof *r->out);
    assert_true(r->in && r->out);
}

static void rig_begin(rig *r, uint32_t width, uint32_t height, uint32_t coarse_width,
                      uint32_t coarse_height)
{
    rig_begin_view(r, width, height, coarse_width, coarse_height, false);
}

static void rig_end(rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_upsample_search_destroy(&r->pass);
    surface_rig_end(&r->s);
    free(r->in);
    free(r->out);
}

/* The pixel that a texel sees, in the words of coarse_grid.h. */
static uint32_t pixel_of(uint32_t texel, uint32_t size, uint32_t length, uint32_t offset)
{
    uint32_t first = texel * length / size, next = (texel + 1) * length / size;
    return first + (next - first) * offset / 65536u;
}

static void rig_split(rig *r, uint32_t iteration)
{
    lsf_iteration_begin(&r->s.iteration, iteration);
    surface_rig_upload(&r->s);
    lsf_upsample_search_split(&r->pass, &r->s.iteration, &r->s.maps);
}

static void rig_run(rig *r)
{
    const lsf_split_light light = {r->irradiance, r->specular};
    surface_rig_write(r->irradiance, r->width, r->height, r->in);
    surface_rig_write(r->specular, r->width, r->height, r->in);
    lsf_upsample_search_run(&r->pass, &r->s.iteration, &r->s.maps, &light);
    float *specular = r->out;
    surface_rig_read(r->pass.light.specular, r->s.width, r->s.height, specular);
    float *copy = malloc(r->s.width * r->s.height * 4 * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, specular, r->s.width * r->s.height * 4 * sizeof *copy);
    surface_rig_read(r->pass.light.irradiance, r->s.width, r->s.height, r->out);
    assert_memory_equal(copy, r->out, r->s.width * r->s.height * 4 * sizeof *copy);
    free(copy);
}

static const uint32_t sizes[][4] = {
    {64, 48, 32, 24}, {48, 27, 16, 12}, {37, 21, 19, 11}, {7, 13, 7, 1}, {5, 3, 1, 1}};

/* Each texel sees the pixel that coarse_grid.h says, bit for bit, and another in other iterations.
 */
static void split_takes_one_pixel_of_each_block(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++) {
        rig r;
        rig_begin(&r, sizes[s][0], sizes[s][1], sizes[s][2], sizes[s][3]);
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                uint32_t i = y * r.s.width + x;
                seen point = surface_rig_wall(&r.s, 1.0f + lsf_random_float(3, i));
                point.roughness = lsf_random_float(4, i);
                surface_rig_see(&r.s, x, y, &point);
            }
        uint32_t texels = r.width * r.height;
        float *depths = malloc(texels * sizeof *depths);
        uint32_t(*surfaces)[4] = malloc(texels * sizeof *surfaces);
        uint32_t(*glosses)[2] = malloc(texels * sizeof *glosses);
        assert_true(depths && surfaces && glosses);
        for (uint32_t iteration = 0; iteration < 5; iteration++) {
            rig_split(&r, iteration);
            glGetTextureImage(r.pass.coarse.depth, 0, GL_RED, GL_FLOAT,
                              (GLsizei)(texels * sizeof *depths), depths);
            glGetTextureImage(r.pass.coarse.surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                              (GLsizei)(texels * sizeof *surfaces), surfaces);
            glGetTextureImage(r.pass.coarse.gloss, 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                              (GLsizei)(texels * sizeof *glosses), glosses);
            for (uint32_t y = 0; y < r.height; y++)
                for (uint32_t x = 0; x < r.width; x++) {
                    uint32_t i = y * r.width + x;
                    uint32_t px = pixel_of(x, r.width, r.s.width, r.pass.grid.offset[0]);
                    uint32_t py = pixel_of(y, r.height, r.s.height, r.pass.grid.offset[1]);
                    uint32_t p = py * r.s.width + px;
                    assert_memory_equal(&depths[i], &r.s.depths[p], sizeof *depths);
                    assert_memory_equal(surfaces[i], r.s.surfaces[p], sizeof *surfaces);
                    assert_memory_equal(glosses[i], r.s.glosses[p], sizeof *glosses);
                }
        }
        free(depths);
        free(surfaces);
        free(glosses);
        rig_end(&r);
    }
}

/* Over any surfaces; unlit ones and the background get none. */
static void a_constant_stays_to_the_bit(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++) {
        rig r;
        rig_begin(&r, sizes[s][0], sizes[s][1], sizes[s][2], sizes[s][3]);
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                uint32_t i = y * r.s.width + x;
                seen point = surface_rig_wall(&r.s, 1.0f + 0.01f * lsf_random_float(3, i));
                point.normal.x += 0.3f * lsf_random_float(5, i);
                point.normal = lsf_f3_normalize(point.normal);
                surface_rig_see(&r.s, x, y, &point);
            }
        for (uint32_t i = 0; i < 4 * r.width * r.height; i++)
            r.in[i] = 0.1f;
        rig_split(&r, 0);
        rig_run(&r);
        for (uint32_t i = 0; i < 4 * r.s.width * r.s.height; i++)
            assert_true(fabsf(r.out[i] - 0.1f) <= 0.0f);
        rig_end(&r);
    }
}

typedef struct layout {
    seen sides[2];
    bool (*right)(uint32_t x, uint32_t y);
} layout;

/* Whether the grid sees the pixel's own side in the square that is searched. */
static bool in_reach(const rig *r, const layout *l, uint32_t x, uint32_t y)
{
    int32_t home_x = (int32_t)(((x + 1) * r->width - 1) / r->s.width);
    int32_t home_y = (int32_t)(((y + 1) * r->height - 1) / r->s.height);
    for (int32_t j = home_y - r->params.radius; j <= home_y + r->params.radius; j++)
        for (int32_t i = home_x - r->params.radius; i <= home_x + r->params.radius; i++) {
            if (i < 0 || j < 0 || i >= (int32_t)r->width || j >= (int32_t)r->height)
                continue;
            uint32_t px = pixel_of((uint32_t)i, r->width, r->s.width, r->pass.grid.offset[0]);
            uint32_t py = pixel_of((uint32_t)j, r->height, r->s.height, r->pass.grid.offset[1]);
            if (l->right(px, py) == l->right(x, y))
                return true;
        }
    return false;
}

/* Light 1 on one side, 2 on the other: no pixel may get anything else, as long as its side is in
 * reach of the search. */
static void check_sides(rig *r, const layout *l)
{
    uint32_t out_of_reach = 0;
    for (uint32_t iteration = 0; iteration < 4; iteration++) {
        lsf_iteration_begin(&r->s.iteration, iteration);
        for (uint32_t y = 0; y < r->s.height; y++)
            for (uint32_t x = 0; x < r->s.width; x++)
                surface_rig_see(&r->s, x, y, &l->sides[l->right(x, y)]);
        rig_split(r, iteration);
        for (uint32_t y = 0; y < r->height; y++)
            for (uint32_t x = 0; x < r->width; x++) {
                bool right = l->right(pixel_of(x, r->width, r->s.width, r->pass.grid.offset[0]),
                                      pixel_of(y, r->height, r->s.height, r->pass.grid.offset[1]));
                for (int c = 0; c < 4; c++)
                    r->in[4 * (y * r->width + x) + (uint32_t)c] = right ? 2.0f : 1.0f;
            }
        rig_run(r);
        for (uint32_t y = 0; y < r->s.height; y++)
            for (uint32_t x = 0; x < r->s.width; x++) {
                bool right = l->right(x, y);
                bool dark = l->sides[right].background || l->sides[right].unlit;
                float expected = dark ? 0.0f : right ? 2.0f : 1.0f;
                if (!dark && !in_reach(r, l, x, y)) {
                    out_of_reach++;
                    continue;
                }
                assert_true(fabsf(r->out[4 * (y * r->s.width + x)] - expected) <= 0.0f);
            }
    }
    /* Where a bar is cut by the picture's corners. */
    assert_true(out_of_reach < r->s.width * r->s.height / 250);
}

static bool right_half(uint32_t x, uint32_t y)
{
    (void)y;
    return x >= 31;
}

/* A diagonal bar that the grid misses in places. */
static bool on_bar(uint32_t x, uint32_t y)
{
    return (x + 2 * y) % 40 < 3;
}

static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    bool (*const rights[])(uint32_t, uint32_t) = {right_half, on_bar};
    for (size_t form = 0; form < LSF_COUNT(rights); form++)
        for (int edge = 0; edge < 4; edge++) {
            rig r;
            rig_begin(&r, 80, 64, 27, 32);
            layout l = {.sides = {surface_rig_wall(&r.s, 1.0f), surface_rig_wall(&r.s, 1.0f)},
                        .right = rights[form]};
            if (edge == 0)
                l.sides[1] = surface_rig_wall(&r.s, 0.7f);
            else if (edge == 1)
                l.sides[1].normal = lsf_basis_about(l.sides[0].normal).t;
            else if (edge == 2)
                l.sides[1].background = true;
            else
                l.sides[1].unlit = true;
            check_sides(&r, &l);
            rig_end(&r);
        }
}

/* Light that is linear over a wall, and so over the picture, stays it between the outermost places
 * that the grid sees; 2^-20 is rounding. */
static void light_is_interpolated(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < 3; s++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            rig r;
            rig_begin_view(&r, sizes[s][0], sizes[s][1], sizes[s][2], sizes[s][3], orthographic);
            seen point = surface_rig_wall(&r.s, 1.0f);
            for (uint32_t y = 0; y < r.s.height; y++)
                for (uint32_t x = 0; x < r.s.width; x++)
                    surface_rig_see(&r.s, x, y, &point);
            rig_split(&r, 0);
            uint32_t corner[2][2];
            for (uint32_t y = 0; y < r.height; y++)
                for (uint32_t x = 0; x < r.width; x++) {
                    uint32_t px = pixel_of(x, r.width, r.s.width, r.pass.grid.offset[0]);
                    uint32_t py = pixel_of(y, r.height, r.s.height, r.pass.grid.offset[1]);
                    corner[x + y > 0][0] = px;
                    corner[x + y > 0][1] = py;
                    for (uint32_t c = 0; c < 4; c++)
                        r.in[4 * (y * r.width + x) + c] = (float)(px + 2 * py) / 256.0f;
                }
            rig_run(&r);
            for (uint32_t y = corner[0][1]; y <= corner[1][1]; y++)
                for (uint32_t x = corner[0][0]; x <= corner[1][0]; x++) {
                    float expected = (float)(x + 2 * y) / 256.0f;
                    assert_true(fabsf(r.out[4 * (y * r.s.width + x)] - expected) < 0x1p-20f);
                }
            rig_end(&r);
        }
}

/* At the picture's own size there is no pass, and the plan says why. */
static void full_scale_has_no_pass(void **unused)
{
    (void)unused;
    rig r;
    rig_begin(&r, 16, 8, 16, 8);
    const lsf_plan *plan = r.s.setup.plan;
    assert_null(lsf_plan_find_pass(plan, "upsample_search"));
    assert_null(lsf_plan_find_pass(plan, "upsample_search_split"));
    bool omitted = false;
    for (uint64_t i = 0; i < plan->omission_count; i++)
        omitted |= strcmp(plan->omissions[i].name, "upsample_search") == 0;
    assert_true(omitted);
    assert_int_equal(r.pass.light.irradiance, 0);
    rig_end(&r);
}

static void lengths_follow_the_scale(void **unused)
{
    (void)unused;
    assert_int_equal(lsf_coarse_grid_length(1024, 1.0f), 1024);
    assert_int_equal(lsf_coarse_grid_length(1024, 0.5f), 512);
    assert_int_equal(lsf_coarse_grid_length(7, 0.5f), 4);
    assert_int_equal(lsf_coarse_grid_length(1, 0.01f), 1);
}

static void same_bits_with_any_threads(void **unused)
{
    (void)unused;
    static const char *const threads[] = {"0", "1", "8"};
    enum { WIDTH = 150, HEIGHT = 90 };
    float *first = NULL;
    for (size_t t = 0; t < LSF_COUNT(threads); t++) {
        rig r;
        setenv("LP_NUM_THREADS", threads[t], 1);
        rig_begin(&r, WIDTH, HEIGHT, 61, 45);
        unsetenv("LP_NUM_THREADS");
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                seen point =
                    (x * y) % 97 < 60 ? surface_rig_wall(&r.s, 1.0f) : surface_rig_ground();
                surface_rig_see(&r.s, x, y, &point);
            }
        for (uint32_t i = 0; i < 4 * r.width * r.height; i++)
            r.in[i] = lsf_random_float(1, i);
        rig_split(&r, 0);
        rig_run(&r);
        if (t == 0) {
            first = malloc(4 * WIDTH * HEIGHT * sizeof *first);
            assert_non_null(first);
            memcpy(first, r.out, 4 * WIDTH * HEIGHT * sizeof *first);
        } else {
            assert_memory_equal(first, r.out, 4 * WIDTH * HEIGHT * sizeof *first);
        }
        rig_end(&r);
    }
    free(first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(split_takes_one_pixel_of_each_block),
        cmocka_unit_test(a_constant_stays_to_the_bit),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(light_is_interpolated),
        cmocka_unit_test(full_scale_has_no_pass),
        cmocka_unit_test(lengths_follow_the_scale),
        cmocka_unit_test(same_bits_with_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
