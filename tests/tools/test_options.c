/* The option table and what it makes of a command line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/base.h"
#include "tools/number.h"
#include "tools/options.h"
#include "tools/preset.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static lsf_settings settings;
static lsf_error error;

/* Parses words separated by single blanks; the text stays alive until the next call. */
static bool parse(lsf_command_bit command, const char *line)
{
    static char words[2048];
    char *argv[64];
    int argc = 0;
    lsf_settings_finish(&settings);
    error = (lsf_error){0};
    snprintf(words, sizeof words, "%s", line);
    for (char *word = words; word; argc++) {
        argv[argc] = word;
        word = strchr(word, ' ');
        if (word)
            *word++ = '\0';
    }
    argv[argc] = NULL;
    return lsf_settings_parse(&settings, command, argc, argv, &error);
}

static void must_parse(lsf_command_bit command, const char *line)
{
    if (!parse(command, line))
        fail_msg("%s: %s", line, error.message);
}

/* Refused, with every one of the parts in the message. */
static void must_refuse(lsf_command_bit command, const char *line, const char *part,
                        const char *other)
{
    if (parse(command, line))
        fail_msg("%s: was taken", line);
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    if (!strstr(error.message, part) || (other && !strstr(error.message, other)))
        fail_msg("%s: \"%s\" lacks \"%s\" or \"%s\"", line, error.message, part,
                 other ? other : "");
}

/* The table cannot ask the library: the pages are made from it before the library is. */
static void test_layers_of_the_table(void **state)
{
    (void)state;
    lsf_string names = {0};
    for (uint32_t i = 0; i < LSF_AOV_COUNT; i++)
        lsf_string_add(&names, "%s|", lsf_aov_name(1u << i));
    lsf_string_add(&names, "all");
    for (size_t i = 0; lsf_command_option_at(i); i++)
        if (lsf_command_option_at(i)->type == LSF_VALUE_AOVS)
            assert_string_equal(lsf_command_option_at(i)->choices, names.text);
    free(names.text);
}

static void test_rows_are_whole(void **state)
{
    (void)state;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        assert_true(i < 128); /* lsf_settings.given */
        assert_non_null(option->help);
        assert_non_null(option->group);
        assert_true(option->commands != 0);
        assert_int_equal(option->argument == NULL, option->type == LSF_VALUE_FLAG);
        assert_int_equal(option->choices != NULL,
                         option->type == LSF_VALUE_CHOICE || option->type == LSF_VALUE_PRESET ||
                             option->type == LSF_VALUE_AOVS || option->type == LSF_VALUE_THRESHOLD);
        char *range = lsf_command_option_range(option);
        assert_non_null(range);
        free(range);
        for (size_t j = 0; j < i; j++) {
            const lsf_command_option *other = lsf_command_option_at(j);
            if (!(option->commands & other->commands))
                continue;
            assert_string_not_equal(option->name, other->name);
            assert_true(!option->letter || option->letter != other->letter);
        }
    }
}

static size_t size_of_value(lsf_value_type type)
{
    return type == LSF_VALUE_RESOLUTION || type == LSF_VALUE_SEED || type == LSF_VALUE_DOUBLE ? 8
                                                                                              : 4;
}

/* Typing the default that --help shows changes nothing. */
static void test_shown_defaults_are_the_defaults(void **state)
{
    (void)state;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (!option->initial)
            continue;
        static const struct {
            lsf_command_bit command;
            const char *operands;
        } uses[] = {{LSF_COMMAND_RENDER, ""},
                    {LSF_COMMAND_COMPARE, " a.exr b.exr"},
                    {LSF_COMMAND_MEASURE, ""},
                    {LSF_COMMAND_SANDBOX, " a.frag"}};
        size_t use = 0;
        while (use < LSF_COUNT(uses) - 1 && !(option->commands & uses[use].command))
            use++;
        lsf_command_bit command = uses[use].command;
        const char *operands = uses[use].operands;
        char line[256];
        snprintf(line, sizeof line, "x%s --%s %s", operands, option->name, option->initial);
        must_parse(command, line);
        lsf_settings typed = settings;
        settings.operands = (lsf_list_setting){0};
        snprintf(line, sizeof line, "x%s", operands);
        must_parse(command, line);
        const char *typed_value = (const char *)&typed + option->offset;
        const char *plain_value = (const char *)&settings + option->offset;
        if (option->type == LSF_VALUE_TECHNIQUE)
            assert_string_equal(option->initial, settings.technique);
        else
            assert_memory_equal(typed_value, plain_value, size_of_value(option->type));
        free((void *)typed.operands.items);
    }
}

static void test_defaults_are_the_librarys(void **state)
{
    (void)state;
    must_parse(LSF_COMMAND_RENDER, "render");
    lsf_render_params given = lsf_settings_render_params(&settings);
    lsf_render_params expected = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    assert_string_equal(given.technique, expected.technique);
    assert_int_equal(given.width, expected.width);
    assert_int_equal(given.height, expected.height);
    assert_int_equal(given.samples, expected.samples);
    assert_true(isinf(given.time_limit));
    assert_int_equal(given.bounces, expected.bounces);
    assert_int_equal(given.seed, expected.seed);
    assert_null(given.camera);
    assert_null(given.camera_position);
    assert_null(given.camera_target);
    assert_true(isnan(given.fov_y));
    assert_int_equal(given.aovs, 0);
    assert_int_equal(given.option_count, 0);
    assert_int_equal(lsf_settings_context_params(&settings).backend, LSF_BACKEND_AUTO);
    assert_false(lsf_settings_context_params(&settings).debug);
    assert_null(lsf_settings_scene_params(&settings).environment_radiance);
}

static void check_everything(void)
{
    lsf_render_params params = lsf_settings_render_params(&settings);
    assert_int_equal(settings.operands.count, 1);
    assert_string_equal(settings.operands.items[0], "scene.gltf");
    assert_string_equal(settings.output, "out.exr");
    assert_int_equal(params.width, 7);
    assert_int_equal(params.height, 13);
    assert_int_equal(params.samples, 9);
    assert_true(params.time_limit == 2.5);
    assert_int_equal(params.bounces, 3);
    assert_true(params.seed == UINT64_MAX);
    assert_string_equal(params.camera, "Cam");
    assert_true(params.camera_position[0] == -1 && params.camera_position[1] == 2 &&
                params.camera_position[2] == 3e-2f);
    assert_true(params.camera_target[0] == 0 && params.camera_target[1] == -0.5f);
    assert_true(params.fov_y == 30);
    assert_true(params.time == -1.5);
    assert_true(settings.exposure.ev == -2);
    assert_int_equal(params.aovs, LSF_AOV_ALBEDO | LSF_AOV_DEPTH);
    assert_string_equal(settings.json_path, "-");
    assert_true(settings.diffuse_only && settings.gl_debug);
    assert_int_equal(settings.backend, LSF_BACKEND_OSMESA);
    assert_string_equal(settings.shader_dir, "glsl");
    assert_int_equal(settings.format, LSF_IMAGE_FORMAT_EXR);
    assert_true(lsf_settings_scene_params(&settings).environment_radiance[2] == 0.25f);
    assert_true(lsf_settings_given(&settings, "seed"));
    assert_false(lsf_settings_given(&settings, "halves"));
}

static void test_order_does_not_matter(void **state)
{
    (void)state;
    static const char *const words[] = {
        "scene.gltf",
        "-o out.exr",
        "--resolution 7,13",
        "--samples=9",
        "--time-limit 2.5",
        "-b 3",
        "-c Cam",
        "--seed 18446744073709551615",
        "--camera-position -1,2,3e-2",
        "--camera-target 0,-.5,+1",
        "--fov-y 30",
        "--time -1.5",
        "--exposure -2",
        "--aov depth,albedo",
        "--json -",
        "--diffuse-only",
        "--gl-debug",
        "--backend osmesa",
        "--shader-dir glsl",
        "--format exr",
        "-e 1,.5,0.25",
        "--technique direct",
    };
    enum { COUNT = LSF_COUNT(words) };
    for (size_t shift = 0; shift < COUNT; shift++) {
        char line[1024] = "render";
        for (size_t i = 0; i < COUNT; i++) {
            size_t length = strlen(line);
            snprintf(line + length, sizeof line - length, " %s", words[(i * 7 + shift) % COUNT]);
        }
        must_parse(LSF_COMMAND_RENDER, line);
        check_everything();
    }
}

/* The standard's rule, that operands end the options, does not hold here. */
static void test_order_with_posixly_correct(void **state)
{
    (void)state;
    setenv("POSIXLY_CORRECT", "1", 1);
    must_parse(LSF_COMMAND_RENDER, "render scene.gltf -s 3");
    unsetenv("POSIXLY_CORRECT");
    assert_int_equal(settings.samples, 3);
    assert_int_equal(settings.operands.count, 1);
}

static void test_forms(void **state)
{
    (void)state;
    must_parse(LSF_COMMAND_RENDER, "render -r 640x480 --aov all");
    assert_int_equal(settings.resolution[0], 640);
    assert_int_equal(settings.resolution[1], 480);
    assert_int_equal(settings.aovs, 255);
    must_parse(LSF_COMMAND_RENDER, "render --aov albedo --aov normal -s 1 -s 2");
    assert_int_equal(settings.aovs, LSF_AOV_ALBEDO | LSF_AOV_NORMAL);
    assert_int_equal(settings.samples, 2);
    must_parse(LSF_COMMAND_RENDER, "render -- -scene.gltf");
    assert_string_equal(settings.operands.items[0], "-scene.gltf");
    must_parse(LSF_COMMAND_RENDER, "render --time-limit 3");
    assert_true(lsf_settings_render_params(&settings).samples == UINT32_MAX);
    must_parse(LSF_COMMAND_RENDER, "render -e map.hdr");
    assert_string_equal(lsf_settings_scene_params(&settings).environment_path, "map.hdr");
    assert_null(lsf_settings_scene_params(&settings).environment_radiance);
    must_parse(LSF_COMMAND_RENDER, "render -e map.hdr -e 0,0,0");
    assert_null(lsf_settings_scene_params(&settings).environment_path);
    must_parse(LSF_COMMAND_RENDER, "render -e ./1,2,3");
    assert_string_equal(lsf_settings_scene_params(&settings).environment_path, "./1,2,3");
    must_parse(LSF_COMMAND_REFERENCE, "reference --halves");
    assert_true(settings.halves);
    must_parse(LSF_COMMAND_INFO, "info a.glb --json -");
    assert_true(lsf_settings_print_json(&settings));
    must_parse(LSF_COMMAND_PLAN, "plan --json a.json a.glb -b 0");
    assert_false(lsf_settings_print_json(&settings));
    assert_string_equal(settings.json_path, "a.json");
    must_parse(LSF_COMMAND_COMPARE, "compare a.exr --threshold rmse=0.1 b.exr --threshold ssim=.9 "
                                    "c.exr --mask m.png --difference d.png --epsilon 0.01");
    assert_int_equal(settings.operands.count, 3);
    assert_int_equal(settings.thresholds.count, 2);
    assert_true(settings.epsilon == 0.01);
    must_parse(LSF_COMMAND_INFO, "info --help"); /* needs no scene then */
}

static void test_pass_options(void **state)
{
    (void)state;
    lsf_option option;
    if (!lsf_option_list(0, &option))
        fail_msg("no pass has an option");
    char line[512], wrong[512], key[128];
    snprintf(key, sizeof key, "%s", option.key);
    snprintf(line, sizeof line, "render -D %s=%s -D %s=x", key, option.value, key);
    must_parse(LSF_COMMAND_RENDER, line);
    lsf_render_params params = lsf_settings_render_params(&settings);
    assert_int_equal(params.option_count, 2);
    assert_non_null(strstr(params.options[0], key));
    snprintf(wrong, sizeof wrong, "render -D %sx=1", key);
    must_refuse(LSF_COMMAND_RENDER, wrong, "did you mean", key);
    must_refuse(LSF_COMMAND_RENDER, "render -D novalue", "pass.key=value", "novalue");
    must_refuse(LSF_COMMAND_RENDER, "render -D =1", "pass.key=value", NULL);
}

static void test_bad_values(void **state)
{
    (void)state;
    static const struct {
        const char *line, *part, *other;
    } cases[] = {
        {"render --samples 0", "--samples 0", "1..1000000000"},
        {"render --samples -1", "--samples -1", "1..1000000000"},
        {"render --samples 1.5", "--samples 1.5", "whole number"},
        {"render --samples 0x10", "--samples 0x10", "whole number"},
        {"render --samples 99999999999999999999", "--samples", "whole number"},
        {"render --samples 64k", "--samples 64k", "whole number"},
        {"render -s", "--samples", "needs a value"},
        {"render --samples", "--samples", "needs a value"},
        {"render --resolution 0,5", "--resolution 0,5", "1..65535"},
        {"render --resolution 5,65536", "--resolution 5,65536", "1..65535"},
        {"render --resolution 640", "--resolution 640", "1..65535"},
        {"render --resolution 640,480,3", "--resolution 640,480,3", "1..65535"},
        {"render --resolution -5,5", "--resolution -5,5", "1..65535"},
        {"render --resolution ,", "--resolution ,", "1..65535"},
        {"render --time-limit 0", "--time-limit 0", "0.001..1e+09"},
        {"render --time-limit inf", "--time-limit inf", "a number"},
        {"render --bounces -1", "--bounces -1", "0..1000"},
        {"render --bounces 1001", "--bounces 1001", "0..1000"},
        {"render --seed 18446744073709551616", "--seed", "18446744073709551615"},
        {"render --seed -1", "--seed -1", "whole number"},
        {"render --fov-y 0", "--fov-y 0", "0.01..179"},
        {"render --fov-y 180", "--fov-y 180", "0.01..179"},
        {"render --fov-y nan", "--fov-y nan", "0.01..179"},
        {"render --fov-y 30deg", "--fov-y 30deg", "0.01..179"},
        {"render --fov-y 3,5", "--fov-y 3,5", "0.01..179"},
        {"render --time 1e999", "--time 1e999", "a number"},
        {"render --exposure 1e9", "--exposure 1e9", "-100..100"},
        {"render --camera-position 1,2", "--camera-position 1,2", "three"},
        {"render --camera-position 1,2,3,4", "--camera-position", "three"},
        {"render --camera-position 1,,3", "--camera-position", "three"},
        {"render --camera-position 1,2,1e39", "--camera-position", "three"},
        {"render --camera-target a,b,c", "--camera-target a,b,c", "three"},
        {"render --aov albdo", "--aov albdo", "did you mean albedo"},
        {"render --aov albedo,", "--aov albedo,", "indirect_diffuse"},
        {"render --aov ,", "--aov ,", "indirect_diffuse"},
        {"render --technique dircet", "--technique dircet", "did you mean direct"},
        {"render --backend eg", "--backend eg", "auto|egl|osmesa"},
        {"render --backend EGL", "--backend EGL", "auto|egl|osmesa"},
        {"render --format jpg", "--format jpg", "exr|hdr|png"},
        {"render --environment 1,2", "--environment 1,2", "three numbers"},
        {"render --environment 1,2,-3", "--environment 1,2,-3", "three numbers"},
        {"render --environment -1,2,3", "--environment -1,2,3", "three numbers"},
        {"render --quiet=yes", "--quiet", "takes no value"},
        {"render -q -v", "--quiet", "--verbose"},
        {"render --resoltion 5,5", "--resoltion", "did you mean --resolution"},
        {"render --zzzzzzz", "--zzzzzzz", "help render"},
        {"render --camera- 1", "--camera-", "--camera-position, --camera-target"},
        {"render -Z", "-Z", "help render"},
        {"render --halves", "--halves", "an option of reference"},
        {"render --threshold a=1", "--threshold", "an option of compare"},
        {"render --output=", "--output", "not empty"},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++)
        must_refuse(LSF_COMMAND_RENDER, cases[i].line, cases[i].part, cases[i].other);
    must_refuse(LSF_COMMAND_HELP, "help plan info", "info", "[COMMAND]");
    must_refuse(LSF_COMMAND_INFO, "info", "needs SCENE", NULL);
    must_refuse(LSF_COMMAND_INFO, "info a.gltf -s 3", "-s", "not an option of info");
    must_refuse(LSF_COMMAND_COMPARE, "compare a.exr", "needs TEST REFERENCE", NULL);
    must_refuse(LSF_COMMAND_COMPARE, "compare a b --threshold rmse", "--threshold rmse",
                "METRIC=X");
    must_refuse(LSF_COMMAND_COMPARE, "compare a b --threshold rmse=a", "--threshold rmse=a", NULL);
}

static const char *preset_path;

static void write_preset(const char *text)
{
    assert_true(lsf_file_write(preset_path, text, strlen(text), &error));
}

static void parse_with_preset(const char *words)
{
    char line[512];
    snprintf(line, sizeof line, "render a.glb -o a.exr %s --preset %s", words, preset_path);
    must_parse(LSF_COMMAND_RENDER, line);
}

/* A preset stands before the command line, wherever that names it. */
static void test_presets(void **state)
{
    (void)state;
    char line[256];
    write_preset("# best\n\n  technique=cone \nsamples=7\r\nraw\ndefine=cone.count=4\n"
                 "define=voxel.resolution=64\ncamera=Side view\nbounces=2");
    parse_with_preset("-s 9 -D cone.count=5");
    assert_string_equal(settings.technique, "cone");
    assert_int_equal(settings.samples, 9);
    assert_int_equal(settings.bounces, 2);
    assert_true(settings.raw);
    assert_string_equal(settings.camera, "Side view");
    assert_int_equal(settings.defines.count, 3);
    assert_string_equal(settings.defines.items[0], "cone.count=4");
    assert_string_equal(settings.defines.items[2], "cone.count=5"); /* the last one counts */
    assert_true(lsf_settings_given(&settings, "camera"));
    assert_false(lsf_settings_given(&settings, "seed"));
    /* The picture's header tells the options, for the file may be another one then. */
    assert_non_null(strstr(settings.typed.text, "--camera 'Side view'"));
    assert_null(strstr(settings.typed.text, "preset"));
    /* The path tracer takes what decides on what is seen, and how often light bounces. */
    snprintf(line, sizeof line, "reference a.glb -o a.exr --preset %s", preset_path);
    must_parse(LSF_COMMAND_REFERENCE, line);
    assert_int_equal(settings.samples, 0);
    assert_int_equal(settings.bounces, 2);
    assert_int_equal(settings.defines.count, 0);
    assert_false(lsf_settings_given(&settings, "technique"));

    static const struct {
        const char *text, *says;
    } bad[] = {
        {"technique=cone\nsamples=none\n", "line 2: --samples none: expected a whole number"},
        {"sample=3", "line 1: sample: not an option of render that a preset can have; did you mean "
                     "samples?"},
        {"output=b.exr", "output: not an option"},
        {"preset=b", "preset: not an option"},
        {"raw=1", "raw: takes no value"},
        {"samples", "samples: write =VALUE behind it: a whole number"},
    };
    snprintf(line, sizeof line, "render a.glb -o a.exr --preset %s", preset_path);
    for (size_t i = 0; i < LSF_COUNT(bad); i++) {
        write_preset(bad[i].text);
        must_refuse(LSF_COMMAND_RENDER, line, bad[i].says, preset_path);
    }
    assert_false(parse(LSF_COMMAND_RENDER, "render --preset there/is/none -o a.exr"));
    assert_int_equal(error.code, LSF_ERROR_FILE);
}

/* A name, or a file whose technique the command line replaces. */
static void test_presets_of_measure(void **state)
{
    (void)state;
    char line[256];
    must_parse(LSF_COMMAND_MEASURE, "measure a.glb");
    assert_int_equal(settings.measure_preset, 0);
    must_parse(LSF_COMMAND_MEASURE, "measure a.glb --preset full");
    assert_int_equal(settings.measure_preset, 1);
    assert_non_null(strstr(settings.typed.text, "--preset full"));
    write_preset("technique=cone\nsamples=5\ndefine=cone.count=4\n");
    snprintf(line, sizeof line, "measure a.glb --preset %s", preset_path);
    must_parse(LSF_COMMAND_MEASURE, line);
    assert_int_equal(settings.measure_preset, LSF_PRESET_FILE);
    assert_int_equal(settings.techniques.count, 1);
    assert_string_equal(settings.techniques.items[0], "cone");
    assert_int_equal(settings.samples, 5);
    assert_null(strstr(settings.typed.text, "preset"));
    snprintf(line, sizeof line, "measure a.glb --preset %s -t direct", preset_path);
    must_parse(LSF_COMMAND_MEASURE, line);
    assert_int_equal(settings.techniques.count, 1);
    assert_string_equal(settings.techniques.items[0], "direct");
    must_refuse(LSF_COMMAND_MEASURE, "measure a.glb --preset fast",
                "--preset fast: neither one of quick|full nor a file", NULL);
}

static void test_numbers(void **state)
{
    (void)state;
    static const char *const good[] = {"0", "-1", "+1.", ".5", "1e3", "1E-3", "-0.0", "00012"};
    static const char *const bad[] = {"",    " 1",    "1 ",  "0x1p3", "inf",     "-inf",  "nan",
                                      "1e",  "1e+",   ".",   "-",     "1,5",     "1.2.3", "--1",
                                      "1_0", "1e999", "\t1", "1f",    "infinity"};
    double value;
    for (size_t i = 0; i < LSF_COUNT(good); i++)
        assert_true(lsf_parse_number(good[i], -1e300, 1e300, &value));
    for (size_t i = 0; i < LSF_COUNT(bad); i++)
        if (lsf_parse_number(bad[i], -1e300, 1e300, &value))
            fail_msg("\"%s\" was taken for a number", bad[i]);
    assert_true(lsf_parse_number("0.1", 0.1, 0.1, &value));
    assert_true(value == 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers_of_the_table),
        cmocka_unit_test(test_rows_are_whole),
        cmocka_unit_test(test_shown_defaults_are_the_defaults),
        cmocka_unit_test(test_defaults_are_the_librarys),
        cmocka_unit_test(test_order_does_not_matter),
        cmocka_unit_test(test_order_with_posixly_correct),
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_pass_options),
        cmocka_unit_test(test_bad_values),
        cmocka_unit_test(test_presets),
        cmocka_unit_test(test_presets_of_measure),
        cmocka_unit_test(test_numbers),
    };
    char path[] = "/tmp/lightsheaf-preset-XXXXXX";
    close(mkstemp(path));
    preset_path = path;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    lsf_settings_finish(&settings);
    return failed;
}
