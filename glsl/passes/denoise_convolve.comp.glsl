/* A convolution of 3 x 3 pixels, with zeros outside the maps. A work group computes 16 x 16 pixels and 8 features
 * of the target, an invocation four of the pixels. */
#include "passes/denoise_layer.glsl"

#define LSF_SIDE (LSF_DENOISE_TILE / 2)    /* invocations */
#define LSF_READ (LSF_DENOISE_TILE + 2)    /* pixels, with a border of one */
#define LSF_INVOCATIONS (LSF_SIDE * LSF_SIDE)

layout(local_size_x = LSF_SIDE, local_size_y = LSF_SIDE) in;

layout(std430, binding = LSF_BINDING_DENOISE_SOURCE + 1) readonly buffer lsf_denoise_beside_block
{
    uvec4 beside_maps[];
};

shared vec4 low[LSF_READ * LSF_READ], high[LSF_READ * LSF_READ];

/* The maximum of four pixels of the source. */
void pool(uint group, uvec2 at, out vec4 most_low, out vec4 most_high)
{
    uint width = 2u * size.x, index = (group * 2u * size.y + 2u * at.y) * width + 2u * at.x;
    uvec4 a = source_maps[index], b = source_maps[index + 1u];
    uvec4 c = source_maps[index + width], d = source_maps[index + width + 1u];
    most_low = max(max(low_of(a), low_of(b)), max(low_of(c), low_of(d)));
    most_high = max(max(high_of(a), high_of(b)), max(high_of(c), high_of(d)));
}

void read_tile(uint group)
{
    ivec2 origin = ivec2(gl_WorkGroupID.xy) * LSF_DENOISE_TILE - 1;
    for (uint i = gl_LocalInvocationIndex; i < LSF_READ * LSF_READ; i += LSF_INVOCATIONS) {
        ivec2 at = origin + ivec2(i % LSF_READ, i / LSF_READ);
        vec4 one = vec4(0.0), other = vec4(0.0);
        if (all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(size)))) {
            uvec2 from = uvec2(at);
            uint index = from.y * size.x + from.x, plane = size.x * size.y;
            if (pooled) {
                pool(group, from, one, other);
            } else {
                uvec4 texel =
                    group < groups.x ? source_maps[group * plane + index] : beside_maps[(group - groups.x) * plane + index];
                one = low_of(texel);
                other = high_of(texel);
            }
        }
        low[i] = one;
        high[i] = other;
    }
}

void main()
{
    uint target = gl_WorkGroupID.z;
    vec4 sums[4][2];
    for (int p = 0; p < 4; p++)
        for (int h = 0; h < 2; h++)
            sums[p][h] = weights[first_bias + LSF_ROW * target + uint(h)];
    for (uint group = 0u; group < groups.x + groups.y; group++) {
        barrier();
        read_tile(group);
        barrier();
        uint at = first_weight + (target * groups.z + group) * 9u * LSF_DENOISE_GROUP * LSF_ROW;
        for (uint tap = 0u; tap < 9u; tap++, at += LSF_DENOISE_GROUP * LSF_ROW) {
            uint index = (gl_LocalInvocationID.y + tap / 3u) * LSF_READ + gl_LocalInvocationID.x + tap % 3u;
            for (uint p = 0u; p < 4u; p++) {
                uint from = index + (p / 2u * LSF_READ + p % 2u) * LSF_SIDE;
                sums[p][0] += four_features(at, low[from], high[from]);
                sums[p][1] += four_features(at + 4u * LSF_ROW, low[from], high[from]);
            }
        }
    }
    for (uint p = 0u; p < 4u; p++) {
        uvec2 at = gl_WorkGroupID.xy * LSF_DENOISE_TILE + gl_LocalInvocationID.xy + uvec2(p % 2u, p / 2u) * LSF_SIDE;
        if (all(lessThan(at, size)))
            target_maps[(target * size.y + at.y) * size.x + at.x] = halves_of(sums[p][0], sums[p][1]);
    }
}
