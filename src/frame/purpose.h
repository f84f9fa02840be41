/* Purposes of random numbers: each names a sequence of its own (lsf_iteration_seed), so that no
 * two choices are correlated by accident. */
#ifndef LSF_FRAME_PURPOSE_H
#define LSF_FRAME_PURPOSE_H

typedef enum lsf_purpose {
    LSF_PURPOSE_PIXEL = 0,
    LSF_PURPOSE_SHADOW_MAP = 1,                  /* rotation and offset, two for each light */
    LSF_PURPOSE_REFLECTIVE_SHADOW_MAP = 0x20000, /* the same */
    LSF_PURPOSE_BUNDLE_DIRECTION = 0x40000,      /* one for each bundle of an iteration */
    LSF_PURPOSE_BUNDLE_ROTATION = 0x60000,
    LSF_PURPOSE_BUNDLE_SHIFT,
    LSF_PURPOSE_VPL_DIRECTION,
    LSF_PURPOSE_VPL_ROTATION,
    LSF_PURPOSE_VPL_LIGHT,
    LSF_PURPOSE_VPL_EMITTER,
    LSF_PURPOSE_VOXEL_SHIFT, /* two */
    LSF_PURPOSE_SPARSE_GRID = LSF_PURPOSE_VOXEL_SHIFT + 2,
    LSF_PURPOSE_VOXEL_PATH,
    LSF_PURPOSE_CONE_ROTATION,
    LSF_PURPOSE_CONE_ELEVATION,
    LSF_PURPOSE_VOXEL_EMITTER,
    LSF_PURPOSE_SKY,                               /* two */
    LSF_PURPOSE_BLEND_VOXEL = LSF_PURPOSE_SKY + 2, /* whether blended surfaces are there */
    /* Whether surfaces that transmit, and blended ones, are hit; see lib/straight.glsl and
     * lib/alpha.glsl. */
    LSF_PURPOSE_STRAIGHT_PIXEL,
    LSF_PURPOSE_PIXEL_POINT, /* which of a pixel's points gathers light that bounces */
    LSF_PURPOSE_VPL_CLOUD,
    LSF_PURPOSE_VPL_CLOUD_EMITTER,
    LSF_PURPOSE_VPL_CLOUD_DEAL, /* how many light paths each light has */
    LSF_PURPOSE_VPL_VIEW,       /* the visible points that VPLs are to light */
    LSF_PURPOSE_LIGHT_TREE,
    LSF_PURPOSE_OPEN_SKY, /* directions whose light has no shadows */
    LSF_PURPOSE_VOXEL_DRAW,
    LSF_PURPOSE_VOXEL_LAMP,
    LSF_PURPOSE_SPECULAR_PATH,
    LSF_PURPOSE_SPECULAR_PATH_EMITTER,
    LSF_PURPOSE_STRAIGHT_SHADOW_MAP = 0x80000,            /* one for each light */
    LSF_PURPOSE_STRAIGHT_REFLECTIVE_SHADOW_MAP = 0xa0000, /* the same */
    LSF_PURPOSE_STRAIGHT_VPL = 0xc0000,                   /* one for each VPL of an iteration */
    LSF_PURPOSE_STRAIGHT_BUNDLE = 0xe0000,                /* one for each bundle of an iteration */
} lsf_purpose;

#endif
