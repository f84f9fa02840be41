/* Each fragment is a column of voxels. */
#include "passes/voxelize_mark.glsl"

in flat ivec2 triangle; /* number, and the axis of projection */

void main()
{
    voxel_triangle t;
    ivec2 column = ivec2(gl_FragCoord.xy);
    if (triangle_load(uint(triangle.x), triangle.y, t) && all(greaterThanEqual(column, t.low)) &&
        all(lessThan(column, t.low + t.columns)))
        visit_column(t, column);
}
