#include "scene/emitted_light.h"

#include "math/sampling.h"
#include "scene/emitters.h"

/* Number of emitters drawn for each point. Together they give the median within a few percent,
 * which is little beside the factors by which scenes differ. */
#define EMITTERS_EACH 32

/* Light of the emitter's point that the point reflects, over the density of the emitter's point. */
static float reflected(const lsf_seen_point *point, const lsf_emitter_sample *emitter)
{
    float radiance = lsf_f3_luminance(lsf_f3_load(emitter->radiance));
    lsf_float3 to = lsf_f3_sub(lsf_f3_load(emitter->position), point->position);
    float squared = lsf_f3_dot(to, to);
    float at_point = lsf_f3_dot(to, point->normal);
    float at_emitter = -lsf_f3_dot(to, lsf_f3_load(emitter->normal));
    if (!(at_point > 0.0f) || !(at_emitter > 0.0f))
        return 0.0f;
    /* Divided by r^2 twice: r^4 may underflow to 0 where r^2 does not. */
    float share = (at_point / squared) * (at_emitter / squared) / (3.14159265f * emitter->density);
    return radiance * share;
}

static float reflected_of_all(const lsf_seen_point *point, const lsf_emitters *emitters,
                              uint32_t first)
{
    float sum = 0.0f;
    for (uint32_t i = first; i < first + EMITTERS_EACH; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(i, 1, bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        lsf_emitter_sample emitter = lsf_emitters_sample(emitters, u);
        sum += reflected(point, &emitter);
    }
    return sum / EMITTERS_EACH;
}

static float median_reflected(const lsf_seen *seen, const lsf_emitters *emitters)
{
    float each[LSF_SEEN_SIDE * LSF_SEEN_SIDE];
    for (uint32_t i = 0; i < seen->count; i++)
        each[i] = reflected_of_all(&seen->points[i], emitters, i * EMITTERS_EACH);
    return lsf_seen_median(each, seen->count);
}

float lsf_emitted_light(const lsf_scene *scene, const lsf_state *state, const lsf_seen *seen)
{
    lsf_emitters emitters = {0};
    float median = -1.0f;
    if (lsf_emitters_init(&emitters, scene, state))
        median =
            seen->count > 0 && emitters.power.sum > 0.0 ? median_reflected(seen, &emitters) : 0.0f;
    lsf_emitters_finish(&emitters);
    return median;
}
