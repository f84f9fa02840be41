/* One ray-bundle's projection, uniform buffer LSF_BINDING_BUNDLE. Normalised space. */
#ifndef LSF_SHARED_BUNDLE_DATA_H
#define LSF_SHARED_BUNDLE_DATA_H

#include "shared/shared.h"

/* With q = (right, up, forward) . p of a point p, its place on the map, 0..texels, and its depth,
 * 0..1 over the whole scene, are
 *   place = ((q.xy - center) / extent * 0.5 + 0.5) * texels,   depth = (q.z - start) / length
 * Both are affine in p. right x up = -forward: seen along forward, x is right and y up.
 *
 * Where parts of the scene lie far apart, what lies between them along an axis is taken out of q:
 * of a gap from s on and g long, q loses clamp(q - s, 0, g). No triangle reaches into one, so that
 * the maps stay affine over each. */
struct lsf_bundle_data {
    vec4 right, up; /* unit axes; right.w: the map's texels to those in use, along a side */
    vec4 forward;   /* unit: the bundle's direction; w: its density [1/sr], p_r in the paper */
    vec4 window;    /* xy: center, zw: extent (half width and height) of the whole map */
    vec4 range; /* start, length (along forward), texels in use along a side, which lie about the
                 * map's centre; 1 / texels of the map */
    vec4 gap_starts[3],
        gap_lengths[3]; /* along right, up and forward, in ascending order; length 0: none */
};

/* In an array, at 256 bytes each: GL's largest alignment of ranges bound as uniform buffers. */
struct lsf_bundle_slot_data {
    LSF_SHARED_STRUCT(lsf_bundle_data) data;
    vec4 unused[5];
};

/* How far a node's plane may pass from the origin of a ray and still be the surface that it left: a
 * part of a texel, for what curves within one, beside half a step of the keys' depth. Measured: see
 * ray_bundle.md. */
#define LSF_BUNDLE_SELF_TEXELS 0.2f

/* Storage buffer of pixels whose search takes longer, while no materials are read; work groups that
 * share them. */
#define LSF_BINDING_REST 0
#define LSF_BUNDLE_REST_GROUPS 64

/* Storage buffer of triangles that are left to GL, while a bundle is built. */
#define LSF_BINDING_BUNDLE_LARGE 1
/* Triangles a work group rasterises, and texels of the largest one's box. */
#define LSF_BUNDLE_SMALL_SIZE 64
#define LSF_BUNDLE_SMALL_TEXELS 256

/* Words before the chains' heads: the number of chained nodes, and of nodes that a shader
 * rasterised, of the latter 16 counters, in cache lines of their own, so that threads do not meet.
 */
#define LSF_BUNDLE_CHAINED 0
#define LSF_BUNDLE_RASTERISED 16
#define LSF_BUNDLE_COUNTERS 272

/* Account of what was built, for the GPU and, later, the host. Sums are of two words, the low one
 * first; new ones are of the iteration in progress, the others of iterations that had room. */
struct lsf_bundle_status {
    uint draw_vertices, draw_instances, draw_first,
        draw_base;              /* DrawArraysIndirectCommand: of the
                                 * whole picture, or of nothing once some bundle had too little room */
    uint needed;                /* chained nodes of the largest bundle since the room last grew */
    uint iterations_done;       /* that had room, from the first on */
    uint drawn_low, drawn_high; /* fragments that GL rasterised for the latest bundle */
    uint new_nodes_low, new_nodes_high;
    uint new_chained_low, new_chained_high;
    uint nodes_low, nodes_high;
    uint chained_low, chained_high;
    uint first_needed; /* chained nodes of the largest bundle of the iteration that lacked room
                          first */
};

/* Its storage buffer, while no materials are read. */
#define LSF_BINDING_BUNDLE_STATUS 0

/* Tiles of pixels that a window is fitted to, and invocations that fit one. */
#define LSF_BUNDLE_TILE 8
#define LSF_BUNDLE_FIT_SIZE 256

/* Half width of a window that holds low..high wherever its grid is shifted within half a texel: one
 * texel more on each side. Texels are not smaller than four roundings of a position (2^-24). */
LSF_SHARED_FUNCTION float lsf_bundle_extent(float low, float high, float texels)
{
    float inside = max(0.5f * (high - low), (texels - 2.0f) * 1.1920929e-7f);
    return inside * texels / (texels - 2.0f);
}

#include "shared/shared_end.h"
#endif
