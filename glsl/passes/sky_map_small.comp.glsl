/* Draws triangles that cover few texels into a map of the environment, one per invocation, because the pipeline's
 * setup of a triangle costs more than so few texels. */
#define LSF_BINDING_TRIANGLES 3
#include "lib/scene_triangles.glsl"
#include "lib/sky_map.glsl"

layout(local_size_x = 64) in;

layout(location = 1) uniform uvec2 range; /* first triangle, and the end of the range */
layout(r32ui, binding = 0) uniform uimage2DArray map_image;
layout(location = 0) uniform int map;

/* Rounding error of a position, in normalised space. A texel's centre this close outside an edge is covered, so
 * that no light leaks between two triangles. */
#define POSITION_ERROR 2.4e-7

/* Functions that are affine over the map: value at the centre of texel `first`, and change from texel to texel. */
struct map_triangle {
    ivec2 first, end;         /* texels whose centres its bounding box holds */
    vec3 edges, edges_x, edges_y; /* distances inwards from the edges, times the edges' lengths */
    float depth;
    vec2 gradient;
    vec2 depths; /* least and greatest of its corners, because the gradient of slivers is unreliable */
    uint slopes; /* of keys */
};

float cross2(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* False when it covers no texel. */
bool triangle_on_map(uint triangle, out map_triangle t)
{
    vec3 q0 = sky_map_project(map, scene_triangle_corner(triangle, 0u));
    vec3 q1 = sky_map_project(map, scene_triangle_corner(triangle, 1u));
    vec3 q2 = sky_map_project(map, scene_triangle_corner(triangle, 2u));
    vec4 texel = sky_maps[map].texel;
    float error = POSITION_ERROR / min(texel.x, texel.y);
    /* The values are clamped before they become integers, because corners may be far outside. */
    t.first = ivec2(clamp(ceil(min(q0.xy, min(q1.xy, q2.xy)) - error - 0.5), 0.0, texel.w));
    t.end = ivec2(clamp(floor(max(q0.xy, max(q1.xy, q2.xy)) + error + 0.5), 0.0, texel.w));
    vec2 e1 = q1.xy - q0.xy, e2 = q2.xy - q0.xy, e3 = q2.xy - q1.xy;
    float area = cross2(e1, e2);
    if (area == 0.0 || t.end.x <= t.first.x || t.end.y <= t.first.y)
        return false;
    vec2 start = vec2(t.first) + 0.5;
    vec3 tolerance = error * vec3(abs(e3.x) + abs(e3.y), abs(e2.x) + abs(e2.y), abs(e1.x) + abs(e1.y));
    float side = sign(area);
    t.edges = side * vec3(cross2(e3, start - q1.xy), -cross2(e2, start - q0.xy),
                          cross2(e1, start - q0.xy)) + tolerance;
    t.edges_x = side * vec3(-e3.y, e2.y, -e1.y);
    t.edges_y = side * vec3(e3.x, -e2.x, e1.x);
    vec2 d = vec2(q1.z, q2.z) - q0.z;
    t.gradient = vec2(d.x * e2.y - d.y * e1.y, d.y * e1.x - d.x * e2.x) / area;
    t.depth = q0.z + dot(t.gradient, start - q0.xy);
    t.depths = vec2(min(q0.z, min(q1.z, q2.z)), max(q0.z, max(q1.z, q2.z)));
    t.slopes = sky_map_slopes(map, t.gradient);
    return true;
}

bool covers(map_triangle t, ivec2 at)
{
    vec2 apart = vec2(at - t.first);
    vec3 edges = t.edges + apart.x * t.edges_x + apart.y * t.edges_y;
    return min(edges.x, min(edges.y, edges.z)) >= 0.0;
}

void draw_texel(map_triangle t, ivec2 at)
{
    vec2 apart = vec2(at - t.first);
    float depth = clamp(t.depth + dot(t.gradient, apart), t.depths.x, t.depths.y);
    imageAtomicMax(map_image, ivec3(at, map), sky_map_key(depth, t.slopes));
}

void main()
{
    uint triangle = range.x + gl_GlobalInvocationID.x;
    map_triangle t;
    if (triangle >= range.y || !triangle_on_map(triangle, t))
        return;
    ivec2 at = t.first;
    while (at.y < t.end.y) {
        /* Advances to the next covered texel, because the expensive part below should run in all lanes that have
         * one at once. */
        bool covered = false;
        ivec2 found = at;
        while (!covered && at.y < t.end.y) {
            covered = covers(t, at);
            found = at;
            at.x++;
            if (at.x == t.end.x)
                at = ivec2(t.first.x, at.y + 1);
        }
        if (covered)
            draw_texel(t, found);
    }
}
