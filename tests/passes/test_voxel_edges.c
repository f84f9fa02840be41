/* What a floor sees beside a block that stands on it, against the form factor of the block's side:
 * the voxels at the block's foot and around its edges hold two surfaces each. */
#include <math.h>

#include "light_rules.h"
#include "shared/brdf.h"

/* The room is 2 wide; 30 voxels, with the grid's margins. */
#define RESOLUTION "voxel.resolution=32"
#define VOXEL (2.0 / 30.0)

#define WIDTH 0.8
#define HEIGHT 0.7
#define DEPTH 0.5
#define TURN 0.3 /* of the block about y [radians] */

/* A point by its distance to the right of the middle of the block's front, above the floor, and
 * before the front. */
static lsf_float3 at_block(double right, double up, double before)
{
    double c = cos(TURN), s = sin(TURN);
    return lsf_f3((float)(c * right + s * before), (float)(up - 1.0),
                  (float)(c * before - s * right));
}

static void build_block(lsf_scene *scene)
{
    const double x = 0.5 * WIDTH;
    const lsf_float3 front[2] = {at_block(-x, 0, 0), at_block(x, 0, 0)},
                     back[2] = {at_block(-x, 0, -DEPTH), at_block(x, 0, -DEPTH)},
                     front_top[2] = {at_block(-x, HEIGHT, 0), at_block(x, HEIGHT, 0)},
                     back_top[2] = {at_block(-x, HEIGHT, -DEPTH), at_block(x, HEIGHT, -DEPTH)};
    build_quad(scene, front[0], front[1], front_top[1], front_top[0]);
    build_quad(scene, back[1], back[0], back_top[0], back_top[1]);
    build_quad(scene, front[1], back[1], back_top[1], front_top[1]);
    build_quad(scene, back[0], front[0], front_top[0], back_top[0]);
    build_quad(scene, front_top[0], front_top[1], back_top[1], back_top[0]);
}

static void build_walls(lsf_scene *scene)
{
    const lsf_float3 low[4] = {lsf_f3(-1, -1, -1), lsf_f3(1, -1, -1), lsf_f3(1, -1, 1),
                               lsf_f3(-1, -1, 1)},
                     high[4] = {lsf_f3(-1, 1, -1), lsf_f3(1, 1, -1), lsf_f3(1, 1, 1),
                                lsf_f3(-1, 1, 1)};
    for (int i = 0; i < 4; i++)
        build_quad(scene, low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
    build_quad(scene, high[0], high[1], high[2], high[3]);
}

/* A white floor in a room whose other walls emit 1, and a black block, or the other way round. */
static lsf_scene *block_on_floor(bool block_emits)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_floor(scene, -1.0f, 1.0f);
    for (int of_block = 0; of_block < 2; of_block++) {
        lsf_material *material = build_material(scene, 0.0f, 0.0f, 0.0f);
        if (block_emits == (of_block == 1))
            material->emission[0] = material->emission[1] = material->emission[2] = 1.0f;
        material->double_sided = true;
        if (of_block)
            build_block(scene);
        else
            build_walls(scene);
    }
    scene->diffuse_only = true;
    finish_gl_scene(scene);
    return scene;
}

/* Form factor of the front, seen from the floor before its middle (Siegel and Howell, "Thermal
 * Radiation Heat Transfer", appendix: a plane element and a perpendicular rectangle). */
static double form_factor(double distance)
{
    double a = 0.5 * WIDTH, far = hypot(distance, HEIGHT);
    return (atan(a / distance) - distance / far * atan(a / far)) / (double)LSF_PI;
}

static void foot_of_a_block(void **unused)
{
    (void)unused;
    static const char *const options[] = {RESOLUTION, "voxel_path.emitters=0"};
    for (int emits = 0; emits < 2; emits++) {
        lsf_scene *scene = block_on_floor(emits);
        for (int voxels = 1; voxels <= 8; voxels *= 2) {
            double distance = voxels * VOXEL, factor = form_factor(distance);
            lsf_float3 eye = at_block(0.0, 0.6, distance + 0.2), at = at_block(0.0, 0.0, distance);
            lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
            params.technique = "voxel_path";
            params.samples = 48;
            params.bounces = 0;
            params.options = options;
            params.option_count = 2;
            params.fov_y = 0.2f;
            lsf_image *image = render_gl_from(scene, params, 16, eye, at);
            double rgb[3], expected = emits ? factor : 1.0 - factor;
            mean_rgb(image, 0, rgb);
            print_message("%d voxels from a block that %s: %.5f, expected %.5f\n", voxels,
                          emits ? "emits" : "is dark", rgb[1], expected);
            assert_true(fabs(rgb[1] - expected) < 0.005);
            lsf_image_destroy(image);
        }
        lsf_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(foot_of_a_block)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
