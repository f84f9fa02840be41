/* The light that the light in turn adds to pixels all over the picture, one in each cell of a grid. A pixel counts
 * no more than LIMIT pixels of mean light do: a highlight says little about light that bounces. One work group. */
#include "lib/luminance.glsl"

#define OWN (LSF_LIGHT_IMPORTANCE_SIDE * LSF_LIGHT_IMPORTANCE_SIDE / LSF_LIGHT_IMPORTANCE_GROUP)
#define LIMIT 16.0

layout(local_size_x = LSF_LIGHT_IMPORTANCE_GROUP) in;

layout(binding = 0) uniform sampler2D radiance_texture;
layout(location = 0) uniform uint light;

layout(std430, binding = 0) buffer before_block
{
    float before[];
};
layout(std430, binding = 1) writeonly buffer sum_block
{
    float sums[];
};

shared float partial_sums[LSF_LIGHT_IMPORTANCE_GROUP];

/* Over the group, in the same order each time. */
float sum_of_group(float value)
{
    uint own = gl_LocalInvocationIndex;
    partial_sums[own] = value;
    barrier();
    for (uint half_count = LSF_LIGHT_IMPORTANCE_GROUP / 2u; half_count > 0u; half_count /= 2u) {
        if (own < half_count)
            partial_sums[own] += partial_sums[own + half_count];
        barrier();
    }
    float sum = partial_sums[0];
    barrier();
    return sum;
}

/* Light added to a pixel since the last call. */
float added(uint i)
{
    const float side = float(LSF_LIGHT_IMPORTANCE_SIDE);
    vec2 cell = vec2(i % LSF_LIGHT_IMPORTANCE_SIDE, i / LSF_LIGHT_IMPORTANCE_SIDE);
    ivec2 pixel = ivec2((cell + 0.5) / side * vec2(textureSize(radiance_texture, 0)));
    float now = luminance(texelFetch(radiance_texture, pixel, 0).rgb);
    float light_added = light == 0u ? now : max(now - before[i], 0.0);
    before[i] = now;
    return light_added;
}

void main()
{
    float values[OWN];
    float sum = 0.0;
    for (uint i = 0u; i < OWN; i++) {
        values[i] = added(i * LSF_LIGHT_IMPORTANCE_GROUP + gl_LocalInvocationIndex);
        sum += values[i];
    }
    float most = LIMIT * sum_of_group(sum) / float(OWN * LSF_LIGHT_IMPORTANCE_GROUP);
    sum = 0.0;
    for (uint i = 0u; i < OWN; i++)
        sum += min(values[i], most);
    sum = sum_of_group(sum);
    if (gl_LocalInvocationIndex == 0u)
        sums[light] = sum;
}
