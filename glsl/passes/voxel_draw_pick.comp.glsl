/* Draws sides of voxels by their luminance, one from each of as many equal parts of the sum over all. */
#include "lib/hash.glsl"
#include "lib/voxel_brick.glsl"
#include "passes/voxel_draw_list.glsl"

layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_texture;
layout(location = 0) uniform uint seed; /* of the iteration */

/* The last brick that begins at `place` in the sum or before it. */
uint brick_at(float place)
{
    uint first = 0u, end = 1u << (3 * LSF_VOXEL_DRAW_BITS);
    while (end - first > 1u) {
        uint middle = (first + end) / 2u;
        bool before = brick_sums[middle] <= place;
        first = before ? middle : first;
        end = before ? end : middle;
    }
    return first;
}

void main()
{
    uint draw = gl_GlobalInvocationID.x;
    float u = hash_unit(hash(uvec3(draw, seed, 0u))).x;
    float place = (float(draw) + u) * (voxel_draw_total / float(LSF_VOXEL_DRAWS));
    uint index = brick_at(place);
    ivec3 cell = brick_of(index);
    ivec3 texel = occupancy_texel(cell * LSF_VOXEL_BRICK);
    lsf_voxel_brick_data brick = lsf_voxel_brick_data(voxel_brick_pack(cell), texelFetch(occupancy_texture, texel, 0).r,
                                                      texelFetch(occupancy_texture, texel + ivec3(1, 0, 0), 0).r, 0u);
    /* Where rounding makes the sides' sum fall short of the place, the last that shines is drawn. */
    float left = place - brick_sums[index], part = 0.0;
    uint drawn = 0u;
    int count = LSF_VOXEL_SIDES * voxel_brick_voxels(brick);
    for (int n = 0; n < count && left >= 0.0; n++) {
        ivec3 voxel = voxel_brick_cell(brick, n / LSF_VOXEL_SIDES);
        int slice = n % LSF_VOXEL_SIDES;
        float weight = side_weight(voxel, slice);
        if (weight > 0.0) {
            drawn = voxel_brick_pack(voxel) | (uint(slice) << LSF_VOXEL_DRAW_SLICE_SHIFT);
            part = min(left / weight, 1.0);
        }
        left -= weight;
    }
    voxel_draws[draw] = uvec2(drawn, floatBitsToUint(part));
}
