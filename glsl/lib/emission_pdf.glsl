/* With which density the light in turn emits VPLs towards a point. Switches LSF_SPOT_LIGHT,
 * LSF_DIRECTIONAL_LIGHT. */
#ifndef LSF_LIB_EMISSION_PDF
#define LSF_LIB_EMISSION_PDF

#include "lib/light_map.glsl"
#include "shared/brdf.h"
#include "shared/light.h"

/* Per steradian about the light; for a directional light per area of a plane across it. The light
 * block must be that of the reflective shadow map. */
float emission_pdf(vec3 position)
{
    float type = light.attenuation.w;
#if LSF_DIRECTIONAL_LIGHT
    if (type == LSF_LIGHT_TYPE_DIRECTIONAL) {
        vec2 extent = light.map_window[0].zw;
        vec2 place = abs(light_map_place(0, light_map_coordinates(0, position)));
        return max(place.x, place.y) <= 1.0 ? 0.25 / (extent.x * extent.y) : 0.0;
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

#endif
