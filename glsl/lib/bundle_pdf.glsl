/* Density [1/sr] p_r of ray-bundles by direction; see src/techniques/bundle_directions.h. Switch
 * LSF_BUNDLE_IMPORTANCE: directions are drawn by an environment map's radiance, else uniformly. */
#ifndef LSF_LIB_BUNDLE_PDF
#define LSF_LIB_BUNDLE_PDF

#include "lib/lat_long.glsl"
#include "shared/scene_data.h"

#if LSF_BUNDLE_IMPORTANCE
layout(binding = LSF_UNIT_BUNDLE_PDF) uniform sampler2D bundle_pdf_texture;
#endif

float bundle_pdf(vec3 direction)
{
#if LSF_BUNDLE_IMPORTANCE
    ivec2 size = textureSize(bundle_pdf_texture, 0);
    ivec2 cell = min(ivec2(lat_long(direction) * vec2(size)), size - 1);
    return texelFetch(bundle_pdf_texture, cell, 0).r;
#else
    return 0.5 / LSF_PI;
#endif
}

#endif
