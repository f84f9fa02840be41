/* A transposed convolution of 2 x 2 pixels: each pixel of the source becomes four of the target, each by its own
 * weights. An invocation computes one pixel of the source and 8 features of the target. */
#include "passes/denoise_layer.glsl"

layout(local_size_x = LSF_DENOISE_TILE / 2, local_size_y = LSF_DENOISE_TILE / 2) in;

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    uint target = gl_WorkGroupID.z;
    if (any(greaterThanEqual(at, size)))
        return;
    vec4 sums[4][2];
    for (int p = 0; p < 4; p++)
        for (int h = 0; h < 2; h++)
            sums[p][h] = weights[first_bias + LSF_ROW * target + uint(h)];
    for (uint group = 0u; group < groups.x; group++) {
        uvec4 texel = source_maps[(group * size.y + at.y) * size.x + at.x];
        vec4 low = low_of(texel), high = high_of(texel);
        uint from = first_weight + (target * groups.z + group) * 4u * LSF_DENOISE_GROUP * LSF_ROW;
        for (uint p = 0u; p < 4u; p++, from += LSF_DENOISE_GROUP * LSF_ROW) {
            sums[p][0] += four_features(from, low, high);
            sums[p][1] += four_features(from + 4u * LSF_ROW, low, high);
        }
    }
    for (uint p = 0u; p < 4u; p++) {
        uvec2 to = 2u * at + uvec2(p % 2u, p / 2u);
        target_maps[(target * 2u * size.y + to.y) * 2u * size.x + to.x] = halves_of(sums[p][0], sums[p][1]);
    }
}
