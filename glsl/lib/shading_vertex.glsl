/* The path vertex that a fragment shades, and its reflectance towards the eye. The vertex is the visible point (x3
 * in the paper), or with LSF_DEEP a point that a ray-bundle found from there. Switches LSF_SPECULAR_PARAMS, LSF_SPECULAR,
 * LSF_SPARSE, LSF_INTERLEAVE, LSF_POOLED (a filter pools the pixels of the pattern) and those of lib/brdf.glsl and
 * lib/view.glsl.
 *
 * Light is summed in two parts: irradiance, which the visible point reflects by k_d / pi, and the radiance of its
 * specular lobe. */
#ifndef LSF_LIB_SHADING_VERTEX
#define LSF_LIB_SHADING_VERTEX

#include "lib/brdf.glsl"
#include "lib/specular_share.glsl"
#if LSF_POOLED
#include "lib/pooling.glsl"
#endif
#include "lib/region.glsl"
#include "lib/sparse.glsl"

#if LSF_DEEP
layout(binding = 0) uniform sampler2D position_texture;
layout(binding = 3) uniform usampler2D throughput_texture;
layout(location = LSF_LOCATION_ARRIVAL) uniform vec3 arrival; /* direction of the bundle that found the vertex */
#else
layout(binding = 0) uniform sampler2D depth_texture;
#endif
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_SPECULAR_PARAMS
layout(binding = 2) uniform usampler2D specular_params_texture;
#endif

struct shading_vertex {
    vec3 position, view; /* view: unit, towards the previous vertex */
    surface s;
    float raster_error;     /* the position's, see LSF_RASTER_STEP */
    vec3 diffuse, specular; /* contribution to both parts of unit radiance towards that vertex */
#if LSF_SPECULAR_PATHS
    float lobe_left; /* share of the specular light of surfaces that paths leave */
#endif
#if LSF_POOLED
    float normal_change; /* change of the normal over the pattern of pixels [radians] */
#endif
};

struct light_parts {
    vec3 irradiance, specular;
};

/* Six numbers as half floats, clamped to finite values. */
uvec3 throughput_pack(light_parts t)
{
    t.irradiance = min(t.irradiance, 65504.0);
    t.specular = min(t.specular, 65504.0);
    return uvec3(packHalf2x16(t.irradiance.rg), packHalf2x16(vec2(t.irradiance.b, t.specular.r)),
                 packHalf2x16(t.specular.gb));
}

#if LSF_POOLED
/* Change of the normal from a texel to the next, the smaller of both sides. */
float normal_step(vec3 normal, ivec2 texel, ivec2 along)
{
    ivec2 last = textureSize(surface_texture, 0) - 1;
    vec3 after = octahedral_decode(texelFetch(surface_texture, min(texel + along, last), 0).y);
    vec3 before = octahedral_decode(texelFetch(surface_texture, max(texel - along, ivec2(0)), 0).y);
#if LSF_SCATTER
    /* Normals of walls that are looked through count as those of either side. */
    after *= sign(dot(after, normal));
    before *= sign(dot(before, normal));
#endif
    return min(length(after - normal), length(before - normal));
}
#endif

/* False where there is nothing to shade. */
bool vertex_load(out shading_vertex v)
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
#if LSF_DEEP
    vec4 position = texelFetch(position_texture, texel, 0);
    if (position.w == 0.0)
        return false;
    v.position = position.xyz;
    v.raster_error = position.w;
    uvec3 t = texelFetch(throughput_texture, texel, 0).xyz;
    vec2 middle = unpackHalf2x16(t.y);
    v.diffuse = vec3(unpackHalf2x16(t.x), middle.x);
    v.specular = vec3(middle.y, unpackHalf2x16(t.z));
#else
    float depth = texelFetch(depth_texture, texel, 0).r;
    if (depth == 0.0)
        return false;
#if LSF_SPARSE
    vec2 ndc = position_ndc(texel);
#else
    vec2 ndc = sample_ndc(region_fragment());
#endif
    v.position = position_from_depth(ndc, depth);
    v.view = -normalize(view_ray_direction(ndc));
    v.diffuse = vec3(1.0);
    v.specular = vec3(1.0);
#endif
    v.s = surface_unpack(texelFetch(surface_texture, texel, 0));
#if !LSF_DEEP
    v.raster_error = view_raster_error(v.position, v.s.geometric_normal);
#endif
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, texel, 0), v.s);
#endif
#if LSF_DEEP
    /* The normal faces the ray that found the vertex. */
    v.view = dot(v.s.geometric_normal, arrival) > 0.0 ? arrival : -arrival;
#else
    v.view = surface_view(v.s, v.view);
#endif
#if LSF_SPECULAR_PATHS
    v.lobe_left = 1.0 - specular_paths_share(v.s, v.view);
#endif
#if LSF_POOLED
    /* Neighbours in split order are one pattern apart. */
    v.normal_change = 0.5 * (normal_step(v.s.normal, texel, ivec2(1, 0)) + normal_step(v.s.normal, texel, ivec2(0, 1)));
#endif
    return !v.s.unlit;
}

/* Reflects unit radiance from `direction` into both parts, the cosine included; 0 from behind. `kernel` as in
 * brdf_evaluate. */
light_parts vertex_reflect(shading_vertex v, vec3 direction, float kernel)
{
    light_parts r;
    float cosine = dot(v.s.normal, direction);
    if (cosine <= 0.0 || dot(v.s.geometric_normal, direction) <= 0.0) {
        r.irradiance = r.specular = vec3(0.0);
        return r;
    }
#if LSF_POOLED
    vec3 f0 = surface_specular_f0(v.s);
    kernel *= pooling_spread(kernel, largest(f0), pow(v.s.roughness, 4.0), v.normal_change, float(INTERLEAVE_SIZE));
#endif
    brdf_value f = brdf_evaluate(v.s, v.view, direction, kernel);
#if LSF_DEEP
    vec3 sum = brdf_sum(v.s, f) * cosine;
    r.irradiance = v.diffuse * sum;
    r.specular = v.specular * sum;
#else
    r.irradiance = vec3(f.diffuse * cosine);
    r.specular = f.specular * cosine;
#if LSF_SPECULAR_PATHS
    r.specular *= v.lobe_left;
#endif
#endif
    return r;
}

#endif
