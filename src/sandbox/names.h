/* The names that the sandbox gives a meaning to: one table, from which declarations, the plan
 * and the page are made. */
#ifndef LSF_SANDBOX_NAMES_H
#define LSF_SANDBOX_NAMES_H

#include <lightsheaf/sandbox.h>

/* Parts of the engine that a name needs; bits. */
typedef enum lsf_sandbox_need {
    LSF_NEED_VIEW = 1 << 0,        /* the camera */
    LSF_NEED_GBUFFER = 1 << 1,     /* the surface in each pixel */
    LSF_NEED_MOTION = 1 << 2,      /* its position a frame before */
    LSF_NEED_LIGHTS = 1 << 3,      /* the scene's lights */
    LSF_NEED_SHADOW = 1 << 4,      /* a shadow map of one of them */
    LSF_NEED_REFLECTIVE = 1 << 5,  /* ... with the surfaces that it reaches */
    LSF_NEED_ENVIRONMENT = 1 << 6, /* light from outside */
    LSF_NEED_VOXELS = 1 << 7,      /* the scene as voxels */
    LSF_NEED_RADIANCE = 1 << 8,    /* the light that they send out, as a pyramid */
    LSF_NEED_BUNDLE = 1 << 9,      /* the lists of a ray-bundle */
    LSF_NEED_HITS = 1 << 10,       /* ... and what rays from the visible points meet */
    LSF_NEED_PICTURE = 1 << 11,    /* the picture of a technique */
    LSF_NEED_DIRECT = 1 << 12,     /* ... and its layers */
    LSF_NEED_DIFFUSE = 1 << 13,
    LSF_NEED_SPECULAR = 1 << 14,
} lsf_sandbox_need;

typedef enum lsf_sandbox_kind {
    LSF_SANDBOX_UNIFORM,    /* set for each frame */
    LSF_SANDBOX_ENGINE,     /* a function on what the engine has made of the scene */
    LSF_SANDBOX_OLDER,      /* what GLSL of WebGL 1 had, as a macro */
    LSF_SANDBOX_ANNOTATION, /* stands in a comment */
    LSF_SANDBOX_SOURCE,     /* of a channel */
} lsf_sandbox_kind;

typedef struct lsf_sandbox_row {
    lsf_sandbox_kind kind;
    const char *name;
    const char *use;
    uint32_t needs; /* lsf_sandbox_need bits; of functions */
    const char *help;
} lsf_sandbox_row;

/* NULL past the end. */
const lsf_sandbox_row *lsf_sandbox_row_at(uint32_t index);
/* The row of a uniform or a function of that name; LSF_NONE: it is none. */
uint32_t lsf_sandbox_find_name(const char *name, size_t length);

/* The file below glsl/ that declares what a need gives, and what needs a file of the library has
 * that a shader includes itself. */
const char *lsf_sandbox_need_file(lsf_sandbox_need need);
uint32_t lsf_sandbox_needs_of_file(const char *path);

#endif
