/* Rough thin walls, which scatter what they let through, against closed forms: light of lamps, and
 * all that comes from a white world. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"
#include "shared/albedo.h"

static void look(const lsf_scene *scene, const char *technique, lsf_float3 eye, double rgb[3])
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    static const char *const options[] = {"shadow.texels_per_pixel=64", "voxel.resolution=32"};
    params.technique = technique;
    params.bounces = 0;
    params.samples = 64;
    params.aovs = LSF_AOV_NORMAL;
    params.fov_y = 0.1f;
    params.options = options;
    params.option_count = strstr("direct bidirectional", technique) == NULL ? 2 : 1;
    lsf_image *image = render_gl_from(scene, params, 16, eye, lsf_f3(0, 0, 0));
    mean_rgb(image, 0, rgb);
    /* Of nothing it is 0. */
    int up = lsf_image_channel(image, "normal.Y");
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height; i++)
        assert_true(image->pixels[i * image->channel_count + (uint64_t)up] >= 0.0f);
    lsf_image_destroy(image);
}

/* Smith's term of one direction for the height-correlated masking of both. */
static double smith(double alpha, double cosine)
{
    double tangent2 = 1.0 / (cosine * cosine) - 1.0;
    return 0.5 * (sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

static double schlick(double cosine)
{
    return 0.04 + 0.96 * pow(1.0 - cosine, 5.0);
}

/* (1 - F) D V cos of a wall in the plane y = 0 of index 1.5 between directions on both sides of it
 * (KHR_materials_transmission; glTF 2.0, appendix B). */
static double wall_lobe(double roughness, lsf_float3 view, lsf_float3 light)
{
    lsf_float3 mirrored = lsf_f3(light.x, -light.y, light.z);
    lsf_float3 h = lsf_f3_normalize(lsf_f3_add(view, mirrored));
    double alpha = roughness * roughness, nh = (double)h.y, nv = (double)view.y;
    double nl = (double)mirrored.y, vh = (double)lsf_f3_dot(view, h);
    double bottom = nh * nh * (alpha * alpha - 1.0) + 1.0;
    double d = alpha * alpha / (M_PI * bottom * bottom);
    double g = 1.0 / (1.0 + smith(alpha, nv) + smith(alpha, nl));
    return (1.0 - schlick(vh)) * d * g / (4.0 * nv);
}

/* A lamp behind a tinted pane, and a clear one between both: rough, and smoother than suppression
 * leaves a lobe, of which a part is then left to light that goes straight on. */
static void panes_scatter_lamps(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique;
        lsf_light_type type;
        float roughness;
    } cases[] = {
        {"direct", LSF_LIGHT_DIRECTIONAL, 0.6f}, {"bidirectional", LSF_LIGHT_POINT, 0.3f},
        {"cone", LSF_LIGHT_SPOT, 0.6f},          {"voxel_path", LSF_LIGHT_POINT, 0.6f},
        {"voxel_path", LSF_LIGHT_SPOT, 0.3f},
    };
    const double tint[3] = {0.9, 0.5, 0.2};
    const lsf_float3 eye = {0.6f, 1.7f, 0.2f}, lamp = {-0.3f, -1.5f, 0.4f};
    for (size_t k = 0; k < LSF_COUNT(cases); k++) {
        lsf_scene *scene = build_scene();
        lsf_material *glass = build_glass(scene, 1.0f, cases[k].roughness, 0.0f);
        for (int c = 0; c < 3; c++)
            glass->base_color[c] = (float)tint[c];
        build_floor(scene, 0.0f, 4.0f);
        build_glass(scene, 1.0f, 0.0f, 0.0f)->base_color[1] = 0.5f;
        build_floor(scene, -0.7f, 4.0f);
        lsf_light *light =
            build_light(scene, cases[k].type, lamp, lsf_f3_scale(lamp, -1.0f), 10.0f);
        light->outer_cone = 0.5f;
        light->inner_cone = 0.4f;
        finish_gl_scene(scene);
        double rgb[3], expected[3];
        look(scene, cases[k].technique, eye, rgb);
        double d2 = (double)lsf_f3_dot(lamp, lamp);
        double lit = cases[k].type == LSF_LIGHT_DIRECTIONAL ? 10.0 : 10.0 / d2;
        lit *= 1.0 - schlick(-(double)lsf_f3_normalize(lamp).y);
        for (int c = 0; c < 3; c++)
            expected[c] = lit * tint[c] * (c == 1 ? 0.5 : 1.0) *
                          wall_lobe((double)cases[k].roughness, lsf_f3_normalize(eye),
                                    lsf_f3_normalize(lamp));
        /* The clear pane is in few texels of the map that the picture shows, and by chance. */
        assert_seen(cases[k].technique, rgb, expected, 0.05);
        destroy_scene(scene);
    }
}

/* What a pane does with the light of a white world, each of it once: by the integrals of its lobes,
 * whatever part of what it transmits goes straight. One is smoother than suppression leaves a lobe,
 * of index 1, for it would mirror what few samples find; the other transmits a fifth. */
static void white_world(void **unused)
{
    (void)unused;
    static const char *const techniques[] = {"direct", "bidirectional", "cone", "voxel_path",
                                             "substitute_tree"};
    const lsf_float3 eye = {0.6f, 0.8f, 0};
    for (size_t k = 0; k < 2 * LSF_COUNT(techniques); k++) {
        bool smooth = k % 2 == 0;
        float roughness = smooth ? 0.08f : 0.8f, f0 = smooth ? 0.0f : 0.04f;
        float transmission = smooth ? 1.0f : 0.2f;
        lsf_scene *scene = build_scene();
        lsf_material *glass = build_glass(scene, 0.9f, roughness, 0.0f);
        glass->base_color[1] = 0.4f;
        glass->transmission = transmission;
        glass->ior = smooth ? 1.0f : 1.5f;
        build_floor(scene, 0.0f, 4.0f);
        build_environment(scene, 1.0f);
        finish_gl_scene(scene);
        double rgb[3], expected[3];
        look(scene, techniques[k / 2], eye, rgb);
        float reflected = lsf_specular_albedo(f0, 1.0f, eye.y, roughness);
        float passed = lsf_specular_albedo(1.0f - f0, 0.0f, eye.y, roughness);
        float diffuse = lsf_diffuse_albedo(f0, 1.0f, eye.y);
        for (int c = 0; c < 3; c++)
            expected[c] =
                (double)(reflected + glass->base_color[c] *
                                         (transmission * passed + (1.0f - transmission) * diffuse));
        assert_seen(techniques[k / 2], rgb, expected, 0.02);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_scatter_lamps),
        cmocka_unit_test(white_world),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
