/* Scenes built in code: what becomes of what is added, and what is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <lightsheaf/lightsheaf.h>

#include "../io/glb.h"
#include "base/base.h"
#include "rebuild.h"

static lsf_error error;

/* --- like one of a file --- */

static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
/* One of no length, and one too long. */
static const float normals[] = {0, 0, 1, 0, 0, 0, 0, 0, 3, 0, 0.6f, 0.8f};
/* The second triangle's texture is mirrored. */
static const float uvs[] = {0, 0, 1, 0, 1, 1, 2, 0.5f};
static const float colors[] = {1, 1, 1, 1, 0.5f, 1, 1, 1, 1, 0.2f, 1, 1, 1, 1, 1, 0.25f};
static const uint32_t corners[] = {0, 1, 2, 0, 2, 3};

/* The square as two meshes: with normals, coordinates and colours, of an anisotropic material; and
 * without normals, of the default one. */
static lsf_scene *load_squares(void)
{
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"extensionsUsed\":[\"KHR_materials_anisotropy\"],"
        "\"nodes\":[{\"mesh\":0},{\"mesh\":1,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,-1,1]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
        "\"TEXCOORD_0\":2,\"COLOR_0\":3},\"indices\":4,\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":4}]}],"
        "\"materials\":[{\"alphaMode\":\"BLEND\",\"extensions\":{\"KHR_materials_anisotropy\":"
        "{\"anisotropyStrength\":0.5}}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"
        "{\"bufferView\":4,\"componentType\":5125,\"count\":6,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":32},"
        "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":64},"
        "{\"buffer\":0,\"byteOffset\":192,\"byteLength\":24}],"
        "\"buffers\":[{\"byteLength\":216}]}   ";
    const void *const parts[] = {square, normals, uvs, colors, corners};
    const size_t sizes[] = {sizeof square, sizeof normals, sizeof uvs, sizeof colors,
                            sizeof corners};
    char binary[216], *at = binary;
    for (size_t i = 0; i < LSF_COUNT(parts); at += sizes[i++])
        memcpy(at, parts[i], sizes[i]);
    lsf_scene *scene = load_glb(json, binary, sizeof binary, &error);
    if (!scene)
        fail_msg("%s", error.message);
    return scene;
}

static lsf_scene *build_squares(void)
{
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    lsf_material_desc desc = {LSF_MATERIAL_DESC_DEFAULTS};
    desc.alpha_mode = LSF_ALPHA_BLEND;
    desc.anisotropy = 0.5f;
    uint32_t material = lsf_scene_add_material(scene, NULL, &desc, NULL, 0, &error);
    lsf_mesh_part part = {LSF_MESH_PART_DEFAULTS};
    part.vertex_count = 4;
    part.positions = square;
    part.index_count = 6;
    part.indices = corners;
    lsf_mesh_part first = part;
    first.material = material;
    first.normals = normals;
    first.uvs[0] = uvs;
    first.colors = colors;
    lsf_node_desc node = {LSF_NODE_DESC_DEFAULTS};
    node.mesh = lsf_scene_add_mesh(scene, NULL, &first, 1, &error);
    assert_int_equal(lsf_scene_add_node(scene, &node, &error), 0);
    node.mesh = lsf_scene_add_mesh(scene, NULL, &part, 1, &error);
    node.matrix[14] = -1.0;
    assert_int_equal(lsf_scene_add_node(scene, &node, &error), 1);
    if (!lsf_scene_commit(scene, &error))
        fail_msg("%s", error.message);
    return scene;
}

static void assert_close_stream(const char *name, const float *values, const float *expected,
                                size_t width, uint64_t count, float tolerance)
{
    if (!values != !expected)
        fail_msg("one has %s", name);
    for (size_t i = 0; values && i < count * width; i++)
        if (!(fabsf(values[i] - expected[i]) <= tolerance))
            fail_msg("%s of vertex %zu are %.9g, expected %.9g", name, i / width, (double)values[i],
                     (double)expected[i]);
}

static void assert_same_stream(const char *name, const float *values, const float *expected,
                               size_t width, uint64_t count)
{
    assert_close_stream(name, values, expected, width, count, 0.0f);
}

/* Unit vectors that were made unit again may differ by as much. */
static void assert_same_geometry(const lsf_scene *scene, const lsf_scene *expected, float of_units)
{
    const lsf_vertices *v = &scene->vertices, *e = &expected->vertices;
    assert_int_equal(v->count, e->count);
    assert_same_stream("positions", v->position, e->position, 3, e->count);
    assert_close_stream("normals", v->normal, e->normal, 3, e->count, of_units);
    assert_close_stream("tangents", v->tangent, e->tangent, 4, e->count, of_units);
    assert_same_stream("coordinates 0", v->uv0, e->uv0, 2, e->count);
    assert_same_stream("coordinates 1", v->uv1, e->uv1, 2, e->count);
    assert_same_stream("colors", v->color, e->color, 4, e->count);
    assert_int_equal(scene->index_count, expected->index_count);
    assert_memory_equal(scene->indices, expected->indices,
                        expected->index_count * sizeof *expected->indices);
    assert_int_equal(scene->instance_count, expected->instance_count);
    assert_memory_equal(scene->instances, expected->instances,
                        expected->instance_count * sizeof *expected->instances);
    assert_memory_equal(&scene->requirements, &expected->requirements, sizeof scene->requirements);
}

static void completed_as_of_a_file(void **state)
{
    (void)state;
    lsf_scene *loaded = load_squares(), *built = build_squares();
    assert_same_geometry(built, loaded, 0.0f);
    assert_true(built->vertices.count > 4 + 6); /* mirrored corners have vertices of their own */
    assert_int_equal(built->camera_count, 1);
    assert_true(built->key_light.present);
    /* The same notes, but that a program left out normals on purpose. */
    assert_int_equal(lsf_scene_note_count(built) + 1, lsf_scene_note_count(loaded));
    uint32_t at = 0;
    for (uint32_t i = 0; i < lsf_scene_note_count(loaded); i++)
        if (!strstr(lsf_scene_note(loaded, i), "without normals"))
            assert_string_equal(lsf_scene_note(built, at++), lsf_scene_note(loaded, i));
    lsf_scene_destroy(loaded);
    lsf_scene_destroy(built);
}

static void rebuilt(void **state)
{
    (void)state;
    lsf_scene *loaded = load_default_scene("interior.gltf"), *built = rebuild(loaded);
    assert_same_geometry(built, loaded, 0x1p-23f);
    lsf_scene_destroy(loaded);
    lsf_scene_destroy(built);
}

/* Streams begin where the first part needs them: what was there before has their default. */
static void streams_that_begin_late(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    const uint8_t texel[4] = {255, 128, 0, 255};
    lsf_scene_texture_desc texture = {LSF_SCENE_TEXTURE_DESC_DEFAULTS};
    texture.width = texture.height = 1;
    texture.texels = texel;
    lsf_material_texture used = {LSF_MATERIAL_TEXTURE_DEFAULTS};
    used.texture = lsf_scene_add_texture(scene, &texture, &error);
    used.uv_set = 1;
    lsf_material_desc desc = {LSF_MATERIAL_DESC_DEFAULTS};
    uint32_t material = lsf_scene_add_material(scene, "m", &desc, &used, 1, &error);
    assert_int_equal(material, 0);
    lsf_mesh_part part = {LSF_MESH_PART_DEFAULTS};
    part.vertex_count = 3;
    part.positions = square;
    part.uvs[1] = uvs;
    assert_int_equal(lsf_scene_add_mesh(scene, "plain", &part, 1, &error), 0);
    assert_null(scene->vertices.uv1);
    part.material = material;
    assert_int_equal(lsf_scene_add_mesh(scene, "mapped", &part, 1, &error), 1);
    const float expected[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1};
    assert_memory_equal(scene->vertices.uv1, expected, sizeof expected);
    assert_null(scene->vertices.uv0);
    assert_null(scene->vertices.tangent);
    assert_null(scene->vertices.color);
    assert_string_equal(lsf_scene_name(scene, LSF_KIND_MATERIAL, 0), "m");
    lsf_scene_destroy(scene);
}

/* --- what is refused --- */

static void check_usage(bool failed, const char *call, const char *words)
{
    if (!failed || error.code != LSF_ERROR_USAGE || !strstr(error.message, words))
        fail_msg("%s: code %d, \"%s\"", call, error.code, error.message);
    error = (lsf_error){0};
}
#define REFUSED(call, words) check_usage((call) == LSF_NONE, #call, words)
#define FAILS(call, words) check_usage(!(call), #call, words)

static void textures_and_materials(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    const float bad[] = {1.0f, NAN, 0.0f}, texels[] = {1.0f, 0.5f, 0.0f};
    lsf_scene_texture_desc good = {LSF_SCENE_TEXTURE_DESC_DEFAULTS};
    good.width = good.height = 1;
    good.channels = 3;
    good.type = LSF_TEXEL_F32;
    good.texels = texels;
    lsf_scene_texture_desc t = good;
    REFUSED(lsf_scene_add_texture(NULL, &t, &error), "scene");
    REFUSED(lsf_scene_add_texture(scene, NULL, &error), "desc");
    t.width = 0;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "0 x 1");
    t = good;
    t.height = 65536;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "65536");
    t = good;
    t.channels = 5;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "5 channels");
    t = good;
    t.texels = NULL;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "texels");
    t.texels = bad;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "channel 1 of texel 0 is nan");
    t = good;
    t.srgb = true;
    REFUSED(lsf_scene_add_texture(scene, &t, &error), "sRGB");
    assert_int_equal(scene->texture_count, 0);
    assert_int_equal(lsf_scene_add_texture(scene, &good, &error), 0);

    lsf_material_desc m = {LSF_MATERIAL_DESC_DEFAULTS};
    lsf_material_texture used[2] = {{LSF_MATERIAL_TEXTURE_DEFAULTS},
                                    {LSF_MATERIAL_TEXTURE_DEFAULTS}};
    REFUSED(lsf_scene_add_material(scene, NULL, NULL, NULL, 0, &error), "desc");
    REFUSED(lsf_scene_add_material(scene, NULL, &m, NULL, 1, &error), "textures");
    REFUSED(lsf_scene_add_material(scene, NULL, &m, used, 1, &error), "texture 4294967295");
    used[0].texture = used[1].texture = 0;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, used, 2, &error), "the same use");
    used[0].uv_set = 2;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, used, 1, &error), "set 2");
    used[0].uv_set = 0;
    used[0].transform[4] = INFINITY;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, used, 1, &error), "transform");
    used[0].use = LSF_TEXTURE_USE_COUNT;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, used, 1, &error), "use");
    m.roughness = NAN;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, NULL, 0, &error), "roughness is nan");
    m = (lsf_material_desc){LSF_MATERIAL_DESC_DEFAULTS};
    m.sheen_color[2] = -0.1f;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, NULL, 0, &error), "sheen_color is -0.1");
    m = (lsf_material_desc){LSF_MATERIAL_DESC_DEFAULTS};
    m.attenuation_distance = 0.0f;
    REFUSED(lsf_scene_add_material(scene, NULL, &m, NULL, 0, &error), "attenuation_distance");
    assert_int_equal(scene->material_count, 0);
    lsf_scene_destroy(scene);
}

static void meshes(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    const float bad[] = {0, 0, 0, 1, NAN, 0, 1, 1, 0}, dark[12] = {[7] = -1.0f};
    const uint32_t beyond[] = {0, 1, 4};
    lsf_mesh_part good = {LSF_MESH_PART_DEFAULTS};
    good.vertex_count = 3;
    good.positions = square;
    lsf_mesh_part p = good;
    REFUSED(lsf_scene_add_mesh(scene, NULL, NULL, 0, &error), "parts");
    p.positions = NULL;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "positions");
    p.positions = bad;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error),
            "part 0: positions of vertex 1 are nan in component 1");
    p = good;
    p.colors = dark;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "colors of vertex 1");
    p = good;
    p.material = 0;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "material 0 does not exist");
    p = good;
    p.vertex_count = 4;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "4 corners");
    p.index_count = 3;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "indices");
    p.indices = beyond;
    REFUSED(lsf_scene_add_mesh(scene, NULL, &p, 1, &error), "index 2 is 4");
    lsf_mesh_part two[] = {good, p};
    REFUSED(lsf_scene_add_mesh(scene, NULL, two, 2, &error), "part 1");
    assert_int_equal(scene->mesh_count, 0);
    assert_int_equal(scene->vertices.count, 0);
    lsf_scene_destroy(scene);
}

static void what_is_placed(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    lsf_light_desc light = {.type = LSF_LIGHT_SPOT, .range = INFINITY, .outer_cone = 2.0f};
    REFUSED(lsf_scene_add_light(scene, NULL, NULL, &error), "desc");
    REFUSED(lsf_scene_add_light(scene, NULL, &light, &error), "outer_cone is 2");
    light.outer_cone = 0.5f;
    light.intensity[1] = INFINITY;
    REFUSED(lsf_scene_add_light(scene, NULL, &light, &error), "intensity is inf");
    light.intensity[1] = 1.0f;
    assert_int_equal(lsf_scene_add_light(scene, NULL, &light, &error), 0);

    lsf_node_desc node = {LSF_NODE_DESC_DEFAULTS};
    node.parent = 0;
    REFUSED(lsf_scene_add_node(scene, &node, &error), "parent 0 does not exist");
    node.parent = LSF_NONE;
    node.mesh = 1;
    REFUSED(lsf_scene_add_node(scene, &node, &error), "mesh 1");
    node.mesh = LSF_NONE;
    node.light = 1;
    REFUSED(lsf_scene_add_node(scene, &node, &error), "light 1");
    node.light = 0;
    node.matrix[3] = 1.0;
    REFUSED(lsf_scene_add_node(scene, &node, &error), "entry 3");
    node.matrix[3] = 0.0;
    assert_int_equal(lsf_scene_add_node(scene, &node, &error), 0);

    lsf_camera_desc camera = {LSF_CAMERA_DESC_DEFAULTS};
    REFUSED(lsf_scene_add_camera(scene, &camera, &error), "does not exist");
    camera.node = 0;
    camera.fov_y = 180.0f;
    REFUSED(lsf_scene_add_camera(scene, &camera, &error), "180");
    camera.fov_y = 50.0f;
    camera.near_plane = 0.0f;
    REFUSED(lsf_scene_add_camera(scene, &camera, &error), "near_plane is 0");
    camera.near_plane = 0.1f;
    assert_int_equal(lsf_scene_add_camera(scene, &camera, &error), 0);
    REFUSED(lsf_scene_add_camera(scene, &camera, &error), "carries one");

    const float bad[3] = {0.0f, -1.0f, 0.0f};
    lsf_environment_desc sky = {.radiance = {0.0f, NAN, 0.0f}};
    FAILS(lsf_scene_set_environment(scene, &sky, &error), "radiance nan");
    sky = (lsf_environment_desc){.texels = bad};
    FAILS(lsf_scene_set_environment(scene, &sky, &error), "0 x 0");
    sky.width = sky.height = 1;
    FAILS(lsf_scene_set_environment(scene, &sky, &error), "radiance -1");
    lsf_scene_destroy(scene);
}

/* Before it is committed nothing is done with it but adding, and afterwards anything else. */
static void the_order_of_things(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    lsf_view view;
    double matrix[16];
    lsf_mesh_part part = {LSF_MESH_PART_DEFAULTS};
    part.vertex_count = 3;
    part.positions = square;
    lsf_node_desc node = {LSF_NODE_DESC_DEFAULTS};
    node.mesh = lsf_scene_add_mesh(scene, "m", &part, 1, &error);
    assert_int_equal(lsf_scene_add_node(scene, &node, &error), 0);
    assert_null(lsf_scene_get_requirements(scene));
    assert_null(lsf_scene_describe(scene, true));
    FAILS(lsf_plan_create(scene, &params, &error), "lsf_scene_commit");
    FAILS(lsf_render_params_view(scene, &params, &view, &error), "lsf_scene_commit");
    FAILS(lsf_reference_render(scene, &params, 0, NULL, &error), "lsf_scene_commit");
    FAILS(lsf_scene_get_node(scene, 0, matrix, &error), "lsf_scene_commit");
    assert_true(lsf_scene_commit(scene, &error));
    FAILS(lsf_scene_commit(scene, &error), "whole");
    REFUSED(lsf_scene_add_node(scene, &node, &error), "whole");
    assert_true(lsf_scene_get_node(scene, 0, matrix, &error));
    lsf_plan *plan = lsf_plan_create(scene, &params, &error);
    assert_non_null(plan);
    lsf_plan_destroy(plan);
    lsf_scene_destroy(scene);
    FAILS(lsf_scene_commit(NULL, &error), "scene");
}

static void what_cannot_be_committed(void **state)
{
    (void)state;
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    lsf_node_desc node = {LSF_NODE_DESC_DEFAULTS};
    node.matrix[0] = 1e60;
    node.parent = lsf_scene_add_node(scene, &node, &error);
    assert_int_equal(lsf_scene_add_node(scene, &node, &error), 1);
    FAILS(lsf_scene_commit(scene, &error), "use smaller scales");
    FAILS(lsf_scene_commit(scene, &error), "only be destroyed");
    lsf_scene_destroy(scene);
    const lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS, .environment_path = "no such.exr"};
    assert_null(lsf_scene_create(&params, &error));
    assert_int_equal(error.code, LSF_ERROR_FILE);
    error = (lsf_error){0};
}

/* Whatever a material has can be edited, but for what vertices would have to have. */
static void edited(void **state)
{
    (void)state;
    lsf_scene *scene = build_squares();
    lsf_material_desc desc, read;
    assert_true(lsf_scene_get_material(scene, 0, &desc, &error));
    assert_true(desc.anisotropy == 0.5f);
    desc.anisotropy = 0.0f;
    desc.sheen_color[1] = 0.5f;
    desc.transmission = 1.0f;
    desc.volume = true;
    desc.attenuation_distance = 2.0f;
    desc.specular_color[0] = 3.0f;
    assert_true(lsf_scene_set_material(scene, 0, &desc, &error));
    assert_true(lsf_scene_get_material(scene, 0, &read, &error));
    assert_memory_equal(&read, &desc, sizeof desc);
    const lsf_requirements *r = lsf_scene_get_requirements(scene);
    assert_true(r->sheened && r->refractive && r->specular_varied && !r->anisotropic);
    desc.anisotropy = 0.5f;
    assert_true(lsf_scene_set_material(scene, 0, &desc, &error));
    FAILS(lsf_scene_set_material(scene, 1, &desc, &error), "no tangents");
    lsf_scene_destroy(scene);
}

/* An empty one is a scene, too. */
static void nothing_at_all(void **state)
{
    (void)state;
    const float sky[] = {1, 2, 3};
    lsf_scene *scene = lsf_scene_create(
        &(lsf_scene_params){LSF_SCENE_PARAMS_DEFAULTS, .environment_radiance = sky}, &error);
    assert_true(lsf_scene_commit(scene, &error));
    assert_true(scene->requirements.environment);
    assert_int_equal(lsf_scene_count(scene, LSF_KIND_MATERIAL), 1);
    lsf_scene_destroy(scene);
}

static void ignore_message(lsf_log_level level, const char *message, void *user)
{
    (void)level;
    (void)message;
    (void)user;
}

int main(void)
{
    lsf_log_set_handler(ignore_message, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(completed_as_of_a_file),
        cmocka_unit_test(rebuilt),
        cmocka_unit_test(streams_that_begin_late),
        cmocka_unit_test(textures_and_materials),
        cmocka_unit_test(meshes),
        cmocka_unit_test(what_is_placed),
        cmocka_unit_test(the_order_of_things),
        cmocka_unit_test(what_cannot_be_committed),
        cmocka_unit_test(edited),
        cmocka_unit_test(nothing_at_all),
    };
    return cmocka_run_group_tests_name("build", tests, NULL, NULL);
}
