/* Draws the scene's triangles into a VPL's map: those that cover a few texels here, the others are listed for
 * vpl_large.vert.glsl, because the pipeline's setup of a triangle costs more than so few texels. */
#define LSF_BINDING_TRIANGLES 3
#include "lib/hemisphere.glsl"
#include "lib/scene_triangles.glsl"

layout(local_size_x = 64) in;

layout(r32ui, binding = 0) coherent uniform uimage2D map_image;
layout(std430, binding = 1) writeonly buffer large_block
{
    uint large_triangles[]; /* 4 triangle + octant */
};
layout(std430, binding = 2) buffer command_block
{
    uint command[4]; /* of glDrawArraysIndirect; the first counts vertices */
};
layout(location = 0) uniform uint triangle_count;

#define FEW_TEXELS 16

/* Rounding error of a position on the map, relative to its side. A texel's centre this close outside an edge is
 * covered, so that no ray gets through between two triangles. */
#define POSITION_ERROR 2.4e-7

void list_large(uint triangle, uint octant)
{
    uint at = atomicAdd(command[0], 3u) / 3u;
    large_triangles[at] = 4u * triangle + octant;
}

float cross2(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* Draws the triangle where it covers texel centres, if it lies in this octant and is small enough. */
bool draw_small(vec2 octant, vec3 local[3])
{
    float texels = light.map_shape.z;
    vec2 corner[3];
    vec3 depth;
    for (int i = 0; i < 3; i++) {
        vec3 q = hemisphere_project(octant, local[i]);
        if (q.z < light.map_shape.x)
            return false;
        corner[i] = (q.xy / q.z * 0.5 + 0.5) * texels;
        depth[i] = light.map_shape.x / q.z;
    }
    float error = POSITION_ERROR * texels;
    vec2 low = min(corner[0], min(corner[1], corner[2])) - error;
    vec2 high = max(corner[0], max(corner[1], corner[2])) + error;
    ivec2 first = max(ivec2(ceil(low - 0.5)), ivec2(0));
    ivec2 size = min(ivec2(floor(high - 0.5)), ivec2(int(texels) - 1)) - first + 1;
    if (size.x <= 0 || size.y <= 0)
        return true;
    if (size.x > FEW_TEXELS || size.y > FEW_TEXELS || size.x * size.y > FEW_TEXELS)
        return false;
    vec2 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], e3 = corner[2] - corner[1];
    float area = cross2(e1, e2);
    if (area == 0.0)
        return true;
    float side = sign(area);
    vec3 tolerance = error * vec3(abs(e3.x) + abs(e3.y), abs(e2.x) + abs(e2.y),
                                  abs(e1.x) + abs(e1.y));
    vec2 d = vec2(depth[1] - depth[0], depth[2] - depth[0]);
    vec2 gradient = vec2(d.x * e2.y - d.y * e1.y, d.y * e1.x - d.x * e2.x) / area;
    int count = size.x * size.y;
    for (int i = 0; i < FEW_TEXELS; i++) {
        if (i >= count)
            break;
        ivec2 at = first + ivec2(i % size.x, i / size.x);
        if (hemisphere_octant_of_texel(at, int(texels)) != octant)
            continue;
        vec2 center = vec2(at) + 0.5;
        vec3 inside = side * vec3(cross2(e3, center - corner[1]), -cross2(e2, center - corner[0]),
                                  cross2(e1, center - corner[0]));
        if (any(lessThan(inside, -tolerance)))
            continue;
        /* The depth stays between those of the corners, however thin the triangle. */
        vec3 weights = max(inside, vec3(0.0));
        float sum = weights.x + weights.y + weights.z;
        float z = sum > 0.0 ? dot(weights, depth) / sum : depth[0];
        imageAtomicMax(map_image, at, hemisphere_pack(z, gradient / z * (0.5 * texels)));
    }
    return true;
}

void main()
{
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= triangle_count)
        return;
    vec3 local[3];
    float highest = 0.0, lowest = 1.0;
    uint x_sides = 0u, y_sides = 0u; /* 1: some corner is on the positive side, 2: on the negative */
    for (uint i = 0u; i < 3u; i++) {
        vec3 p = scene_triangle_corner(triangle, i) - light.map_origin.xyz;
        local[i] = hemisphere_local(p);
        vec2 octant = hemisphere_octant(local[i]);
        x_sides |= octant.x > 0.0 ? 1u : 2u;
        y_sides |= octant.y > 0.0 ? 1u : 2u;
        highest = max(highest, local[i].z);
        lowest = min(lowest, local[i].z);
    }
    if (highest <= 0.0)
        return;
    bool one_octant = x_sides != 3u && y_sides != 3u;
    vec2 octant = vec2(x_sides == 1u ? 1.0 : -1.0, y_sides == 1u ? 1.0 : -1.0);
    if (one_octant && lowest > 0.0 && draw_small(octant, local))
        return;
    for (uint i = 0u; i < 4u; i++)
        if ((x_sides & ((i & 1u) + 1u)) != 0u && (y_sides & ((i >> 1) + 1u)) != 0u)
            list_large(triangle, i);
}
