#include "reference/direct.h"

#include "math/sampling.h"
#include "reference/punctual.h"
#include "scene/environment.h"

static void add_emitter(lsf_walk *w, const lsf_light_choice *choice)
{
    const lsf_reference_world *world = w->world;
    float u[2] = {(float)choice->u[0], (float)choice->u[1]};
    lsf_reference_emitter_sample light = lsf_reference_emitter_draw(
        &world->lights.emitters, &world->geometry, choice->light, w->surface.position, u);
    light.pdf *= choice->probability;
    if (!(light.pdf > 0.0f) || !(lsf_f3_max(light.radiance) > 0.0f))
        return;
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, light.direction);
    if (!(reflection.pdf > 0.0f) || !lsf_walk_reaches(w, light.target))
        return;
    float weight = lsf_mis_weight(light.pdf, reflection.pdf) / light.pdf;
    lsf_float3 to = lsf_f3_sub(light.target, w->surface.position);
    lsf_float3 left = lsf_left_after(lsf_walk_absorption(w, light.direction), lsf_f3_length(to));
    lsf_walk_add_reflected(w, &reflection, lsf_f3_scale(lsf_f3_mul(light.radiance, left), weight));
}

/* The scene is surrounded by air: light from there enters a medium through its surface. */
static void add_sky(lsf_walk *w, float asked)
{
    const lsf_sky *sky = &w->world->lights.sky;
    uint32_t bits[2];
    lsf_sobol_2d_bits(w->sampler->index, lsf_walk_seed(w, LSF_WALK_SKY), bits);
    double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
    float pdf;
    lsf_float3 direction = lsf_sky_sample(sky, u, &pdf);
    pdf *= asked;
    lsf_reference_reflection reflection = lsf_reference_bsdf_evaluate(&w->bsdf, direction);
    if (!(reflection.pdf > 0.0f) || !lsf_walk_reaches_sky(w, direction))
        return;
    float weight = lsf_mis_weight(pdf, reflection.pdf) / pdf;
    lsf_walk_add_reflected(
        w, &reflection,
        lsf_f3_scale(lsf_environment_radiance(sky->environment, direction), weight));
}

static lsf_light_numbers numbers(const lsf_walk *w, lsf_walk_dimension dimension)
{
    return (lsf_light_numbers){lsf_walk_seed(w, dimension), w->sampler->index};
}

static void add_bulbs(lsf_walk *w, const lsf_light_receiver *receiver)
{
    lsf_light_choice choices[LSF_LIGHTS_MOST];
    uint32_t count = lsf_light_tree_draw(&w->world->lights.bulbs, receiver, lsf_walk_most(w),
                                         numbers(w, LSF_WALK_LIGHT), choices);
    for (uint32_t i = 0; i < count; i++)
        lsf_add_punctual(w, choices[i].light, choices[i].probability);
}

static void add_glow(lsf_walk *w, const lsf_light_receiver *receiver)
{
    lsf_light_choice choice;
    if (lsf_light_tree_draw(&w->world->lights.glow, receiver, 1, numbers(w, LSF_WALK_EMITTER),
                            &choice) == 1)
        add_emitter(w, &choice);
}

static void add_far(lsf_walk *w, const lsf_light_receiver *receiver, uint32_t most)
{
    const lsf_reference_lights *lights = &w->world->lights;
    double u =
        lsf_unit_double(lsf_sobol_1d_bits(w->sampler->index, lsf_walk_seed(w, LSF_WALK_LIGHT)));
    lsf_light_choice choices[LSF_LIGHTS_MOST];
    uint32_t count = lsf_far_lights_draw(lights, receiver, most, u, choices);
    for (uint32_t i = 0; i < count; i++) {
        if (choices[i].light < lights->far_count)
            lsf_add_punctual(w, lights->far[choices[i].light], choices[i].probability);
        else
            add_sky(w, choices[i].probability);
    }
}

void lsf_add_direct(lsf_walk *w)
{
    lsf_light_receiver receiver = lsf_walk_receiver(w);
    if (w->world->lights.bulbs.nodes != NULL)
        add_bulbs(w, &receiver);
    if (w->world->lights.glow.nodes != NULL)
        add_glow(w, &receiver);
    add_far(w, &receiver, lsf_walk_most(w));
}
