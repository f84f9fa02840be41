/* Density [1/sr] of ray-bundles by direction, p_r; see src/techniques/bundle_directions.h. Switch
 * LSF_BUNDLE_IMPORTANCE: they are drawn by an environment map's light, else uniformly. */
#ifndef LSF_LIB_BUNDLE_PDF
#define LSF_LIB_BUNDLE_PDF

#include "shared/brdf.h"
#include "shared/scene_data.h"

#if LSF_BUNDLE_IMPORTANCE
layout(binding = LSF_UNIT_BUNDLE_PDF) uniform sampler2D bundle_pdf_texture;
#endif

float bundle_pdf(vec3 direction)
{
#if LSF_BUNDLE_IMPORTANCE
    vec2 uv = vec2(0.5 + atan(direction.z, direction.x) / (2.0 * LSF_PI),
                   acos(clamp(direction.y, -1.0, 1.0)) / LSF_PI);
    ivec2 size = textureSize(bundle_pdf_texture, 0);
    return texelFetch(bundle_pdf_texture, min(ivec2(uv * vec2(size)), size - 1), 0).r;
#else
    return 0.5 / LSF_PI;
#endif
}

#endif
