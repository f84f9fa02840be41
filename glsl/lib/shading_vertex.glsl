/* The path vertex that a fragment shades, and what it reflects towards the eye. A vertex is what a
 * pixel sees (x3 in the paper), or with LSF_DEEP what a ray-bundle met on the way there. Switches
 * LSF_GLOSS, LSF_SPECULAR, LSF_INTERLEAVE and those of lib/brdf.glsl and lib/view.glsl.
 *
 * Light is summed in two parts: irradiance, for which the visible point reflects k_d / pi, and the
 * radiance of its specular lobe. */
#ifndef LSF_LIB_SHADING_VERTEX
#define LSF_LIB_SHADING_VERTEX

#include "lib/brdf.glsl"
#include "lib/region.glsl"
#include "lib/view.glsl"

#if LSF_DEEP
layout(binding = 0) uniform sampler2D position_texture;
layout(binding = 3) uniform usampler2D throughput_texture;
layout(location = LSF_LOCATION_ARRIVAL) uniform vec3 arrival; /* of the bundle that found it */
#else
layout(binding = 0) uniform sampler2D depth_texture;
#endif
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_GLOSS
layout(binding = 2) uniform usampler2D gloss_texture;
#endif

struct shading_vertex {
    vec3 position, view; /* view: unit, towards the vertex before */
    surface s;
    vec3 diffuse, specular; /* what a unit of radiance towards that vertex adds to both parts */
};

struct light_parts {
    vec3 irradiance, specular;
};

/* Six numbers as half floats, and none of them infinite. */
uvec3 throughput_pack(light_parts t)
{
    t.irradiance = min(t.irradiance, 65504.0);
    t.specular = min(t.specular, 65504.0);
    return uvec3(packHalf2x16(t.irradiance.rg), packHalf2x16(vec2(t.irradiance.b, t.specular.r)),
                 packHalf2x16(t.specular.gb));
}

/* False where there is nothing to shade. */
bool vertex_load(out shading_vertex v)
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
#if LSF_DEEP
    vec4 position = texelFetch(position_texture, texel, 0);
    if (position.w == 0.0)
        return false;
    v.position = position.xyz;
    uvec3 t = texelFetch(throughput_texture, texel, 0).xyz;
    vec2 middle = unpackHalf2x16(t.y);
    v.diffuse = vec3(unpackHalf2x16(t.x), middle.x);
    v.specular = vec3(middle.y, unpackHalf2x16(t.z));
#else
    float depth = texelFetch(depth_texture, texel, 0).r;
    if (depth == 0.0)
        return false;
    vec2 ndc = sample_ndc(region_fragment());
    v.position = position_from_depth(ndc, depth);
    v.view = -normalize(view_ray_direction(ndc));
    v.diffuse = vec3(1.0);
    v.specular = vec3(1.0);
#endif
    v.s = surface_unpack(texelFetch(surface_texture, texel, 0));
#if LSF_GLOSS
    gloss_unpack(texelFetch(gloss_texture, texel, 0), v.s);
#endif
#if LSF_DEEP
    /* The normal looks back to where the ray came from. */
    v.view = dot(v.s.geometric_normal, arrival) > 0.0 ? arrival : -arrival;
#endif
    return !v.s.unlit;
}

/* Both parts of unit radiance that arrives along `direction`, the cosine included; 0 from behind.
 * `kernel` as in brdf_evaluate. */
light_parts vertex_reflect(shading_vertex v, vec3 direction, float kernel)
{
    light_parts r;
    float cosine = dot(v.s.normal, direction);
    if (cosine <= 0.0 || dot(v.s.geometric_normal, direction) <= 0.0) {
        r.irradiance = r.specular = vec3(0.0);
        return r;
    }
    brdf_value f = brdf_evaluate(v.s, v.view, direction, kernel);
#if LSF_DEEP
    vec3 sum = brdf_sum(v.s, f) * cosine;
    r.irradiance = v.diffuse * sum;
    r.specular = v.specular * sum;
#else
    r.irradiance = vec3(f.diffuse * cosine);
    r.specular = f.specular * cosine;
#endif
    return r;
}

#endif
