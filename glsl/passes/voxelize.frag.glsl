/* A fragment a column of voxels. */
#include "passes/voxelize.glsl"

in flat int triangle;

void main()
{
    voxel_triangle t;
    ivec2 column = ivec2(gl_FragCoord.xy);
    if (triangle_load(uint(triangle), t) && all(greaterThanEqual(column, t.low)) &&
        all(lessThan(column, t.low + t.columns)))
        visit_column(t, column);
}
