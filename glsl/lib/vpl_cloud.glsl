/* For shaders that fill a cloud of virtual point lights: its records, and the slots of the vertices of light
 * paths. Records of points on emitters come first, then the first vertices of all paths, their second ones and so
 * on. */
#ifndef LSF_LIB_VPL_CLOUD
#define LSF_LIB_VPL_CLOUD

#include "lib/octahedral.glsl"
#include "lib/luminance.glsl"
#include "lib/path_random.glsl"
#include "lib/reflectance.glsl"
#include "lib/vpl_lobe.glsl"
#include "shared/brdf.h"
#include "shared/vpl_record.h"

layout(local_size_x = 64) in;

layout(std430, binding = 2) buffer lsf_vpl_cloud_block
{
    lsf_vpl_record cloud[];
};

layout(location = 0) uniform uvec4 cloud_shape; /* points on emitters, paths; first path and number of paths of
                                                 * this dispatch */
layout(location = 1) uniform uvec3 cloud_iteration;  /* iteration, seed; number of the current light */
#if LSF_SPECULAR
layout(location = 4) uniform float lobe_share; /* least specular share of reflected light that keeps its lobe */
#endif

/* `vertex` counts from 0, the first vertex that reflects light. */
uint cloud_slot(uint path, uint vertex)
{
    return cloud_shape.x + vertex * cloud_shape.y + path;
}

/* Three numbers for the segment of a path that leads to that vertex. */
vec3 cloud_random(uint path, uint vertex)
{
    path_random_key key;
    key.pixel = cloud_iteration.z;
    key.seed = cloud_iteration.y;
    key.texel = ivec2(0);
    return path_random(key, cloud_iteration.x * cloud_shape.y + path, vertex);
}

/* What a surface with the normal n and the shading normal s sends out of light from a direction whose intensity would be
 * this if all was reflected: one of its lobes, which chance takes by their shares, or all as diffuse light. `u`: a number, and what is left of
 * it. Normals are on the side that the light comes to. Switch LSF_SPECULAR. */
lsf_vpl_record cloud_reflect(vec3 position, vec3 n, vec3 s, vec3 direction, reflector m, vec3 intensity, uint depth,
                             inout float u)
{
    vec3 diffuse, specular;
    reflectances(m, max(-dot(s, direction), 0.0), diffuse, specular);
    lsf_vpl_record v;
    v.position = position;
    v.normal = octahedral_encode(n);
    v.depth_and_lobe = min(depth, LSF_VPL_DEPTH_MASK);
    v.intensity = (diffuse + specular) * intensity;
#if LSF_SPECULAR
    float glossy = luminance(specular);
    float share = glossy / max(glossy + luminance(diffuse), 1e-6);
    if (share < lobe_share)
        return v;
    bool taken = u < share;
    u = min(taken ? u / share : (u - share) / (1.0 - share), 1.0 - 1.0 / 16777216.0);
    if (taken) {
        /* The lobe is about n: light as if from where n mirrors it to what s does. */
        vec3 axis = vpl_lobe_lift(reflect(direction, s), n);
        v.intensity = specular * intensity / share;
        v.depth_and_lobe |= vpl_lobe_pack(vpl_lobe(reflect(-axis, n), m.roughness));
    } else {
        v.intensity = diffuse * intensity / (1.0 - share);
    }
#endif
    return v;
}

#endif
