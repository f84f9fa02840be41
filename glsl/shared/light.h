/* Attenuation of punctual lights, KHR_lights_punctual. One definition for shaders and reference. */
#ifndef LSF_SHARED_LIGHT_H
#define LSF_SHARED_LIGHT_H

#include "shared/brdf.h"
#include "shared/shared.h"

/* Squared distance below which 1/d^2 is clamped, in normalised units: light at a surface that
 * touches the light stays finite. 1e-6 of the scene's half extent. */
#define LSF_LIGHT_DISTANCE2_MIN 1e-12f

/* 1/d^2 with the recommended window max(min(1 - (d/range)^4, 1), 0). `inverse_range2` is
 * 1/range^2, 0 for no range. */
LSF_SHARED_FUNCTION float lsf_distance_attenuation(float distance2, float inverse_range2)
{
    float d2 = max(distance2, LSF_LIGHT_DISTANCE2_MIN);
    float x = d2 * inverse_range2;
    float window = max(min(1.0f - x * x, 1.0f), 0.0f);
    return window / d2;
}

/* Penumbra: squared linear ramp of the cosine between the outer and the inner cone. `scale` and
 * `offset` are lsf_spot_scale() and -cos_outer * scale. */
LSF_SHARED_FUNCTION float lsf_spot_attenuation(float cosine, float scale, float offset)
{
    float a = max(min(cosine * scale + offset, 1.0f), 0.0f);
    return a * a;
}

LSF_SHARED_FUNCTION float lsf_spot_scale(float cos_inner, float cos_outer)
{
    return 1.0f / max(0.001f, cos_inner - cos_outer);
}

/* Largest value of the ramp, on the cone's axis: 1 unless the cone is narrower than
 * lsf_spot_scale can resolve. */
LSF_SHARED_FUNCTION float lsf_spot_axis(float scale, float offset)
{
    return max(min(scale + offset, 1.0f), 0.0f);
}

/* Solid angle of the cone inside the ramp. */
LSF_SHARED_FUNCTION float lsf_spot_inner(float scale, float offset)
{
    return 2.0f * LSF_PI * max(1.0f - (1.0f - offset) / scale, 0.0f);
}

/* Integral of lsf_spot_attenuation over all directions [sr]: with a = cosine scale + offset, the
 * ramp gives 2 pi / scale times the integral of a^2 da. */
LSF_SHARED_FUNCTION float lsf_spot_integral(float scale, float offset)
{
    float axis = lsf_spot_axis(scale, offset);
    return lsf_spot_inner(scale, offset) + 2.0f * LSF_PI * (axis * axis * axis) / (3.0f * scale);
}

/* The cosine c for which a fraction u of that integral lies between the axis and c. */
LSF_SHARED_FUNCTION float lsf_spot_cosine(float u, float scale, float offset)
{
    float solid_angle = u * lsf_spot_integral(scale, offset);
    float inner = lsf_spot_inner(scale, offset);
    if (solid_angle <= inner)
        return 1.0f - solid_angle / (2.0f * LSF_PI);
    float axis = lsf_spot_axis(scale, offset);
    float cube = axis * axis * axis - 3.0f * scale * (solid_angle - inner) / (2.0f * LSF_PI);
    return min((pow(max(cube, 0.0f), 1.0f / 3.0f) - offset) / scale, 1.0f);
}

#include "shared/shared_end.h"
#endif
