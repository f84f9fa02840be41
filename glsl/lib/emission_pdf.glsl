/* Density with which the current light emits VPLs towards a point. Switches LSF_SPOT_LIGHT, LSF_DIRECTIONAL_LIGHT,
 * LSF_EMISSION_ADAPTIVE. The light block must be that of the reflective shadow map. Densities are per steradian
 * about the light; for a directional light, per area of a plane across it. */
#ifndef LSF_LIB_EMISSION_PDF
#define LSF_LIB_EMISSION_PDF

#include "lib/light_projection.glsl"
#include "shared/brdf.h"
#include "shared/light.h"

/* Converts a density over positions on a face, in units of -1..1, to one over directions (or areas) at this point:
 * a face's position (x, y) = q.xy / (q.z extent) spans extent.x extent.y / (1 + (q.x^2 + q.y^2) / q.z^2)^(3/2)
 * steradians. */
float emission_face_density(int face, vec3 position)
{
    vec2 extent = light.map_window[face].zw;
    if (!light_projection_perspective())
        return 1.0 / (extent.x * extent.y);
    vec3 q = light_projection_coordinates(face, position);
    float secant2 = dot(q, q) / (q.z * q.z);
    return secant2 * sqrt(secant2) / (extent.x * extent.y);
}

/* Density in proportion to the light's intensity. */
float emission_pdf_uniform(vec3 position)
{
    float type = light.attenuation.w;
#if LSF_DIRECTIONAL_LIGHT
    if (type == LSF_LIGHT_TYPE_DIRECTIONAL) {
        vec2 face_position = abs(light_projection_face_position(0, light_projection_coordinates(0, position)));
        return max(face_position.x, face_position.y) <= 1.0 ? 0.25 * emission_face_density(0, position) : 0.0;
    }
#endif
#if LSF_SPOT_LIGHT
    if (type == LSF_LIGHT_TYPE_SPOT) {
        float cosine = dot(normalize(position - light.position.xyz), light.direction.xyz);
        return lsf_spot_attenuation(cosine, light.attenuation.y, light.attenuation.z) /
               lsf_spot_integral(light.attenuation.y, light.attenuation.z);
    }
#endif
    return 0.25 / LSF_PI;
}

#if LSF_EMISSION_ADAPTIVE

/* Importance: the flux that each texel reflects. Times light.position.w it is the density over positions. */
layout(binding = LSF_UNIT_EMISSION) uniform sampler2DArray emission_importance;

/* Share of the VPLs that are emitted in proportion to intensity whatever the map shows, so that points that a
 * texel's centre misses have a density, too: defensive importance sampling (Hesterberg 1995, "Weighted Average
 * Importance Sampling and Defensive Mixture Distributions"). No VPL then has more than eight times the power that
 * it has with uniform emission. */
#define EMISSION_DEFENSIVE 0.125

float emission_pdf(vec3 position)
{
    float uniform_pdf = emission_pdf_uniform(position);
    if (light.position.w == 0.0)
        return uniform_pdf; /* the light reaches no surface */
    int face = light_projection_face(position);
    vec3 q = light_projection_coordinates(face, position);
    vec2 face_position = light_projection_face_position(face, q);
    if ((light_projection_perspective() && q.z <= 0.0) || max(abs(face_position.x), abs(face_position.y)) > 1.0)
        return EMISSION_DEFENSIVE * uniform_pdf; /* beside the map */
    ivec2 last = ivec2(int(light.map_shape.z) - 1);
    ivec2 at = clamp(ivec2((face_position * 0.5 + 0.5) * light.map_shape.z), ivec2(0), last);
    float adaptive_pdf = texelFetch(emission_importance, ivec3(at, face), 0).r * light.position.w *
                         emission_face_density(face, position);
    return mix(adaptive_pdf, uniform_pdf, EMISSION_DEFENSIVE);
}

#else

float emission_pdf(vec3 position)
{
    return emission_pdf_uniform(position);
}

#endif
#endif
