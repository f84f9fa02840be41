/* Light at fewer points than pixels, on surfaces made by hand: what points see, what reaches
 * pixels. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "passes/sparse.h"
#include "shared/albedo.h"
#include "surface_rig.h"

typedef struct rig {
    surface_rig s;
    uint32_t interleave, places[2];
    lsf_sparse_params params;
    lsf_sparse pass;
    GLuint irradiance, specular;
    uint32_t *pixels;                     /* of each place, UINT32_MAX: none */
    float *in, *in_specular;              /* four floats a place */
    float *irradiance_out, *specular_out; /* ... and a pixel */
} rig;

static void rig_begin_view(rig *r, uint32_t width, uint32_t height, uint32_t stride,
                           uint32_t interleave, bool outliers, bool orthographic)
{
    lsf_error error = {0};
    memset(r, 0, sizeof *r);
    r->interleave = interleave;
    r->params = (lsf_sparse_params){LSF_SPARSE_PARAMS_DEFAULTS};
    r->params.outliers = outliers;
    surface_rig_begin(&r->s, width, height, orthographic);
    lsf_plan *plan = r->s.setup.plan;
    plan->stride = stride;
    plan->finest_stride = lsf_sparse_grid_finest(stride, 2 * stride * stride);
    lsf_sparse_plan_split(plan, &r->params, interleave);
    lsf_sparse_plan_gather(plan, &r->params, interleave);
    lsf_sparse_plan_upsample(plan, &r->params, interleave);
    surface_rig_start(&r->s);
    if (!lsf_sparse_create(&r->pass, r->s.context, plan, &r->params, &error))
        fail_msg("%s", error.message);
    lsf_sparse_grid_texture_size(plan, r->places);
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, r->places[0], r->places[1]);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, r->places[0], r->places[1]);
    r->pixels = calloc(r->places[0] * r->places[1], sizeof *r->pixels);
    r->in = calloc(r->places[0] * r->places[1], 4 * sizeof *r->in);
    r->in_specular = calloc(r->places[0] * r->places[1], 4 * sizeof *r->in);
    r->irradiance_out = calloc(width * height, 4 * sizeof *r->irradiance_out);
    r->specular_out = calloc(width * height, 4 * sizeof *r->specular_out);
    assert_true(r->pixels && r->in && r->in_specular && r->irradiance_out && r->specular_out);
}

static void rig_begin(rig *r, uint32_t width, uint32_t height, uint32_t stride)
{
    rig_begin_view(r, width, height, stride, 1, false, false);
}

static void rig_end(rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_sparse_destroy(&r->pass);
    surface_rig_end(&r->s);
    free(r->pixels);
    free(r->in);
    free(r->in_specular);
    free(r->irradiance_out);
    free(r->specular_out);
}

static void rig_split(rig *r)
{
    uint32_t count = r->places[0] * r->places[1];
    surface_rig_upload(&r->s);
    lsf_sparse_split(&r->pass, &r->s.iteration, &r->s.maps);
    glGetTextureImage(r->pass.split.pixels, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                      (GLsizei)(count * sizeof *r->pixels), r->pixels);
}

/* The number of the pixel that is seen at a place. */
static bool pixel_at(const rig *r, uint32_t place, uint32_t *pixel)
{
    const lsf_sparse_grid *grid = &r->s.iteration.grid;
    uint32_t packed = r->pixels[place], x = place % r->places[0], y = place / r->places[0];
    if (x >= grid->width || y >= grid->layers * grid->height || packed == UINT32_MAX)
        return false;
    *pixel = (packed >> 16) * r->s.width + (packed & 0xffffu);
    return true;
}

static void rig_run(rig *r)
{
    const lsf_split_light light = {r->irradiance, r->specular};
    surface_rig_write(r->irradiance, r->places[0], r->places[1], r->in);
    surface_rig_write(r->specular, r->places[0], r->places[1], r->in_specular);
    lsf_sparse_gather(&r->pass, &r->s.iteration, &r->s.maps, &light);
    bool sparse = r->pass.upsample_program != 0;
    if (sparse)
        lsf_sparse_upsample(&r->pass, &r->s.iteration, &r->s.maps, &r->pass.gathered);
    const lsf_split_light *out = sparse ? &r->pass.light : &r->pass.gathered;
    surface_rig_read(out->irradiance, r->s.width, r->s.height, r->irradiance_out);
    surface_rig_read(out->specular, r->s.width, r->s.height, r->specular_out);
}

static void see_all(rig *r, seen (*what)(const rig *r, uint32_t x, uint32_t y))
{
    for (uint32_t y = 0; y < r->s.height; y++)
        for (uint32_t x = 0; x < r->s.width; x++) {
            seen point = what(r, x, y);
            surface_rig_see(&r->s, x, y, &point);
        }
}

static seen a_wall(const rig *r, uint32_t x, uint32_t y)
{
    (void)x;
    (void)y;
    return surface_rig_wall(&r->s, 1.0f);
}

/* Hardly any point fits any pixel. */
static seen crumbs(const rig *r, uint32_t x, uint32_t y)
{
    uint32_t i = y * r->s.width + x;
    seen point = surface_rig_wall(&r->s, 1.0f + lsf_random_float(3, i));
    point.roughness = lsf_random_float(4, i);
    return point;
}

static seen a_rough_wall(const rig *r, uint32_t x, uint32_t y)
{
    uint32_t i = y * r->s.width + x;
    seen point = surface_rig_wall(&r->s, 1.0f + 0.01f * lsf_random_float(3, i));
    point.normal.x += 0.3f * lsf_random_float(5, i);
    point.normal = lsf_f3_normalize(point.normal);
    return point;
}

static const uint32_t sizes[][3] = {{64, 48, 4}, {48, 27, 16}, {37, 21, 2}, {7, 13, 8}, {5, 3, 16}};

/* Over stride x stride iterations each pixel is a point once; then the stride is halved. */
static void phases_fill_the_picture(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++) {
        uint32_t w = sizes[s][0], h = sizes[s][1], first = 0;
        lsf_plan plan = {
            .seen_width = w, .seen_height = h, .stride = sizes[s][2], .finest_stride = 1};
        for (uint32_t stride = sizes[s][2]; stride > 1; stride /= 2) {
            uint32_t turns[64 * 48] = {0};
            bool small = w < stride || h < stride; /* phases are those of pixels then */
            for (uint32_t i = 0; i < stride * stride; i++) {
                lsf_sparse_grid grid = lsf_sparse_grid_at(&plan, first + i, 7 + i, 0x12345u);
                assert_int_equal(grid.stride, stride);
                for (uint32_t y = grid.phase[1]; y < h; y += stride)
                    for (uint32_t x = grid.phase[0]; x < w; x += stride)
                        turns[y * w + x]++;
            }
            for (uint32_t i = 0; i < w * h; i++)
                assert_true(small ? turns[i] >= 1 : turns[i] == 1);
            first += stride * stride;
        }
        assert_int_equal(lsf_sparse_grid_at(&plan, first, 0, 0).stride, 1);
    }
    assert_int_equal(lsf_sparse_grid_finest(4, 16), 4);
    assert_int_equal(lsf_sparse_grid_finest(4, 17), 2);
    assert_int_equal(lsf_sparse_grid_finest(4, 21), 1);
    assert_int_equal(lsf_sparse_grid_finest(16, UINT32_MAX), 1);
    assert_int_equal(lsf_sparse_grid_finest(1, 5), 1);
}

/* Each place sees its pixel, bit for bit; those of the first layer are the grid's, in the order of
 * tiles, those of the second are others of the same block. */
static void places_see_their_pixels(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++)
        for (uint32_t tiles = 1; tiles <= 3; tiles += 2) {
            rig r;
            rig_begin_view(&r, sizes[s][0], sizes[s][1], sizes[s][2], tiles, false, false);
            see_all(&r, crumbs);
            lsf_iteration_begin(&r.s.iteration, (uint32_t)s);
            rig_split(&r);
            uint32_t count = r.places[0] * r.places[1], own = 0, firsts = 0;
            const lsf_sparse_grid *grid = &r.s.iteration.grid;
            float *depths = malloc(count * sizeof *depths);
            uint32_t(*surfaces)[4] = malloc(count * sizeof *surfaces);
            uint32_t(*glosses)[2] = malloc(count * sizeof *glosses);
            assert_true(depths && surfaces && glosses);
            glGetTextureImage(r.pass.split.depth, 0, GL_RED, GL_FLOAT,
                              (GLsizei)(count * sizeof *depths), depths);
            glGetTextureImage(r.pass.split.surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                              (GLsizei)(count * sizeof *surfaces), surfaces);
            glGetTextureImage(r.pass.split.specular_params, 0, GL_RG_INTEGER, GL_UNSIGNED_INT,
                              (GLsizei)(count * sizeof *glosses), glosses);
            for (uint32_t tile = 0; tile < tiles * tiles; tile++) {
                lsf_region region = lsf_sparse_region(grid, tiles, tile);
                int32_t rows = region.height / 2;
                for (int32_t y = 0; y < region.height; y++)
                    for (int32_t x = 0; x < region.width; x++) {
                        uint32_t i =
                            (uint32_t)(region.y + y) * r.places[0] + (uint32_t)(region.x + x);
                        uint32_t px = (uint32_t)x * tiles + (uint32_t)region.tile_x, pixel;
                        uint32_t py = (uint32_t)(y % rows) * tiles + (uint32_t)region.tile_y;
                        if (!pixel_at(&r, i, &pixel)) {
                            assert_true(depths[i] <= 0.0f);
                            continue;
                        }
                        uint32_t at[2] = {pixel % r.s.width, pixel / r.s.width};
                        if (y < rows) {
                            assert_int_equal(at[0], px * grid->stride + grid->phase[0]);
                            assert_int_equal(at[1], py * grid->stride + grid->phase[1]);
                        } else {
                            assert_int_equal(at[0] / grid->stride, px);
                            assert_int_equal(at[1] / grid->stride, py);
                        }
                        firsts += y < rows;
                        own += y >= rows;
                        assert_memory_equal(&depths[i], &r.s.depths[pixel], sizeof *depths);
                        assert_memory_equal(surfaces[i], r.s.surfaces[pixel], sizeof *surfaces);
                        assert_memory_equal(glosses[i], r.s.glosses[pixel], sizeof *glosses);
                    }
            }
            assert_true(firsts > 0 && firsts <= grid->width * grid->height);
            assert_true(s > 1 || own > 0);
            free(depths);
            free(surfaces);
            free(glosses);
            rig_end(&r);
        }
}

/* Over any surfaces, of any colour; unlit ones and the background get none. The specular part is
 * divided by its tint and multiplied again. */
static void a_constant_stays(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++)
        for (int outliers = 0; outliers < 2; outliers++) {
            rig r;
            rig_begin_view(&r, sizes[s][0], sizes[s][1], sizes[s][2], 1, outliers, false);
            see_all(&r, a_rough_wall);
            for (uint32_t i = 0; i < 4 * r.places[0] * r.places[1]; i++)
                r.in[i] = 0.1f;
            rig_split(&r);
            rig_run(&r);
            for (uint32_t i = 0; i < 4 * r.s.width * r.s.height; i++)
                assert_true(fabsf(r.irradiance_out[i] - 0.1f) <= 0.0f);
            rig_end(&r);
        }
}

/* Of a metal of any colour in each pixel, under light that is the same everywhere. */
static float mirrored(const rig *r, uint32_t pixel, int channel)
{
    uint32_t x = pixel % r->s.width, y = pixel / r->s.width;
    uint32_t bits = channel < 2 ? r->s.surfaces[pixel][2] >> 16 * channel : r->s.surfaces[pixel][3];
    lsf_float3 ray = lsf_f3_normalize(surface_rig_ray(&r->s, x, y));
    lsf_float3 normal = surface_rig_wall(&r->s, 1.0f).normal;
    return lsf_specular_albedo((float)(bits & 0xffffu) / 65535.0f, 1.0f, -lsf_f3_dot(ray, normal),
                               0.5f);
}

static void metals_keep_their_texture(void **unused)
{
    (void)unused;
    rig r;
    rig_begin(&r, 32, 24, 4);
    for (uint32_t y = 0; y < r.s.height; y++)
        for (uint32_t x = 0; x < r.s.width; x++) {
            uint32_t i = y * r.s.width + x;
            seen point = surface_rig_wall(&r.s, 1.0f);
            point.roughness = 0.5f;
            surface_rig_see(&r.s, x, y, &point);
            r.s.surfaces[i][3] = (i * 40503u & 0xffffu) | 0x7fff0000u;
        }
    rig_split(&r);
    for (uint32_t i = 0, pixel; i < r.places[0] * r.places[1]; i++)
        for (int c = 0; pixel_at(&r, i, &pixel) && c < 3; c++)
            r.in_specular[4 * i + (uint32_t)c] = 2.0f * mirrored(&r, pixel, c);
    rig_run(&r);
    for (uint32_t i = 0; i < r.s.width * r.s.height; i++)
        for (int c = 0; c < 3; c++) {
            float expected = 2.0f * mirrored(&r, i, c);
            float found = r.specular_out[4 * i + (uint32_t)c];
            if (fabsf(found - expected) > 1e-3f * expected)
                fail_msg("pixel %u, channel %d: %g instead of %g", i, c, (double)found,
                         (double)expected);
        }
    rig_end(&r);
}

typedef struct layout {
    seen sides[2];
    bool (*right)(uint32_t x, uint32_t y);
} layout;

/* Light 1 on one side, 2 on the other: no pixel gets anything else but those that are counted. */
static void check_sides(rig *r, const layout *l, bool thin)
{
    uint64_t wrong = 0;
    for (uint32_t iteration = 0; iteration < 4; iteration++) {
        lsf_iteration_begin(&r->s.iteration, iteration);
        for (uint32_t y = 0; y < r->s.height; y++)
            for (uint32_t x = 0; x < r->s.width; x++)
                surface_rig_see(&r->s, x, y, &l->sides[l->right(x, y)]);
        rig_split(r);
        for (uint32_t i = 0, pixel; i < r->places[0] * r->places[1]; i++)
            for (int c = 0; pixel_at(r, i, &pixel) && c < 4; c++)
                r->in[4 * i + (uint32_t)c] =
                    l->right(pixel % r->s.width, pixel / r->s.width) ? 2.0f : 1.0f;
        rig_run(r);
        for (uint32_t i = 0; i < r->s.width * r->s.height; i++) {
            bool right = l->right(i % r->s.width, i / r->s.width);
            bool dark = l->sides[right].background || l->sides[right].unlit;
            float expected = dark ? 0.0f : right ? 2.0f : 1.0f;
            wrong += fabsf(r->irradiance_out[4 * i] - expected) > 1e-3f * expected;
        }
    }
    const uint64_t *counts = lsf_sparse_counts(&r->pass);
    assert_true(wrong <= counts[LSF_SPARSE_BORROWED]);
    assert_true(counts[LSF_SPARSE_BORROWED] < r->s.width * r->s.height / 250);
    bool lit = !l->sides[1].background && !l->sides[1].unlit;
    assert_true(!thin || !lit || counts[LSF_SPARSE_ALONE] > 0);
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

/* Two pixels wide, between the points of many phases. */
static bool on_post(uint32_t x, uint32_t y)
{
    (void)y;
    return x == 31 || x == 32;
}

static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    bool (*const rights[])(uint32_t, uint32_t) = {right_half, on_bar, on_post};
    for (size_t form = 0; form < LSF_COUNT(rights); form++)
        for (int edge = 0; edge < 4; edge++) {
            rig r;
            rig_begin(&r, 80, 64, form == 2 ? 16 : 4);
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
            check_sides(&r, &l, form == 2);
            rig_end(&r);
        }
}

/* Light that is linear over a wall, and so over the picture, stays it between the outermost points;
 * 2^-20 is rounding. */
static void light_is_interpolated(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < 3; s++)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            rig r;
            rig_begin_view(&r, sizes[s][0], sizes[s][1], sizes[s][2], 1, false, orthographic);
            see_all(&r, a_wall);
            rig_split(&r);
            const lsf_sparse_grid *grid = &r.s.iteration.grid;
            uint32_t last[2] = {0, 0};
            for (uint32_t i = 0, pixel; i < r.places[0] * r.places[1]; i++)
                for (uint32_t c = 0; pixel_at(&r, i, &pixel) && c < 4; c++) {
                    uint32_t x = pixel % r.s.width, y = pixel / r.s.width;
                    last[0] = x > last[0] ? x : last[0];
                    last[1] = y > last[1] ? y : last[1];
                    r.in[4 * i + c] = (float)(x + 2 * y) / 256.0f;
                }
            rig_run(&r);
            for (uint32_t y = grid->phase[1]; y <= last[1]; y++)
                for (uint32_t x = grid->phase[0]; x <= last[0]; x++) {
                    float expected = (float)(x + 2 * y) / 256.0f;
                    float found = r.irradiance_out[4 * (y * r.s.width + x)];
                    assert_true(fabsf(found - expected) < 0x1p-20f);
                }
            rig_end(&r);
        }
}

/* One point of light 8 among others of 1, and one of none, in the colour of all. */
static void outliers_get_the_mean_of_their_neighbours(void **unused)
{
    (void)unused;
    for (uint32_t stride = 1; stride <= 4; stride *= 4) {
        rig r;
        rig_begin_view(&r, 64, 48, stride, 1, true, false);
        see_all(&r, a_wall);
        if (stride > 1)
            rig_split(&r);
        else
            surface_rig_upload(&r.s);
        uint32_t spike = 5 * r.places[0] + 5, dark = 8 * r.places[0] + 9;
        for (uint32_t i = 0; i < r.places[0] * r.places[1]; i++) {
            float noise = 1.0f + 0.1f * lsf_random_float(6, i);
            float level = i == spike ? 8.0f : i == dark ? 0.0f : noise;
            r.in[4 * i] = 1.5f * level;
            r.in[4 * i + 1] = level;
            r.in[4 * i + 2] = i == spike ? 2.0f * level : 0.5f * level;
        }
        rig_run(&r);
        const lsf_sparse_grid *grid = &r.s.iteration.grid;
        for (int k = 0; k < 2; k++) {
            uint32_t place = k ? dark : spike;
            uint32_t x = place % r.places[0] * stride + grid->phase[0];
            uint32_t y = place / r.places[0] * stride + grid->phase[1];
            const float *found = &r.irradiance_out[4 * (y * r.s.width + x)];
            float own = 0.2126f * found[0] + 0.7152f * found[1] + 0.0722f * found[2];
            float mean = 0.2126f * 1.5f + 0.7152f + 0.0722f * 0.5f;
            assert_true(own >= mean * 1.0f && own <= mean * 1.1f);
            assert_true(fabsf(found[0] - 1.5f * found[1]) < 1e-5f * found[0]);
            if (k == 0)
                assert_true(fabsf(found[2] - 2.0f * found[1]) < 1e-5f * found[2]);
        }
        rig_end(&r);
    }
}

/* With every pixel a point there is no pass, and the plan says why. */
static void every_pixel_has_no_pass(void **unused)
{
    (void)unused;
    rig r;
    memset(&r, 0, sizeof r);
    r.params = (lsf_sparse_params){LSF_SPARSE_PARAMS_DEFAULTS};
    surface_rig_begin(&r.s, 16, 8, false);
    lsf_plan *plan = r.s.setup.plan;
    uint64_t passes = plan->pass_count, resources = plan->resource_count;
    lsf_sparse_plan_split(plan, &r.params, 1);
    lsf_sparse_plan_gather(plan, &r.params, 1);
    lsf_sparse_plan_upsample(plan, &r.params, 1);
    assert_int_equal(plan->pass_count, passes);
    assert_int_equal(plan->resource_count, resources);
    bool omitted = false;
    for (uint64_t i = 0; i < plan->omission_count; i++)
        omitted |= strcmp(plan->omissions[i].name, "sparse") == 0;
    assert_true(omitted);
    surface_rig_start(&r.s);
    surface_rig_end(&r.s);
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
        rig_begin(&r, WIDTH, HEIGHT, 4);
        unsetenv("LP_NUM_THREADS");
        see_all(&r, crumbs);
        for (uint32_t i = 0; i < 4 * r.places[0] * r.places[1]; i++)
            r.in[i] = lsf_random_float(1, i);
        rig_split(&r);
        rig_run(&r);
        if (t == 0) {
            first = malloc(4 * WIDTH * HEIGHT * sizeof *first);
            assert_non_null(first);
            memcpy(first, r.irradiance_out, 4 * WIDTH * HEIGHT * sizeof *first);
        } else {
            assert_memory_equal(first, r.irradiance_out, 4 * WIDTH * HEIGHT * sizeof *first);
        }
        rig_end(&r);
    }
    free(first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phases_fill_the_picture),
        cmocka_unit_test(places_see_their_pixels),
        cmocka_unit_test(a_constant_stays),
        cmocka_unit_test(metals_keep_their_texture),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(light_is_interpolated),
        cmocka_unit_test(outliers_get_the_mean_of_their_neighbours),
        cmocka_unit_test(every_pixel_has_no_pass),
        cmocka_unit_test(same_bits_with_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
