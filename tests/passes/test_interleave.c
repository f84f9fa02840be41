/* Interleaved sampling: the order of pixels, and that a blur removes the pattern. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "render_gl.h"

#include "passes/sparse.h"

/* Tiles cover a picture without gaps, each pixel once, in the order that regions say. */
static void regions_cover_the_picture(void **unused)
{
    (void)unused;
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {16, 8}, {5, 33}};
    for (size_t s = 0; s < LSF_COUNT(sizes); s++)
        for (uint32_t size = 1; size <= 8; size++) {
            const lsf_sparse_grid grid = {
                .stride = 1, .width = sizes[s][0], .height = sizes[s][1], .layers = 1};
            uint8_t seen[33 * 33] = {0};
            uint32_t count = 0;
            for (uint32_t tile = 0; tile < size * size; tile++) {
                lsf_region r = lsf_sparse_region(&grid, size, tile);
                for (int32_t y = r.y; y < r.y + r.height; y++)
                    for (int32_t x = r.x; x < r.x + r.width; x++) {
                        uint32_t px = (uint32_t)((x - r.x) * (int32_t)size + r.tile_x);
                        uint32_t py = (uint32_t)((y - r.y) * (int32_t)size + r.tile_y);
                        assert_true(px < grid.width && py < grid.height);
                        assert_int_equal(seen[(uint32_t)y * grid.width + (uint32_t)x]++, 0);
                        count++;
                    }
            }
            assert_int_equal(count, grid.width * grid.height);
        }
}

/* In the shader, place and pixel are inverse to each other and agree with the regions. */
static void shader_agrees(void **unused)
{
    (void)unused;
    shader_folder folder;
    shader_folder_create(&folder);
    shader_folder_write(&folder, "places.comp.glsl",
                        "#include \"lib/interleave.glsl\"\n"
                        "layout(local_size_x = 1) in;\n"
                        "layout(std430, binding = 0) buffer out_block { ivec4 places[]; };\n"
                        "layout(location = 0) uniform ivec2 length;\n"
                        "void main()\n"
                        "{\n"
                        "    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);\n"
                        "    ivec2 place = interleave_position(pixel, length);\n"
                        "    places[pixel.y * length.x + pixel.x] =\n"
                        "        ivec4(place, interleave_pixel(place, length));\n"
                        "}\n");
    lsf_context *context = gl_test_context(gl_test_backend(), folder.path);
    static const uint32_t sizes[][2] = {{1, 1}, {7, 13}, {33, 5}};
    for (int size = 1; size <= 8; size++)
        for (size_t s = 0; s < LSF_COUNT(sizes); s++) {
            uint32_t w = sizes[s][0], h = sizes[s][1];
            const lsf_sparse_grid grid = {.stride = 1, .width = w, .height = h, .layers = 1};
            lsf_error error = {0};
            const lsf_define defines[] = {{"LSF_INTERLEAVE", size > 1}, {"LSF_ORTHOGRAPHIC", 0}};
            const struct lsf_view_data view = {.jitter = {.w = (float)size}};
            lsf_program_desc desc = {.label = "places",
                                     .files = {"places.comp.glsl"},
                                     .defines = defines,
                                     .define_count = LSF_COUNT(defines)};
            GLuint program = lsf_program_get(context, &desc, &error);
            if (!program)
                fail_msg("%s", error.message);
            GLuint buffer = lsf_buffer_create(context, "places", 16 * (uint64_t)w * h, NULL,
                                              GL_MAP_READ_BIT, &error);
            GLuint view_buffer = lsf_buffer_create(context, "view", sizeof view, &view, 0, &error);
            int32_t places[33 * 13][4];
            glUseProgram(program);
            glUniform2i(0, (GLint)w, (GLint)h);
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
            glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VIEW, view_buffer);
            glDispatchCompute(w, h, 1);
            glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
            glGetNamedBufferSubData(buffer, 0, 16 * (GLsizeiptr)(w * h), places);
            for (uint32_t y = 0; y < h; y++)
                for (uint32_t x = 0; x < w; x++) {
                    uint32_t n = (uint32_t)size;
                    lsf_region r = lsf_sparse_region(&grid, n, y % n * n + x % n);
                    const int32_t *p = places[y * w + x];
                    assert_int_equal(p[0], r.x + (int32_t)(x / n));
                    assert_int_equal(p[1], r.y + (int32_t)(y / n));
                    assert_int_equal(p[2], x);
                    assert_int_equal(p[3], y);
                }
            lsf_buffer_destroy(context, &buffer);
            lsf_buffer_destroy(context, &view_buffer);
        }
    gl_test_check(context);
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
}

/* A floor that fills the picture, under a uniform environment: light is the same everywhere, and
 * each tile's samples are off by an error of their own. */
static lsf_image *render_floor(int phases)
{
    char phases_option[64];
    snprintf(phases_option, sizeof phases_option, "sparse.blur=%d", phases);
    const char *options[] = {"interleave.size=2", "bundle.count=4", "environment.open=0",
                             phases_option};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_floor(scene, 0.0f, 4.0f);
    scene->diffuse_only = true;
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    const float eye[3] = {0, 1, 0.01f}, target[3] = {0, 0, 0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "bidirectional";
    params.samples = 1;
    params.seed = 2; /* none of its directions grazes the floor */
    params.bounces = 0;
    params.width = params.height = 24;
    params.camera_position = eye;
    params.camera_target = target;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    lsf_scene_destroy(scene);
    return image;
}

/* Range of a channel over the middle of the picture, which no border touches. */
static float spread(const lsf_image *image)
{
    float low = INFINITY, high = 0.0f;
    for (uint32_t y = 6; y < 18; y++)
        for (uint32_t x = 6; x < 18; x++) {
            float value = image->pixels[(y * image->width + x) * image->channel_count];
            low = fminf(low, value);
            high = fmaxf(high, value);
        }
    return (high - low) / high;
}

static void blur_removes_the_pattern(void **unused)
{
    (void)unused;
    lsf_image *raw = render_floor(0);
    assert_true(spread(raw) > 0.05f);
    for (int phases = 1; phases <= 3; phases++) {
        lsf_image *blurred = render_floor(phases);
        print_message("%d phases: spread %.2e of %.2e\n", phases, (double)spread(blurred),
                      (double)spread(raw));
        assert_true(spread(blurred) < 1e-5f);
        lsf_image_destroy(blurred);
    }
    lsf_image_destroy(raw);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regions_cover_the_picture),
        cmocka_unit_test(shader_agrees),
        cmocka_unit_test(blur_removes_the_pattern),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
