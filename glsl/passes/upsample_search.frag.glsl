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

/* What the pixel shows. */
struct shown {
    vec3 position, plane, normal;
};

/* A texel of the grid, which sees `pixel`. */
place place_at(ivec2 texel, ivec2 pixel, shown s)
{
    ivec2 inside = clamp(texel, ivec2(0), coarse.xy - 1);
    float depth = texelFetch(coarse_depth_texture, inside, 0).r;
    uvec4 surface = texelFetch(coarse_surface_texture, inside, 0);
    vec3 apart = position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth) - s.position;
    float cosine = dot(s.normal, octahedral_decode(surface.y)), rise = dot(s.plane, apart);
    float distance = dot(apart, apart);
    int kind = cosine >= search.y && rise * rise <= search.z * distance ? LSF_SAME
               : cosine > 0.0                                          ? LSF_FACING
                                                                       : LSF_OTHER;
    bool lit = inside == texel && depth != 0.0 && !surface_texel_unlit(surface);
    return place(texel, lit ? kind : LSF_NONE, distance);
}

bool better(place a, place b)
{
    return a.kind < b.kind || (a.kind == b.kind && a.distance < b.distance);
}

/* Outward ring by ring, until one holds a place of the same surface. */
place search_from(ivec2 texel, shown s)
{
    place best = place_at(texel, coarse_pixel(texel), s);
    for (int ring = 1; ring <= int(search.x) && best.kind != LSF_SAME; ring++)
        for (int i = 0; i < 8 * ring; i++) {
            /* Each side from a corner up to the next. */
            int side = i / (2 * ring), along = i - side * 2 * ring - ring;
            ivec2 at = texel + (side == 0   ? ivec2(along, -ring)
                                : side == 1 ? ivec2(ring, along)
                                : side == 2 ? ivec2(-along, ring)
                                            : ivec2(-ring, -along));
            place p = place_at(at, coarse_pixel(at), s);
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
    shown s = shown(position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth),
                    octahedral_decode(surface.x), octahedral_decode(surface.y));
    /* The four texels whose pixels lie around this one, and its part of the way between them. */
    ivec2 own = coarse_texel(pixel), seen = coarse_pixel(own);
    ivec2 turn = ivec2(pixel.x < seen.x ? -1 : 1, pixel.y < seen.y ? -1 : 1);
    ivec2 beyond = coarse_pixel(own + turn);
    vec2 part = vec2(pixel - seen) / vec2(beyond - seen);
    place best = place(own, LSF_NONE, 0.0);
    vec4 weights;
    for (int i = 0; i < 4; i++) {
        bvec2 far = bvec2((i & 1) != 0, (i & 2) != 0);
        vec2 parts = mix(1.0 - part, part, far);
        float weight = parts.x * parts.y;
        place p = place_at(own + turn * ivec2(far), mix(seen, beyond, far), s);
        weights[i] = p.kind == LSF_SAME ? weight : 0.0;
        if (weights[i] > 0.0 && best.kind != LSF_SAME)
            best = p;
    }
    if (best.kind != LSF_SAME)
        best = search_from(own, s);
    if (best.kind == LSF_NONE)
        return;
    /* Differences to one of them: a constant stays what it is to the bit. */
    irradiance_out = texelFetch(irradiance_texture, best.texel, 0);
    vec4 irradiance = vec4(0.0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, best.texel, 0);
    vec4 specular = vec4(0.0);
#endif
    float sum = 0.0;
    for (int i = 0; i < 4; i++) {
        if (weights[i] == 0.0)
            continue;
        ivec2 at = own + turn * ivec2(i & 1, i >> 1);
        sum += weights[i];
        irradiance += weights[i] * (texelFetch(irradiance_texture, at, 0) - irradiance_out);
#if LSF_SPECULAR
        specular += weights[i] * (texelFetch(specular_texture, at, 0) - specular_out);
#endif
    }
    if (sum > 0.0) {
        irradiance_out += irradiance / sum;
#if LSF_SPECULAR
        specular_out += specular / sum;
#endif
    }
}
