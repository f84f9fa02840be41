/* Restores the total brightness of the picture's light, for each channel of each part separately. */
#include "shared/denoise_data.h"

layout(local_size_x = LSF_DENOISE_TILE, local_size_y = LSF_DENOISE_TILE) in;

layout(binding = 0, rgba32f) uniform image2D light_images[1 + LSF_LOBE];
layout(std430, binding = LSF_BINDING_DENOISE_TOTAL) readonly buffer lsf_denoise_total_block
{
    vec4 totals[];
};

/* The factor is clamped to 1/2..2: beyond that, a few pixels that are far too bright hold more light than all
 * others. */
float gain(float before, float after)
{
    return before > 0.0 && after > 0.0 ? clamp(before / after, 0.5, 2.0) : 1.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(light_images[0]))))
        return;
    for (int part = 0; part <= LSF_LOBE; part++) {
        uint first = LSF_DENOISE_SUM_GAIN * LSF_DENOISE_SUMS + 2u * uint(part);
        vec4 before = totals[first], after = totals[first + 1u], light = imageLoad(light_images[part], pixel);
        light.rgb *= vec3(gain(before.r, after.r), gain(before.g, after.g), gain(before.b, after.b));
        imageStore(light_images[part], pixel, light);
    }
}
