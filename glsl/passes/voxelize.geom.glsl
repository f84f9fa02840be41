/* Conservative rasterisation: enlarges a triangle, projected along its normal's longest axis, to cover the centres
 * of all pixels that it touches. The result is the Minkowski sum with a pixel, whose corners are those of a pixel
 * at each corner of the triangle (Hasselgren, Akenine-Moeller and Ohlsson 2005, GPU Gems 2, chapter 42, first
 * algorithm). Slivers are no special case: no corner lies farther out than a pixel. */
#include "lib/voxel.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 9) out;

layout(location = 27) uniform float side; /* of the viewport [pixels] */

in vec3 corner[3];
out flat ivec2 triangle;

/* Half a pixel, plus what snapping to the raster's subpixels (2^-4 at least: GL 4.5, table 23.55) and its fill
 * rule may remove. */
#define REACH (0.5 + 1.0 / 16.0)

/* The pixel corner that is farthest to the right of e. */
vec2 outermost(vec2 e)
{
    return vec2(e.y >= 0.0 ? 1.0 : -1.0, e.x >= 0.0 ? -1.0 : 1.0);
}

void main()
{
    vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
    vec3 m = abs(n);
    int axis = m.x >= m.y && m.x >= m.z ? 0 : m.y >= m.z ? 1 : 2;
    vec2 p[3];
    for (int i = 0; i < 3; i++)
        p[i] = axis == 0 ? corner[i].yz : axis == 1 ? corner[i].zx : corner[i].xy;
    if (n[axis] < 0.0) {
        vec2 swapped = p[1];
        p[1] = p[2];
        p[2] = swapped;
    }
    vec2 polygon[9];
    for (int i = 0; i < 3; i++) {
        vec2 before = outermost(p[i] - p[(i + 2) % 3]), after = outermost(p[(i + 1) % 3] - p[i]);
        /* Opposite corners have one between them, a quarter turn to the left of the first. */
        vec2 between = before == -after ? vec2(-before.y, before.x) : after;
        polygon[3 * i] = p[i] + REACH * before;
        polygon[3 * i + 1] = p[i] + REACH * between;
        polygon[3 * i + 2] = p[i] + REACH * after;
    }
    const int zigzag[9] = int[](0, 1, 8, 2, 7, 3, 6, 4, 5);
    for (int i = 0; i < 9; i++) {
        triangle = ivec2(gl_PrimitiveIDIn, axis);
        gl_Position = vec4(polygon[zigzag[i]] / side * 2.0 - 1.0, 0.0, 1.0);
        EmitVertex();
    }
    EndPrimitive();
}
