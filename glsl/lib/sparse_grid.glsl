/* The grid of points at which indirect light is gathered; see src/frame/sparse_grid.h. Switch LSF_SPARSE,
 * 0 where points are the picture's pixels. */
#ifndef LSF_LIB_SPARSE_GRID
#define LSF_LIB_SPARSE_GRID

#include "shared/scene_data.h"

#if LSF_SPARSE
layout(location = LSF_LOCATION_SPARSE_GRID) uniform ivec4 sparse_grid;  /* number of points; pixel of the first one */
layout(location = LSF_LOCATION_SPARSE_SHAPE) uniform ivec2 sparse_shape; /* distance between points [pixels];
                                                                          * layers */

ivec2 sparse_pixel(ivec2 point)
{
    return point * sparse_shape.x + sparse_grid.zw;
}

/* Whether the grid has the point; it may lie beyond the picture's border. */
bool sparse_has(ivec2 point, ivec2 picture)
{
    return point.x >= 0 && point.y >= 0 && point.x < sparse_grid.x && point.y < sparse_grid.y &&
           all(lessThan(sparse_pixel(point), picture));
}
#else
#define sparse_pixel(point) (point)
#endif

#endif
