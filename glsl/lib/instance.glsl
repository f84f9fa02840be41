/* The instance that a vertex shader draws; see lsf_instance_data. */
#ifndef LSF_LIB_INSTANCE
#define LSF_LIB_INSTANCE

#include "shared/scene_data.h"

layout(location = LSF_ATTRIBUTE_TRANSFORM) in vec4 transform_rows[3];
layout(location = LSF_ATTRIBUTE_NORMAL_TRANSFORM) in vec4 normal_rows[3];

vec3 instance_position(vec3 object)
{
    vec4 p = vec4(object, 1.0);
    return vec3(dot(transform_rows[0], p), dot(transform_rows[1], p), dot(transform_rows[2], p));
}

vec3 instance_direction(vec3 object)
{
    vec4 d = vec4(object, 0.0);
    return vec3(dot(transform_rows[0], d), dot(transform_rows[1], d), dot(transform_rows[2], d));
}

vec3 instance_normal(vec3 object)
{
    return vec3(dot(normal_rows[0].xyz, object), dot(normal_rows[1].xyz, object),
                dot(normal_rows[2].xyz, object));
}

uint instance_material()
{
    return uint(normal_rows[0].w);
}

uint instance_number()
{
    return uint(normal_rows[2].w);
}

bool instance_mirrored()
{
    return normal_rows[1].w != 0.0;
}

#endif
