/* Rays between surfaces in the grid. They start and end as far above a surface as its voxels reach (voxel_lift),
 * so that occupied voxels at the start belong to other surfaces, which meet it in a corner or pass close by. */
#ifndef LSF_LIB_VOXEL_SIGHT
#define LSF_LIB_VOXEL_SIGHT

#include "lib/voxel_trace.glsl"

layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D voxel_point;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D voxel_normal;

/* Height above the plane of a voxel that touches a plane with the unit normal n: at most |n_x| + |n_y| + |n_z|. */
vec3 voxel_lift(vec3 n)
{
    return (abs(n.x) + abs(n.y) + abs(n.z)) * n;
}

/* Height of the ray's origin above the surface in the cell, and the rate at which the ray rises above it. */
vec2 voxel_height(ivec3 cell, voxel_ray ray)
{
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    return vec2(dot(n, ray.origin - q), dot(n, ray.direction));
}

/* Whether a ray passes only voxels of surfaces that face like the unit normal n or against it, and form no edge, up to
 * the distance `end`. */
bool voxel_leaves_alone(voxel_ray ray, vec3 n, float end)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && ray.distance < end && voxel_inside(ray.cell); i++) {
        if (voxel_occupied(ray.cell)) {
            uint bits = texelFetch(voxel_normal, ray.cell, 0).r;
            if (abs(dot(voxel_normal_unpack(bits), n)) < VOXEL_EDGE || voxel_edge(bits) != VOXEL_EDGE_NONE)
                return false;
        }
        voxel_ray_step(ray, ray.cell, ivec3(1));
    }
    return true;
}

/* The part of a ray on which it rises as far as the voxels of a surface with the unit normal n reach, or which is
 * twice as long as that is high. */
vec3 voxel_rise(vec3 n, vec3 direction)
{
    return length(voxel_lift(n)) * min(1.0 / max(dot(n, direction), 1e-6), 2.0) * direction;
}

/* The end of this part. Flat rays are lifted by what is missing. */
vec3 voxel_start_along(vec3 point, vec3 n, vec3 direction)
{
    vec3 rise = voxel_rise(n, direction);
    return point + rise + voxel_lift(n) - dot(n, rise) * n;
}

/* Whether a ray from a point of a surface with the unit normal n passes no other surface before it is as far above this
 * one as its voxels reach. If not, voxels may miss what it meets there. */
bool voxel_starts_alone(vec3 point, vec3 n, vec3 direction)
{
    voxel_ray ray;
    return voxel_ray_begin(point, direction, ray) &&
           voxel_leaves_alone(ray, n, length(voxel_rise(n, direction)) + 1.0);
}

/* The start of a ray from a point of a surface with the unit normal n, as far above it as its voxels reach. It lies
 * on the ray, because straight above the point the light is that of another place; but straight above it where the
 * ray may pass other surfaces on the way. */
vec3 voxel_start(vec3 point, vec3 n, vec3 direction)
{
    return voxel_starts_alone(point, n, direction) ? voxel_start_along(point, n, direction) : point + voxel_lift(n);
}

/* Moves the ray out of the voxels in which it starts, except one whose surface lies ahead. False: it leaves the
 * grid. */
bool voxel_leave_start(inout voxel_ray ray)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_occupied(ray.cell); i++) {
        vec2 height = voxel_height(ray.cell, ray);
        if (height.x * height.y < 0.0)
            return true;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return false;
    }
    return true;
}

/* The same for a ray that starts on the surface of the medium through which it runs: it leaves the voxels in which
 * it starts, except one through which it exits the medium ahead, whose normal points along it. */
bool voxel_leave_inside(inout voxel_ray ray)
{
    int steps = voxel_ray_steps();
    for (int i = 0; i < steps && voxel_occupied(ray.cell); i++) {
        vec2 height = voxel_height(ray.cell, ray);
        if (height.y > 0.0 && height.x < 0.0)
            return true;
        voxel_ray_step(ray, ray.cell, ivec3(1));
        if (!voxel_inside(ray.cell))
            return false;
    }
    return true;
}

/* The surface of a voxel as a ray meets it: its plane's unit normal, a point of it [voxels], the texel of
 * voxelize.normal, and the height of the ray's origin above the plane with the rate at which the ray rises. */
struct voxel_plane {
    vec3 normal, point;
    uint bits;
    vec2 height;
};

voxel_plane voxel_plane_of(ivec3 cell, voxel_ray ray)
{
    voxel_plane p;
    p.bits = texelFetch(voxel_normal, cell, 0).r;
    p.normal = voxel_normal_unpack(p.bits);
    p.point = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    p.height = vec2(dot(p.normal, ray.origin - p.point), dot(p.normal, ray.direction));
    return p;
}

/* Height of the ray above the plane. */
float voxel_height_at(voxel_plane p, float distance)
{
    return p.height.x + distance * p.height.y;
}

/* Distance between two others at which the ray crosses the plane, or touches it; VOXEL_FAR: it does not. */
float voxel_crossing(voxel_plane p, float first, float last)
{
    float before = voxel_height_at(p, first), after = voxel_height_at(p, last);
    if (min(abs(before), abs(after)) >= VOXEL_PLANE && before * after >= 0.0)
        return VOXEL_FAR;
    return p.height.y == 0.0 ? first : clamp(-p.height.x / p.height.y, first, last);
}

/* On which side of the other plane the surface of a voxel in an edge lies: 1 in front, -1 behind, 0 on both. */
float voxel_edge_side(uint bits)
{
    uint edge = voxel_edge(bits);
    return edge == VOXEL_EDGE_FRONT ? 1.0 : edge == VOXEL_EDGE_BACK ? -1.0 : 0.0;
}

/* The voxel beside the cell in a direction, if its point lies in the plane p; else the cell. */
ivec3 voxel_beside_in_plane(ivec3 cell, voxel_plane p, vec3 direction)
{
    vec3 size = abs(direction);
    float largest = max(size.x, max(size.y, size.z));
    ivec3 axis = size.x == largest ? ivec3(1, 0, 0) : size.y == largest ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
    ivec3 there = cell + axis * ivec3(sign(direction));
    if (!voxel_inside(there) || !voxel_occupied(there))
        return cell;
    vec3 q = vec3(there) + voxel_point_unpack(texelFetch(voxel_point, there, 0).r);
    return abs(dot(p.normal, q - p.point)) < VOXEL_PLANE ? there : cell;
}

/* Advances to the first surface that the ray crosses before `end`, in the voxel `met`; the ray is then beyond it.
 * False: there is none.
 *
 * Where surfaces meet or bend, only one of them is stored in a voxel, so that those of its six neighbours count, too.
 * Two that form an edge end at each other's planes: a crossing counts on that side of the other plane on which the
 * surface lies. Others count where they are known to be on the ray's side of the voxel's own plane. `corners`: an
 * edge of which the ray is within the angle, such as those of a room seen from within, is closed whatever the ray
 * crosses: where three surfaces meet, none of the seven voxels may store the third. */
bool voxel_ray_meet(inout voxel_ray ray, float end, bool corners, out ivec3 met)
{
    int steps = voxel_ray_steps();
    bool found = false;
    voxel_plane own;
    vec3 across = vec3(0.0); /* to the part of the own surface that is crossed, where an edge is between */
    for (int i = 0; i < steps && !found; i++) {
        if (!voxel_inside(ray.cell) || !voxel_ray_trace(ray, end))
            return false;
        ivec3 cell = ray.cell;
        float entry = ray.distance;
        voxel_ray_step(ray, cell, ivec3(1));
        float leave = min(ray.distance, end);
        own = voxel_plane_of(cell, ray);
        float own_at = voxel_crossing(own, entry, leave), ahead = voxel_height_at(own, entry);
        float own_side = voxel_edge_side(own.bits);
        float first = VOXEL_FAR; /* at which a neighbour's surface is crossed */
        bool closed = false;     /* the ray is within the angle of an edge */
        across = vec3(0.0);
        met = cell;
        uint beside = (own.bits >> VOXEL_BESIDE_SHIFT) & VOXEL_BESIDE_ANY;
        if (own_at < VOXEL_FAR && voxel_edge(own.bits) == VOXEL_EDGE_NONE)
            beside = 0u;
        for (; beside != 0u; beside &= beside - 1u) {
            ivec3 there = voxel_beside(cell, findLSB(beside));
            voxel_plane other = voxel_plane_of(there, ray);
            float at = voxel_crossing(other, entry, leave), apart = dot(own.normal, other.point - own.point);
            /* On which side of the own plane the neighbour's surface lies. */
            float side = abs(apart) > 2.0 * VOXEL_PLANE ? sign(apart) : 0.0;
            bool edge = abs(dot(own.normal, other.normal)) < VOXEL_EDGE;
            if (edge && side == 0.0)
                side = voxel_edge_side(other.bits);
            bool counts =
                at < first && side * (edge ? voxel_height_at(own, at) : ahead) >= -VOXEL_PLANE;
            if (edge) {
                float before = voxel_height_at(other, entry), hit = voxel_height_at(other, own_at);
                bool behind = dot(other.normal, own.point - other.point) < -VOXEL_PLANE;
                if (own_at < VOXEL_FAR && own_side == 0.0 && abs(hit) > VOXEL_PLANE && behind != (hit < 0.0))
                    across = sign(hit) * other.normal;
                if (own_side * hit < -VOXEL_PLANE)
                    own_at = VOXEL_FAR;
                if (corners && !counts && side * ahead > -VOXEL_PLANE && own_side * before > -VOXEL_PLANE) {
                    closed = true;
                    /* Of surfaces that are not crossed, one that the ray approaches is seen from its side. */
                    if (first == VOXEL_FAR && ahead * own.height.y >= 0.0 && before * other.height.y < 0.0)
                        met = there;
                }
            }
            if (counts) {
                first = at;
                met = there;
            }
        }
        found = closed || min(own_at, first) < VOXEL_FAR;
        bool own_first = own_at < VOXEL_FAR && own_at <= first;
        if (own_first || (first == VOXEL_FAR && ahead * own.height.y < 0.0))
            met = cell;
        if (!own_first)
            across = vec3(0.0);
    }
    if (found && across != vec3(0.0))
        met = voxel_beside_in_plane(met, own, across);
    return found;
}

/* The lift of a point of a surface with the unit normal n, towards one of another surface. Where two face each other, both
 * lifts together are at most as high as what is between, or the ends would have passed each other. */
vec3 voxel_lift_towards(vec3 point, vec3 n, vec3 other, vec3 other_n)
{
    vec3 lift = voxel_lift(n);
    float height = dot(n, other - point), facing = max(-dot(n, other_n), 0.0);
    float most = height > 0.0 ? min(height / (length(lift) + length(voxel_lift(other_n))), 1.0) : 1.0;
    return mix(1.0, most, facing) * lift;
}

/* Whether one surface point sees another [voxels]; with their unit normals. True where the lifted ends have passed
 * each other: the grid does not resolve what is between. */
bool voxel_sees(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal)
{
    vec3 start = from + voxel_lift_towards(from, from_normal, to, to_normal);
    vec3 span = to + voxel_lift_towards(to, to_normal, from, from_normal) - start;
    float end = length(span);
    voxel_ray ray;
    if (dot(span, to - from) <= 0.0 || !voxel_ray_begin(start, span / end, ray))
        return true;
    ivec3 met;
    return !voxel_ray_meet(ray, end, false, met);
}

#endif
