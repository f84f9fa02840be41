/* The light of the nearest place of the same surface that the grid sees, or, where the four texels
 * around the pixel show it, their mean by distance. See src/passes/upsample_search.md. */
#include "lib/coarse.glsl"
#include "lib/gbuffer.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
layout(binding = 2) uniform sampler2D coarse_depth_texture;
layout(binding = 3) uniform usampler2D coarse_surface_texture;
layout(binding = 4) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 5) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

layout(location = 0) uniform vec3 search; /* radius [texels], min_cosine, slope squared */

/* How well a place would do: places of the same surface, then those that face the same way, then
 * any other; among equals the nearest. */
#define LSF_SAME 0
#define LSF_FACING 1
#define LSF_OTHER 2
#define LSF_NONE 3

struct place {
    ivec2 texel;
    int kind;
    float distance; /* squared [normalised space] */
};

bool better(place a, place b)
{
    return a.kind < b.kind || (a.kind == b.kind && a.distance < b.distance);
}

place place_at(ivec2 texel, vec3 position, vec3 plane, vec3 normal)
{
    place p = place(texel, LSF_NONE, 0.0);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, coarse.xy)))
        return p;
    float depth = texelFetch(coarse_depth_texture, texel, 0).r;
    uvec4 surface = texelFetch(coarse_surface_texture, texel, 0);
    if (depth == 0.0 || surface_texel_unlit(surface))
        return p;
    vec3 apart = position_from_depth(coarse_ndc(texel), depth) - position;
    float cosine = dot(normal, octahedral_decode(surface.y)), rise = dot(plane, apart);
    p.distance = dot(apart, apart);
    p.kind = cosine < search.y || rise * rise > search.z * p.distance
                 ? cosine > 0.0 ? LSF_FACING : LSF_OTHER
                 : LSF_SAME;
    return p;
}

/* Outward ring by ring, until one holds a place of the same surface. */
place search_from(ivec2 texel, vec3 position, vec3 plane, vec3 normal)
{
    place best = place_at(texel, position, plane, normal);
    for (int ring = 1; ring <= int(search.x) && best.kind != LSF_SAME; ring++)
        for (int i = 0; i < 8 * ring; i++) {
            /* Each side from a corner up to the next. */
            int side = i / (2 * ring), along = i - side * 2 * ring - ring;
            ivec2 at = side == 0   ? ivec2(along, -ring)
                       : side == 1 ? ivec2(ring, along)
                       : side == 2 ? ivec2(-along, ring)
                                   : ivec2(-ring, -along);
            place p = place_at(texel + at, position, plane, normal);
            if (better(p, best))
                best = p;
        }
    return best;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    uvec4 surface = texelFetch(surface_texture, pixel, 0);
    if (depth == 0.0 || surface_texel_unlit(surface))
        return;
    vec3 position = position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth);
    vec3 plane = octahedral_decode(surface.x), normal = octahedral_decode(surface.y);
    place best = search_from(coarse_texel(pixel), position, plane, normal);
    if (best.kind == LSF_NONE)
        return;
    irradiance_out = texelFetch(irradiance_texture, best.texel, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, best.texel, 0);
#endif
}
