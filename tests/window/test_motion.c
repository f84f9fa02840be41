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

static void goes_around(void **state)
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

/* A machine on which a frame takes so much for itself, and so much for pixels and for maps. */
static double frame(const lsf_budget *b, double fixed, double pixels, double maps)
{
    return fixed + pixels * b->scale * b->scale + maps / (1.0 + b->coarse);
}

static void budgets_are_held(void **state)
{
    (void)state;
    static const double machines[][3] = {{0.01, 0.02, 0.01},
                                         {0.01, 0.4, 0.02},
                                         {0.02, 2.0, 0.1},
                                         {0.03, 0.05, 0.15},
                                         {0.0, 0.3, 0.0}};
    for (size_t m = 0; m < sizeof machines / sizeof machines[0]; m++) {
        const double *t = machines[m];
        lsf_budget b;
        lsf_budget_start(&b, 0.1);
        int changes = 0;
        for (int i = 0; i < 400; i++)
            changes += lsf_budget_measure(&b, frame(&b, t[0], t[1], t[2])) && i >= 200;
        assert_true(frame(&b, t[0], t[1], t[2]) <= 1.1 * b.seconds);
        assert_int_equal(changes, 0); /* it comes to rest */
        for (int i = 0; i < 400; i++) /* and back, on a faster machine */
            lsf_budget_measure(&b, 0.02 * frame(&b, t[0], t[1], t[2]));
        assert_true(b.scale == 1.0 && b.coarse == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(goes_around),
        cmocka_unit_test(what_is_dragged_stays_under_the_cursor),
        cmocka_unit_test(rays_and_places_agree),
        cmocka_unit_test(budgets_are_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
