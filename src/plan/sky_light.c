#include "plan/sky_light.h"

#include <math.h>

#include "scene/environment.h"

const lsf_option_row lsf_sky_light_options[LSF_SKY_LIGHT_OPTION_COUNT] = {
    {"environment.directions", LSF_OPTION_INT, offsetof(lsf_sky_light_params, directions), -1, 256,
     NULL, "directions",
     "directions drawn by the environment's radiance in an iteration, each with a shadow map; -1: "
     "16 where it alone lights what the camera sees from outside, else 8; 0: bundles, cones and "
     "paths find the environment by chance, and the direct technique is not lit by it"},
    {"environment.open", LSF_OPTION_INT, offsetof(lsf_sky_light_params, open), -1, 1024, NULL,
     "samples",
     "samples per pixel and iteration of the environment's light without shadows, as many by its "
     "radiance as by the surface; -1: 64 where it alone lights what the camera sees from outside "
     "and no light is kept from frame to frame, else 32, or 8 where a time limit is short for the "
     "picture's size; 0: only shadow maps determine its light"},
    {"environment.control", LSF_OPTION_ENUM, offsetof(lsf_sky_light_params, control), 0, 0,
     "share|whole", "",
     "weight of the environment's light without shadows in a pixel, which shadow maps then "
     "correct; share: the part that earlier directions found; whole: all of it"},
};

uint32_t lsf_sky_light_count(const lsf_requirements *requirements,
                             const lsf_sky_light_params *params, bool open)
{
    bool lit = requirements->environment && requirements->triangles > 0;
    if (!lit)
        return 0;
    return params->directions >= 0 ? (uint32_t)params->directions : open ? 16 : 8;
}

bool lsf_sky_light_is_controlled(uint32_t directions, const lsf_sky_light_params *params)
{
    return directions > 0 && params->open != 0;
}

void lsf_sky_light_draw(lsf_light_state *light, lsf_sky_share *share, const lsf_sky *sky,
                        const double u[2], uint32_t count)
{
    float pdf;
    lsf_float3 direction = lsf_sky_sample(sky, u, &pdf);
    lsf_float3 radiance = lsf_environment_radiance(sky->environment, direction);
    *light = (lsf_light_state){.type = LSF_LIGHT_DIRECTIONAL, .range = INFINITY};
    lsf_f3_store(light->direction, lsf_f3_scale(direction, -1.0f));
    lsf_f3_store(light->tangent, lsf_basis_about(direction).t);
    lsf_f3_store(light->intensity, lsf_f3_scale(radiance, 1.0f / ((float)count * pdf)));
    *share = (lsf_sky_share){.density = (float)count * lsf_sky_density(sky, radiance),
                             .shares = {1.0f, 1.0f}};
}
