/* Sums of the square roots of the filtered light's luminance, over the pixels where it is known. With square
 * roots, a few bright pixels do not make all others dark. */
#include "lib/luminance.glsl"
#include "passes/denoise_light.glsl"
#include "passes/denoise_sums.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = all(lessThan(pixel, textureSize(filtered_textures[0], 0))), tells = false;
    float light = 0.0;
    for (int part = 0; inside && part <= LSF_LOBE; part++) {
        vec4 filtered = texelFetch(filtered_textures[part], pixel, 0);
        if (filtered.a < 0.0)
            continue;
        light += max(luminance(filtered.rgb), 0.0) / part_unit(part);
        tells = true;
    }
    sum_add(0u, tells ? vec4(sqrt(light), 1.0, 0.0, 0.0) : vec4(0.0));
}
