/* Means of light and their filter, on surfaces and light made by hand. */
#ifndef LSF_TESTS_PASSES_LIGHT_FILTER_RIG_H
#define LSF_TESTS_PASSES_LIGHT_FILTER_RIG_H

#include "passes/light_filter.h"
#include "passes/light_guide.h"
#include "passes/light_mean.h"
#include "surface_rig.h"

enum { MAX_PIXELS = 96 * 96 };
static const float PI_F = 3.14159265f;

typedef float texels[MAX_PIXELS][4];

typedef struct filter_rig {
    surface_rig s;
    lsf_light_mean mean;
    lsf_light_guide guide;
    lsf_light_filter filter;
    lsf_gbuffer_maps gbuffer;
    GLuint irradiance, specular, picture;
    texels light, specular_params; /* of the next iteration */
    texels raw, out; /* the means of all of them, and what the filter makes of these */
    uint32_t iterations;
} filter_rig;

/* Nothing is seen yet. Pixels have noise of their own. */
void filter_rig_begin(filter_rig *r, uint32_t width, uint32_t height, bool orthographic,
                      const lsf_light_filter_params *params);
void filter_rig_end(filter_rig *r);

uint32_t pixels_of(const filter_rig *r);
/* What a pixel sees, white. */
void see(filter_rig *r, uint32_t i, const seen *point);
void see_everywhere(filter_rig *r, const seen *point);

void set_light(filter_rig *r, uint32_t i, float irradiance, float specular);
/* Sets light of mean `mean` and noise that differs between pixels and iterations. */
void noisy_light(filter_rig *r, uint32_t i, float mean);
/* An iteration of the light that is set. */
void iterate(filter_rig *r);
/* Fills `raw` and `out`. */
void filter(filter_rig *r);
void assert_unchanged(const filter_rig *r, uint32_t i);

float random_at(uint32_t seed, uint32_t i);
/* Of mean 1 and standard deviation 1, with a heavy tail. */
float exponential_at(uint32_t seed, uint32_t i);

#endif
