/* Splitting, gathering and filtering of light on surfaces made by hand: what is moved, what is
 * shared and what is kept apart. */
#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "passes/interleave.h"
#include "surface_rig.h"

enum { MAX_PIXELS = 40 * 40 };

typedef struct light {
    float irradiance[4], specular[4];
} light;

typedef struct rig {
    surface_rig s;
    lsf_interleave pass;
    uint32_t size;
    GLuint irradiance, specular;
    light split[MAX_PIXELS], out[MAX_PIXELS];
} rig;

static void rig_begin(rig *r, uint32_t width, uint32_t height, int32_t size, int32_t periods)
{
    lsf_error error = {0};
    memset(r, 0, sizeof *r);
    r->size = (uint32_t)size;
    lsf_interleave_params interleave = {LSF_INTERLEAVE_PARAMS_DEFAULTS};
    interleave.size = size;
    interleave.periods = periods;
    surface_rig_begin(&r->s, width, height, false);
    lsf_interleave_plan(r->s.setup.plan, &interleave);
    surface_rig_start(&r->s);
    if (!lsf_interleave_create(&r->pass, r->s.context, r->s.setup.plan, &interleave, &error))
        fail_msg("%s", error.message);
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
}

static void rig_end(rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_interleave_destroy(&r->pass);
    surface_rig_end(&r->s);
}

/* Where a pixel lies in split order. */
static uint32_t place_of(const rig *r, uint32_t x, uint32_t y)
{
    lsf_region region =
        lsf_interleave_region(r->s.setup.plan, r->size, y % r->size * r->size + x % r->size);
    return ((uint32_t)region.y + y / r->size) * r->s.width + (uint32_t)region.x + x / r->size;
}

static light *light_at(rig *r, uint32_t x, uint32_t y)
{
    return &r->split[place_of(r, x, y)];
}

static light *out_at(rig *r, uint32_t x, uint32_t y)
{
    return &r->out[y * r->s.width + x];
}

static void read_light(rig *r, GLuint name, size_t offset)
{
    static float texels[MAX_PIXELS][4];
    surface_rig_read(name, r->s.width, r->s.height, texels[0]);
    for (uint32_t i = 0; i < r->s.width * r->s.height; i++)
        memcpy((char *)&r->out[i] + offset, texels[i], sizeof texels[i]);
}

static void rig_run(rig *r)
{
    static float irradiance[MAX_PIXELS][4], specular[MAX_PIXELS][4];
    for (uint32_t i = 0; i < r->s.width * r->s.height; i++) {
        memcpy(irradiance[i], r->split[i].irradiance, sizeof irradiance[i]);
        memcpy(specular[i], r->split[i].specular, sizeof specular[i]);
    }
    surface_rig_upload(&r->s);
    surface_rig_write(r->irradiance, r->s.width, r->s.height, irradiance[0]);
    surface_rig_write(r->specular, r->s.width, r->s.height, specular[0]);
    const lsf_split_light split = {r->irradiance, r->specular};
    lsf_interleave_split(&r->pass, &r->s.iteration, &r->s.maps);
    lsf_interleave_gather(&r->pass, &r->s.iteration, &r->s.maps, &split);
    read_light(r, r->pass.light.irradiance, offsetof(light, irradiance));
    read_light(r, r->pass.light.specular, offsetof(light, specular));
}

static float random_at(uint32_t seed, uint32_t i)
{
    return lsf_random_float(seed, i);
}

static void set_light(light *l, float irradiance, float specular)
{
    for (int c = 0; c < 4; c++) {
        l->irradiance[c] = irradiance;
        l->specular[c] = specular;
    }
}

static void random_light(rig *r)
{
    for (uint32_t i = 0; i < r->s.width * r->s.height; i++)
        for (uint32_t c = 0; c < 4; c++) {
            r->split[i].irradiance[c] = random_at(1, 4 * i + c);
            r->split[i].specular[c] = random_at(2, 4 * i + c);
        }
}

static const uint32_t odd_sizes[][2] = {{1, 1}, {7, 13}, {33, 5}};

/* Without a filter: the G-buffer where regions say, and light back in its place, to the bit. */
static void split_and_gather_keep_every_bit(void **unused)
{
    (void)unused;
    static rig r;
    static float depths[MAX_PIXELS];
    static uint32_t surfaces[MAX_PIXELS][4], glosses[MAX_PIXELS][2];
    for (size_t s = 0; s < LSF_COUNT(odd_sizes); s++)
        for (int32_t size = 2; size <= 8; size++) {
            rig_begin(&r, odd_sizes[s][0], odd_sizes[s][1], size, 0);
            for (uint32_t i = 0; i < r.s.width * r.s.height; i++) {
                seen point = surface_rig_wall(&r.s, 1.0f + random_at(3, i));
                point.roughness = random_at(4, i);
                surface_rig_see(&r.s, i % r.s.width, i / r.s.width, &point);
            }
            random_light(&r);
            rig_run(&r);
            glGetTextureImage(r.pass.split.depth, 0, GL_RED, GL_FLOAT, sizeof depths, depths);
            glGetTextureImage(r.pass.split.surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                              sizeof surfaces, surfaces);
            glGetTextureImage(r.pass.split.gloss, 0, GL_RG_INTEGER, GL_UNSIGNED_INT, sizeof glosses,
                              glosses);
            for (uint32_t i = 0; i < r.s.width * r.s.height; i++) {
                uint32_t place = place_of(&r, i % r.s.width, i / r.s.width);
                assert_memory_equal(&depths[place], &r.s.depths[i], sizeof *depths);
                assert_memory_equal(surfaces[place], r.s.surfaces[i], sizeof *surfaces);
                assert_memory_equal(glosses[place], r.s.glosses[i], sizeof *glosses);
                assert_memory_equal(&r.out[i], &r.split[place], sizeof(light));
            }
            rig_end(&r);
        }
}

/* Over any surfaces. */
static void a_constant_stays_to_the_bit(void **unused)
{
    (void)unused;
    static rig r;
    for (size_t s = 0; s < LSF_COUNT(odd_sizes); s++) {
        rig_begin(&r, odd_sizes[s][0], odd_sizes[s][1], 4, 2);
        for (uint32_t i = 0; i < r.s.width * r.s.height; i++) {
            seen point = surface_rig_wall(&r.s, 1.0f + 0.01f * random_at(3, i));
            point.normal.x += 0.3f * random_at(5, i);
            point.normal = lsf_f3_normalize(point.normal);
            point.roughness = random_at(4, i);
            surface_rig_see(&r.s, i % r.s.width, i / r.s.width, &point);
            set_light(&r.split[i], 0.1f, 1.3e5f);
        }
        rig_run(&r);
        for (uint32_t i = 0; i < r.s.width * r.s.height; i++)
            assert_memory_equal(&r.out[i], &r.split[i], sizeof(light));
        rig_end(&r);
    }
}

/* Light that repeats with the pattern becomes its mean, up to the picture's border. What is left is
 * rounding: of positions, 2^-24 of the scene against a pixel's width of 2e-2 / 0.5 at least, which
 * squared is nothing; and of sums of 17 terms along either axis, 2^-24 each.
 *
 * The specular lobe is weighed by (1 + t^2)^-2 > 1 - 2 t^2 along each axis. Over a wall at distance
 * 1 the mirrored ray turns by a pixel's angle for each pixel and its start moves by as much, half
 * of which is the facets' turn: t = pixels times that angle, and a place beyond the border is
 * taken from up to a pattern further. */
static void the_pattern_is_removed(void **unused)
{
    (void)unused;
    static const int32_t sizes[] = {2, 3, 4, 8};
    static rig r;
    for (size_t s = 0; s < LSF_COUNT(sizes); s++)
        for (int32_t periods = 1; periods <= 2; periods++)
            for (int slanted = 0; slanted < 2; slanted++) {
                rig_begin(&r, 37, 21, sizes[s], periods);
                uint32_t n = r.size;
                double mean = 0.0;
                for (uint32_t i = 0; i < n * n; i++)
                    mean += (double)random_at(6, i) / (n * n);
                seen point = slanted ? surface_rig_ground() : surface_rig_wall(&r.s, 1.0f);
                for (uint32_t y = 0; y < r.s.height; y++)
                    for (uint32_t x = 0; x < r.s.width; x++) {
                        float value = random_at(6, y % n * n + x % n);
                        surface_rig_see(&r.s, x, y, &point);
                        set_light(light_at(&r, x, y), value, value);
                    }
                rig_run(&r);
                double worst[2] = {0.0, 0.0};
                for (uint32_t i = 0; i < r.s.width * r.s.height; i++) {
                    worst[0] = fmax(worst[0], fabs((double)r.out[i].irradiance[0] - mean));
                    worst[1] = fmax(worst[1], fabs((double)r.out[i].specular[0] - mean));
                }
                print_message("size %u, %d periods, %s: off by %.1e, specular %.1e of %.2f\n", n,
                              periods, slanted ? "floor" : "wall", worst[0], worst[1], mean);
                assert_true(worst[0] <= 17 * 0x1p-24 * 2);
                double angle =
                    2.0 * (double)lsf_f3_length(lsf_f3_load(&r.s.iteration.view.forward_dx.x)) /
                    r.s.width;
                double t = angle * (n * (uint32_t)periods / 2 + n);
                assert_true(slanted || worst[1] <= 2.0 * 2.0 * t * t);
                rig_end(&r);
            }
}

/* Left and right halves see `sides` and have light 1 and 0 (specular 3 and 0). */
static void run_halves(rig *r, const seen sides[2])
{
    for (uint32_t y = 0; y < r->s.height; y++)
        for (uint32_t x = 0; x < r->s.width; x++) {
            bool right = x >= r->s.width / 2;
            surface_rig_see(&r->s, x, y, &sides[right]);
            set_light(light_at(r, x, y), right ? 0.0f : 1.0f, right ? 0.0f : 3.0f);
        }
    rig_run(r);
}

static void check_halves(rig *r)
{
    for (uint32_t y = 0; y < r->s.height; y++)
        for (uint32_t x = 0; x < r->s.width; x++) {
            bool right = x >= r->s.width / 2;
            const light *l = out_at(r, x, y);
            assert_true(fabsf(l->irradiance[0] - (right ? 0.0f : 1.0f)) < 1e-30f);
            assert_true(fabsf(l->specular[0] - (right ? 0.0f : 3.0f)) < 1e-30f);
        }
}

/* Steps of some pixels, edges, background and unlit surfaces. */
static void nothing_crosses_an_edge(void **unused)
{
    (void)unused;
    static rig r;
    for (int edge = 0; edge < 4; edge++) {
        rig_begin(&r, 32, 32, 4, 2);
        seen sides[2] = {surface_rig_wall(&r.s, 1.0f), surface_rig_wall(&r.s, 1.0f)};
        float pixel = 2.0f * lsf_f3_length(lsf_f3_load(&r.s.iteration.view.forward_dx.x)) / 32.0f;
        if (edge == 0) /* 2^-(50 / (0.5 4))^2 is 0 */
            sides[1] = surface_rig_wall(&r.s, 1.0f + 50.0f * pixel);
        else if (edge == 1)
            sides[1].normal = lsf_basis_about(sides[0].normal).t;
        else if (edge == 2)
            sides[1].background = true;
        else
            sides[1].unlit = true;
        run_halves(&r, sides);
        check_halves(&r);
        rig_end(&r);
    }
}

/* A mirror keeps its light to the bit and gives none to rougher neighbours; the rougher, the more
 * is shared. */
static void sharp_reflections_stay_sharp(void **unused)
{
    (void)unused;
    static const float roughness[] = {0.0f, 0.05f, 0.1f, 0.2f, 1.0f};
    static rig r;
    float spread[LSF_COUNT(roughness)];
    for (size_t i = 0; i < LSF_COUNT(roughness); i++) {
        rig_begin(&r, 32, 32, 4, 2);
        seen point = surface_rig_wall(&r.s, 1.0f);
        point.roughness = roughness[i];
        for (uint32_t p = 0; p < r.s.width * r.s.height; p++)
            surface_rig_see(&r.s, p % r.s.width, p / r.s.width, &point);
        random_light(&r);
        rig_run(&r);
        float low = INFINITY, high = 0.0f;
        for (uint32_t y = 0; y < r.s.height; y++)
            for (uint32_t x = 0; x < r.s.width; x++) {
                const light *out = out_at(&r, x, y);
                low = fminf(low, out->specular[0]);
                high = fmaxf(high, out->specular[0]);
                if (i == 0)
                    assert_memory_equal(out->specular, light_at(&r, x, y)->specular, 16);
            }
        spread[i] = high - low;
        print_message("roughness %.2f: spread %.3f\n", (double)roughness[i], (double)spread[i]);
        assert_true(i == 0 || spread[i] < spread[i - 1]);
        rig_end(&r);
    }
    assert_true(spread[LSF_COUNT(spread) - 1] < 0.5f * spread[0]);
    rig_begin(&r, 32, 32, 4, 2);
    seen sides[2] = {surface_rig_wall(&r.s, 1.0f), surface_rig_wall(&r.s, 1.0f)};
    sides[0].roughness = 0.0f;
    run_halves(&r, sides);
    for (uint32_t p = 0; p < r.s.width * r.s.height; p++)
        assert_true(r.out[p].specular[0] == (p % r.s.width < r.s.width / 2 ? 3.0f : 0.0f));
    rig_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(split_and_gather_keep_every_bit),
        cmocka_unit_test(a_constant_stays_to_the_bit),
        cmocka_unit_test(the_pattern_is_removed),
        cmocka_unit_test(nothing_crosses_an_edge),
        cmocka_unit_test(sharp_reflections_stay_sharp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
