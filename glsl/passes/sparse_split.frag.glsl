/* Copies the surfaces at the points into the order in which light is gathered. */
#include "lib/gbuffer_copy.glsl"
#include "lib/hash.glsl"
#include "lib/pixel_side.glsl"
#include "passes/sparse_order.glsl"

#if LSF_SPARSE
layout(location = 2 + LSF_SPECULAR_PARAMS) out uint pixel_out;
#endif
#if LSF_SPARSE && LSF_PIXEL_SIDE == 1
#include "passes/sparse_guide.glsl"

layout(binding = 3) uniform usampler2D source_texture;
layout(location = 1) uniform uint random_seed; /* a different number in each iteration */

/* A random pixel of the point's block among those that no point of the grid represents, all with equal
 * probability; (-1, -1): there is none. */
ivec2 own_pixel(ivec2 point, ivec2 picture)
{
    ivec2 corner = point * sparse_shape.x, found = ivec2(-1);
    uint least = 0xffffffffu;
    for (int i = 0; i < sparse_shape.x * sparse_shape.x; i++) {
        ivec2 at = min(corner + ivec2(i % sparse_shape.x, i / sparse_shape.x), picture - 1);
        uint number = hash(uvec3(at, random_seed)).x;
        if (texelFetch(source_texture, at, 0).r == SPARSE_ALONE && number <= least) {
            least = number;
            found = at;
        }
    }
    return found;
}
#endif

void main()
{
    ivec2 position = ivec2(gl_FragCoord.xy);
#if LSF_SPARSE && LSF_PIXEL_SIDE > 1
    ivec2 pixel = sparse_pixel(interleave_pixel(position, sparse_grid.xy));
    gbuffer_copy(pixel);
    pixel_out = uint(pixel.x) | uint(pixel.y) << 16;
#elif LSF_SPARSE
    ivec2 picture = textureSize(source_texture, 0);
    int layer;
    ivec2 point = sparse_point(position, layer);
    ivec2 pixel = layer == 0 ? sparse_pixel(point) : own_pixel(point, picture);
    bool there = pixel.x >= 0 && all(lessThan(pixel, picture));
    gbuffer_copy(there ? pixel : ivec2(0));
    if (!there)
        depth_out = 0.0;
    pixel_out = there ? uint(pixel.x) | uint(pixel.y) << 16 : 0xffffffffu;
#else
    gbuffer_copy(interleave_pixel(position, textureSize(depth_texture, 0)));
#endif
}
