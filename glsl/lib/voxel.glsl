/* The voxel grid, the contents of its textures, and the functions that pack and unpack them.
 *
 * voxelize.albedo R32UI    square roots of R and G in 11 bits each, of B in 10
 * voxelize.normal R32UI    unit normal of the triangle's plane, octahedral, 2 x 12 bits | bits about the
 *                          neighbours, VOXEL_BESIDE and VOXEL_EDGE, << 24
 * voxelize.shading R32UI   the shading normal, likewise | rotation of the tangent about the plane's normal << 24
 * voxelize.point R32UI     a point of the surface in the voxel, 3 x 10 bits | emits on both sides << 30 |
 *                          unlit << 31
 * voxelize.emission R32UI  mantissas of 9, 9 and 8 bits with one 5-bit exponent, in units of the grid's radiance; at the
 *                          border of an emitting surface << 18
 * voxelize.specular_params R32UI     roughness along tangent and bitangent, (n - 1) / (n + 1) of the refractive
 *                          index n, metallic; 8 bits each
 * voxelize.transmission R32UI  as specular_params.z of lib/gbuffer.glsl, seen from the front
 * voxelize.shining R32UI   a bit for each brick that holds emitting voxels, laid out as occupancy */
#ifndef LSF_LIB_VOXEL
#define LSF_LIB_VOXEL

#include "lib/octahedral.glsl"
#include "shared/scene_data.h"
#include "shared/voxel_data.h"

layout(std140, binding = LSF_BINDING_VOXEL) uniform lsf_voxel_block
{
    lsf_voxel_grid_data grid;
};

/* From normalised space to voxel coordinates: cell i spans [i, i + 1]. */
vec3 voxel_from_position(vec3 position)
{
    return (position - grid.origin.xyz) * grid.size.w;
}

vec3 voxel_to_position(vec3 voxel)
{
    return grid.origin.xyz + voxel * grid.origin.w;
}

bool voxel_inside(ivec3 cell)
{
    return all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(grid.size.xyz)));
}

/* Texel of the cell's level of occupancy that holds the bit of the cell. */
ivec3 occupancy_texel(ivec3 cell)
{
    ivec3 brick = cell >> 2;
    return ivec3(2 * brick.x + ((cell.z >> 1) & 1), brick.yz);
}

uint occupancy_bit(ivec3 cell)
{
    return 1u << uint((cell.x & 3) | ((cell.y & 3) << 2) | ((cell.z & 1) << 4));
}

uint voxel_brick_pack(ivec3 brick)
{
    return uint(brick.x | (brick.y << 10) | (brick.z << 20));
}

ivec3 voxel_brick_unpack(uint bits)
{
    return ivec3(uvec3(bits, bits >> 10, bits >> 20) & 1023u);
}

/* Error of a voxel's plane [voxels]: points are stored to 2^-11 and normals to about 2^-11 in direction, over at
 * most three voxels. */
#define VOXEL_PLANE (1.0 / 256.0)

/* Surfaces in neighbouring voxels form an edge when the cosine between their normals is below this. */
#define VOXEL_EDGE 0.7

/* Bits about the six neighbours of a voxel, along -x, x, -y, y, -z and z: one for each whose surface is not in the
 * voxel's plane, but whose plane passes through the voxel. Above them VOXEL_EDGE_.., whether some of these form an
 * edge with it, and on which side of their planes the voxel's own surface lies: in front, behind, or on both (also
 * where it differs between them, or is not known). */
#define VOXEL_NORMAL_BITS 0xffffffu
#define VOXEL_BESIDE_SHIFT 24u
#define VOXEL_BESIDE_ANY 63u
#define VOXEL_EDGE_SHIFT 30u
#define VOXEL_EDGE_NONE 0u
#define VOXEL_EDGE_BOTH 1u
#define VOXEL_EDGE_FRONT 2u
#define VOXEL_EDGE_BACK 3u

/* VOXEL_EDGE_.. of a texel of voxelize.normal. */
uint voxel_edge(uint bits)
{
    return bits >> VOXEL_EDGE_SHIFT;
}

ivec3 voxel_beside(ivec3 cell, int side)
{
    cell[side >> 1] += 2 * (side & 1) - 1;
    return cell;
}

uint voxel_albedo_pack(vec3 albedo)
{
    uvec3 q = uvec3(sqrt(clamp(albedo, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
    return q.r | (q.g << 11) | (q.b << 22);
}

vec3 voxel_albedo_unpack(uint bits)
{
    vec3 root = vec3(uvec3(bits & 2047u, (bits >> 11) & 2047u, bits >> 22)) /
                vec3(2047.0, 2047.0, 1023.0);
    return root * root;
}

uint voxel_normal_pack(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        p = (1.0 - abs(p.yx)) * octahedral_sign(p);
    uvec2 q = uvec2(clamp(p * 2047.0 + 2047.5, 0.0, 4094.0));
    return q.x | (q.y << 12);
}

vec3 voxel_normal_unpack(uint bits)
{
    vec2 p = vec2(uvec2(bits & 4095u, (bits >> 12) & 4095u)) / 2047.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * octahedral_sign(n.xy);
    return normalize(n);
}

/* Rotation of the tangent in the orthonormal_basis of the plane's normal, 0..1 of a full turn. */
uint voxel_rotation_pack(float rotation)
{
    return uint(fract(rotation) * 256.0) << 24;
}

float voxel_rotation_unpack(uint bits)
{
    return (float(bits >> 24) + 0.5) / 256.0;
}

/* `inside`: offset from the voxel's lower corner, 0..1. */
uint voxel_point_pack(vec3 inside, bool emits_both, bool unlit)
{
    uvec3 q = uvec3(clamp(inside, 0.0, 1.0) * 1023.0 + 0.5);
    return q.x | (q.y << 10) | (q.z << 20) | (emits_both ? 1u << 30 : 0u) | (unlit ? 1u << 31 : 0u);
}

vec3 voxel_point_unpack(uint bits)
{
    return vec3(uvec3(bits, bits >> 10, bits >> 20) & 1023u) / 1023.0;
}

bool voxel_emits_both(uint bits)
{
    return (bits & (1u << 30)) != 0u;
}

bool voxel_unlit(uint bits)
{
    return (bits & (1u << 31)) != 0u;
}

float voxel_transmission(uint bits)
{
    return float(bits & 255u) / 255.0;
}

/* Bit of a texel of voxelize.emission: the voxel is at the border of an emitting surface. */
#define VOXEL_EMISSION_BORDER (1u << 18)

/* Shared exponent as in GL_RGB9_E5 (OpenGL 4.5, section 8.5.2), a format that images cannot have; the lowest bit of blue
 * is left free, for the border. */
uint voxel_emission_pack(vec3 emission)
{
    vec3 c = clamp(emission, 0.0, 65408.0);
    float largest = max(c.r, max(c.g, c.b));
    int exponent = largest > 0.0 ? max(-16, int(floor(log2(largest)))) + 16 : 0;
    if (largest * exp2(float(24 - exponent)) + 0.5 >= 512.0)
        exponent++;
    uvec2 mantissa = uvec2(c.rg * exp2(float(24 - exponent)) + 0.5);
    uint blue = min(uint(c.b * exp2(float(23 - exponent)) + 0.5), 255u);
    return mantissa.r | (mantissa.g << 9) | (blue << 19) | (uint(exponent) << 27);
}

vec3 voxel_emission_unpack(uint bits)
{
    vec3 mantissa = vec3(uvec3(bits, bits >> 9, bits >> 18) & uvec3(511u, 511u, 510u));
    return mantissa * exp2(float(int(bits >> 27)) - 24.0);
}

#endif
