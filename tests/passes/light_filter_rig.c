#include "light_filter_rig.h"

#include <math.h>

#include "base/base.h"
#include "math/sampling.h"

void filter_rig_begin(filter_rig *r, uint32_t width, uint32_t height, bool orthographic,
                      const lsf_light_filter_params *params)
{
    lsf_error error = {0};
    memset(r, 0, sizeof *r);
    assert_true(width * height <= MAX_PIXELS);
    surface_rig_begin(&r->s, width, height, orthographic);
    r->s.setup.plan->pattern = 1; /* pixels have noise of their own */
    lsf_light_mean_plan(r->s.setup.plan, &(lsf_light_mean_use){.indirect = true});
    lsf_light_guide_plan(r->s.setup.plan);
    lsf_light_filter_plan(r->s.setup.plan, params);
    surface_rig_start(&r->s);
    if (!lsf_light_mean_create(&r->mean, r->s.context, r->s.setup.plan, &error) ||
        !lsf_light_guide_create(&r->guide, r->s.context, r->s.setup.plan, &error) ||
        !lsf_light_filter_create(&r->filter, r->s.context, r->s.setup.plan, params, &error))
        fail_msg("%s", error.message);
    r->gbuffer.seen = r->s.maps;
    r->irradiance = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
    r->specular = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
    r->picture = surface_rig_texture(&r->s, GL_RGBA32F, width, height);
}

void filter_rig_end(filter_rig *r)
{
    lsf_texture_destroy(r->s.context, &r->irradiance);
    lsf_texture_destroy(r->s.context, &r->specular);
    lsf_texture_destroy(r->s.context, &r->picture);
    lsf_light_filter_destroy(&r->filter);
    lsf_light_guide_destroy(&r->guide);
    lsf_light_mean_destroy(&r->mean);
    surface_rig_end(&r->s);
}

uint32_t pixels_of(const filter_rig *r)
{
    return r->s.width * r->s.height;
}

void see(filter_rig *r, uint32_t i, const seen *point)
{
    surface_rig_see(&r->s, i % r->s.width, i / r->s.width, point);
    r->s.surfaces[i][2] = 0xffffffffu;
    r->s.surfaces[i][3] |= 0xffffu;
    r->s.glosses[i][0] |= 2621u << 16; /* f0 of 0.04 */
}

void see_everywhere(filter_rig *r, const seen *point)
{
    for (uint32_t i = 0; i < pixels_of(r); i++)
        see(r, i, point);
}

void set_light(filter_rig *r, uint32_t i, float irradiance, float specular)
{
    for (int c = 0; c < 3; c++) {
        r->light[i][c] = irradiance;
        r->specular_params[i][c] = specular;
    }
}

void iterate(filter_rig *r)
{
    if (r->iterations == 0)
        surface_rig_upload(&r->s);
    surface_rig_write(r->irradiance, r->s.width, r->s.height, r->light[0]);
    surface_rig_write(r->specular, r->s.width, r->s.height, r->specular_params[0]);
    const lsf_light_parts parts = {.gbuffer = &r->gbuffer,
                                   .indirect = {r->irradiance, r->specular}};
    r->s.iteration.done = r->iterations++;
    lsf_light_mean_run(&r->mean, &r->s.iteration, &parts, 0);
}

void filter(filter_rig *r)
{
    static texels specular;
    surface_rig_read(r->mean.diffuse.light, r->s.width, r->s.height, r->raw[0]);
    surface_rig_read(r->mean.specular.light, r->s.width, r->s.height, specular[0]);
    for (uint32_t i = 0; i < pixels_of(r); i++)
        for (int c = 0; c < 4; c++)
            r->raw[i][c] = c < 3 ? r->raw[i][c] + specular[i][c] : 1.0f;
    surface_rig_write(r->picture, r->s.width, r->s.height, r->raw[0]);
    const lsf_light_guide_inputs means = {.mean = r->mean.guide,
                                          .diffuse_factor = r->mean.diffuse.factor,
                                          .specular_factor = r->mean.specular.factor};
    lsf_light_guide_run(&r->guide, r->s.setup.plan, r->iterations, &means);
    const lsf_light_filter_inputs inputs = {
        .guide = r->guide.maps,
        .half = r->mean.half,
        .half_count = lsf_light_mean_half(r->iterations),
        .picture = r->picture,
        .parts = {{r->mean.diffuse.light, r->mean.diffuse.factor},
                  {r->mean.specular.light, r->mean.specular.factor}}};
    lsf_light_filter_run(&r->filter, &r->s.iteration, r->iterations, &inputs);
    lsf_light_filter_finish(&r->filter, &r->s.iteration, r->iterations, &inputs,
                            r->filter.filtered);
    surface_rig_read(r->filter.picture, r->s.width, r->s.height, r->out[0]);
}

void assert_unchanged(const filter_rig *r, uint32_t i)
{
    assert_memory_equal(r->out[i], r->raw[i], 3 * sizeof **r->out); /* A: variance */
}

float random_at(uint32_t seed, uint32_t i)
{
    return lsf_random_float(seed, i);
}

float exponential_at(uint32_t seed, uint32_t i)
{
    return -logf(1.0f - random_at(seed, i));
}

void noisy_light(filter_rig *r, uint32_t i, float mean)
{
    set_light(r, i, mean * exponential_at(100 + r->iterations, i), 0.0f);
}
