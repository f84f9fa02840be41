/* What voxels reflect of the light that arrives at them from others and from beyond: a work group a
 * brick. A brick's voxels are mostly empty, so that those with a surface are listed first, a side
 * each; in which order the list comes does not matter. */
#include "lib/environment.glsl"
#include "lib/voxel_cone.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, rgba16f) uniform image3D radiance_image;
layout(binding = 1) uniform sampler3D base_texture;
#if !LSF_SEALED
layout(binding = LSF_UNIT_VOXEL_OCCUPANCY) uniform usampler3D occupancy_voxels;
#endif
layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D point_texture;
layout(std430, binding = LSF_BINDING_BRICKS) readonly buffer lsf_brick_block
{
    uint bricks[];
};
layout(location = 0) uniform bvec3 sum_of; /* what was there, the base, what is reflected */

/* The largest half float. */
#define RADIANCE_MAX 65504.0

shared uint side_count;
shared uint sides[2 * LSF_VOXEL_BRICK * LSF_VOXEL_BRICK * LSF_VOXEL_BRICK];

ivec3 cell_in_brick(uint i)
{
    return ivec3(uvec3(i, i >> 2, i >> 4) & 3u);
}

/* Voxels take the turns of a 4 x 4 x 4 pattern. */
float cell_turn(ivec3 cell)
{
    uvec3 c = uvec3(cell) & 3u;
    return float((c.x * 5u + c.y * 9u + c.z * 3u) & 15u) / 16.0;
}

/* The mean radiance that a side sees, weighted by the cosine. */
vec3 gather(vec3 place, vec3 n, float turn)
{
    vec3 tangent, bitangent;
    orthonormal_basis(n, tangent, bitangent);
    float angle = 2.0 * LSF_PI * (cone_gather.x + cone_gather.y * turn);
    vec3 across = cos(angle) * tangent + sin(angle) * bitangent;
    vec3 beside = cross(n, across);
    vec3 sum = vec3(0.0);
    int count = int(cone_gather.z);
    for (int i = 0; i < count; i++) {
        vec4 cone = cone_set[i];
        vec3 direction = cone.x * across + cone.y * beside + cone.z * n;
        cone_light light = cone_trace(place, n, direction, cone.w);
        sum += light.radiance;
#if LSF_ENVIRONMENT
        sum += light.transmittance * grid.unit.y * environment_radiance(direction);
#endif
    }
    return sum / cone_gather.z;
}

void write(ivec3 cell, int slice, float share, vec3 reflected)
{
    ivec3 texel = cell + ivec3(0, 0, slice * int(grid.size.z));
    vec3 sum = share * reflected;
    if (sum_of.x)
        sum += imageLoad(radiance_image, texel).rgb;
    if (sum_of.y)
        sum += texelFetch(base_texture, texel, 0).rgb;
    imageStore(radiance_image, texel, vec4(min(sum, RADIANCE_MAX), share));
}

void main()
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * uint(LSF_VOXEL_LIST_ROW);
    bool listed = at < bricks[LSF_VOXEL_LIST_HEADER - 1];
    uint self = gl_LocalInvocationIndex;
    ivec3 corner = ivec3(0);
    if (self == 0u)
        side_count = 0u;
    barrier();
    if (listed) {
        corner = voxel_brick_unpack(bricks[uint(LSF_VOXEL_LIST_HEADER) + at]) * LSF_VOXEL_BRICK;
        ivec3 cell = corner + cell_in_brick(self);
        if ((texelFetch(occupancy_voxels, occupancy_texel(cell), 0).r & occupancy_bit(cell)) != 0u) {
#if LSF_VOXEL_SIDES == 1
            sides[atomicAdd(side_count, 1u)] = self;
#else
            uint first = atomicAdd(side_count, 2u);
            sides[first] = self;
            sides[first + 1u] = self | 64u;
#endif
        }
    }
    barrier();
    uint count = side_count;
    for (uint i = self; i < count; i += 64u) {
        bool back = (sides[i] & 64u) != 0u;
        ivec3 cell = corner + cell_in_brick(sides[i] & 63u);
        vec3 n = voxel_normal_unpack(texelFetch(normal_texture, cell, 0).r);
        n = back ? -n : n;
        vec3 reflected = vec3(0.0);
        if (sum_of.z) {
            vec3 place = vec3(cell) + voxel_point_unpack(texelFetch(point_texture, cell, 0).r);
            vec3 albedo = voxel_albedo_unpack(texelFetch(albedo_texture, cell, 0).r);
            if (max(albedo.r, max(albedo.g, albedo.b)) > 0.0)
                reflected = albedo * gather(place, n, cell_turn(cell));
        }
#if LSF_VOXEL_SIDES == 1
        write(cell, 0, 1.0, reflected);
#else
        write(cell, n.x > 0.0 ? 1 : 0, n.x * n.x, reflected);
        write(cell, n.y > 0.0 ? 3 : 2, n.y * n.y, reflected);
        write(cell, n.z > 0.0 ? 5 : 4, n.z * n.z, reflected);
#endif
    }
}
