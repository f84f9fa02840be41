/* The JSON writer: commas, nesting, escapes, numbers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tools/json.h"
#include "tools/json_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void test_nesting(void **state)
{
    (void)state;
    lsf_json json = {0};
    lsf_json_begin(&json, NULL, '{');
    lsf_json_string(&json, "a", "quote \" back \\ line \n");
    lsf_json_begin(&json, "empty", '[');
    lsf_json_end(&json, ']');
    lsf_json_begin(&json, "list", '[');
    lsf_json_integer(&json, NULL, UINT64_MAX);
    lsf_json_number(&json, NULL, INFINITY);
    lsf_json_bool(&json, NULL, true);
    lsf_json_end(&json, ']');
    lsf_json_vector(&json, "v", (float[]){1, -0.5f}, 2);
    lsf_json_vector(&json, "none", NULL, 3);
    lsf_json_string(&json, "null", NULL);
    lsf_json_end(&json, '}');
    assert_string_equal(json.text.text, "{\n"
                                        "  \"a\": \"quote \\\" back \\\\ line \\u000a\",\n"
                                        "  \"empty\": [],\n"
                                        "  \"list\": [\n"
                                        "    18446744073709551615,\n"
                                        "    null,\n"
                                        "    true\n"
                                        "  ],\n"
                                        "  \"v\": [1, -0.5],\n"
                                        "  \"none\": null,\n"
                                        "  \"null\": null\n"
                                        "}\n");
    free(json.text.text);
}

static lsf_json_document document;
static lsf_error error;

static bool parse(const char *text)
{
    lsf_json_document_finish(&document);
    return lsf_json_parse(&document, text, strlen(text), "a.json", &error);
}

static void test_reading(void **state)
{
    (void)state;
    assert_true(parse(" { \"a\" : [1, -2.5e3 ,true,false, null,\"x\\n\\u00e9\\ud83d\\ude00\\/\"],"
                      "\"b\":{}, \"c\": [], \"d\": {\"e\": 7}} \n"));
    const lsf_json_value *root = document.values;
    const lsf_json_value *v = lsf_json_first(&document, lsf_json_find(&document, root, "a"));
    static const lsf_json_kind kinds[] = {LSF_JSON_NUMBER, LSF_JSON_NUMBER, LSF_JSON_BOOL,
                                          LSF_JSON_BOOL,   LSF_JSON_NULL,   LSF_JSON_STRING};
    static const double numbers[] = {1.0, -2500.0, 1.0, 0.0};
    for (size_t i = 0; i < LSF_COUNT(kinds); i++, v = lsf_json_next(&document, v)) {
        assert_non_null(v);
        assert_int_equal(v->kind, kinds[i]);
        if (i < LSF_COUNT(numbers))
            assert_true(v->number == numbers[i]);
        if (i == LSF_COUNT(kinds) - 1)
            assert_string_equal(v->text, "x\n\xc3\xa9\xf0\x9f\x98\x80/");
    }
    assert_null(v);
    assert_null(lsf_json_first(&document, lsf_json_find(&document, root, "b")));
    assert_null(lsf_json_find(&document, lsf_json_find(&document, root, "c"), "e"));
    assert_true(lsf_json_find_number(&document, lsf_json_find(&document, root, "d"), "e") == 7.0);
    assert_true(isnan(lsf_json_find_number(&document, root, "none")));
    assert_null(lsf_json_find_string(&document, root, "a"));
    lsf_json_document_finish(&document);
}

static void test_what_is_no_json(void **state)
{
    (void)state;
    static const char *const bad[] = {"",          "{",           "[1,]",
                                      "{\"a\"}",   "{\"a\":}",    "[1 2]",
                                      "tru",       "01x",         "+1",
                                      ".5",        "\"a",         "\"\\x\"",
                                      "\"\\u12\"", "\"\\ud800\"", "\"\\u0000\"",
                                      "{a:1}",     "[1] 2",       "\"\x01\"",
                                      "\"\\",      "[\"a\":1]",   "\"\\ud800\\u0041\"",
                                      "-",         "\"\\u"};
    for (size_t i = 0; i < LSF_COUNT(bad); i++)
        if (parse(bad[i]))
            fail_msg("%s was taken for JSON", bad[i]);
    assert_false(parse("[1,\n2,\n}"));
    assert_non_null(strstr(error.message, "a.json: line 3: "));
    char deep[300];
    memset(deep, '[', sizeof deep);
    deep[sizeof deep - 1] = '\0';
    assert_false(parse(deep));
    lsf_json_document_finish(&document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nesting),
        cmocka_unit_test(test_reading),
        cmocka_unit_test(test_what_is_no_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
