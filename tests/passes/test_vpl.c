/* Virtual point lights: they lie on the surfaces that the light meets, where its density says,
 * carry its flux, and their maps see what rays see. */
#include <math.h>

#include "../reference/chi_square.h"
#include "light_passes.h"

#include "base/base.h"
#include "math/sampling.h"

typedef struct light_case {
    const char *name;
    lsf_light_type type;
    lsf_float3 position, direction;
    float inner, outer;
} light_case;

static const light_case cases[] = {
    {"point", LSF_LIGHT_POINT, {0.1f, 0.5f, 0.2f}, {0, -1, 0}, 0, 0},
    {"narrow spot", LSF_LIGHT_SPOT, {0.1f, 0.7f, 0.2f}, {-0.3f, -1, 0.2f}, 0.3f, 0.8f},
    {"wide spot", LSF_LIGHT_SPOT, {0.1f, 0.5f, 0.2f}, {-0.3f, -1, 0.2f}, 0.9f, 1.4f},
    {"hard spot", LSF_LIGHT_SPOT, {0.1f, 0.7f, 0.2f}, {-0.3f, -1, 0.2f}, 0.5f, 0.5f},
    {"sun", LSF_LIGHT_DIRECTIONAL, {0, 0, 0}, {0.4f, -1, 0.3f}, 0, 0},
};

/* A room with a box and a slanted board in it; under the sun without walls. */
static lsf_scene *room(const light_case *c)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.7f, 0.5f, 0.3f);
    if (c->type == LSF_LIGHT_DIRECTIONAL)
        build_floor(scene, -0.8f, 1.0f);
    else
        build_box(scene, lsf_f3(-1, -0.8f, -1), lsf_f3(1, 0.8f, 1), true);
    build_box(scene, lsf_f3(-0.5f, -0.8f, -0.3f), lsf_f3(0.1f, -0.1f, 0.3f), false);
    build_quad(scene, lsf_f3(0.4f, -0.5f, -0.6f), lsf_f3(0.9f, -0.5f, -0.4f),
               lsf_f3(0.8f, 0.2f, 0.4f), lsf_f3(0.3f, 0.2f, 0.2f));
    lsf_light *light = build_light(scene, c->type, c->position, c->direction, 3.0f);
    light->inner_cone = c->inner;
    light->outer_cone = c->outer;
    finish_gl_scene(scene);
    return scene;
}

static lsf_float3 xyz(lsf_vec4 v)
{
    return lsf_f3(v.x, v.y, v.z);
}

static void start(light_passes *p, const lsf_scene *scene, int32_t count, int32_t rsm)
{
    lsf_reflective_shadow_map_params rsm_params = {LSF_REFLECTIVE_SHADOW_MAP_PARAMS_DEFAULTS};
    lsf_vpl_params vpl_params = {LSF_VPL_PARAMS_DEFAULTS};
    rsm_params.resolution = rsm;
    vpl_params.count = count;
    light_passes_init(p, scene, &rsm_params, &vpl_params);
}

/* Where a ray back from the VPL starts, and where the VPL lies on it. */
static lsf_float3 ray_start(const light_passes *p, const struct lsf_vpl_data *vpl, double *distance)
{
    lsf_float3 to_light = xyz(vpl->to_light), position = xyz(vpl->position);
    if (p->state.lights[0].type != LSF_LIGHT_DIRECTIONAL) {
        *distance = sqrt((double)vpl->to_light.w);
        return lsf_f3_load(p->state.lights[0].position);
    }
    *distance = 4.0;
    return lsf_f3_mad(position, to_light, 4.0f);
}

static void positions_lie_on_surfaces(void **unused)
{
    (void)unused;
    for (size_t c = 0; c < LSF_COUNT(cases); c++) {
        lsf_scene *scene = room(&cases[c]);
        light_passes p;
        start(&p, scene, 4096, 256);
        light_passes_run(&p, 3, 0);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        uint32_t lit = 0, close = 0, flat = 0, normal_right = 0;
        for (uint32_t i = 0; i < 4096; i++) {
            if (vpls[i].position.w == 0.0f)
                continue;
            lit++;
            double distance;
            lsf_float3 origin = ray_start(&p, &vpls[i], &distance), normal;
            lsf_float3 direction = lsf_f3_scale(xyz(vpls[i].to_light), -1.0f);
            double hit = light_passes_trace(&p, origin, direction, 0.0, &normal);
            close += fabs(hit - distance) < 1e-5;
            if (fabs(hit - distance) < 1e-2) {
                flat++;
                lsf_float3 n = xyz(vpls[i].geometric_normal);
                normal_right += fabsf(fabsf(lsf_f3_dot(n, normal)) - 1.0f) < 1e-5f &&
                                lsf_f3_dot(n, direction) < 0.0f;
            }
        }
        print_message("%s: %u of 4096 VPLs lit, %u where the ray ends, %u near it, %u with its "
                      "normal\n",
                      cases[c].name, lit, close, flat, normal_right);
        /* Silhouettes run through texels: a few rays go past what the texel's centre meets. */
        assert_true(lit > (cases[c].type == LSF_LIGHT_DIRECTIONAL ? 1024 : 4095));
        assert_true(close >= 0.99 * lit && normal_right >= 0.99 * lit);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

static void maps_see_what_rays_see(void **unused)
{
    (void)unused;
    enum { POINTS = 4096, VPLS = 8 };
    for (size_t c = 0; c < LSF_COUNT(cases); c++) {
        lsf_scene *scene = room(&cases[c]);
        light_passes p;
        start(&p, scene, VPLS, 256);
        light_passes_run(&p, 1, 0);
        struct lsf_vpl_data *vpls = light_passes_vpls(&p);
        float(*points)[8] = calloc(POINTS, sizeof *points);
        float *visible = calloc(POINTS, sizeof *visible);
        uint32_t asked = 0, agreed = 0, leaks = 0, shades = 0;
        for (uint32_t v = 0; v < VPLS; v++) {
            if (vpls[v].position.w == 0.0f)
                continue;
            lsf_float3 x1 = xyz(vpls[v].position), n1 = xyz(vpls[v].geometric_normal);
            for (uint32_t i = 0; i < POINTS; i++) {
                float u[2], w[2];
                light_passes_random(i, v, u);
                light_passes_random(i, 1000 + v, w);
                uint32_t t = (uint32_t)(u[0] * (float)p.triangle_count);
                const lsf_float3 *corner = p.corners + 3 * t;
                float b1, b2;
                lsf_sample_triangle(w[0], w[1], &b1, &b2);
                lsf_float3 x = lsf_f3_mad(
                    lsf_f3_mad(lsf_f3_scale(corner[0], 1 - b1 - b2), corner[1], b1), corner[2], b2);
                lsf_float3 n = lsf_f3_normalize(lsf_f3_cross(lsf_f3_sub(corner[1], corner[0]),
                                                             lsf_f3_sub(corner[2], corner[0])));
                if (lsf_f3_dot(n, lsf_f3_sub(x1, x)) < 0.0f)
                    n = lsf_f3_scale(n, -1.0f);
                lsf_f3_store(points[i], x);
                lsf_f3_store(points[i] + 4, n);
            }
            lsf_vpl_shadow_map(&p.vpl, &p.iteration, v);
            lsf_vpl_bind(&p.vpl, v);
            light_passes_probe(&p, "lib/shadow.glsl", "#define LSF_SHADOW_HEMISPHERE 1",
                               "shadow_visibility(position, normal)", (const float(*)[8])points,
                               POINTS, visible);
            for (uint32_t i = 0; i < POINTS; i++) {
                lsf_float3 to = lsf_f3_sub(lsf_f3_load(points[i]), x1);
                float distance = lsf_f3_length(to);
                lsf_float3 direction = lsf_f3_scale(to, 1.0f / distance);
                if (lsf_f3_dot(direction, n1) < 1e-3f || distance < 1e-3f ||
                    lsf_f3_dot(direction, lsf_f3_load(points[i] + 4)) > -1e-3f)
                    continue;
                bool seen =
                    light_passes_trace(&p, x1, direction, 1e-5, NULL) > (double)distance - 1e-5;
                asked++;
                agreed += seen == (visible[i] != 0.0f);
                leaks += !seen && visible[i] != 0.0f;
                shades += seen && visible[i] == 0.0f;
            }
        }
        print_message("%s: %.4f of %u points agree; %u are lit but hidden, %u hidden but lit\n",
                      cases[c].name, (double)agreed / asked, asked, leaks, shades);
        assert_true(asked > 5000 && agreed >= 0.99 * asked);
        free(points);
        free(visible);
        free(vpls);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_lie_on_surfaces),
        cmocka_unit_test(maps_see_what_rays_see),
    };
    return cmocka_run_group_tests_name("vpl", tests, NULL, NULL);
}
