/* For shaders that fill a cloud of virtual point lights: its records, and the slots of the vertices of light
 * paths. Records of points on emitters come first, then the first vertices of all paths, their second ones and so
 * on. */
#ifndef LSF_LIB_VPL_CLOUD
#define LSF_LIB_VPL_CLOUD

#include "lib/octahedral.glsl"
#include "lib/path_random.glsl"
#include "shared/brdf.h"
#include "shared/vpl_record.h"

layout(local_size_x = 64) in;

layout(std430, binding = 2) buffer lsf_vpl_cloud_block
{
    lsf_vpl_record cloud[];
};

layout(location = 0) uniform uvec4 cloud_shape; /* points on emitters, paths; first path and number of paths of
                                                 * this dispatch */
layout(location = 1) uniform uvec3 cloud_turn;  /* iteration, seed; number of the current light */

/* `vertex` counts from 0, the first vertex that reflects light. */
uint cloud_slot(uint path, uint vertex)
{
    return cloud_shape.x + vertex * cloud_shape.y + path;
}

/* Three numbers for the segment of a path that leads to that vertex. */
vec3 cloud_random(uint path, uint vertex)
{
    path_random_key key;
    key.pixel = cloud_turn.z;
    key.seed = cloud_turn.y;
    key.place = ivec2(0);
    return path_random(key, cloud_turn.x * cloud_shape.y + path, vertex);
}

#endif
