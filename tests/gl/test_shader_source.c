/* What needs no context: includes, #line, and the drivers' ways to write a place. */
#include "shader_folder.h"

#include "gl/context.h"

static shader_folder folder;

static int setup(void **state)
{
    (void)state;
    shader_folder_create(&folder);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    shader_folder_destroy(&folder);
    return 0;
}

static void expect_error(const char *path, const char *mention)
{
    lsf_shader_source source;
    lsf_error error = {0};
    assert_false(lsf_shader_source_build(folder.path, path, NULL, 0, &source, &error));
    if (!strstr(error.message, mention))
        fail_msg("\"%s\" is not in: %s", mention, error.message);
}

static void test_includes_once_with_lines(void **state)
{
    (void)state;
    shader_folder_write(&folder, "a.glsl", "a1\n#include \"b.glsl\"\na3\n");
    shader_folder_write(&folder, "b.glsl", "b1"); /* no newline at its end */
    shader_folder_write(&folder, "main.glsl",
                        "m1\n#include \"a.glsl\"\n  #  include \"b.glsl\"\nm4\n");
    static const struct {
        const char *text, *path;
        unsigned line;
    } expected[] = {
        {"#version 450 core", "defines", 1},
        {"m1", "main.glsl", 1},
        {"// begin a.glsl", "main.glsl", 2},
        {"a1", "a.glsl", 1},
        {"// begin b.glsl", "a.glsl", 2},
        {"b1", "b.glsl", 1},
        {"// end b.glsl", "a.glsl", 2},
        {"a3", "a.glsl", 3},
        {"// end a.glsl", "main.glsl", 2},
        {"// above: b.glsl", "main.glsl", 3},
        {"m4", "main.glsl", 4},
    };
    lsf_shader_source source;
    lsf_error error = {0};
    assert_true(lsf_shader_source_build(folder.path, "main.glsl", NULL, 0, &source, &error));
    assert_int_equal(source.line_count, LSF_COUNT(expected));
    const char *line = source.text.text;
    for (size_t i = 0; i < LSF_COUNT(expected); i++) {
        size_t length = strcspn(line, "\n");
        assert_int_equal(length, strlen(expected[i].text));
        assert_memory_equal(line, expected[i].text, length);
        assert_string_equal(source.paths[source.origins[i].file], expected[i].path);
        assert_int_equal(source.origins[i].line, expected[i].line);
        line += length + 1;
    }
    assert_int_equal(*line, '\0');
    lsf_shader_source_free(&source);
}

static void test_includes_in_comments_are_left(void **state)
{
    (void)state;
    static const char *const text = "/* text\n#include \"none.glsl\"\n*/ x /* */\n// /*\n"
                                    "%s\n//#include \"none.glsl\"\n";
    char *written = lsf_format(text, "#include <math.h>"), *expected = lsf_format(text, "");
    shader_folder_write(&folder, "main.glsl", written);
    lsf_shader_source source;
    assert_true(lsf_shader_source_build(folder.path, "main.glsl", NULL, 0, &source, NULL));
    assert_string_equal(source.text.text + strlen("#version 450 core\n"), expected);
    lsf_shader_source_free(&source);
    free(written);
    free(expected);
}

static void test_defines_come_first(void **state)
{
    (void)state;
    static const lsf_define defines[] = {{"TAPS", 16}, {"BIAS", -1}};
    shader_folder_write(&folder, "main.glsl", "x");
    lsf_shader_source source;
    assert_true(lsf_shader_source_build(folder.path, "main.glsl", defines, 2, &source, NULL));
    assert_string_equal(source.text.text,
                        "#version 450 core\n#define TAPS 16\n#define BIAS -1\nx\n");
    lsf_shader_source_free(&source);
}

static void test_bad_includes(void **state)
{
    (void)state;
    shader_folder_write(&folder, "missing.glsl", "\n#include \"none.glsl\"\n");
    expect_error("missing.glsl", "none.glsl");
    expect_error("missing.glsl", "included at missing.glsl:2");
    shader_folder_write(&folder, "round.glsl", "#include \"trip.glsl\"\n");
    shader_folder_write(&folder, "trip.glsl", "\n\n#include \"round.glsl\"\n");
    expect_error("round.glsl", "trip.glsl:3: round.glsl includes itself");
    shader_folder_write(&folder, "self.glsl", "#include \"self.glsl\"\n");
    expect_error("self.glsl", "self.glsl:1: self.glsl includes itself");
    shader_folder_write(&folder, "out.glsl", "#include \"../secret.glsl\"\n");
    expect_error("out.glsl", "../secret.glsl: a shader's path must stay below glsl/");
    shader_folder_write(&folder, "root.glsl", "#include \"/etc/passwd\"\n");
    expect_error("root.glsl", "must stay below");
    shader_folder_write(&folder, "odd.glsl", "\n#include math.h\n");
    expect_error("odd.glsl", "odd.glsl:2: write #include \"path\"");
    shader_folder_write(&folder, "open.glsl", "#include \"math.h\n");
    expect_error("open.glsl", "open.glsl:1: write #include");
    shader_folder_write(&folder, "empty.glsl", "#include");
    expect_error("empty.glsl", "empty.glsl:1: write #include");
    expect_error("none.glsl", "none.glsl");
}

static void test_embedded_files(void **state)
{
    (void)state;
    lsf_shader_source source;
    lsf_error error = {0};
    assert_true(
        lsf_shader_source_build(NULL, "lib/fullscreen.vert.glsl", NULL, 0, &source, &error));
    assert_non_null(strstr(source.text.text, "gl_VertexID"));
    lsf_shader_source_free(&source);
    assert_true(lsf_shader_source_build(NULL, "shared/brdf.h", NULL, 0, &source, &error));
    assert_non_null(strstr(source.text.text, "lsf_ggx_d"));
    lsf_shader_source_free(&source);
    assert_false(lsf_shader_source_build(NULL, "lib/none.glsl", NULL, 0, &source, &error));
    assert_non_null(strstr(error.message, "lib/none.glsl"));
}

static void test_places_of_each_driver(void **state)
{
    (void)state;
    char *paths[] = {"defines", "passes/a.frag.glsl", "lib/b.glsl"};
    lsf_shader_origin origins[] = {{0, 1, false}, {0, 2, false},  {1, 1, false},
                                   {2, 1, false}, {2, 14, false}, {1, 3, false}};
    lsf_shader_source source = {
        .paths = paths, .path_count = 3, .origins = origins, .line_count = LSF_COUNT(origins)};
    static const char *const cases[][2] = {
        {"0:5(7): error: `x' undeclared\n", "lib/b.glsl:14: error: `x' undeclared\n"},
        {"0:6(2): preprocessor error: y\n", "passes/a.frag.glsl:3: preprocessor error: y\n"},
        {"0(3) : error C1503: undefined variable \"x\"\n",
         "passes/a.frag.glsl:1: error C1503: undefined variable \"x\"\n"},
        {"0(2) : warning C7022: unrecognized\n", "defines:2: warning C7022: unrecognized\n"},
        {"ERROR: 0:4: 'x' : undeclared identifier\n",
         "lib/b.glsl:1: error: 'x' : undeclared identifier\n"},
        {"WARNING: 0:3: unused\n", "passes/a.frag.glsl:1: warning: unused\n"},
        {"0:1(1): error: a\n0:4(1): error: b", "defines:1: error: a\nlib/b.glsl:1: error: b\n"},
        /* Lines without a place, or with one outside the text, stay as they are. */
        {"error: linking with uncompiled shader\n", "error: linking with uncompiled shader\n"},
        {"Fragment info\n-------------\n\n", "Fragment info\n-------------\n"},
        {"0:7(1): error: x\n", "0:7(1): error: x\n"},
        {"0:0(1): error: x\n", "0:0(1): error: x\n"},
        {"1:1(1): error: x\n", "1:1(1): error: x\n"},
        {"0:99999999999999999999999: x\n", "0:99999999999999999999999: x\n"},
        {"0:", "0:\n"},
        {"0:2(", "0:2(\n"},
        {"0(2", "0(2\n"},
        {"0:2(3)", "0:2(3)\n"},
        {"", ""},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_string mapped = {0};
        lsf_shader_source_map_log(&source, cases[i][0], &mapped);
        assert_string_equal(mapped.text ? mapped.text : "", cases[i][1]);
        free(mapped.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_includes_once_with_lines),
        cmocka_unit_test(test_includes_in_comments_are_left),
        cmocka_unit_test(test_defines_come_first),
        cmocka_unit_test(test_bad_includes),
        cmocka_unit_test(test_embedded_files),
        cmocka_unit_test(test_places_of_each_driver),
    };
    return cmocka_run_group_tests_name("shader source", tests, setup, teardown);
}
