/* For each pixel, the points of the grid that show the same surface. */
#include "lib/sparse_grid.glsl"
#include "passes/sparse_guide.glsl"

layout(std430, binding = LSF_BINDING_SPARSE_COUNTS) coherent buffer sparse_count_block
{
    uint alone_count, borrowed_count;
};
layout(location = 0) out uint source_out;

float weight_of(ivec2 point, ivec2 picture, shown own, out float apart)
{
    bool there = sparse_has(point, picture);
    shown other = shown_at(there ? sparse_pixel(point) : ivec2(0));
    apart = apart_squared(own, other);
    return there ? guide_weight(own, other) : 0.0;
}

/* Searches ring by ring until one has points of the same surface, and returns the nearest of them. */
uint search(ivec2 point, ivec2 picture, shown own)
{
    uint found = SPARSE_ALONE;
    float nearest = 1e30, apart;
    for (int ring = 1; ring <= int(guide.x) && found == SPARSE_ALONE; ring++)
        for (int i = 0; i < 8 * ring; i++) {
            /* Each side runs from one corner up to the next. */
            int side = i / (2 * ring), along = i - side * 2 * ring - ring;
            ivec2 at = point + (side == 0   ? ivec2(along, -ring)
                                : side == 1 ? ivec2(ring, along)
                                : side == 2 ? ivec2(-along, ring)
                                            : ivec2(-ring, -along));
            if (weight_of(at, picture, own, apart) > 0.0 && apart < nearest) {
                nearest = apart;
                found = SPARSE_ONE + uint(at.y * sparse_grid.x + at.x);
            }
        }
    return found;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), picture = ivec2(view.size.xy);
    source_out = SPARSE_DARK;
    shown own = shown_at(pixel);
    if (!own.lit)
        return;
    ivec2 from = pixel - sparse_grid.zw + sparse_shape.x;
    ivec2 first = from / sparse_shape.x - 1, part = from - from / sparse_shape.x * sparse_shape.x;
    float sum = 0.0, apart;
    for (int i = 0; i < 4; i++) {
        ivec2 next = ivec2(i & 1, i >> 1);
        bool far = (next.x == 1 && part.x == 0) || (next.y == 1 && part.y == 0);
        float weight = weight_of(first + next, picture, own, apart);
        sum += far ? 0.0 : weight;
    }
    source_out = sum > 0.0 ? SPARSE_MIXED : search(first + part * 2 / sparse_shape.x, picture, own);
    if (source_out == SPARSE_ALONE)
        atomicAdd(alone_count, 1u);
}
