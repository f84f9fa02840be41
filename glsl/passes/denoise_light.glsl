/* Light as in light_filter, without tint, and the scale that makes it dimensionless. */
#ifndef LSF_PASSES_DENOISE_LIGHT
#define LSF_PASSES_DENOISE_LIGHT

#include "shared/brdf.h"
#include "shared/denoise_data.h"

/* A: variance, below 0: unknown. */
layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE];
layout(binding = 4) uniform sampler2D filtered_textures[1 + LSF_LOBE];

/* The unit of irradiance is pi times that of radiance. */
float part_unit(int part)
{
    return part == 0 ? LSF_PI : 1.0;
}

/* The scale from the sums over the picture: (mean of sqrt(Y))^2. 0: there is no light, or the sums overflow. */
float light_scale(vec4 sum)
{
    float mean = sum.y > 0.0 ? sum.x / sum.y : 0.0, scale = mean * mean;
    return scale < 1e30 && scale > 1e-30 ? scale : 0.0;
}

#endif
