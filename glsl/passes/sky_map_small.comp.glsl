/* Draws triangles that cover few texels into a batch of maps of the environment, one per invocation, because the
 * pipeline's setup of a triangle costs more than so few texels. */
#define LSF_BINDING_TRIANGLES 3
#include "lib/scene_triangles.glsl"
#include "lib/sky_map.glsl"

layout(local_size_x = 64) in;

layout(location = 0) uniform int map_count;
layout(location = 1) uniform uvec2 range; /* first triangle, and the end of the range */
layout(location = 2) uniform uint firsts[LSF_SKY_MAPS_MAX]; /* first triangle for each map */
layout(r32ui, binding = 0) coherent uniform uimage2DArray map_image;

/* Rounding error of a position, in normalised space. A texel's centre this close outside an edge is covered, so
 * that no light leaks between two triangles. */
#define POSITION_ERROR 2.4e-7

/* Functions that are affine over the map: value at the centre of texel `first`, and change from texel to texel. */
struct map_triangle {
    ivec2 first, size;            /* texels whose centres its bounding box holds */
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
bool triangle_on_map(int map, vec3 corners[3], out map_triangle t)
{
    vec3 q0 = sky_map_project(map, corners[0]);
    vec3 q1 = sky_map_project(map, corners[1]);
    vec3 q2 = sky_map_project(map, corners[2]);
    vec4 texel = sky_maps[map].texel;
    float error = POSITION_ERROR / min(texel.x, texel.y);
    /* The values are clamped before they become integers, because corners may be far outside. */
    t.first = ivec2(clamp(ceil(min(q0.xy, min(q1.xy, q2.xy)) - error - 0.5), 0.0, texel.w));
    t.size = ivec2(clamp(floor(max(q0.xy, max(q1.xy, q2.xy)) + error + 0.5), 0.0, texel.w)) - t.first;
    vec2 e1 = q1.xy - q0.xy, e2 = q2.xy - q0.xy, e3 = q2.xy - q1.xy;
    float area = cross2(e1, e2);
    if (area == 0.0 || min(t.size.x, t.size.y) <= 0)
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

/* The covered texels of a row: the first, and the end. `per_edge`: the reciprocal of edges_x. An edge along the row
 * bounds either all of it or none. */
ivec2 covered_in_row(map_triangle t, vec3 per_edge, int row)
{
    vec3 crossings = -(t.edges + float(row) * t.edges_y) * per_edge;
    vec3 least = mix(vec3(0.0), crossings, greaterThanEqual(t.edges_x, vec3(0.0)));
    vec3 greatest = mix(crossings, vec3(t.size.x), greaterThanEqual(t.edges_x, vec3(0.0)));
    float from = max(least.x, max(least.y, least.z)), to = min(greatest.x, min(greatest.y, greatest.z));
    return ivec2(clamp(vec2(ceil(from), floor(to) + 1.0), 0.0, float(t.size.x)));
}

void draw_texel(int map, map_triangle t, ivec2 at)
{
    float depth = clamp(t.depth + dot(t.gradient, vec2(at)), t.depths.x, t.depths.y);
    imageAtomicMax(map_image, ivec3(t.first + at, map), sky_map_key(depth, t.slopes));
}

void draw_triangle(int map, map_triangle t)
{
    vec3 per_edge = 1.0 / mix(t.edges_x, vec3(1e-30), equal(t.edges_x, vec3(0.0)));
    ivec2 span = ivec2(0);
    int row = 0;
    while (true) {
        /* Advances to the next covered texel, because the expensive part below should run in all lanes that have
         * one at once. */
        while (span.x >= span.y && row < t.size.y)
            span = covered_in_row(t, per_edge, row++);
        if (span.x >= span.y)
            break;
        draw_texel(map, t, ivec2(span.x++, row - 1));
    }
}

void main()
{
    uint triangle = range.x + gl_GlobalInvocationID.x;
    if (triangle >= range.y)
        return;
    vec3 corners[3];
    for (uint i = 0u; i < 3u; i++)
        corners[i] = scene_triangle_corner(triangle, i);
    for (int map = 0; map < map_count; map++) {
        map_triangle t;
        if (triangle >= firsts[map] && triangle_on_map(map, corners, t))
            draw_triangle(map, t);
    }
}
