/* GPUs move vertices to 1/256 pixel before they derive depths from them, which software GL does
 * not: here vertex shaders do. Neither shadow maps nor bundles may take the error for an occluder.
 */
#include <dirent.h>
#include <math.h>

#include "../gl/shader_folder.h"
#include "light_rules.h"

/* Shaders that draw surfaces, and the side of their viewport in pixels. */
static const struct {
    const char *shader, *size;
} surfaces[] = {
    {"gbuffer", "view.size.xy"},
    {"ray_bundle_build", "vec2(bundle.side)"},
    {"reflective_shadow_map", "vec2(light.map_shape.z)"},
    {"shadow_map", "vec2(light.map_shape.z)"},
    {"sky_map", "vec2(sky_maps[map].texel.w)"},
    {"sky_map_large", "vec2(sky_maps[map].texel.w)"},
    {"sky_map_straight", "vec2(sky_maps[map].texel.w)"},
    {"vpl_large", "vec2(light.map_shape.z)"},
    {"vpl_shadow_map", "vec2(light.map_shape.z)"},
    {"vpl_straight", "vec2(light.map_shape.z)"},
};

/* A vertex behind the viewer is left where it is, as the pipeline clips the triangle first. */
static const char move[] =
    "#define main unmoved_main\n"
    "#include \"unmoved/%s.vert.glsl\"\n"
    "#undef main\n"
    "void main()\n"
    "{\n"
    "    unmoved_main();\n"
    "    vec2 size = %s, at = (gl_Position.xy / gl_Position.w * 0.5 + 0.5) * size;\n"
    "    if (gl_Position.w > 0.0 && max(abs(at.x), abs(at.y)) < 32768.0)\n"
    "        gl_Position.xy = (floor(at * 256.0 + 0.5) / 256.0 / size * 2.0 - 1.0) * "
    "gl_Position.w;\n"
    "}\n";

static void link_to(const char *target, const char *path)
{
    char *absolute = realpath(target, NULL);
    assert_non_null(absolute);
    assert_int_equal(symlink(absolute, path), 0);
    free(absolute);
}

/* The folder's passes become links to each file, beside those that are written. */
static void write_shaders(const shader_folder *folder)
{
    char passes[96], unmoved[96];
    snprintf(passes, sizeof passes, "%s/passes", folder->path);
    snprintf(unmoved, sizeof unmoved, "%s/unmoved", folder->path);
    assert_int_equal(rename(passes, unmoved), 0);
    assert_int_equal(mkdir(passes, 0700), 0);
    DIR *files = opendir(unmoved);
    assert_non_null(files);
    for (struct dirent *file; (file = readdir(files));) {
        char *target = lsf_format("%s/%s", unmoved, file->d_name);
        char *path = lsf_format("%s/%s", passes, file->d_name);
        if (file->d_name[0] != '.')
            link_to(target, path);
        free(target);
        free(path);
    }
    closedir(files);
    for (size_t i = 0; i < LSF_COUNT(surfaces); i++) {
        char name[96], path[192], text[1024];
        snprintf(name, sizeof name, "passes/%s.vert.glsl", surfaces[i].shader);
        snprintf(path, sizeof path, "%s/%s", folder->path, name);
        snprintf(text, sizeof text, move, surfaces[i].shader, surfaces[i].size);
        assert_int_equal(unlink(path), 0);
        shader_folder_write(folder, name, text);
    }
}

static void render(const lsf_scene *scene, const char *technique, const char *shader_dir,
                   double rgb[3])
{
    static const float eye[3] = {1.6f, 1.4f, 1.9f}, target[3] = {-0.5f, 0.6f, -0.7f};
    lsf_error error = {0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1,
                                .samples = 8};
    params.technique = technique;
    params.width = params.height = 48;
    params.camera_position = eye;
    params.camera_target = target;
    lsf_context *context = gl_test_context(gl_test_backend(), shader_dir);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
}

/* Each technique's light of lamps, of a sun and of a sky. */
static void pictures_stay(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique;
        bool sun, sky;
        double allowed;
    } cases[] = {
        {"direct", false, false, 1e-3},
        {"direct", true, true, 1e-3},
        {"bidirectional", false, false, 1e-3},
        {"bidirectional", true, true, 1e-3},
        {"cone", true, true, 1e-3},
        {"voxel_path", true, true, 1e-3},
        {"substitute_tree", false, false, 5e-3},
    };
    shader_folder folder;
    shader_folder_create(&folder);
    write_shaders(&folder);
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = lit_room_scene(1.0f);
        double still[3], moved[3];
        if (cases[i].sun)
            build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f),
                        3.0f);
        if (cases[i].sky)
            build_environment(scene, 0.5f);
        finish_gl_scene(scene);
        render(scene, cases[i].technique, NULL, still);
        render(scene, cases[i].technique, folder.path, moved);
        assert_seen(cases[i].technique, moved, still, cases[i].allowed);
        lsf_scene_destroy(scene);
    }
    shader_folder_destroy(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_stay)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
