/* Cross-bilateral filter along one axis, guided by the G-buffer; the weights are derived in
 * src/passes/interleave.md. Switch LSF_INTERLEAVE, the size of the pattern. */
#include "lib/gbuffer.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/view.glsl"

layout(binding = 3) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

layout(location = 0) uniform ivec2 along;  /* (1, 0), then (0, 1) */
layout(location = 1) uniform ivec2 reach;  /* pixels to each side; 1 when the outermost count half */
layout(location = 2) uniform vec2 weights; /* depth_weight, normal_weight */

/* Below it squares of roughness and of angles are as good as 0. */
#define LSF_TINY 1e-20

vec3 position_at(ivec2 pixel, float depth)
{
    return position_from_depth(sample_ndc(vec2(pixel) + 0.5), depth);
}

/* A pixel's width where the point lies [normalised space]. */
float pixel_size(float depth)
{
#if LSF_ORTHOGRAPHIC
    return 2.0 * length(view.start_dx.xyz) * view.size.z;
#else
    return 2.0 * length(view.forward_dx.xyz) * view.size.z * view_depth(depth);
#endif
}

#if LSF_SPECULAR
/* Where a pixel's specular light would come from, were it a mirror. */
struct reflection {
    vec3 view, direction;
    float alpha;
};

reflection reflection_at(ivec2 pixel, vec3 normal)
{
    vec3 ray = normalize(view_ray_direction(sample_ndc(vec2(pixel) + 0.5)));
    float roughness = 1.0;
#if LSF_GLOSS
    roughness = unpackUnorm2x16(texelFetch(gloss_texture, pixel, 0).x).x;
#endif
    return reflection(-ray, reflect(ray, normal), roughness * roughness);
}

/* The pixel's lobe about `normal` where the neighbour's has its peak, as a part of its own peak;
 * and how alike both lobes are. */
float specular_weight(reflection r, vec3 normal, reflection other, vec3 apart)
{
    /* Along the normal of the facets that would mirror it to the pixel. */
    vec3 h = r.view + other.direction + apart;
    float nh = dot(normal, h);
    vec3 across = h - nh * normal;
    float a2 = r.alpha * r.alpha, b2 = other.alpha * other.alpha;
    float peak = a2 * nh * nh / max(a2 * nh * nh + dot(across, across), LSF_TINY);
    return nh > 0.0 ? peak * peak * 2.0 * r.alpha * other.alpha / max(a2 + b2, LSF_TINY) : 0.0;
}
#endif

/* Pixels to add so that a neighbour beyond the picture's border is one of the same tile within. */
int turn_back(int place, int length)
{
    int beyond = place < 0 ? -place : place - length + 1;
    int patterns = (beyond + LSF_INTERLEAVE - 1) / LSF_INTERLEAVE * LSF_INTERLEAVE;
    return place < 0 ? patterns : place >= length ? -patterns : 0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(depth_texture, 0);
    irradiance_out = texelFetch(irradiance_texture, pixel, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, pixel, 0);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    uvec4 texel = texelFetch(surface_texture, pixel, 0);
    if (depth == 0.0 || surface_texel_unlit(texel))
        return;
    vec3 plane = octahedral_decode(texel.x), normal = octahedral_decode(texel.y);
    vec3 position = position_at(pixel, depth);
    float tolerance = weights.x * pixel_size(depth);
    /* Differences to the pixel's own light are summed: a constant stays what it is to the bit. */
    vec4 irradiance = vec4(0.0);
    float sum = 1.0;
#if LSF_SPECULAR
    reflection r = reflection_at(pixel, normal);
    vec4 specular = vec4(0.0);
    float specular_sum = 1.0;
#endif
    int place = along.x * pixel.x + along.y * pixel.y;
    int length = along.x * size.x + along.y * size.y;
    for (int i = -reach.x; i <= reach.x; i++) {
        int steps = i + turn_back(place + i, length);
        ivec2 at = pixel + steps * along;
        if (steps == 0) {
            /* Its own place, or one beyond the border that the pixel itself stands for. */
            float w = i == 0 ? 0.0 : abs(i) == reach.x && reach.y != 0 ? 0.5 : 1.0;
            sum += w;
#if LSF_SPECULAR
            specular_sum += w;
#endif
            continue;
        }
        if (place + steps < 0 || place + steps >= length)
            continue;
        float there = texelFetch(depth_texture, at, 0).r;
        uvec4 other_texel = texelFetch(surface_texture, at, 0);
        vec3 other = octahedral_decode(other_texel.y);
        float cosine = dot(normal, other);
        if (there == 0.0 || surface_texel_unlit(other_texel) || cosine <= 0.0)
            continue;
        vec3 apart = position_at(at, there) - position;
        float off = dot(plane, apart) / (tolerance * abs(float(steps)));
        float w = abs(i) == reach.x && reach.y != 0 ? 0.5 : 1.0;
        w *= exp2(-off * off) * pow(cosine, weights.y);
        irradiance += w * (texelFetch(irradiance_texture, at, 0) - irradiance_out);
        sum += w;
#if LSF_SPECULAR
        w *= specular_weight(r, normal, reflection_at(at, other), apart);
        specular += w * (texelFetch(specular_texture, at, 0) - specular_out);
        specular_sum += w;
#endif
    }
    irradiance_out += irradiance / sum;
#if LSF_SPECULAR
    specular_out += specular / specular_sum;
#endif
}
