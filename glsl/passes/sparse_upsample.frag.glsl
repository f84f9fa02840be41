/* Interpolates light of the grid's points to every pixel, guided by the surfaces that pixels show. See
 * src/passes/sparse.md. */
#include "lib/luminance.glsl"
#include "lib/sparse.glsl"
#include "passes/sparse_guide.glsl"
#include "passes/sparse_order.glsl"
#if LSF_SPECULAR
#include "passes/sparse_tint.glsl"
#endif

layout(std430, binding = LSF_BINDING_SPARSE_COUNTS) coherent buffer sparse_count_block
{
    uint alone_count, borrowed_count;
};
layout(binding = 3) uniform usampler2D source_texture;
layout(binding = 4) uniform sampler2D irradiance_texture;     /* of the grid's points */
layout(binding = 6) uniform sampler2D own_irradiance_texture; /* with the second layer */
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 5) uniform sampler2D specular_texture;
layout(binding = 7) uniform sampler2D own_specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

void take(ivec2 point)
{
    irradiance_out = texelFetch(irradiance_texture, point, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, point, 0);
#endif
}

void take_own(ivec2 point)
{
    ivec2 above = point + ivec2(0, sparse_grid.y);
    irradiance_out = texelFetch(own_irradiance_texture, above, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(own_specular_texture, above, 0);
#endif
}

void mix_around(ivec2 pixel, ivec2 picture, shown own)
{
    ivec2 from = pixel - sparse_grid.zw + sparse_shape.x;
    ivec2 first = from / sparse_shape.x - 1;
    vec2 part = vec2(from - from / sparse_shape.x * sparse_shape.x) / float(sparse_shape.x);
    vec4 irradiance = vec4(0.0), specular = vec4(0.0);
    float sum = 0.0;
    for (int i = 0; i < 4; i++) {
        bvec2 next = bvec2((i & 1) != 0, (i & 2) != 0);
        vec2 parts = mix(1.0 - part, part, next);
        ivec2 point = first + ivec2(next);
        if (parts.x * parts.y == 0.0 || !sparse_has(point, picture))
            continue;
        float weight = parts.x * parts.y * guide_weight(own, shown_at(sparse_pixel(point)));
        if (weight == 0.0)
            continue;
        /* Differences from the first of them are interpolated, so that a constant is kept to the bit. */
        if (sum == 0.0)
            take(point);
        sum += weight;
        irradiance += weight * (texelFetch(irradiance_texture, point, 0) - irradiance_out);
#if LSF_SPECULAR
        specular += weight * (texelFetch(specular_texture, point, 0) - specular_out);
#endif
    }
    irradiance_out += irradiance / max(sum, 1e-30);
#if LSF_SPECULAR
    specular_out += specular / max(sum, 1e-30);
#endif
}

/* Own points of the surrounding blocks: the nearest of the same surface; else, of all points around, the nearest
 * lit one, of those that face the same side if there are any. */
void take_nearest(ivec2 pixel, ivec2 picture, shown own)
{
    ivec2 block = pixel / sparse_shape.x, best = ivec2(-1);
    float best_rank = 3.0, nearest = 1e30;
    for (int i = 0; i < 18; i++) {
        int layer = i < 9 ? 1 : 0;
        ivec2 point = block + ivec2(i % 3, i / 3 % 3) - 1;
        if (point.x < 0 || point.y < 0 || any(greaterThanEqual(point, sparse_grid.xy)))
            continue;
        ivec2 at = position_pixel(sparse_position(point, layer));
        if (any(greaterThanEqual(at, picture)))
            continue;
        shown other = shown_at(at);
        float rank = !other.lit                        ? 3.0
                     : guide_weight(own, other) > 0.0 ? 0.0
                     : dot(own.normal, other.normal) > 0.0 ? 1.0 : 2.0;
        float apart = apart_squared(own, other);
        if (rank < best_rank || (rank == best_rank && rank < 3.0 && apart < nearest)) {
            best_rank = rank;
            nearest = apart;
            best = point + ivec2(0, layer * sparse_grid.y);
        }
    }
    if (best_rank > 0.0)
        atomicAdd(borrowed_count, 1u);
    if (best_rank == 3.0)
        return;
    if (best.y >= sparse_grid.y)
        take_own(best - ivec2(0, sparse_grid.y));
    else
        take(best);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), picture = textureSize(source_texture, 0);
    uint source = texelFetch(source_texture, pixel, 0).r;
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
    if (source == SPARSE_DARK)
        return;
    shown own = shown_at(pixel);
    if (source == SPARSE_MIXED)
        mix_around(pixel, picture, own);
    else if (source == SPARSE_ALONE)
        take_nearest(pixel, picture, own);
    else {
        int number = int(source - SPARSE_ONE);
        take(ivec2(number % sparse_grid.x, number / sparse_grid.x));
    }
#if LSF_SPECULAR
    vec3 tint = specular_tint(pixel);
    specular_out *= vec4(tint, luminance(tint));
#endif
}
