/* One invocation a voxel of an occupied brick, and the texels of its sides. */
#include "lib/voxel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0, rgba16f) uniform image3D radiance_image;
layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_texture;
layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D point_texture;
#if LSF_EMISSION
layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D emission_texture;
#endif
layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};

/* The largest half float. */
#define RADIANCE_MAX 65504.0

/* False past the list's end. */
bool voxel_of_invocation(out ivec3 cell)
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * LSF_VOXEL_LIST_ROW;
    if (at >= bricks[3])
        return false;
    cell = voxel_brick_unpack(bricks[LSF_VOXEL_LIST_HEADER + at]) * LSF_VOXEL_BRICK +
           ivec3(gl_LocalInvocationID);
    return true;
}

bool voxel_occupied(ivec3 cell)
{
    return (texelFetch(occupancy_texture, occupancy_texel(cell), 0).r & occupancy_bit(cell)) != 0u;
}

ivec3 slice_texel(ivec3 cell, int slice)
{
    return cell + ivec3(0, 0, slice * int(grid.size.z));
}

/* The slice that holds a side's lobe along an axis; `facing`: that component of the side's normal. */
int lobe_slice(int axis, float facing)
{
    return 2 * axis + (facing > 0.0 ? 1 : 0);
}
