/* What a plan says that its passes read is what their programs are given to read. */
#include "plan/flow.h"

#include <string.h>

#include "base/base.h"
#include "gl_spy.h"
#include "spied_pictures.h"

enum { TOUCHES = 4096 };

typedef struct touch {
    char pass[64], resource[64];
} touch;

static touch touches[TOUCHES];
static size_t touch_count;

static void add_touch(const char *pass, const gl_spy_use *use)
{
    char label[64];
    gl_spy_label(use->kind, use->name, label);
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0 && strcmp(touches[i].resource, label) == 0)
            return;
    assert_true(touch_count < TOUCHES);
    snprintf(touches[touch_count].pass, sizeof touches->pass, "%s", pass);
    snprintf(touches[touch_count++].resource, sizeof touches->resource, "%s", label);
}

static void on_command(const gl_spy_command *command)
{
    for (size_t i = 0; i < command->use_count; i++)
        add_touch(command->pass, &command->uses[i]);
}

static void start(void)
{
    touch_count = 0;
    gl_spy_start(on_command);
}

static bool touches_stem(const char *pass, const char *resource)
{
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0 && lsf_plan_same_stem(touches[i].resource, resource))
            return true;
    return false;
}

static bool has_run(const char *pass)
{
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0)
            return true;
    return false;
}

static int wrong;

static void check_plan(const lsf_renderer *renderer)
{
    const lsf_plan *plan = lsf_renderer_plan(renderer);
    for (size_t i = 0; i < touch_count; i++) {
        const lsf_plan_pass *pass = lsf_plan_find_pass(plan, touches[i].pass);
        const char *resource = touches[i].resource;
        if (pass && lsf_plan_find(plan, resource) && !lsf_plan_pass_reads(plan, pass, resource) &&
            !lsf_plan_pass_fills(pass, resource)) {
            print_message("%s: %s reads %s\n", plan->technique, pass->name, resource);
            wrong++;
        }
    }
    for (uint64_t p = 0; p < plan->pass_count; p++)
        for (uint64_t r = 0; r < plan->resource_count; r++) {
            const lsf_plan_pass *pass = &plan->passes[p];
            const char *resource = plan->resources[r].name;
            if (has_run(pass->name) && lsf_plan_pass_reads(plan, pass, resource) &&
                !touches_stem(pass->name, resource)) {
                print_message("%s: %s does not read %s\n", plan->technique, pass->name, resource);
                wrong++;
            }
        }
}

static void passes_read_what_the_plan_says(void **state)
{
    (void)state;
    spy_on_pictures(start, check_plan);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(passes_read_what_the_plan_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
