/* LSF_SAMPLER_SLOTS samplers, all of them in use. */
layout(binding = 0) uniform sampler2D slots[LSF_SAMPLER_SLOTS];

ivec2 slots_sum()
{
    ivec2 sum = ivec2(0);
    for (int i = 0; i < slots.length(); i++)
        sum += textureSize(slots[i], 0);
    return sum;
}
