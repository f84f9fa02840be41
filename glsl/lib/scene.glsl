/* Instances, materials and their textures. A pass that includes this has the switches
 * LSF_TEXTURED, LSF_SECOND_UV and LSF_VERTEX_COLOR. */
#ifndef LSF_LIB_SCENE
#define LSF_LIB_SCENE

#include "shared/scene_data.h"

layout(std430, binding = LSF_BINDING_INSTANCES) readonly buffer lsf_instance_block
{
    lsf_instance_data instances[];
};
layout(std430, binding = LSF_BINDING_MATERIALS) readonly buffer lsf_material_block
{
    lsf_material_data materials[];
};

vec3 instance_position(lsf_instance_data instance, vec3 object)
{
    vec4 p = vec4(object, 1.0);
    return vec3(dot(instance.transform_0, p), dot(instance.transform_1, p),
                dot(instance.transform_2, p));
}

vec3 instance_normal(lsf_instance_data instance, vec3 normal)
{
    return vec3(dot(instance.normal_0.xyz, normal), dot(instance.normal_1.xyz, normal),
                dot(instance.normal_2.xyz, normal));
}

vec3 instance_direction(lsf_instance_data instance, vec3 direction)
{
    return vec3(dot(instance.transform_0.xyz, direction), dot(instance.transform_1.xyz, direction),
                dot(instance.transform_2.xyz, direction));
}

bool slot_used(lsf_texture_slot_data slot)
{
    return slot.row_0.w != 0.0;
}

vec2 slot_uv(lsf_texture_slot_data slot, vec2 uv0, vec2 uv1)
{
    vec3 uv = vec3(slot.row_1.w == 0.0 ? uv0 : uv1, 1.0);
    return vec2(dot(slot.row_0.xyz, uv), dot(slot.row_1.xyz, uv));
}

#endif
