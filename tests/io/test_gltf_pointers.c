/* KHR_animation_pointer and KHR_node_visibility: values at an instant against those found by hand,
 * what they require, and what is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "base/base.h"
#include "glb.h"
#include "scene/state.h"

#include <lightsheaf/lightsheaf.h>

static lsf_error error;

/* --- a file --- */

/* Keys at 0 and 1 second, then values of them, at places (floats) that `accessors` names. */
static const float floats[] = {
    0,    0,     0,     1, 0,    0, 0, 1,    0, /* 0: a triangle */
    0,    1,                                    /* 9: times */
    1,    0,     0,     1, 0,    1, 0, 0.5f, /* 11: base colours; from 11 on 1, 0, 0, 1 as floats */
    0,    8,                                 /* 19: strengths, intensities */
    0,    0,     2,     0, 1,    0,          /* 21: cubic: in, value, out of two keys */
    1,    0.5f,  0.25f, 0, 0.5f, 1,          /* 27: light colours */
    0.5f, 1.0f,                              /* 33: angles */
    0,    0,     2,     4,                   /* 35: offsets */
    0,    0,     0,     4, 2,    0,          /* 39: translations */
    1,    3,                                 /* 45: out of the range of a share */
    1.0f, 0.25f,                             /* 47: roughness */
};
enum { FLOATS = sizeof floats / sizeof *floats };

#define ACCESSOR(at, count, type)                                                                  \
    "{\"bufferView\":0,\"byteOffset\":" #at ",\"componentType\":5126,\"count\":" #count            \
    ",\"type\":\"" type "\"}"
#define POSITIONS                                                                                  \
    "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","                      \
    "\"min\":[0,0,0],\"max\":[1,1,0]}"

/* Accessors: 0 positions, 1 times, 2 colours, 3 strengths, 4 cubic, 5 light colours, 6 angles,
 * 7 offsets, 8 translations, 9 too much, 10 roughness, 11 visibility. */
static lsf_scene *load(const char *channels, const char *samplers)
{
    static const char image[] =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAA"
        "ADElEQVR4nGP43+AAAARBAcAM0e2RAAAAAElFTkSuQmCC";
    char binary[sizeof floats + 4] = {0};
    memcpy(binary, floats, sizeof floats);
    binary[sizeof floats + 1] = 1; /* hidden, then visible */
    char *json = lsf_format(
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,5]}],"
        "\"extensionsUsed\":[\"KHR_animation_pointer\",\"KHR_node_visibility\","
        "\"KHR_lights_punctual\",\"KHR_materials_transmission\",\"KHR_texture_transform\","
        "\"KHR_materials_emissive_strength\"],"
        "\"nodes\":[{\"name\":\"a\",\"mesh\":0},{\"name\":\"lamp\",\"extensions\":"
        "{\"KHR_lights_punctual\":{\"light\":0}}},{\"name\":\"c\",\"camera\":0},{\"name\":\"d\","
        "\"camera\":0,\"children\":[4],\"extensions\":{\"KHR_node_visibility\":{\"visible\":%s}}},"
        "{\"name\":\"below\",\"mesh\":0,\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
        "{\"name\":\"never\",\"mesh\":1,\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}"
        "}}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.7,\"znear\":0.1}}],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"color\":[1,1,0."
        "5],"
        "\"intensity\":2,\"range\":10,\"spot\":{\"innerConeAngle\":0.2,\"outerConeAngle\":0.4}}]}},"
        "\"images\":[{\"uri\":\"%s\"}],\"textures\":[{\"source\":0}],"
        "\"materials\":[{\"alphaMode\":\"BLEND\",\"emissiveFactor\":[1,0.5,0.25],"
        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":"
        "{\"KHR_texture_transform\":{\"scale\":[2,2]}}}},\"extensions\":"
        "{\"KHR_materials_transmission\":{},\"KHR_materials_emissive_strength\":"
        "{\"emissiveStrength\":0}}},{}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":1}]}],"
        "\"animations\":[{\"channels\":[%s],\"samplers\":[%s]}],"
        "\"accessors\":[" POSITIONS
        "," ACCESSOR(36, 2, "SCALAR") "," ACCESSOR(44, 2, "VEC4") "," ACCESSOR(76, 2, "SCALAR") "," ACCESSOR(84, 6, "SCALAR") "," ACCESSOR(
            108, 2,
            "VEC3") "," ACCESSOR(132, 2,
                                 "SCALAR") "," ACCESSOR(140, 2,
                                                        "VEC2") "," ACCESSOR(156, 2,
                                                                             "VEC3") "," ACCESSOR(180,
                                                                                                  2,
                                                                                                  "SCALAR") "," ACCESSOR(188,
                                                                                                                         2,
                                                                                                                         "SCALAR") ","
                                                                                                                                   "{\"bufferView\":1,\"componentType\":5121,\"count\":2,\"type\":\"SCALAR\"}],"
                                                                                                                                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d},{\"buffer\":0,\"byteOffset\":%d,"
                                                                                                                                   "\"byteLength\":2}],\"buffers\":[{\"byteLength\":%d}]}   ",
        strstr(channels, "visible") ? "true" : "false", image, channels, samplers,
        (int)sizeof floats, (int)sizeof floats, (int)sizeof binary);
    assert_non_null(json);
    error = (lsf_error){0};
    lsf_scene *scene = load_glb(json, binary, sizeof binary, &error);
    free(json);
    return scene;
}

#define CHANNEL(sampler, pointer)                                                                  \
    "{\"sampler\":" #sampler ",\"target\":{\"path\":\"pointer\",\"extensions\":"                   \
    "{\"KHR_animation_pointer\":{\"pointer\":\"" pointer "\"}}}}"
#define SAMPLER(output, interpolation)                                                             \
    "{\"input\":1,\"output\":" #output ",\"interpolation\":\"" interpolation "\"}"

static lsf_scene *load_good(const char *channels, const char *samplers)
{
    lsf_scene *scene = load(channels, samplers);
    if (!scene)
        fail_msg("%s", error.message);
    return scene;
}

static void update(lsf_state *state, const lsf_scene *scene, double time, const char *camera)
{
    const lsf_view_params view = {.time = time, .camera = camera, .fov_y = NAN, .aspect = 1.0f};
    if (!lsf_state_update(state, scene, &view, &error))
        fail_msg("%s", error.message);
}

static void assert_values(const float *values, size_t count, const float *expected)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabsf(values[i] - expected[i]) <= 1e-6f))
            fail_msg("value %zu is %.9g, expected %.9g", i, (double)values[i], (double)expected[i]);
}
#define VALUES(values, ...)                                                                        \
    assert_values(values, sizeof((float[]){__VA_ARGS__}) / sizeof(float), (float[]){__VA_ARGS__})

/* --- values --- */

static void materials(void **unused)
{
    (void)unused;
    lsf_scene *scene = load_good(
        CHANNEL(0, "/materials/0/pbrMetallicRoughness/baseColorFactor") "," CHANNEL(
            1,
            "/materials/"
            "0/"
            "extensions/"
            "KHR_"
            "materials_"
            "emissive_"
            "strength/"
            "emissiveStr"
            "ength") "," CHANNEL(2,
                                 "/materials/0/extensions/KHR_materials_transmission/"
                                 "transmissionFactor") "," CHANNEL(3,
                                                                   "/materials/0/"
                                                                   "pbrMetallicRoughness/"
                                                                   "roughnessFactor") "," CHANNEL(4,
                                                                                                  "/mat"
                                                                                                  "eria"
                                                                                                  "ls/"
                                                                                                  "0/"
                                                                                                  "pbrM"
                                                                                                  "etal"
                                                                                                  "licR"
                                                                                                  "ough"
                                                                                                  "ness"
                                                                                                  "/bas"
                                                                                                  "eCol"
                                                                                                  "orTe"
                                                                                                  "xtur"
                                                                                                  "e/"
                                                                                                  "exte"
                                                                                                  "nsio"
                                                                                                  "ns/"
                                                                                                  "KHR_"
                                                                                                  "text"
                                                                                                  "ure_"
                                                                                                  "tran"
                                                                                                  "sfor"
                                                                                                  "m/"
                                                                                                  "offs"
                                                                                                  "et") "," CHANNEL(5,
                                                                                                                    "/ma"
                                                                                                                    "ter"
                                                                                                                    "ial"
                                                                                                                    "s/"
                                                                                                                    "0/"
                                                                                                                    "pbr"
                                                                                                                    "Met"
                                                                                                                    "all"
                                                                                                                    "icR"
                                                                                                                    "oug"
                                                                                                                    "hne"
                                                                                                                    "ss/"
                                                                                                                    "met"
                                                                                                                    "all"
                                                                                                                    "icF"
                                                                                                                    "act"
                                                                                                                    "o"
                                                                                                                    "r"),
        SAMPLER(2, "LINEAR") "," SAMPLER(3, "LINEAR") "," SAMPLER(4, "CUBICSPLINE") "," SAMPLER(
            10, "STEP") "," SAMPLER(7, "LINEAR") "," SAMPLER(9, "LIN"
                                                                "EA"
                                                                "R"));
    lsf_state state = {0};
    update(&state, scene, 0.25, NULL);
    const lsf_material *m = &state.animated.materials[0];
    VALUES(m->base_color, 0.75f, 0.25f, 0.0f, 0.875f);
    VALUES(m->emission, 2.0f, 1.0f, 0.5f);
    /* Hermite: (3 - 2 t) t^2 of the value 1, and t (1 - t)^2 of the tangent 2. */
    VALUES(&m->transmission, (3 - 0.5f) * 0.0625f + 2 * 0.25f * 0.5625f);
    VALUES(&m->roughness, 1.0f);
    VALUES(m->base_color_texture.transform, 2, 0, 0.5f, 0, 2, 1);
    VALUES(&m->metallic, 1.0f); /* brought into its range, which a note tells */
    update(&state, scene, 5.0, NULL);
    m = &state.animated.materials[0];
    VALUES(m->base_color, 0, 1, 0, 0.5f);
    VALUES(m->emission, 8, 4, 2);
    VALUES(&m->roughness, 0.25f);
    const lsf_requirements *r = lsf_scene_get_requirements(scene);
    assert_true(r->emissive && r->transmissive && r->blended && r->texture_transformed);
    assert_false(r->moving);
    bool noted = false;
    for (uint32_t i = 0; i < lsf_scene_note_count(scene); i++)
        noted =
            noted || strstr(lsf_scene_note(scene, i), "metallicFactor: 1 value below 0 or above");
    assert_true(noted);

    /* A program that edits the material has it from then on. */
    lsf_material_desc desc;
    assert_true(lsf_scene_get_material(scene, 0, &desc, &error));
    desc.roughness = 0.5f;
    assert_true(lsf_scene_set_material(scene, 0, &desc, &error));
    update(&state, scene, 5.0, NULL);
    VALUES(&state.animated.materials[0].roughness, 0.5f);
    VALUES(state.animated.materials[0].emission, 0, 0, 0);
    assert_false(lsf_scene_get_requirements(scene)->emissive);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

static void lights_and_cameras(void **unused)
{
    (void)unused;
    lsf_scene *scene =
        load_good(CHANNEL(0, "/extensions/KHR_lights_punctual/lights/0/color") "," CHANNEL(
                      1, "/ext"
                         "ensi"
                         "ons/"
                         "KHR_"
                         "ligh"
                         "ts_"
                         "punc"
                         "tual"
                         "/lig"
                         "hts/"
                         "0/"
                         "inte"
                         "nsit"
                         "y") "," CHANNEL(1, "/extensions/KHR_lights_punctual/lights/0/"
                                             "range") "," CHANNEL(2, "/extensions/"
                                                                     "KHR_lights_"
                                                                     "punctual/"
                                                                     "lights/0/spot/"
                                                                     "outerConeAngl"
                                                                     "e") "," CHANNEL(2, "/camer"
                                                                                         "as/0/"
                                                                                         "perspe"
                                                                                         "ctive/"
                                                                                         "yfov"),
                  SAMPLER(5, "LINEAR") "," SAMPLER(3, "LINEAR") "," SAMPLER(6, "LINEAR"));
    lsf_state state = {0};
    update(&state, scene, 0.5, "c");
    const lsf_light *light = &state.animated.lights[0];
    VALUES(light->intensity, 4 * 0.5f, 4 * 0.5f, 4 * 0.625f);
    VALUES(&light->range, 4);
    VALUES(&light->outer_cone, 0.75f);
    VALUES(&light->inner_cone, 0.2f);
    assert_int_equal(state.light_count, 1); /* the other node's is never there */
    float scale2 = (float)(state.scale * state.scale);
    VALUES(state.lights[0].intensity, 2 * scale2, 2 * scale2, 2.5f * scale2);
    VALUES(&state.lights[0].cos_outer, cosf(0.75f));
    float degrees = 0.75f * 180.0f / 3.14159265f;
    assert_true(fabsf(state.view.fov_y - degrees) < 1e-4f);
    update(&state, scene, 0.5, "d"); /* which shares it */
    assert_true(fabsf(state.view.fov_y - degrees) < 1e-4f);
    update(&state, scene, 0.0, "c");
    VALUES(state.lights[0].intensity, 0, 0, 0);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

static void nodes(void **unused)
{
    (void)unused;
    lsf_scene *scene = load_good(CHANNEL(0, "/nodes/0/translation") "," CHANNEL(
                                     1, "/nodes/3/extensions/KHR_node_visibility/visible"),
                                 SAMPLER(8, "LINEAR") "," SAMPLER(11, "STEP"));
    assert_int_equal(scene->channel_count, 1);
    assert_int_equal(scene->instance_count, 2); /* "never" has none */
    assert_int_equal(scene->nodes[0].mesh, 0);
    assert_true(lsf_scene_get_requirements(scene)->moving);
    lsf_state state = {0};
    update(&state, scene, 0.5, NULL);
    assert_true(state.worlds[12] == 2.0 && state.worlds[13] == 1.0);
    assert_int_equal(state.light_count, 2);
    assert_true(state.instances[1].skipped && !state.instances[0].skipped);
    VALUES(state.lights[1].intensity, 0, 0, 0);
    assert_true(state.lights[0].intensity[0] > 0.0f);
    update(&state, scene, 1.0, NULL);
    assert_true(!state.instances[1].skipped && state.lights[1].intensity[0] > 0.0f);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);

    /* Without an animation of it neither mesh nor light is there. */
    scene = load_good(CHANNEL(0, "/nodes/0/translation"), SAMPLER(8, "LINEAR"));
    assert_int_equal(scene->instance_count, 1);
    assert_int_equal(lsf_scene_get_requirements(scene)->spot_lights, 1);
    lsf_scene_destroy(scene);
}

/* --- what is left out, and what is refused --- */

static void ignored(void **unused)
{
    (void)unused;
    static const char *const pointers[] = {CHANNEL(0, "/materials/0/doubleSided"),
                                           CHANNEL(0, "/materials/0/"),
                                           CHANNEL(0, "/materials/0"),
                                           CHANNEL(0, "/cameras/0/perspective/zfar"),
                                           CHANNEL(0, "/nodes/0/weights/0/1"),
                                           CHANNEL(0, ""),
                                           CHANNEL(0, "nonsense"),
                                           CHANNEL(0, "/materials/0/occlusionTexture/strength")};
    for (size_t i = 0; i < LSF_COUNT(pointers); i++) {
        lsf_scene *scene = load_good(pointers[i], SAMPLER(3, "LINEAR"));
        assert_int_equal(scene->channel_count + scene->animated_count, 0);
        bool noted = false;
        for (uint32_t n = 0; n < lsf_scene_note_count(scene); n++)
            noted = noted || strstr(lsf_scene_note(scene, n), "are ignored");
        assert_true(noted);
        lsf_scene_destroy(scene);
    }
    /* A channel without a node: glTF 2.0 has it ignored. */
    lsf_scene *scene =
        load_good("{\"sampler\":0,\"target\":{\"path\":\"scale\"}}", SAMPLER(8, "LINEAR"));
    assert_int_equal(scene->channel_count, 0);
    lsf_scene_destroy(scene);
}

static void refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *channels, *samplers, *words;
    } cases[] = {
        {CHANNEL(0, "/materials/2/alphaCutoff"), SAMPLER(3, "LINEAR"), "names nothing"},
        {CHANNEL(0, "/materials/99999999999999999999/alphaCutoff"), SAMPLER(3, "LINEAR"),
         "names nothing"},
        {CHANNEL(0, "/nodes//translation"), SAMPLER(8, "LINEAR"), "names nothing"},
        {CHANNEL(0, "/materials/0/emissiveFactor"), SAMPLER(3, "LINEAR"), "as many components"},
        {CHANNEL(0, "/materials/0/alphaCutoff"), SAMPLER(4, "LINEAR"), "there must be 2"},
        {CHANNEL(1, "/materials/0/alphaCutoff"), SAMPLER(3, "LINEAR"), "no sampler 1"},
        {CHANNEL(0, "/materials/0/alphaCutoff") "," CHANNEL(0, "/materials/0/alphaCutoff"),
         SAMPLER(3, "LINEAR"), "the same target"},
        {CHANNEL(0, "/nodes/0/translation") ",{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
                                            "\"translation\"}}",
         SAMPLER(8, "LINEAR"), "the same target"},
        {CHANNEL(0, "/nodes/3/extensions/KHR_node_visibility/visible"), SAMPLER(11, "LINEAR"),
         "STEP"},
        {CHANNEL(0, "/nodes/3/extensions/KHR_node_visibility/visible"), SAMPLER(3, "STEP"),
         "UNSIGNED_BYTE"},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = load(cases[i].channels, cases[i].samplers);
        if (scene || error.code != LSF_ERROR_FILE || !strstr(error.message, cases[i].words))
            fail_msg("case %zu: \"%s\"", i, error.message);
    }
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
        cmocka_unit_test(materials), cmocka_unit_test(lights_and_cameras),
        cmocka_unit_test(nodes),     cmocka_unit_test(ignored),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests_name("pointers", tests, NULL, NULL);
}
