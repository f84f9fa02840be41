/* Weights that say how well light at one pixel represents light at another; see src/passes/sparse.md. */
#ifndef LSF_PASSES_SPARSE_GUIDE
#define LSF_PASSES_SPARSE_GUIDE

#include "lib/gbuffer.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/view.glsl"

layout(location = 0) uniform vec3 guide; /* radius [points], 1 / slope^2, normal_weight */

/* Smaller weights count as 0. */
#define LSF_GUIDE_LEAST 0.0625

/* The surface in a pixel. */
struct shown {
    bool lit;
    vec3 position, plane, normal;
};

shown shown_at(ivec2 pixel)
{
    float depth = texelFetch(depth_texture, pixel, 0).r;
    uvec4 surface = texelFetch(surface_texture, pixel, 0);
    return shown(depth != 0.0 && !surface_texel_unlit(surface),
                 position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth),
                 octahedral_decode(surface.x), octahedral_decode(surface.y));
}

/* 0 where they show different surfaces. */
float guide_weight(shown own, shown other)
{
    vec3 apart = other.position - own.position;
    float rise = dot(own.plane, apart), cosine = max(dot(own.normal, other.normal), 0.0);
    float weight = exp2(-rise * rise * guide.y / max(dot(apart, apart), 1e-30)) * pow(cosine, guide.z);
    return other.lit && weight >= LSF_GUIDE_LEAST ? weight : 0.0;
}

float apart_squared(shown own, shown other)
{
    vec3 apart = other.position - own.position;
    return dot(apart, apart);
}

/* Source of a pixel's light, one number per pixel. */
#define SPARSE_DARK 0u  /* none */
#define SPARSE_MIXED 1u /* the points around it */
#define SPARSE_ALONE 2u /* none of the grid's: its own point, or a neighbour's own */
#define SPARSE_ONE 3u   /* the point with that number plus this */

#endif
