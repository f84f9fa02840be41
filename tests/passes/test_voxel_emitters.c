/* Light of emissive surfaces by voxel paths and by cones: closed forms, and that points drawn on
 * them, rays that meet them by chance, and both together bring the same light. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"
#include "shared/brdf.h"

enum { MAX_OPTIONS = 3 };

static lsf_image *render(const lsf_scene *scene, const char *technique, uint32_t size,
                         uint32_t samples, uint32_t bounces, lsf_float3 eye, lsf_float3 target,
                         float fov_y, const char *const options[MAX_OPTIONS])
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = technique;
    params.samples = samples;
    params.bounces = bounces;
    params.fov_y = fov_y;
    params.options = options;
    while (params.option_count < MAX_OPTIONS && options[params.option_count])
        params.option_count++;
    return render_gl_from(scene, params, size, eye, target);
}

static double mean_of(const lsf_image *image, uint32_t channel)
{
    double sum = 0.0, pixels = (double)image->width * image->height;
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height; i++) {
        float value = image->pixels[i * image->channel_count + channel];
        assert_true(isfinite(value) && value >= 0.0f);
        sum += (double)value;
    }
    return sum / pixels;
}

/* Irradiance on a plane with unit normal n, at p, from a polygon of radiance 1 above it: half the
 * sum over its edges of the angle that p sees, times n on the edge's plane (Lambert 1760,
 * Photometria). */
static double polygon_irradiance(const lsf_float3 *corners, int count, lsf_float3 p, lsf_float3 n)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        lsf_float3 a = lsf_f3_normalize(lsf_f3_sub(corners[i], p));
        lsf_float3 b = lsf_f3_normalize(lsf_f3_sub(corners[(i + 1) % count], p));
        lsf_float3 across = lsf_f3_cross(a, b);
        double sine = sqrt((double)lsf_f3_dot(across, across));
        sum += atan2(sine, (double)lsf_f3_dot(a, b)) * (double)lsf_f3_dot(n, across) / sine;
    }
    return 0.5 * fabs(sum);
}

/* A quad about `center` with these half sides. */
static void lamp_corners(lsf_float3 center, lsf_float3 u, lsf_float3 v, lsf_float3 corners[4])
{
    for (int i = 0; i < 4; i++)
        corners[i] = lsf_f3_mad(lsf_f3_mad(center, u, i == 0 || i == 3 ? -1.0f : 1.0f), v,
                                i < 2 ? -1.0f : 1.0f);
}

/* A floor of albedo 1/2, and a quad of radiance 1 over it; a black ceiling, unless at 0. */
static lsf_scene *floor_and_lamp(const lsf_float3 corners[4], bool both, float ceiling)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 2.0f);
    if (ceiling > 0.0f) {
        build_material(scene, 0.0f, 0.0f, 0.0f);
        build_floor(scene, ceiling, 2.0f);
    }
    lsf_material *lamp = build_material(scene, 0.0f, 0.0f, 0.0f);
    lamp->double_sided = both;
    for (int c = 0; c < 3; c++)
        lamp->emission[c] = 1.0f;
    build_quad(scene, corners[0], corners[1], corners[2], corners[3]);
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

/* Light of a quad at a point of the floor, with one side that shines and with both. A voxel is 1/16
 * wide. Of a large lamp, rays that meet it by chance find a part: it looks a voxel larger and
 * nearer to them. A ceiling takes some of the voxels that a lamp shares with it. */
static void quads_over_a_plane(void **state)
{
    const char *technique = *state;
    static const char *const options[MAX_OPTIONS] = {"voxel.resolution=66"};
    const struct {
        const char *name;
        lsf_float3 center, u, v;
        double allowed;
        float ceiling;
    } cases[] = {
        {"overhead", {0.3f, 1, 0}, {0.2f, 0, 0}, {0, 0, 0.3f}, 0.005, 0},
        {"below a ceiling", {0.3f, 1, 0}, {0.2f, 0, 0}, {0, 0, 0.3f}, 0.005, 1.005f},
        {"large", {0.1f, 0.7f, 0.2f}, {0.5f, 0, 0}, {0, 0, 0.5f}, 0.03, 0},
        {"tilted", {-0.5f, 0.8f, 0.1f}, {0.15f, 0.1f, 0}, {0, 0, 0.2f}, 0.005, 0},
        {"upright", {-0.2f, 0.2f, 0}, {0, 0.19f, 0}, {0, 0, 0.3f}, 0.01, 0},
        {"a fifth of a voxel", {0.2f, 0.6f, 0.1f}, {0.0032f, 0, 0}, {0, 0, 0.0032f}, 0.003, 0},
    };
    const lsf_float3 point = lsf_f3(0, 0, 0), up = lsf_f3(0, 1, 0);
    for (size_t i = 0; i < LSF_COUNT(cases); i++)
        for (int both = i == 0 ? 0 : 1; both < 2; both++) {
            lsf_float3 corners[4];
            lamp_corners(cases[i].center, cases[i].u, cases[i].v, corners);
            lsf_scene *scene = floor_and_lamp(corners, both, cases[i].ceiling);
            lsf_image *image =
                render(scene, technique, 16, 16, 0, lsf_f3(1.5f, 0.3f, 1.2f), point, 0.2f, options);
            lsf_float3 normal = lsf_f3_cross(lsf_f3_sub(corners[1], corners[0]),
                                             lsf_f3_sub(corners[3], corners[0]));
            bool faces = both || lsf_f3_dot(normal, lsf_f3_sub(point, corners[0])) > 0.0f;
            double expected =
                faces ? 0.5 / (double)LSF_PI * polygon_irradiance(corners, 4, point, up) : 0.0;
            double found = mean_of(image, 1);
            print_message("%s%s: %.4e, expected %.4e\n", cases[i].name, both ? ", both sides" : "",
                          found, expected);
            assert_true(fabs(found - expected) <= cases[i].allowed * expected);
            lsf_image_destroy(image);
            lsf_scene_destroy(scene);
        }
}

/* Lamps that face the floor from so near that rays start above them, and strips that are narrower
 * than a voxel, which look three times as wide to rays. The picture shows the floor below them. */
static void lamps_close_to_a_plane(void **state)
{
    const char *technique = *state;
    static const char *const options[MAX_OPTIONS] = {"voxel.resolution=66"};
    const struct {
        const char *name;
        float height, half_width, half_length;
        double allowed;
    } cases[] = {
        {"half a voxel above", 0.03f, 0.1f, 0.1f, 0.02},
        {"a strip, a voxel and a half above", 0.094f, 0.016f, 0.6f, 0.02},
        {"a strip, three voxels above", 0.19f, 0.016f, 0.6f, 0.01},
    };
    const lsf_float3 point = lsf_f3(0, 0, 0), up = lsf_f3(0, 1, 0);
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_float3 corners[4];
        lamp_corners(lsf_f3(0, cases[i].height, 0), lsf_f3(cases[i].half_width, 0, 0),
                     lsf_f3(0, 0, cases[i].half_length), corners);
        lsf_scene *scene = floor_and_lamp(corners, false, 0.0f);
        lsf_image *image =
            render(scene, technique, 16, 64, 0, lsf_f3(1.5f, 0.2f, 0), point, 0.002f, options);
        double expected = 0.5 / (double)LSF_PI * polygon_irradiance(corners, 4, point, up);
        double found = mean_of(image, 1);
        print_message("%s: %.4e, expected %.4e\n", cases[i].name, found, expected);
        assert_true(fabs(found - expected) <= cases[i].allowed * expected);
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
}

static double most_of(const lsf_image *image, uint32_t channel)
{
    double most = 0.0;
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height; i++)
        most = fmax(most, (double)image->pixels[i * image->channel_count + channel]);
    return most;
}

/* A lamp a twelfth of a voxel below the ceiling of a room. What its upper side sends to the ceiling
 * goes out through the gap alone, which is 1/40 of the lamp's width. */
static void lamp_below_a_ceiling(void **state)
{
    const char *technique = *state;
    static const char *const options[MAX_OPTIONS] = {"voxel.resolution=66"};
    double light[2], most[2];
    for (int both = 0; both < 2; both++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 0.5f, 0.5f, 0.5f);
        build_box(scene, lsf_f3(-2, -1, -2), lsf_f3(2, 1, 2), true);
        lsf_material *lamp = build_material(scene, 0.0f, 0.0f, 0.0f);
        lamp->double_sided = both;
        for (int c = 0; c < 3; c++)
            lamp->emission[c] = 1.0f;
        build_quad(scene, lsf_f3(-0.1f, 0.995f, -0.1f), lsf_f3(0.1f, 0.995f, -0.1f),
                   lsf_f3(0.1f, 0.995f, 0.1f), lsf_f3(-0.1f, 0.995f, 0.1f));
        finish_gl_scene(scene);
        lsf_image *image = render(scene, technique, 32, 32, 1, lsf_f3(1.8f, 0.5f, 1.8f),
                                  lsf_f3(0, -1, 0), 60.0f, options);
        light[both] = mean_of(image, 1);
        most[both] = most_of(image, 1);
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
    print_message("down: %.5f, at most %.4f; up, too: %.5f, at most %.4f\n", light[0], most[0],
                  light[1], most[1]);
    assert_true(fabs(light[1] / light[0] - 1.0) <= 0.03);
    assert_true(most[1] <= 5.0 * most[0]);
}

enum { PLAIN = 0, BOTH_SIDES = 1, TEXTURED = 2, LARGE = 4, UNLIT = 8 };

/* A corner with a lamp: a small one that hangs, or a large one for a ceiling. */
static lsf_scene *room(int kind)
{
    static const uint8_t texels[] = {255, 255, 255, 20, 40, 90, 0, 0, 0, 200, 100, 50};
    lsf_scene *scene = build_scene();
    build_corner(scene);
    lsf_material *lamp = build_material(scene, 0.2f, 0.2f, 0.2f);
    lamp->double_sided = kind & BOTH_SIDES;
    lamp->unlit = kind & UNLIT;
    for (int c = 0; c < 3; c++) {
        lamp->emission[c] = kind & UNLIT ? 0.0f : 5.0f * (1.0f - 0.2f * (float)c);
        lamp->base_color[c] = kind & UNLIT ? 1.0f : 0.2f;
    }
    if (kind & TEXTURED) {
        lamp->emissive_texture.texture = build_texture(scene, 2, 2, 3, texels, true);
        scene->textures[0].nearest = true;
    }
    if (kind & LARGE)
        build_quad(scene, lsf_f3(-1.7f, 3, -1.9f), lsf_f3(1.7f, 3, -1.9f), lsf_f3(1.7f, 3, 1.9f),
                   lsf_f3(-1.7f, 3, 1.9f));
    else
        build_quad(scene, lsf_f3(-0.4f, 1.7f, -0.2f), lsf_f3(0.2f, 1.7f, -0.2f),
                   lsf_f3(0.2f, 1.9f, 0.5f), lsf_f3(-0.4f, 1.9f, 0.5f));
    if (kind & TEXTURED) { /* each corner of the quad shows a corner of the texture */
        scene->vertices.uv0 = calloc(2 * scene->vertices.count, sizeof(float));
        for (uint64_t i = 0; i < 2 * scene->vertices.count; i++)
            scene->vertices.uv0[i] = 0.5f + scene->vertices.position[3 * (i / 2) + 2 * (i % 2)];
    }
    finish_gl_scene(scene);
    return scene;
}

typedef struct strategies {
    char *technique;
    const char *points[3];
} strategies;

/* A voxel is 0.065 wide; met by chance, a lamp that hangs in the air looks a voxel longer and
 * wider, 20 % larger. A large one does not depend on that as much. */
static void strategies_agree(void **state)
{
    const strategies *s = *state;
    static const struct {
        const char *name;
        int kind;
        uint32_t bounces;
        double by_chance, among_points;
    } cases[] = {
        {"lamp, two bounces", PLAIN, 2, 0.25, 0.01}, {"both sides", BOTH_SIDES, 1, 0.25, 0.01},
        {"textured", TEXTURED, 1, 0.25, 0.02},       {"large", LARGE, 1, 0.06, 0.01},
        {"unlit", UNLIT | LARGE, 1, 0.005, 0.005},
    };
    uint32_t more = getenv("LSF_TEST_QUICK") ? 1 : 2;
    for (size_t k = 0; k < LSF_COUNT(cases); k++) {
        lsf_scene *scene = room(cases[k].kind);
        double light[3];
        for (int i = 0; i < 3; i++) {
            const char *const options[MAX_OPTIONS] = {"voxel.resolution=64", s->points[i]};
            uint32_t samples = more * (i == 0 && !(cases[k].kind & LARGE) ? 128 : 16);
            lsf_image *image =
                render(scene, s->technique, 16, samples, cases[k].bounces, lsf_f3(2.5f, 2, 3.5f),
                       lsf_f3(-0.5f, 0.8f, -0.5f), 35.0f, options);
            light[i] = mean_of(image, 1);
            lsf_image_destroy(image);
        }
        print_message("%s: by chance %.5f, with a point %.5f, with four %.5f\n", cases[k].name,
                      light[0], light[1], light[2]);
        double noise = more == 1 ? 2.0 : 1.0;
        assert_true(fabs(light[0] / light[1] - 1.0) <= noise * cases[k].by_chance);
        assert_true(fabs(light[2] / light[1] - 1.0) <= noise * cases[k].among_points);
        lsf_scene_destroy(scene);
    }
}

int main(void)
{
    static strategies techniques[] = {
        {"voxel_path", {"voxel_path.emitters=0", "voxel_path.emitters=1", "voxel_path.emitters=4"}},
        {"cone", {"cone.emitters=0", "cone.emitters=1", "cone.emitters=4"}}};
    const struct CMUnitTest tests[] = {
        {"quads over a plane, paths", quads_over_a_plane, NULL, NULL, techniques[0].technique},
        {"quads over a plane, cones", quads_over_a_plane, NULL, NULL, techniques[1].technique},
        {"lamps close to a plane, paths", lamps_close_to_a_plane, NULL, NULL,
         techniques[0].technique},
        {"lamps close to a plane, cones", lamps_close_to_a_plane, NULL, NULL,
         techniques[1].technique},
        {"lamp below a ceiling, paths", lamp_below_a_ceiling, NULL, NULL, techniques[0].technique},
        {"lamp below a ceiling, cones", lamp_below_a_ceiling, NULL, NULL, techniques[1].technique},
        {"strategies agree, paths", strategies_agree, NULL, NULL, &techniques[0]},
        {"strategies agree, cones", strategies_agree, NULL, NULL, &techniques[1]},
    };
    return cmocka_run_group_tests_name("voxel emitters", tests, NULL, NULL);
}
