/* Directions towards sides of voxels that are drawn by their radiance (src/passes/voxel_draw.md), and their density.
 * The surface of a voxel is its plane over the face of the cell that the plane is steepest to; points on it are
 * drawn uniformly over that face. */
#ifndef LSF_LIB_VOXEL_DRAW
#define LSF_LIB_VOXEL_DRAW

#include "lib/luminance.glsl"
#include "lib/voxel_sight.glsl"
#include "shared/voxel_draw_data.h"

layout(std430, binding = LSF_BINDING_VOXEL_DRAWS) readonly buffer lsf_voxel_draw_list
{
    float voxel_draw_total, voxel_draw_unused[LSF_VOXEL_DRAWS_HEADER - 1];
    uvec2 voxel_draws[];
};

/* The plane of a voxel's surface, with a point of it [voxels]. */
struct voxel_surface_plane {
    vec3 normal, point;
};

voxel_surface_plane voxel_draw_plane(ivec3 cell)
{
    return voxel_surface_plane(voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r),
                               vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r));
}

/* 1 along the axis that is closest to the normal, else 0. */
vec3 voxel_draw_axis(vec3 n)
{
    vec3 size = abs(n);
    return size.x >= max(size.y, size.z) ? vec3(1.0, 0.0, 0.0)
                                         : size.y >= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
}

/* Density by which a draw finds the side of a voxel, of that radiance, along a direction from a point [1/sr]; 0 where
 * no point is drawn. */
float voxel_draw_density(vec3 from, vec3 direction, ivec3 cell, voxel_surface_plane p, vec3 radiance)
{
    float weight = luminance(radiance), rate = dot(p.normal, direction);
    float distance = dot(p.normal, p.point - from) / (rate != 0.0 ? rate : 1e-20);
    vec3 axis = voxel_draw_axis(p.normal);
    vec3 off = abs(from + distance * direction - (vec3(cell) + 0.5)) * (1.0 - axis);
    if (weight <= 0.0 || distance <= 0.0 || max(off.x, max(off.y, off.z)) > 0.5)
        return 0.0;
    return weight / voxel_draw_total * distance * distance * abs(dot(p.normal, axis)) / max(abs(rate), 1e-20);
}

/* A drawn side of a voxel: its slice, and a direction towards it. */
struct voxel_drawn {
    ivec3 cell;
    int slice;
    vec3 direction;
};

/* Takes the side at number.x of the list, and a point of it by number.y. False: it does not face the point from which
 * it is to be seen, or nothing shines. */
bool voxel_draw(vec2 number, vec3 from, out voxel_drawn drawn)
{
    uvec2 record = voxel_draws[min(uint(number.x * float(LSF_VOXEL_DRAWS)), LSF_VOXEL_DRAWS - 1u)];
    drawn.cell = voxel_brick_unpack(record.x);
    drawn.slice = int(record.x >> LSF_VOXEL_DRAW_SLICE_SHIFT);
    voxel_surface_plane p = voxel_draw_plane(drawn.cell);
    vec3 axis = voxel_draw_axis(p.normal);
    vec2 point = vec2(uintBitsToFloat(record.y), number.y);
    vec3 on_face = axis.x > 0.0 ? point.xxy : point.xyy;
    vec3 beside = (vec3(drawn.cell) + on_face - p.point) * (1.0 - axis);
    vec3 to = p.point + beside - axis * (dot(p.normal, beside) / dot(p.normal, axis)) - from;
    float distance = length(to), facing = dot(p.normal, to);
    drawn.direction = to / max(distance, 1e-20);
    return voxel_draw_total > 0.0 && facing != 0.0 && (LSF_VOXEL_SIDES == 1 || (facing > 0.0) == (drawn.slice == 1));
}

#endif
