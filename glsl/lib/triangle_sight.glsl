/* Whether a triangle of the scene lies between two points. All triangles are tested, which is slow and exact to
 * rounding; for measurements. The including shader declares the storage buffer LSF_BINDING_TRIANGLES. */
#ifndef LSF_LIB_TRIANGLE_SIGHT
#define LSF_LIB_TRIANGLE_SIGHT

#include "lib/scene_triangles.glsl"

/* T. Möller and B. Trumbore 1997, "Fast, Minimum Storage Ray-Triangle Intersection", without division: all values
 * are compared with the determinant. */
bool triangle_between(uint triangle, vec3 from, vec3 span)
{
    vec3 corner = scene_triangle_corner(triangle, 0u);
    vec3 e1 = scene_triangle_corner(triangle, 1u) - corner, e2 = scene_triangle_corner(triangle, 2u) - corner;
    vec3 p = cross(span, e2), s = from - corner, q = cross(s, e1);
    float determinant = dot(e1, p);
    /* Two barycentric weights, and the fraction of the segment. */
    vec3 hit = sign(determinant) * vec3(dot(s, p), dot(span, q), dot(e2, q));
    float size = abs(determinant);
    return min(hit.x, hit.y) >= 0.0 && hit.x + hit.y <= size && hit.z > 0.0 && hit.z < size;
}

bool triangles_between_8(uint first, uint last, vec3 from, vec3 span)
{
    return triangle_between(first, from, span) || triangle_between(min(first + 1u, last), from, span) ||
           triangle_between(min(first + 2u, last), from, span) || triangle_between(min(first + 3u, last), from, span) ||
           triangle_between(min(first + 4u, last), from, span) || triangle_between(min(first + 5u, last), from, span) ||
           triangle_between(min(first + 6u, last), from, span) || triangle_between(min(first + 7u, last), from, span);
}

/* Tests the first `count` triangles. Software GL ends all loops of a shader together after 65535 iterations, so
 * that each iteration tests 16 triangles. */
bool triangles_between(uint count, vec3 from, vec3 to)
{
    vec3 span = to - from;
    for (uint first = 0u; first < count; first += 16u) {
        uint last = count - 1u;
        if (triangles_between_8(first, last, from, span) || triangles_between_8(min(first + 8u, last), last, from, span))
            return true;
    }
    return false;
}

#endif
