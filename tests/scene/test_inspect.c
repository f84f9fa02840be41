/* What a program asks about a scene and edits by text; lights beside a file's. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "scene/scene.h"
#include <lightsheaf/lightsheaf.h>

/* A box of 2 x 2 x 2 with its front open, two blocks in it, a point light under its ceiling. */
static lsf_scene *load(const lsf_scene_params *params, lsf_error *error)
{
    const char *root = getenv("LSF_SOURCE_ROOT");
    char *path = lsf_format("%s/data/scenes/cornell_point.gltf", root ? root : ".");
    lsf_scene *scene = lsf_scene_load(path, params, error);
    free(path);
    return scene;
}

static lsf_scene *box(void)
{
    lsf_error error = {0};
    lsf_scene *scene = load(NULL, &error);
    if (!scene)
        fail_msg("%s", error.message);
    return scene;
}

static void rays(void **state)
{
    (void)state;
    lsf_scene *scene = box();
    lsf_error error = {0};
    lsf_hit hit;
    const lsf_requirements *r = lsf_scene_get_requirements(scene);
    const double middle[3] = {0.5 * (r->bounds_min[0] + r->bounds_max[0]), r->bounds_max[1] - 0.01,
                              0.5 * (r->bounds_min[2] + r->bounds_max[2])};
    static const double ways[][3] = {{0, 3, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 0, -1}};
    const double walls[] = {r->bounds_max[1], r->bounds_min[0], r->bounds_max[0], r->bounds_min[2]};
    for (int i = 0; i < 4; i++) {
        int axis = i == 0 ? 1 : i == 3 ? 2 : 0;
        assert_true(lsf_scene_trace(scene, 0.0, middle, ways[i], &hit, &error));
        assert_int_not_equal(hit.node, LSF_NONE);
        assert_true(fabs(hit.position[axis] - walls[i]) < 1e-6);
        assert_true(fabs(hit.distance - fabs(walls[i] - middle[axis])) < 1e-6);
        double length = fabs(ways[i][0] + ways[i][1] + ways[i][2]);
        assert_true(fabs((double)hit.normal[axis] + ways[i][axis] / length) < 1e-5);
    }
    static const double out[3] = {0, 0, 1}, none[3] = {0};
    assert_true(lsf_scene_trace(scene, 0.0, middle, out, &hit, &error));
    assert_int_equal(hit.node, LSF_NONE);
    assert_int_equal(hit.material, LSF_NONE);
    assert_false(lsf_scene_trace(scene, 0.0, middle, none, &hit, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);

    /* What is moved is met where it is. */
    static const double down[3] = {0, -1, 0};
    assert_true(lsf_scene_trace(scene, 0.0, middle, ways[1], &hit, &error));
    double matrix[16], before = hit.distance;
    assert_true(lsf_scene_get_node(scene, hit.node, matrix, &error));
    matrix[12] -= 0.25;
    assert_true(lsf_scene_set_node(scene, hit.node, matrix, &error));
    uint32_t node = hit.node;
    assert_true(lsf_scene_trace(scene, 0.0, middle, ways[1], &hit, &error));
    assert_int_equal(hit.node, node);
    assert_true(fabs(hit.distance - before - 0.25) < 1e-6);
    assert_true(lsf_scene_trace(scene, 0.0, middle, down, &hit, &error));
    assert_true(hit.normal[1] > 0.99f);
    lsf_scene_destroy(scene);
}

static void nodes(void **state)
{
    (void)state;
    lsf_scene *scene = box();
    lsf_error error = {0};
    lsf_node_info info;
    uint32_t lights = 0, cameras = 0, meshes = 0;
    double local[16], world[16];
    for (uint32_t i = 0; i < lsf_scene_count(scene, LSF_KIND_NODE); i++) {
        assert_true(lsf_scene_get_node_info(scene, i, &info, &error));
        lights += info.light != LSF_NONE;
        cameras += info.camera != LSF_NONE;
        meshes += info.mesh != LSF_NONE;
        assert_true(info.parent == LSF_NONE || info.parent < i);
        assert_true(lsf_scene_get_node(scene, i, local, &error));
        assert_true(lsf_scene_get_node_world(scene, i, 0.0, world, &error));
        if (info.parent == LSF_NONE)
            assert_memory_equal(local, world, sizeof local);
    }
    assert_int_equal(lights, 1);
    assert_int_equal(cameras, 1);
    assert_true(meshes > 3);
    assert_false(lsf_scene_get_node_info(scene, 1000, &info, &error));
    assert_false(lsf_scene_get_node_world(scene, 1000, 0.0, world, &error));
    lsf_scene_destroy(scene);
}

static void edits(void **state)
{
    (void)state;
    lsf_scene *scene = box();
    lsf_error error = {0};
    lsf_light_desc light;
    lsf_material_desc material;
    double matrix[16];
    assert_true(lsf_scene_edit(scene, "light/0/intensity=3,2.5,1e-1", &error));
    assert_true(lsf_scene_get_light(scene, 0, &light, &error));
    assert_true(light.intensity[0] == 3.0f && light.intensity[1] == 2.5f &&
                light.intensity[2] == 0.1f);
    assert_true(lsf_scene_edit(scene, "light/0/outer_cone=0.5", &error));
    assert_true(lsf_scene_edit(scene, "light/0/type=spot", &error));
    assert_true(lsf_scene_get_light(scene, 0, &light, &error));
    assert_true(light.type == LSF_LIGHT_SPOT && light.outer_cone == 0.5f);
    char *text = lsf_format("material/%s/base_color=0.25,0.5,0.75",
                            lsf_scene_name(scene, LSF_KIND_MATERIAL, 0));
    assert_true(lsf_scene_edit(scene, text, &error));
    free(text);
    assert_true(lsf_scene_edit(scene, "material/0/roughness=0.5", &error));
    assert_true(lsf_scene_get_material(scene, 0, &material, &error));
    assert_true(material.base_color[0] == 0.25f && material.base_color[2] == 0.75f &&
                material.base_color[3] == 1.0f && material.roughness == 0.5f);
    assert_true(
        lsf_scene_edit(scene, "node/1/matrix=1,0,0,0,0,1,0,0,0,0,1,0,0.5,0.125,-2,1", &error));
    assert_true(lsf_scene_get_node(scene, 1, matrix, &error));
    assert_true(matrix[12] == 0.5 && matrix[14] == -2.0);

    static const char *const wrong[] = {"",
                                        "light",
                                        "light/0",
                                        "light/0/intensity",
                                        "light/0/intensity=",
                                        "light/0/intensity=1,2",
                                        "light/0/intensity=1,2,3,4",
                                        "light/0/intensity=1,2,x",
                                        "light/0/intensity=-1,2,3",
                                        "light/9/intensity=1,2,3",
                                        "light/0/type=lamp",
                                        "light//intensity=1,2,3",
                                        "light/0/colour=1,2,3",
                                        "lamp/0/intensity=1,2,3",
                                        "node/1/matrix=1,0,0",
                                        "material/0/roughness=2",
                                        "/0/roughness=1"};
    for (size_t i = 0; i < LSF_COUNT(wrong); i++) {
        error.code = LSF_OK;
        if (lsf_scene_edit(scene, wrong[i], &error))
            fail_msg("%s: was taken", wrong[i]);
        assert_int_equal(error.code, LSF_ERROR_USAGE);
    }
    lsf_scene_destroy(scene);
}

/* The strength multiplies what was loaded, however often it is set. */
static void edits_of_the_environment(void **state)
{
    (void)state;
    const float radiance[] = {0.5f, 1.0f, 2.0f};
    lsf_error error = {0};
    lsf_scene *scene = box();
    assert_false(lsf_scene_edit(scene, "environment/strength=1", &error));
    lsf_scene_destroy(scene);
    const lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS, .environment_radiance = radiance};
    scene = load(&params, &error);
    assert_non_null(scene);
    assert_true(lsf_scene_edit(scene, "environment/strength=3", &error));
    assert_true(lsf_scene_get_requirements(scene)->environment);
    assert_true(lsf_scene_edit(scene, "environment/strength=0", &error));
    assert_false(lsf_scene_get_requirements(scene)->environment);
    assert_true(lsf_scene_edit(scene, "environment/strength=0.25", &error));
    assert_true(scene->environment.radiance[0] == 0.125f && scene->environment.radiance[2] == 0.5f);
    assert_true(lsf_scene_edit(scene, "environment/rotation=-90", &error));
    assert_true(scene->environment.u_offset == 0.75f);
    float rotation, strength;
    assert_true(lsf_scene_get_environment(scene, &rotation, &strength, &error));
    assert_true(rotation == -90.0f && strength == 0.25f);
    static const char *const wrong[] = {"environment/strength=-1", "environment/strength=1e25",
                                        "environment/rotation=", "environment/rotation=1,2",
                                        "environment/colour=1"};
    for (size_t i = 0; i < LSF_COUNT(wrong); i++) {
        error.code = LSF_OK;
        assert_false(lsf_scene_edit(scene, wrong[i], &error));
        assert_int_equal(error.code, LSF_ERROR_USAGE);
    }
    lsf_scene_destroy(scene);
}

static void lights(void **state)
{
    (void)state;
    lsf_error error = {0};
    lsf_placed_light placed[2] = {
        {.light = {.type = LSF_LIGHT_POINT, .intensity = {1, 2, 3}, .range = INFINITY},
         .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.25, 0.5, 0.75, 1}},
        {.light = {.type = LSF_LIGHT_SPOT,
                   .intensity = {4, 4, 4},
                   .range = INFINITY,
                   .outer_cone = 0.5f},
         .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS, .lights = placed, .light_count = 2};
    lsf_scene *plain = box(), *scene = load(&params, &error);
    assert_non_null(scene);
    uint32_t nodes = lsf_scene_count(plain, LSF_KIND_NODE);
    assert_int_equal(lsf_scene_count(scene, LSF_KIND_LIGHT), 3);
    assert_int_equal(lsf_scene_count(scene, LSF_KIND_NODE), nodes + 2);
    assert_int_equal(lsf_scene_get_requirements(scene)->point_lights, 2);
    assert_int_equal(lsf_scene_get_requirements(scene)->spot_lights, 1);
    lsf_node_info info;
    double matrix[16];
    assert_true(lsf_scene_get_node_info(scene, nodes, &info, &error));
    assert_int_equal(info.light, 1);
    assert_true(lsf_scene_get_node_world(scene, nodes, 0.0, matrix, &error));
    assert_memory_equal(matrix, placed[0].matrix, sizeof matrix);
    lsf_scene_destroy(scene);

    placed[1].light.intensity[0] = -1.0f;
    assert_null(load(&params, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    lsf_scene_destroy(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays),   cmocka_unit_test(nodes),
        cmocka_unit_test(edits),  cmocka_unit_test(edits_of_the_environment),
        cmocka_unit_test(lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
