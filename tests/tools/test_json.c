/* The JSON writer: commas, nesting, escapes, numbers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tools/json.h"

#include <math.h>
#include <stdlib.h>

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nesting)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
