/* The viewer's camera and its budget, without a window. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "view/budget.h"
#include "view/camera.h"

static lsf_viewer_camera camera(void)
{
    return (lsf_viewer_camera){.position = {3.0f, 2.0f, 4.0f},
                               .target = {0.5f, 0.25f, -1.0f},
                               .fov_y = NAN,
                               .shown_fov_y = 40.0f,
                               .extent = 2.0f};
}

static double apart(const float a[3], const float b[3])
{
    return sqrt(pow((double)(a[0] - b[0]), 2.0) + pow((double)(a[1] - b[1]), 2.0) +
                pow((double)(a[2] - b[2]), 2.0));
}

static void orbits_the_scene(void **state)
{
    (void)state;
    lsf_viewer_camera c = camera(), start = c;
    double distance = apart(c.position, c.target);
    for (int i = 0; i < 100; i++)
        lsf_viewer_camera_orbit(&c, 0.03, 0.05); /* over the top, where it stops */
    assert_true(c.own);
    assert_memory_equal(c.target, start.target, sizeof c.target);
    assert_true(fabs(apart(c.position, c.target) - distance) < 1e-4);
    assert_true(c.position[1] > c.target[1] + 0.999f * (float)distance);
    lsf_viewer_camera_from(&c, LSF_VIEWER_RIGHT);
    assert_true(fabs((double)(c.position[0] - c.target[0]) - distance) < 1e-4);
    lsf_viewer_camera_zoom(&c, 1.0);
    assert_true(apart(c.position, c.target) < 0.95 * distance);
    for (int i = 0; i < 1000; i++)
        lsf_viewer_camera_zoom(&c, 10.0);
    assert_true(apart(c.position, c.target) > 0.0);
}

static void what_is_dragged_stays_under_the_cursor(void **state)
{
    (void)state;
    lsf_viewer_camera c = camera();
    const double point[3] = {0.5, 0.25, -1.0}, aspect = 1.5;
    double xy[2];
    lsf_viewer_camera_pan(&c, 0.25, -0.125); /* heights of the picture */
    assert_true(lsf_viewer_camera_project(&c, point, aspect, xy));
    assert_true(fabs(xy[0] * aspect - 0.5) < 1e-5 && fabs(xy[1] - 0.25) < 1e-5);
    lsf_viewer_camera_focus(&c, point);
    assert_true(lsf_viewer_camera_project(&c, point, aspect, xy));
    assert_true(fabs(xy[0]) < 1e-5 && fabs(xy[1]) < 1e-5);
}

static void rays_and_places_agree(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        lsf_viewer_camera c = camera();
        c.shown_height = flat ? 3.0f : 0.0f;
        double origin[3], direction[3], point[3], xy[2];
        lsf_viewer_camera_ray(&c, -0.6, 0.3, 1.5, origin, direction);
        for (int i = 0; i < 3; i++)
            point[i] = origin[i] + 2.5 * direction[i];
        assert_true(lsf_viewer_camera_project(&c, point, 1.5, xy));
        assert_true(fabs(xy[0] + 0.6) < 1e-6 && fabs(xy[1] - 0.3) < 1e-6);
    }
}

/* A machine on which a frame takes so much for itself, for pixels and for maps, and a change of
 * either as much again as it says. */
typedef struct machine {
    double fixed, pixels, maps, change;
} machine;

static double frame(const machine *m, const lsf_budget *b)
{
    double scale = lsf_budget_scale(b);
    return m->fixed + m->pixels * scale * scale + m->maps / pow(1.0 + lsf_budget_coarse(b), 1.5);
}

typedef struct course {
    double settled; /* seconds after which nothing changed any more */
    uint32_t changes;
} course;

/* Frames for so many seconds, each up to a tenth longer or shorter. */
static course run(const machine *m, lsf_budget *b, double seconds)
{
    course c = {0};
    uint32_t noise = 1;
    bool changed = b->frames == 0;
    for (double time = 0.0; time < seconds;) {
        noise = noise * 1664525u + 1013904223u;
        double one = frame(m, b) * (0.9 + 0.2 * (double)noise / 4294967296.0);
        one += changed ? m->change : 0.0;
        time += one;
        changed = lsf_budget_measure(b, one);
        c.settled = changed ? time : c.settled;
        c.changes += changed;
    }
    return c;
}

static const machine machines[] = {{0.01, 0.02, 0.01, 0.1}, {0.01, 0.4, 0.02, 0.1},
                                   {0.02, 2.0, 0.1, 0.2},   {0.03, 0.05, 0.15, 0.1},
                                   {0.0, 0.3, 0.0, 0.1},    {0.005, 0.02, 0.4, 0.3}};

static void budgets_are_held(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof machines / sizeof machines[0]; i++)
        for (int slow = 0; slow < 2; slow++) {
            const machine *m = &machines[i];
            lsf_budget b;
            lsf_budget_start(&b, 0.1, slow);
            course c = run(m, &b, 7.0);
            assert_true(frame(m, &b) <= b.seconds);
            assert_true(c.settled < (slow ? 2.0 : 2.5 + 3.0 * (m->pixels + m->maps)));
            assert_int_equal(run(m, &b, 200.0).changes, 0); /* it stays there */
            assert_false(lsf_budget_measure(&b, 3.0));      /* whatever that was */
            assert_int_equal(run(m, &b, 5.0).changes, 0);
        }
}

/* The next finer rung would have been too slow. */
static void budgets_are_used(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof machines / sizeof machines[0]; i++) {
        const machine *m = &machines[i];
        lsf_budget b;
        lsf_budget_start(&b, 0.1, true);
        run(m, &b, 30.0);
        b.rung -= b.rung > 0;
        assert_true(b.rung == 0 || frame(m, &b) > 0.6 * b.seconds);
    }
}

static void budgets_follow_the_machine(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof machines / sizeof machines[0]; i++) {
        const machine *m = &machines[i],
                      fast = {m->fixed * 0.02, m->pixels * 0.02, m->maps * 0.02, 0.01};
        lsf_budget b;
        lsf_budget_start(&b, 0.1, false);
        run(m, &b, 20.0);
        run(&fast, &b, 5.0);
        assert_int_equal(b.rung, 0);
        run(m, &b, 20.0); /* and back */
        assert_true(frame(m, &b) <= b.seconds);
    }
}

/* Pictures are not made worse where that makes no frame quicker. */
static void budgets_that_cannot_be_held(void **state)
{
    (void)state;
    const machine m = {0.15, 0.03, 0.005, 0.1};
    for (int slow = 0; slow < 2; slow++) {
        lsf_budget b;
        lsf_budget_start(&b, 0.1, slow);
        run(&m, &b, 15.0);
        assert_in_range(b.rung, 0, 8);
        assert_int_equal(run(&m, &b, 30.0).changes, 0);
    }
}

/* A machine that does other work every other second is given what it holds then, ever longer. */
static void budgets_tolerate_other_work(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof machines / sizeof machines[0]; i++) {
        const machine *m = &machines[i],
                      busy = {1.8 * m->fixed, 1.8 * m->pixels, 1.8 * m->maps, 1.8 * m->change};
        uint32_t changes = 0;
        lsf_budget b;
        lsf_budget_start(&b, 0.1, true);
        run(m, &b, 5.0);
        for (int second = 0; second < 60; second++)
            changes += run(second % 2 ? m : &busy, &b, 1.0).changes;
        assert_in_range(changes, 0, 16);
    }
}

/* A price that holds what happened but once is not held against a rung for good. */
static void budgets_retry_slow_sizes(void **state)
{
    (void)state;
    lsf_budget b;
    lsf_budget_start(&b, 0.1, false);
    b.rung = 5;
    for (uint32_t i = 0; i < b.rung; i++)
        b.price[i] = 1.0;
    run(&machines[0], &b, 7.0);
    assert_int_equal(b.rung, 5);
    run(&machines[0], &b, 7.0);
    assert_int_equal(b.rung, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orbits_the_scene),
        cmocka_unit_test(what_is_dragged_stays_under_the_cursor),
        cmocka_unit_test(rays_and_places_agree),
        cmocka_unit_test(budgets_are_held),
        cmocka_unit_test(budgets_are_used),
        cmocka_unit_test(budgets_follow_the_machine),
        cmocka_unit_test(budgets_that_cannot_be_held),
        cmocka_unit_test(budgets_tolerate_other_work),
        cmocka_unit_test(budgets_retry_slow_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
