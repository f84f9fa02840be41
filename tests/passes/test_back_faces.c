/* What the camera sees: of single-sided materials their fronts alone, as glTF asks, though light
 * meets both sides; of coincident surfaces one. By the G-buffer and by the path tracer. */
#include "render_gl.h"

typedef struct sheet {
    bool faces_up, double_sided, mirrored, transmits, shows_backs;
    bool seen; /* from above */
} sheet;

/* A red sheet over a green floor, both unlit or both lit from above. */
static lsf_scene *sheet_over_floor(const sheet *s, bool lit)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0, 1, 0)->unlit = !lit;
    build_floor(scene, 0.0f, 3.0f);
    lsf_material *material = build_material(scene, 1, 0, 0);
    material->unlit = !lit;
    material->double_sided = s->double_sided;
    material->transmission = s->transmits ? 0.5f : 0.0f;
    const lsf_float3 up[4] = {{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}};
    lsf_node *node = s->faces_up ? build_quad(scene, up[0], up[1], up[2], up[3])
                                 : build_quad(scene, up[3], up[2], up[1], up[0]);
    node->scale[0] = s->mirrored ? -1.0 : 1.0;
    if (lit)
        build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0.01f, -1, 0), 1.0f);
    scene->show_back_faces = s->shows_backs;
    scene->diffuse_only = lit;
    finish_gl_scene(scene);
    return scene;
}

/* R and G of what lies at the middle, seen from above. */
static void look_down(const lsf_scene *scene, bool reference, double rgb[3])
{
    static const float eye[3] = {0.1f, 3.0f, 0.2f}, target[3] = {0, 0, 0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    lsf_error error = {0};
    params.technique = "direct";
    params.width = params.height = 8;
    params.samples = 4;
    params.bounces = 0;
    params.fov_y = 5.0f;
    params.camera_position = eye;
    params.camera_target = target;
    lsf_image *image = reference ? lsf_reference_render(scene, &params, 0, NULL, &error)
                                 : render_gl(gl_test_backend(), scene, &params);
    if (!image)
        fail_msg("%s", error.message);
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
}

static void backs_are_hidden(void **unused)
{
    (void)unused;
    static const sheet sheets[] = {
        {.faces_up = true, .seen = true},
        {.faces_up = false, .seen = false},
        {.faces_up = true, .mirrored = true, .seen = true},
        {.faces_up = false, .mirrored = true, .seen = false},
        {.faces_up = false, .double_sided = true, .seen = true},
        {.faces_up = false, .shows_backs = true, .seen = true},
        {.faces_up = false, .transmits = true, .seen = true},
    };
    for (size_t i = 0; i < sizeof sheets / sizeof *sheets; i++)
        for (int reference = 0; reference < 2; reference++) {
            lsf_scene *scene = sheet_over_floor(&sheets[i], false);
            double rgb[3];
            look_down(scene, reference, rgb);
            if (rgb[0] != (sheets[i].seen ? 1.0 : 0.0) || rgb[1] != (sheets[i].seen ? 0.0 : 1.0))
                fail_msg("sheet %zu, reference %d: %g, %g", i, reference, rgb[0], rgb[1]);
            destroy_scene(scene);
        }
}

/* What is not seen shadows nevertheless: a room does not leak where it is looked into from outside.
 */
static void backs_cast_shadows(void **unused)
{
    (void)unused;
    static const sheet hidden = {.faces_up = false};
    for (int reference = 0; reference < 2; reference++) {
        lsf_scene *scene = sheet_over_floor(&hidden, true);
        double rgb[3];
        look_down(scene, reference, rgb);
        assert_true(rgb[0] == 0.0 && rgb[1] == 0.0);
        destroy_scene(scene);
    }
}

/* Of coincident sheets, which exporters write by mistake, both show the one of the first material,
 * whichever the file names first. */
static void coincident_sheets_agree(void **unused)
{
    (void)unused;
    for (uint32_t first = 0; first < 2; first++)
        for (int reference = 0; reference < 2; reference++) {
            lsf_scene *scene = build_scene();
            build_material(scene, 1, 0, 0)->unlit = true;
            build_floor(scene, 0.0f, 1.0f);
            build_material(scene, 0, 1, 0)->unlit = true;
            build_floor(scene, 0.0f, 1.0f);
            scene->primitives[0].material = first;
            scene->primitives[1].material = 1 - first;
            finish_gl_scene(scene);
            double rgb[3];
            look_down(scene, reference, rgb);
            if (rgb[0] != 1.0 || rgb[1] != 0.0)
                fail_msg("first %u, reference %d: %g, %g", first, reference, rgb[0], rgb[1]);
            destroy_scene(scene);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backs_are_hidden),
        cmocka_unit_test(backs_cast_shadows),
        cmocka_unit_test(coincident_sheets_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
