/* Flicker: a lamp, or a box, that moves by a twentieth of a voxel a frame. The picture's largest
 * change from frame to frame, over blocks of pixels, beside that of the path tracer's pictures. */
#include <math.h>

#include "render_gl.h"

#define FRAMES 9
#define SIZE 64u
#define BLOCK 8u
#define BLOCKS ((SIZE / BLOCK) * (SIZE / BLOCK))

/* A voxel of the default grid about a room of 2 is 2 / 126. */
#define STEP (0.05f * 2.0f / 126.0f)

typedef enum moving_part { THE_LAMP, THE_BOX } moving_part;

static lsf_scene *frame_scene(moving_part part, int frame)
{
    float lamp = part == THE_LAMP ? STEP * (float)frame : 0.0f;
    float box = part == THE_BOX ? STEP * (float)frame : 0.0f;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.7f, 0.7f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_material(scene, 0.8f, 0.3f, 0.2f);
    build_box(scene, lsf_f3(-0.6f + box, -1, -0.5f), lsf_f3(-0.1f + box, -0.2f, 0.1f), false);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.3f + lamp, 0.5f, 0.2f), lsf_f3(0, -1, 0), 1.0f);
    finish_gl_scene(scene);
    return scene;
}

/* A technique, with an option or NULL, and how much more than in truth may change. A technique of
 * NULL is the path tracer. */
typedef struct drawn_by {
    const char *technique, *option;
    double bound;
} drawn_by;

static lsf_image *render_frame(const drawn_by *by, moving_part part, int frame)
{
    static const float eye[3] = {0.6f, 0.3f, 0.95f}, target[3] = {-0.3f, -0.5f, -0.4f};
    lsf_scene *scene = frame_scene(part, frame);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    /* As single frames are drawn. */
    const char *const options[] = {"shadow.filter=pcf", "sparse.blur=5", by->option};
    params.technique = by->technique;
    params.options = options;
    params.option_count = !by->technique ? 0 : by->option ? 3 : 2;
    params.width = params.height = SIZE;
    /* Of the path tracer as many as it takes for its noise to change nothing. */
    params.samples = by->technique ? 1 : part == THE_LAMP ? 64 : 256;
    params.camera_position = eye;
    params.camera_target = target;
    params.fov_y = 70.0f;
    lsf_error error = {0};
    lsf_image *image = by->technique ? render_gl(gl_test_backend(), scene, &params)
                                     : lsf_reference_render(scene, &params, 0, NULL, &error);
    if (!image)
        fail_msg("%s", error.message);
    destroy_scene(scene);
    return image;
}

static void block_means(const lsf_image *image, double means[BLOCKS])
{
    memset(means, 0, BLOCKS * sizeof *means);
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        means[i % SIZE / BLOCK + SIZE / BLOCK * (i / SIZE / BLOCK)] +=
            (double)image->pixels[i * image->channel_count + 1] / (BLOCK * BLOCK);
}

/* The largest change of a block from one frame to the next, relative to the picture's mean. */
static double largest_change(const drawn_by *by, moving_part part)
{
    double before[BLOCKS], now[BLOCKS], largest = 0.0, mean = 0.0;
    for (int frame = 0; frame < FRAMES; frame++) {
        lsf_image *image = render_frame(by, part, frame);
        block_means(image, now);
        lsf_image_destroy(image);
        for (uint32_t i = 0; i < BLOCKS; i++) {
            if (frame > 0)
                largest = fmax(largest, fabs(now[i] - before[i]));
            mean += now[i] / BLOCKS / FRAMES;
        }
        memcpy(before, now, sizeof before);
    }
    return largest / mean;
}

static void compare(moving_part part)
{
    /* Voxels add little to what shadow maps do by themselves; most where few directions see one
     * appear. */
    static const drawn_by drawn[] = {{"cone", "cone.sealed=off", 5.0},
                                     {"cone", "cone.sealed=on", 5.0},
                                     {"voxel_path", NULL, 5.0}};
    double reference = largest_change(&(drawn_by){0}, part);
    print_message("%s: path tracer %.2e", part == THE_LAMP ? "lamp" : "box", reference);
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++) {
        double change = largest_change(&drawn[i], part);
        print_message(", %s %s%.2e", drawn[i].technique, i == 0 ? "unsealed " : "", change);
        assert_true(change < drawn[i].bound * reference);
    }
    print_message("\n");
}

static void moving_lamp(void **unused)
{
    (void)unused;
    compare(THE_LAMP);
}

static void moving_box(void **unused)
{
    (void)unused;
    compare(THE_BOX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(moving_lamp), cmocka_unit_test(moving_box)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
