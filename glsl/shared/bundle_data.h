/* One ray-bundle's projection, uniform buffer LSF_BINDING_BUNDLE. Normalised space. */
#ifndef LSF_SHARED_BUNDLE_DATA_H
#define LSF_SHARED_BUNDLE_DATA_H

#include "shared/shared.h"

/* With q = (right, up, forward) . p of a point p, its position on the map, 0..texels, and its
 * depth, 0..1 over the whole scene, are position = ((q.xy - center) / extent * 0.5 + 0.5) * texels,
 * depth = (q.z - start) / length Both are affine in p. right x up = -forward: seen along forward, x
 * is right and y up.
 *
 * Where parts of the scene are far apart, the empty gaps between them along an axis are removed
 * from q: a gap that starts at s and is g long shortens q by clamp(q - s, 0, g). No triangle
 * reaches into a gap, so that the maps stay affine over each triangle. */
struct lsf_bundle_data {
    vec4 right, up; /* unit axes; right.w: the map's texels to those in use, along a side */
    vec4 forward;   /* unit: the bundle's direction; w: its density [1/sr], p_r in the paper */
    vec4 window;    /* xy: center, zw: extent (half width and height) of the whole map */
    vec4 range; /* start, length (along forward), texels in use along a side, which lie about the
                 * map's centre; 1 / texels of the map */
    vec4 gap_starts[3],
        gap_lengths[3]; /* along right, up and forward, in ascending order; length 0: none */
    /* Texels along a side of the map, and the same rounded up to whole tiles; fragments of a texel
     * that are in slices, see lib/ray_bundle.glsl; the first chained node. As switches they would
     * make other numbers of samples compile other shaders. */
    uint side, row, sliced, first_link;
};

/* Stride in an array of bundles, 256 bytes: GL's largest alignment of ranges bound as uniform
 * buffers. */
struct lsf_bundle_slot_data {
    LSF_SHARED_STRUCT(lsf_bundle_data) data;
    vec4 unused[4];
};

/* Largest distance of a node's plane from the origin of a ray at which it still is the surface
 * that the ray left: a fraction of a texel, for surfaces that curve within one, plus half a step
 * of the keys' depth. Measured: see ray_bundle.md. */
#define LSF_BUNDLE_SELF_TEXELS 0.2f

/* Storage buffer of pixels whose search takes longer, at a binding that materials do not use
 * meanwhile; size of the work groups that share them. */
#define LSF_BINDING_REST 0
#define LSF_BUNDLE_REST_GROUPS 64

/* Storage buffer of triangles that are left to GL, during the build of a bundle. */
#define LSF_BINDING_BUNDLE_LARGE 1
/* Triangles that a work group rasterises, and texels in the bounding box of the largest one. */
#define LSF_BUNDLE_SMALL_SIZE 64
#define LSF_BUNDLE_SMALL_TEXELS 256

/* Words in front of the chains' heads: the number of chained nodes, then 16 counters of nodes
 * that a shader rasterised, each in its own cache line, so that threads do not contend. */
#define LSF_BUNDLE_CHAINED 0
#define LSF_BUNDLE_RASTERISED 16
#define LSF_BUNDLE_COUNTERS 272

/* Statistics of built bundles, for the GPU and, later, the host. Sums have two words, the low
 * one first. New sums belong to the iteration in progress, the others to iterations whose nodes
 * fitted. */
struct lsf_bundle_status {
    uint draw_vertices, draw_instances, draw_first,
        draw_base;              /* DrawArraysIndirectCommand: of the whole picture, or of nothing
                                 * once the nodes of some bundle did not fit */
    uint needed;                /* chained nodes of the largest bundle since the capacity last
                                 * grew */
    uint iterations_done;       /* number of leading iterations whose nodes fitted */
    uint drawn_low, drawn_high; /* fragments that GL rasterised for the latest bundle */
    uint new_nodes_low, new_nodes_high;
    uint new_chained_low, new_chained_high;
    uint nodes_low, nodes_high;
    uint chained_low, chained_high;
    uint first_needed; /* chained nodes of the largest bundle in the first iteration whose nodes
                        * did not fit */
};

/* Storage buffer of these statistics, at a binding that materials do not use meanwhile. */
#define LSF_BINDING_BUNDLE_STATUS 0

/* Side of the tiles of pixels that a window is fitted to, and number of invocations that fit
 * one. */
#define LSF_BUNDLE_TILE 8
#define LSF_BUNDLE_FIT_SIZE 256

/* Half width of a window that covers low..high for any shift of its grid within half a texel:
 * one texel more on each side. A texel is at least four roundings of a position (2^-24). */
LSF_SHARED_FUNCTION float lsf_bundle_extent(float low, float high, float texels)
{
    float inside = max(0.5f * (high - low), (texels - 2.0f) * 1.1920929e-7f);
    return inside * texels / (texels - 2.0f);
}

#include "shared/shared_end.h"
#endif
