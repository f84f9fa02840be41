/* Reflective shadow maps: every texel holds what a ray through its centre meets. */
#include <math.h>

#include "light_passes.h"
#include "octahedral.h"

enum { SIDE = 64, PLACES = 600 };

typedef struct map_texels {
    float *depth;
    uint32_t *surface; /* 4 each */
    float *importance; /* with adaptive emission */
    uint32_t faces;
} map_texels;

static map_texels read_map(const light_passes *p)
{
    const lsf_reflective_shadow_map_outputs *out = &p->rsm.outputs;
    map_texels m = {.faces = (uint32_t)out->light.map_origin.w};
    size_t count = (size_t)m.faces * SIDE * SIDE;
    m.depth = calloc(count, sizeof *m.depth);
    m.surface = calloc(count, 4 * sizeof *m.surface);
    m.importance = calloc(count, sizeof *m.importance);
    assert_true(m.depth && m.surface && m.importance);
    glGetTextureImage(out->seen.depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      (GLsizei)(count * sizeof *m.depth), m.depth);
    glGetTextureImage(out->seen.surface, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                      (GLsizei)(4 * count * sizeof *m.surface), m.surface);
    if (out->importance)
        glGetTextureImage(out->importance, 0, GL_RED, GL_FLOAT,
                          (GLsizei)(count * sizeof *m.importance), m.importance);
    return m;
}

static void free_map(map_texels *m)
{
    free(m->depth);
    free(m->surface);
    free(m->importance);
}

static lsf_float3 xyz(lsf_vec4 v)
{
    return lsf_f3(v.x, v.y, v.z);
}

/* The ray through a texel's centre; its direction's coordinate along forward is 1. */
static void texel_ray(const struct lsf_light_data *light, uint32_t face, float x, float y,
                      lsf_float3 *origin, lsf_float3 *direction)
{
    lsf_float3 right = xyz(light->map_right[face]), up = xyz(light->map_up[face]);
    lsf_vec4 window = light->map_window[face];
    float px = (2.0f * (x + 0.5f) / SIDE - 1.0f - light->map_offset.x) * window.z;
    float py = (2.0f * (y + 0.5f) / SIDE - 1.0f - light->map_offset.y) * window.w;
    *origin = xyz(light->map_origin);
    *direction = xyz(light->map_forward[face]);
    if (light->map_shape.y == 0.0f)
        *direction = lsf_f3_mad(lsf_f3_mad(*direction, right, px), up, py);
    else
        *origin = lsf_f3_mad(lsf_f3_mad(*origin, right, px + window.x), up, py + window.y);
}

/* Distance along forward. */
static double texel_distance(const struct lsf_light_data *light, float depth)
{
    double near = (double)light->map_shape.x, far = (double)light->map_shape.y;
    if (depth == 0.0f)
        return INFINITY;
    return far == 0.0 ? near / (double)depth : far - (double)depth * (far - near);
}

static void texels_hold_what_rays_meet(void **unused)
{
    (void)unused;
    for (int c = 0; c < LIGHT_CASES; c++) {
        lsf_scene *scene = light_case_scene(&light_cases[c]);
        light_passes p;
        light_passes_init(&p, scene, SIDE, LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE, 1);
        light_passes_run(&p, (uint32_t)c, 0);
        const struct lsf_light_data *light = &p.rsm.outputs.light;
        map_texels m = read_map(&p);
        int depths = 0, normals = 0, met = 0, important = 0;
        for (int i = 0; i < PLACES; i++) {
            float u[2], w[2];
            light_passes_random((uint64_t)i, 1, u);
            light_passes_random((uint64_t)i, 2, w);
            uint32_t face = (uint32_t)(w[0] * (float)m.faces);
            uint32_t x = (uint32_t)(u[0] * SIDE), y = (uint32_t)(u[1] * SIDE);
            size_t at = ((size_t)face * SIDE + y) * SIDE + x;
            lsf_float3 origin, direction, normal = {0};
            texel_ray(light, face, (float)x, (float)y, &origin, &direction);
            double hit = light_passes_trace(&p, origin, direction, 0.0, &normal);
            double found = texel_distance(light, m.depth[at]);
            double facing = fabs((double)lsf_f3_dot(normal, direction));
            double off = (double)light_passes_raster_error(&p, normal, hit) / fmax(facing, 1e-9);
            bool same = isinf(hit) ? isinf(found) : fabs(found - hit) < 1e-5 * hit + 1e-6 + off;
            lsf_float3 n = octahedral_decode(m.surface[4 * at]);
            depths += same;
            met += isfinite(hit);
            normals += same && isfinite(hit) && lsf_f3_dot(n, direction) < 0.0f &&
                       lsf_f3_length(lsf_f3_cross(n, normal)) < 1e-4f;
            important += isinf(found) && m.importance[at] != 0.0f;
        }
        print_message("%s: of %d texels %d have the depth of the ray, of %d surfaces %d the "
                      "normal\n",
                      light_cases[c].name, (int)PLACES, depths, met, normals);
        /* A triangle's edge through a texel's centre is on either side of it by rounding. */
        assert_true(depths >= PLACES - 3 && normals >= met - 3);
        assert_int_equal(important, 0);
        free_map(&m);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

/* Where alpha is below the cutoff the light goes through. */
static void masks_let_light_through(void **unused)
{
    (void)unused;
    for (int cut = 0; cut < 2; cut++) {
        lsf_scene *scene = build_scene();
        lsf_material *material = build_material(scene, 0.5f, 0.5f, 0.5f);
        material->alpha_mode = LSF_ALPHA_MASK;
        material->base_color[3] = cut ? 0.4f : 0.6f;
        build_floor(scene, 0.0f, 1.0f);
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 0.5f, 0), lsf_f3(0, -1, 0), 1.0f);
        finish_gl_scene(scene);
        light_passes p;
        light_passes_init(&p, scene, SIDE, LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM, 1);
        light_passes_run(&p, 0, 0);
        map_texels m = read_map(&p);
        uint32_t met = 0;
        for (uint32_t i = 0; i < m.faces * SIDE * SIDE; i++)
            met += m.depth[i] != 0.0f;
        assert_true(cut ? met == 0 : met > m.faces * SIDE * SIDE / 4);
        lsf_vpl_shadow_map(&p.vpl, &p.iteration, 0);
        free_map(&m);
        light_passes_finish(&p);
        destroy_scene(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_hold_what_rays_meet),
        cmocka_unit_test(masks_let_light_through),
    };
    return cmocka_run_group_tests_name("reflective shadow map", tests, NULL, NULL);
}
