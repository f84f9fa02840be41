/* Corners of the instance's triangles [voxels]. */
#include "lib/triangle_fetch.glsl"
#include "lib/voxel.glsl"

out vec3 corner;

void main()
{
    uint triangle = uint(gl_VertexID) / 3u;
    corner = voxel_from_position(triangle_position(triangle_corners(triangle)[gl_VertexID % 3]));
}
