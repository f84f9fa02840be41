/* Draws the triangles that vpl_small.comp.glsl has listed into one octant each of a VPL's map. */
#define LSF_BINDING_TRIANGLES 3
#include "lib/hemisphere_clip.glsl"
#include "lib/scene_triangles.glsl"

layout(std430, binding = 1) readonly buffer large_block
{
    uint large_triangles[]; /* 4 triangle + octant */
};

void main()
{
    uint entry = large_triangles[gl_VertexID / 3];
    hemisphere_vertex(entry & 3u, scene_triangle_corner(entry >> 2, uint(gl_VertexID % 3)));
}
