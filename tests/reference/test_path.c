/* What the path tracer must do with scenes: the same bits, split layers, masks, mirrors, leaks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "math/sampling.h"
#include "render_scene.h"

static const float inside_eye[3] = {0.1f, 0.2f, 0.9f}, inside_target[3] = {-0.1f, -0.2f, -1.0f};

/* A box with everything in it: gloss, an emitter, a lamp, an environment that comes in through
 * the missing roof. `s` scales all lengths; point intensities go with its square. */
static lsf_scene *rich_scene(float s)
{
    lsf_scene *scene = build_scene();
    lsf_material *wall = build_material(scene, 0.7f, 0.6f, 0.5f);
    wall->roughness = 0.6f;
    lsf_float3 a = lsf_f3(-s, -s, -s), b = lsf_f3(s, -s, -s), c = lsf_f3(s, -s, s);
    lsf_float3 d = lsf_f3(-s, -s, s), e = lsf_f3(-s, s, -s), f = lsf_f3(s, s, -s);
    build_quad(scene, d, c, b, a);
    build_quad(scene, a, b, f, e);
    build_quad(scene, d, a, e, lsf_f3(-s, s, s));
    lsf_material *metal = build_material(scene, 0.9f, 0.7f, 0.3f);
    metal->metallic = 1.0f;
    metal->roughness = 0.3f;
    build_quad(scene, b, c, lsf_f3(s, s, s), f);
    lsf_material *lamp = build_material(scene, 0.0f, 0.0f, 0.0f);
    lamp->emission[0] = 4.0f;
    lamp->emission[1] = 3.0f;
    lamp->emission[2] = 2.0f;
    build_quad(scene, lsf_f3(-0.2f * s, 0.8f * s, -0.2f * s), lsf_f3(0.2f * s, 0.8f * s, -0.2f * s),
               lsf_f3(0.2f * s, 0.8f * s, 0.2f * s), lsf_f3(-0.2f * s, 0.8f * s, 0.2f * s));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.5f * s, 0.5f * s, 0), lsf_f3(0, -1, 0),
                0.5f * s * s);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.3f, -1, -0.2f), 0.5f);
    enum { WIDTH = 16, HEIGHT = 8 };
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (uint32_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        texels[i] = lsf_random_float(5, i) * (i / 3 == 20 ? 50.0f : 0.5f);
    finish_scene(scene);
    scene->cameras[0].near_plane *= s;
    return scene;
}

static lsf_render_params small_picture(uint32_t size, uint32_t samples, uint32_t bounces)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.width = params.height = size;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = inside_eye;
    params.camera_target = inside_target;
    params.fov_y = 70.0f;
    return params;
}

static bool same_pixels(const lsf_image *a, const lsf_image *b)
{
    size_t size = (size_t)a->width * a->height * a->channel_count * sizeof(float);
    return memcmp(a->pixels, b->pixels, size) == 0;
}

static void same_seed_same_bits(void **unused)
{
    (void)unused;
    lsf_scene *scene = rich_scene(1.0f);
    lsf_render_params params = small_picture(40, 5, 3);
    lsf_image *one = render_scene(scene, &params, 0, 1);
    lsf_image *three = render_scene(scene, &params, 0, 3);
    lsf_image *other_half = render_scene(scene, &params, 1, 1);
    params.seed = 1;
    lsf_image *other_seed = render_scene(scene, &params, 0, 1);
    assert_true(same_pixels(one, three));
    assert_false(same_pixels(one, other_half));
    assert_false(same_pixels(one, other_seed));
    lsf_image_destroy(one);
    lsf_image_destroy(three);
    lsf_image_destroy(other_half);
    lsf_image_destroy(other_seed);
    destroy_scene(scene);
}

/* Beauty is the sum of its layers to the bit; each layer holds what its name says. */
static void layers_add_up(void **unused)
{
    (void)unused;
    lsf_scene *scene = rich_scene(1.0f);
    lsf_render_params params = small_picture(24, 16, 2);
    lsf_image *image = render_scene(scene, &params, 0, 0);
    params.bounces = 0;
    lsf_image *direct = render_scene(scene, &params, 0, 0);
    double diffuse = 0.0, specular = 0.0;
    for (uint32_t i = 0; i < image->width * image->height; i++) {
        const float *p = image->pixels + i * image->channel_count;
        const float *q = direct->pixels + i * direct->channel_count;
        for (int c = 0; c < 3; c++) {
            assert_true(isfinite(p[c]));
            assert_true(p[c] == p[10 + c] + p[13 + c] + p[16 + c] + p[19 + c]);
            assert_true(q[c] == q[10 + c] + q[13 + c] && q[16 + c] == 0.0f && q[19 + c] == 0.0f);
            assert_true(p[10 + c] == q[10 + c] && p[13 + c] == q[13 + c]);
            diffuse += (double)p[16 + c];
            specular += (double)p[19 + c];
        }
    }
    assert_true(diffuse > 0.0 && specular > 0.0);
    lsf_image_destroy(image);
    lsf_image_destroy(direct);
    destroy_scene(scene);
}

/* Lengths times a power of two, intensities with them: not a bit changes, but depth's. */
static void scaling_changes_nothing(void **unused)
{
    (void)unused;
    static const float scales[] = {0x1p-20f, 0x1p20f};
    lsf_scene *scene = rich_scene(1.0f);
    lsf_render_params params = small_picture(24, 4, 3);
    lsf_image *plain = render_scene(scene, &params, 0, 0);
    for (int k = 0; k < 2; k++) {
        float s = scales[k], eye[3], target[3];
        for (int i = 0; i < 3; i++) {
            eye[i] = s * inside_eye[i];
            target[i] = s * inside_target[i];
        }
        lsf_scene *scaled = rich_scene(s);
        params.camera_position = eye;
        params.camera_target = target;
        lsf_image *image = render_scene(scaled, &params, 0, 0);
        for (uint32_t i = 0; i < image->width * image->height; i++) {
            float *depth = &image->pixels[i * image->channel_count + 9];
            *depth /= s;
        }
        assert_true(same_pixels(plain, image));
        lsf_image_destroy(image);
        destroy_scene(scaled);
    }
    lsf_image_destroy(plain);
    destroy_scene(scene);
}

/* The same light by chance among many lamps as by asking the one that they add up to. */
static void many_lights_are_one(void **unused)
{
    (void)unused;
    double means[2];
    for (int many = 0; many < 2; many++) {
        lsf_scene *scene = build_scene();
        scene->diffuse_only = true;
        build_material(scene, 0.5f, 0.5f, 0.5f);
        build_floor(scene, -0.9f, 1.0f);
        for (int i = 0; i < 20; i++) {
            int place = many ? i : i % 5;
            float intensity = many ? 0.1f * (float)(1 + i / 5) : 1.0f;
            if (many || i < 5)
                build_light(scene, LSF_LIGHT_POINT,
                            lsf_f3(0.2f * (float)(place % 5) - 0.4f, -0.2f, 0), lsf_f3(0, -1, 0),
                            intensity);
        }
        finish_scene(scene);
        lsf_render_params params = small_picture(32, many ? 1024 : 16, 0);
        lsf_image *image = render_scene(scene, &params, 0, 0);
        double mean[3];
        image_mean(image, 0, mean);
        means[many] = mean[0];
        lsf_image_destroy(image);
        destroy_scene(scene);
    }
    assert_true(fabs(means[1] / means[0] - 1.0) < 1e-3);
}

/* Two triangles to a wall, a bright lamp and an emitter outside: the closed inside stays black. */
static void no_leaks(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    lsf_material *glow = build_material(scene, 0.5f, 0.5f, 0.5f);
    glow->emission[0] = glow->emission[1] = glow->emission[2] = 1000.0f;
    build_box(scene, lsf_f3(-3, -3, -3), lsf_f3(3, 3, 3), true);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1.7f, 2, 2.3f), lsf_f3(0, -1, 0), 1e6f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.3f, -1, -0.2f), 1e6f);
    scene->environment = (lsf_environment){.present = true, .radiance = {1e6f, 1e6f, 1e6f}};
    finish_scene(scene);
    lsf_render_params params = small_picture(64, 32, 3);
    params.fov_y = 120.0f;
    lsf_image *image = render_scene(scene, &params, 0, 0);
    for (uint32_t i = 0; i < image->width * image->height; i++)
        for (int c = 0; c < 3; c++)
            assert_true(image->pixels[i * image->channel_count + (unsigned)c] == 0.0f);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

/* A checkered mask: light and sight pass where alpha is below the cutoff. */
static void masks_cut_out(void **unused)
{
    (void)unused;
    static const uint8_t texels[8] = {255, 0, 255, 255, 255, 255, 255, 0}; /* grey, alpha */
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 4.0f);
    lsf_material *mask = build_material(scene, 1.0f, 1.0f, 1.0f);
    mask->alpha_mode = LSF_ALPHA_MASK;
    mask->base_color_texture.texture = build_texture(scene, 2, 2, 2, texels, true);
    scene->textures[0].nearest = true;
    build_floor(scene, 1.0f, 1.0f);
    scene->vertices.uv0 = calloc(2 * scene->vertices.count, sizeof(float));
    for (uint64_t i = 0; i < scene->vertices.count; i++) {
        scene->vertices.uv0[2 * i] = 0.5f + 0.5f * scene->vertices.position[3 * i];
        scene->vertices.uv0[2 * i + 1] = 0.5f + 0.5f * scene->vertices.position[3 * i + 2];
    }
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 1.0f);
    finish_scene(scene);
    float rgb[3];
    const float lit = 0.5f / (float)M_PI;
    render_point(scene, lsf_f3(-3, 0.5f, -0.5f), lsf_f3(-0.5f, 0, -0.5f), 16, 0, rgb);
    assert_true(fabsf(rgb[0] - lit) < 1e-5f);
    render_point(scene, lsf_f3(-3, 0.5f, 0.5f), lsf_f3(-0.5f, 0, 0.5f), 16, 0, rgb);
    assert_true(rgb[0] == 0.0f);
    render_point(scene, lsf_f3(-0.5f, 3, -0.5f), lsf_f3(-0.5f, 0, -0.51f), 16, 0, rgb);
    assert_true(fabsf(rgb[0] - lit) < 1e-5f);
    render_point(scene, lsf_f3(-0.5f, 3, 0.5f), lsf_f3(-0.5f, 0, 0.51f), 16, 0, rgb);
    assert_true(fabsf(rgb[0] - 1.0f / (float)M_PI) < 1e-5f);
    destroy_scene(scene);
}

/* A mirrored node keeps its front: an emitter shines the way its mirror image does. */
static void mirrored_fronts(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    lsf_material *lamp = build_material(scene, 0.0f, 0.0f, 0.0f);
    lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 2.0f;
    build_floor(scene, 0.0f, 1.0f)->scale[0] = -1.0;
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0.3f, 2, 0.2f), lsf_f3(0, 0, 0), 4, 0, rgb);
    assert_true(rgb[0] == 2.0f);
    render_point(scene, lsf_f3(0.3f, -2, 0.2f), lsf_f3(0, 0, 0), 4, 0, rgb);
    assert_true(rgb[0] == 0.0f);
    scene->nodes[0].scale[0] = 1.0;
    scene->nodes[0].scale[1] = -1.0;
    render_point(scene, lsf_f3(0.3f, -2, 0.2f), lsf_f3(0, 0, 0), 4, 0, rgb);
    assert_true(rgb[0] == 2.0f);
    destroy_scene(scene);
}

/* sRGB is decoded before texels are blended: halfway between black and white is 0.5. */
static void textures_blend_linear_values(void **unused)
{
    (void)unused;
    static const uint8_t texels[12] = {0, 0, 0, 255, 255, 255, 188, 188, 188, 64, 64, 64};
    lsf_scene *scene = build_scene();
    lsf_material *screen = build_material(scene, 1.0f, 1.0f, 1.0f);
    screen->unlit = true;
    screen->base_color_texture.texture = build_texture(scene, 2, 2, 3, texels, true);
    scene->textures[0].wrap_s = scene->textures[0].wrap_t = LSF_WRAP_CLAMP;
    build_floor(scene, 0.0f, 1.0f);
    scene->vertices.uv0 = calloc(2 * scene->vertices.count, sizeof(float));
    for (uint64_t i = 0; i < scene->vertices.count; i++) {
        scene->vertices.uv0[2 * i] = 0.5f + 0.5f * scene->vertices.position[3 * i];
        scene->vertices.uv0[2 * i + 1] = 0.5f + 0.5f * scene->vertices.position[3 * i + 2];
    }
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0, 2, -0.9f), lsf_f3(0, 0, -0.9f + 1e-6f), 16, 0, rgb);
    assert_true(fabsf(rgb[0] - 0.5f) < 1e-3f);
    render_point(scene, lsf_f3(-0.9f, 2, 0.9f), lsf_f3(-0.9f, 0, 0.9f + 1e-6f), 16, 0, rgb);
    assert_true(fabsf(rgb[0] - 0.5029f) < 1e-4f);
    destroy_scene(scene);
}

/* An environment map with one bright spot, drawn by importance, lights a floor as a quadrature
 * over its bilinear texels says. */
static void environment_map_is_drawn_right(void **unused)
{
    (void)unused;
    enum { WIDTH = 32, HEIGHT = 16, FINE = 16 };
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_floor(scene, 0.0f, 1.0f);
    float *texels = build_environment_map(scene, WIDTH, HEIGHT);
    for (int c = 0; c < 3; c++) {
        texels[3 * (4 * WIDTH + 0) + c] = 100.0f; /* at the seam */
        texels[3 * (2 * WIDTH + 9) + c] = 3.0f;
    }
    finish_scene(scene);
    double expected = 0.0;
    for (int y = 0; y < HEIGHT * FINE; y++) {
        for (int x = 0; x < WIDTH * FINE; x++) {
            double u = (x + 0.5) / FINE - 0.5, v = (y + 0.5) / FINE - 0.5;
            double theta = M_PI * (y + 0.5) / (HEIGHT * FINE);
            double tx = u - floor(u), ty = v - floor(v), l = 0.0;
            for (int j = 0; j < 2; j++) {
                for (int i = 0; i < 2; i++) {
                    int tu = ((int)floor(u) + i + WIDTH) % WIDTH, tv = (int)floor(v) + j;
                    tv = tv < 0 ? 0 : tv >= HEIGHT ? HEIGHT - 1 : tv;
                    l += (i ? tx : 1.0 - tx) * (j ? ty : 1.0 - ty) *
                         (double)texels[3 * (tv * WIDTH + tu)];
                }
            }
            expected += l * fmax(0.0, cos(theta)) * sin(theta) / M_PI * 2.0 * M_PI * M_PI /
                        ((double)WIDTH * FINE * HEIGHT * FINE);
        }
    }
    float rgb[3];
    render_point(scene, lsf_f3(0, 2, 2), lsf_f3(0, 0, 0), 32768, 0, rgb);
    print_message("environment: %.6f, expected %.6f\n", (double)rgb[0], expected);
    assert_true(fabs((double)rgb[0] / expected - 1.0) < 2e-3);
    /* Seen directly: u = 0.5 + atan2(z, x) / 2 pi puts the seam at -x, v the row at 4.5 / 16. */
    double theta = M_PI * 4.5 / HEIGHT, phi = M_PI / WIDTH - M_PI;
    render_point(scene, lsf_f3(0, 2, 0),
                 lsf_f3((float)(10.0 * sin(theta) * cos(phi)), (float)(2.0 + 10.0 * cos(theta)),
                        (float)(10.0 * sin(theta) * sin(phi))),
                 4, 0, rgb);
    assert_true(fabsf(rgb[0] - 100.0f) < 0.05f);
    destroy_scene(scene);
}

static void empty_scene_shows_background(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 1.0f, 1.0f, 1.0f);
    scene->environment = (lsf_environment){.present = true, .radiance = {0.25f, 0.5f, 1.0f}};
    finish_scene(scene);
    lsf_render_params params = small_picture(3, 2, 4);
    lsf_image *image = render_scene(scene, &params, 0, 0);
    assert_true(image->pixels[0] == 0.25f && image->pixels[2] == 1.0f);
    assert_true(isinf(image->pixels[9]));
    lsf_image_destroy(image);
    destroy_scene(scene);
}

/* On a slow machine it is asked within the first pass, too. */
static bool stop_after_a_pass(uint32_t done, uint32_t total, void *user)
{
    *(uint32_t *)user = done;
    (void)total;
    return done == 0;
}

/* Stopping early leaves a picture of the samples that were taken everywhere. */
static void stops_between_passes(void **unused)
{
    (void)unused;
    lsf_scene *scene = rich_scene(1.0f);
    uint32_t done = 0;
    lsf_render_params params = small_picture(150, 1000000, 1);
    params.progress = stop_after_a_pass;
    params.progress_user = &done;
    lsf_image *stopped = render_scene(scene, &params, 0, 0);
    assert_int_equal(done, 1);
    params.progress = NULL;
    params.samples = 1;
    lsf_image *whole = render_scene(scene, &params, 0, 0);
    assert_true(same_pixels(stopped, whole));
    lsf_image_destroy(stopped);
    lsf_image_destroy(whole);
    destroy_scene(scene);
}

/* A sphere before an environment: the light that it reflects is the same before any background. */
static void background_fills_what_is_not_covered(void **state)
{
    (void)state;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_sphere(scene, 3, false);
    build_environment(scene, 2.0f);
    finish_scene(scene);
    static const float eye[3] = {0, 0, 4}, target[3] = {0, 0, 0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.width = params.height = 16;
    params.samples = 64;
    params.bounces = 0;
    params.camera_position = eye;
    params.camera_target = target;
    params.background = LSF_BACKGROUND_TRANSPARENT;
    lsf_image *clear = render_scene(scene, &params, 0, 0);
    params.background = LSF_BACKGROUND_UNIFORM;
    params.background_radiance[1] = 0.5f;
    lsf_image *image = render_scene(scene, &params, 0, 0);
    int alpha = lsf_image_channel(clear, "A");
    double covered = 0;
    for (uint64_t i = 0; i < 256; i++) {
        const float *c = clear->pixels + i * clear->channel_count;
        const float *p = image->pixels + i * image->channel_count;
        covered += (double)c[alpha] / 256;
        for (int k = 0; k < 3; k++) {
            double seen = (1 - (double)c[alpha]) * (k == 1 ? 0.5 : 0);
            assert_true(fabs((double)p[k] - (double)c[k] - seen) < 1e-5);
        }
        assert_true(p[2] <= 2.2f * c[alpha]); /* no more than the environment, but for noise */
    }
    /* A sphere of radius 1 at the distance 4 is seen as a disc of tan^2 = 1 / 15. */
    double half = tan(0.4), share = M_PI / 15 / (4 * half * half);
    assert_true(fabs(covered - share) < 0.01 * share);
    lsf_image_destroy(clear);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_seed_same_bits),
        cmocka_unit_test(layers_add_up),
        cmocka_unit_test(scaling_changes_nothing),
        cmocka_unit_test(many_lights_are_one),
        cmocka_unit_test(no_leaks),
        cmocka_unit_test(masks_cut_out),
        cmocka_unit_test(mirrored_fronts),
        cmocka_unit_test(textures_blend_linear_values),
        cmocka_unit_test(environment_map_is_drawn_right),
        cmocka_unit_test(empty_scene_shows_background),
        cmocka_unit_test(background_fills_what_is_not_covered),
        cmocka_unit_test(stops_between_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
