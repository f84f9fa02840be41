/* First vertices of light paths that leave the current light: the direction is drawn exactly, and the texel of the
 * light's reflective shadow map in that direction gives the plane that the ray hits. Switches LSF_SPECULAR_PARAMS,
 * LSF_SPECULAR, LSF_SHADOW_TINT and those of the libraries. */
#ifndef LSF_LIB_LIGHT_RAY
#define LSF_LIB_LIGHT_RAY

#include "lib/emission_pdf.glsl"
#include "lib/straight.glsl"

layout(binding = 0) uniform sampler2DArray depth_texture;
layout(binding = 1) uniform usampler2DArray surface_texture;
#if LSF_SPECULAR_PARAMS
layout(binding = 2) uniform usampler2DArray specular_params_texture;
#endif

#if LSF_SHADOW_TINT
layout(binding = 3) uniform sampler2DArray tint_texture;
#endif

#if LSF_EMISSION_ADAPTIVE
layout(std430, binding = 4) readonly buffer sum_block
{
    float sums[]; /* prefix sums of importance: one for each row, then that of the row totals */
};
#endif

struct ray {
    vec3 origin, direction; /* unit */
    int face;
    vec2 texel; /* continuous texel coordinates of the ray on the map */
};

struct met_plane {
    vec3 point, normal;
    bool exists;
};

ray ray_through(vec3 origin, vec3 direction)
{
    ray r;
    r.origin = origin;
    r.direction = direction;
    r.face = light_projection_perspective() ? light_projection_face(origin + direction) : 0;
    vec3 q = light_projection_coordinates(r.face, origin + direction);
    r.texel = (light_projection_face_position(r.face, q) * 0.5 + 0.5) * light.map_shape.z;
    return r;
}

/* Draws a ray from the light with density emission_pdf_uniform. */
ray emit_ray_uniform(vec2 u)
{
#if LSF_DIRECTIONAL_LIGHT
    if (light.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL)
        return ray_through(light_projection_position(0, 2.0 * u - 1.0, 1.0), light.direction.xyz);
#endif
    float cosine = 1.0 - 2.0 * u.x;
    vec3 axis = vec3(0.0, 0.0, 1.0);
#if LSF_SPOT_LIGHT
    if (light.attenuation.w == LSF_LIGHT_TYPE_SPOT) {
        cosine = lsf_spot_cosine(u.x, light.attenuation.y, light.attenuation.z);
        axis = light.direction.xyz;
    }
#endif
    vec3 t, b;
    orthonormal_basis(axis, t, b);
    float angle = 2.0 * LSF_PI * u.y;
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    vec3 direction = sine * (cos(angle) * t + sin(angle) * b) + cosine * axis;
    return ray_through(light.position.xyz, normalize(direction));
}

ray ray_of_face_position(int face, vec2 face_position)
{
    vec3 point = light_projection_position(face, face_position, 1.0);
    return light_projection_perspective()
               ? ray_through(light.map_origin.xyz, normalize(point - light.map_origin.xyz))
               : ray_through(point, light.direction.xyz);
}

ray ray_of_center(int face, ivec2 at)
{
    vec2 face_position = (vec2(at) + 0.5) * (2.0 * light.map_shape.w) - 1.0;
    return ray_of_face_position(face, face_position);
}

#if LSF_EMISSION_ADAPTIVE

/* The entry of an increasing run of prefix sums that holds u times the last of them, never one that adds nothing;
 * u becomes the position within the entry, 0..1. */
int find_entry(int start, int count, inout float u)
{
    float wanted = u * sums[start + count - 1];
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (sums[start + middle] > wanted)
            high = middle;
        else
            low = middle + 1;
    }
    float before = low > 0 ? sums[start + low - 1] : 0.0;
    float width = sums[start + low] - before;
    u = width > 0.0 ? clamp((wanted - before) / width, 0.0, 1.0) : 0.5;
    return low;
}

/* Draws a ray from the light with density emission_pdf. */
ray emit_ray(vec2 u)
{
    if (u.x < EMISSION_DEFENSIVE || light.position.w == 0.0) {
        if (light.position.w != 0.0)
            u.x /= EMISSION_DEFENSIVE;
        return emit_ray_uniform(u);
    }
    u.x = (u.x - EMISSION_DEFENSIVE) / (1.0 - EMISSION_DEFENSIVE);
    int texels = int(light.map_shape.z);
    int rows = texels * int(light.map_origin.w);
    int row = find_entry(rows * texels, rows, u.x);
    int column = find_entry(row * texels, texels, u.y);
    int face = row / texels;
    vec2 texel = vec2(column, row - face * texels) + u.yx;
    return ray_of_face_position(face, texel * (2.0 * light.map_shape.w) - 1.0);
}

#else

ray emit_ray(vec2 u)
{
    return emit_ray_uniform(u);
}

#endif

met_plane plane_at(int face, ivec2 at)
{
    met_plane p;
    p.exists = false;
    p.point = p.normal = vec3(0.0);
    ivec2 last = ivec2(int(light.map_shape.z) - 1);
    if (clamp(at, ivec2(0), last) != at)
        return p;
    float depth = texelFetch(depth_texture, ivec3(at, face), 0).r;
    if (depth == 0.0)
        return p;
    vec2 face_position = (vec2(at) + 0.5) * (2.0 * light.map_shape.w) - 1.0;
    p.exists = true;
    p.point = light_projection_position(face, face_position, depth);
    p.normal = surface_unpack(texelFetch(surface_texture, ivec3(at, face), 0)).geometric_normal;
    return p;
}

/* Distance along the ray to the plane. The map does not resolve a surface so steep that its depth doubles within a
 * texel: where such a plane would lead far from the texel, the distance is clamped about that of the texel's centre. */
float distance_to(ray r, met_plane p)
{
    float along = dot(p.point - r.origin, r.direction);
    float bound = 0.5 * (light_projection_perspective() ? along : light.map_shape.y);
    float towards = dot(p.normal, r.direction);
    if (towards >= 0.0)
        return along + bound;
    return clamp(dot(p.normal, p.point - r.origin) / towards, along - bound, along + bound);
}

/* The texel whose plane the ray hits: the one that holds the ray, or the neighbour where that surface bends
 * towards the light within the texel (an inner corner). The planes then cross between the texel's centre and the
 * ray, which hits the neighbour's plane first. */
ivec2 find_texel(ray r, out met_plane met)
{
    ivec2 last = ivec2(int(light.map_shape.z) - 1);
    ivec2 own = clamp(ivec2(floor(r.texel)), ivec2(0), last);
    ivec2 step_to = ivec2(r.texel.x - float(own.x) >= 0.5 ? 1 : -1,
                          r.texel.y - float(own.y) >= 0.5 ? 1 : -1);
    met = plane_at(r.face, own);
    ray center = ray_of_center(r.face, own);
    float own_at_center = dot(met.point - center.origin, center.direction);
    float nearest = distance_to(r, met) * (1.0 - 2e-5); /* anything closer is the same plane */
    ivec2 found = own;
    int end = met.exists ? 4 : 0; /* not a constant, for which compilers would copy the body */
    for (int i = 1; i < end; i++) {
        ivec2 at = own + step_to * ivec2(i & 1, i >> 1);
        met_plane p = plane_at(r.face, at);
        float here = distance_to(r, p);
        if (!p.exists || here >= nearest || distance_to(center, p) <= own_at_center)
            continue;
        nearest = here;
        met = p;
        found = at;
    }
    return found;
}

surface surface_at(int face, ivec2 at)
{
    surface s = surface_unpack(texelFetch(surface_texture, ivec3(at, face), 0));
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, ivec3(at, face), 0), s);
#endif
    return s;
}

bool reflects(surface s)
{
#if LSF_SPECULAR
    bool specular = s.f0 > 0.0;
#else
    const bool specular = false;
#endif
    return !s.unlit && (specular || max(s.base_color.r, max(s.base_color.g, s.base_color.b)) > 0.0);
}

/* The end of such a ray. */
struct light_hit {
    vec3 position, direction; /* unit, away from the light */
    float distance;
    int face;       /* of the map */
    vec3 apart;     /* offset from the centre of the map's texel */
    surface s;
    vec3 intensity; /* of the light, towards the hit [W/sr]; for a directional light [W/m^2] */
    float pdf;      /* density with which it was drawn, emission_pdf */
    bool lit;       /* a surface is hit that reflects the light */
};

/* `u`: two numbers in [0, 1). */
light_hit light_ray_draw(vec2 u)
{
    ray r = emit_ray(u);
    met_plane met;
    ivec2 at = find_texel(r, met);
    light_hit h;
    h.face = r.face;
    h.s = surface_at(r.face, at);
    h.direction = r.direction;
    h.distance = distance_to(r, met);
    h.position = r.origin + h.distance * r.direction;
    h.apart = h.position - met.point;
    h.intensity = light.intensity.rgb;
    bool directional = !light_projection_perspective();
    if (!directional) {
        float distance2 = max(h.distance * h.distance, LSF_LIGHT_DISTANCE2_MIN);
        h.intensity *= lsf_distance_attenuation(distance2, light.attenuation.x) * distance2;
#if LSF_SPOT_LIGHT
        if (light.attenuation.w == LSF_LIGHT_TYPE_SPOT)
            h.intensity *= lsf_spot_attenuation(dot(r.direction, light.direction.xyz),
                                                light.attenuation.y, light.attenuation.z);
#endif
    }
#if LSF_TRANSMISSION && LSF_SHADOW_TINT
    h.intensity *= texelFetch(tint_texture, ivec3(at, r.face), 0).rgb;
    if (!h.s.volume || light.intensity.w > 0.0)
        h.intensity *= straight_weight(h.s, -r.direction);
#endif
    h.pdf = emission_pdf(directional ? r.origin : h.position);
    h.lit = met.exists && reflects(h.s) && h.pdf > 0.0 &&
            max(h.intensity.r, max(h.intensity.g, h.intensity.b)) > 0.0 &&
            dot(h.s.geometric_normal, r.direction) < 0.0 && dot(h.s.normal, r.direction) < 0.0;
    return h;
}

#endif
