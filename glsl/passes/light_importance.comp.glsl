/* Sums the light that the light in turn adds to pixels all over the picture, one in each cell of a grid, in the same
 * order each time. One work group. */
#include "lib/luminance.glsl"

#define PIXELS (LSF_LIGHT_IMPORTANCE_SIDE * LSF_LIGHT_IMPORTANCE_SIDE)

layout(local_size_x = LSF_LIGHT_IMPORTANCE_SIDE, local_size_y = LSF_LIGHT_IMPORTANCE_SIDE) in;

layout(binding = 0) uniform sampler2D radiance_texture;
layout(location = 0) uniform uint light;

layout(std430, binding = 1) buffer before_block
{
    float before[];
};
layout(std430, binding = 2) writeonly buffer sum_block
{
    float sums[];
};

shared float partial_sums[PIXELS];

/* Light added to the invocation's pixel since the last call. */
float added()
{
    vec2 place = (vec2(gl_LocalInvocationID.xy) + 0.5) / float(LSF_LIGHT_IMPORTANCE_SIDE);
    ivec2 pixel = ivec2(place * vec2(textureSize(radiance_texture, 0)));
    float now = luminance(texelFetch(radiance_texture, pixel, 0).rgb);
    float light_added = light == 0u ? now : max(now - before[gl_LocalInvocationIndex], 0.0);
    before[gl_LocalInvocationIndex] = now;
    return light_added;
}

void main()
{
    uint own = gl_LocalInvocationIndex;
    partial_sums[own] = added();
    barrier();
    for (uint half_count = PIXELS / 2u; half_count > 0u; half_count /= 2u) {
        if (own < half_count)
            partial_sums[own] += partial_sums[own + half_count];
        barrier();
    }
    if (own == 0u)
        sums[light] = partial_sums[0];
}
