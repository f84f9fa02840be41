/* Reorders light from split order into that of the grid, with the second layer above the first; there without the
 * specular tint. With LSF_OUTLIERS light that is improbable among its neighbours is scaled to their mean. */
#include "lib/luminance.glsl"
#include "lib/pixel_side.glsl"
#include "passes/sparse_order.glsl"

/* Whether neighbours are asked, or will be. */
#define LSF_SHARED ((LSF_SPARSE && LSF_PIXEL_SIDE == 1) || LSF_OUTLIERS)

#if LSF_SHARED
#include "lib/sparse.glsl"
#include "passes/sparse_guide.glsl"
#if LSF_SPECULAR
#include "lib/specular_albedo.glsl"
#endif
#endif

layout(binding = 3) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

#if LSF_SPECULAR && LSF_SHARED
#include "passes/sparse_tint.glsl"
#endif

ivec2 gathered_position(ivec2 point, int layer)
{
#if LSF_SPARSE
    return sparse_position(point, layer);
#else
    return interleave_position(point, textureSize(irradiance_texture, 0));
#endif
}

#if LSF_OUTLIERS
/* Fewer neighbours than this cannot tell an outlier. */
#define LEAST_NEIGHBOURS 3.0
#define TOLERANCE 2.0 /* standard deviations */

/* Sums over the neighbours of a point: of colours, of luminance less the point's own, and of its square. */
struct neighbours {
    float count, sum, squares;
    vec3 colour;
};

void add(inout neighbours n, vec3 light, float own)
{
    float difference = luminance(light) - own;
    n.count += 1.0;
    n.sum += difference;
    n.squares += difference * difference;
    n.colour += light;
}

/* Differences from the point's own luminance are summed, so that nothing changes where all are equal. */
void hold(neighbours n, inout vec3 light)
{
    if (n.count < LEAST_NEIGHBOURS)
        return;
    float own = luminance(light), mean = n.sum / n.count;
    float variance = max(n.squares / n.count - mean * mean, 0.0);
    if (mean * mean > TOLERANCE * TOLERANCE * variance)
        light = own > 0.0 ? light * ((own + mean) / own) : n.colour / n.count;
}

void hold_outliers(ivec2 point, ivec2 points, inout vec3 irradiance, inout vec3 specular)
{
    ivec2 picture = textureSize(depth_texture, 0);
    shown own = shown_at(sparse_pixel(point));
    neighbours diffuse = neighbours(0.0, 0.0, 0.0, vec3(0.0)), glossy = diffuse;
    for (int i = 0; i < 9; i++) {
        ivec2 at = point + ivec2(i % 3, i / 3) - 1;
        bool there = i != 4 && all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, points)) &&
                     all(lessThan(sparse_pixel(at), picture));
        if (!there || guide_weight(own, shown_at(sparse_pixel(at))) == 0.0)
            continue;
        ivec2 position = gathered_position(at, 0);
        add(diffuse, texelFetch(irradiance_texture, position, 0).rgb, luminance(irradiance));
#if LSF_SPECULAR
        add(glossy, texelFetch(specular_texture, position, 0).rgb / specular_tint(sparse_pixel(at)),
            luminance(specular));
#endif
    }
    hold(diffuse, irradiance);
    hold(glossy, specular);
}
#endif

void main()
{
    ivec2 point = ivec2(gl_FragCoord.xy);
    int layer = 0;
#if LSF_SPARSE
    layer = point.y / sparse_grid.y;
    point.y -= layer * sparse_grid.y;
#endif
    ivec2 position = gathered_position(point, layer);
    irradiance_out = texelFetch(irradiance_texture, position, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, position, 0);
#endif
#if LSF_SHARED
#if LSF_SPARSE
    ivec2 pixel = position_pixel(position), points = sparse_grid.xy;
#else
    ivec2 pixel = point, points = textureSize(depth_texture, 0);
#endif
    bool there = all(lessThan(pixel, textureSize(depth_texture, 0))) && shown_at(pixel).lit;
    if (!there) {
        irradiance_out = vec4(0.0);
#if LSF_SPECULAR
        specular_out = vec4(0.0);
#endif
        return;
    }
    vec3 specular = vec3(0.0);
#if LSF_SPECULAR
    vec3 tint = specular_tint(pixel);
    specular_out /= vec4(tint, luminance(tint));
    specular = specular_out.rgb;
#endif
#if LSF_OUTLIERS
    if (layer == 0)
        hold_outliers(point, points, irradiance_out.rgb, specular);
#endif
#if LSF_SPECULAR
    specular_out.rgb = specular;
#if !LSF_SPARSE
    specular_out *= vec4(tint, luminance(tint));
#endif
#endif
#endif
}
