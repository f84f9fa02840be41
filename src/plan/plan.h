/* The frame plan: what is rendered, from which resources, and why. A technique fills it from the
 * scene's requirements and the options; the renderer then allocates exactly its resources and
 * compiles exactly its switches. */
#ifndef LSF_PLAN_PLAN_H
#define LSF_PLAN_PLAN_H

#include <stdbool.h>
#include <stdint.h>

#include "gl/gl.h"
#include "scene/background.h"
#include "scene/islands.h"
#include "scene/scene.h"
#include <lightsheaf/renderer.h>

#define LSF_PLAN_TEXT_SIZE 200

typedef struct lsf_plan_switch {
    lsf_define define;             /* the name is a string literal */
    char when[LSF_PLAN_TEXT_SIZE]; /* it is on */
} lsf_plan_switch;

/* The finest detail that a map or a grid over the whole scene resolves. */
typedef struct lsf_plan_grain {
    float width;                    /* normalised space; 0: there is no such map */
    const char *cell, *of, *option; /* "a voxel", of a "grid", and the option for finer ones */
    const char *instead;            /* another remedy, to follow a comma, or "" */
} lsf_plan_grain;

#define LSF_PLAN_MAX_SWITCHES 48
#define LSF_PLAN_MAX_READS 4

typedef struct lsf_plan_pass {
    const char *name;
    const char *reads[LSF_PLAN_MAX_READS]; /* names given to lsf_plan_reads, then NULL */
    const char *fills;                     /* name given to lsf_plan_fills, or NULL */
    char why[LSF_PLAN_TEXT_SIZE];
    lsf_plan_switch switches[LSF_PLAN_MAX_SWITCHES];
    uint32_t switch_count;
} lsf_plan_pass;

typedef struct lsf_plan_resource {
    char name[64]; /* also the GL label */
    bool is_buffer;
    lsf_texture_desc texture; /* without label: the resource's name */
    uint64_t bytes;
    char why[LSF_PLAN_TEXT_SIZE];
} lsf_plan_resource;

typedef struct lsf_plan_omission {
    char name[64];
    char why[LSF_PLAN_TEXT_SIZE];
} lsf_plan_omission;

struct lsf_plan {
    const char *technique;
    lsf_requirements requirements;
    uint32_t width, height, samples, bounces, aovs;
    uint32_t pixel_side; /* sample points along a pixel's side in an iteration, a power of two */
    uint32_t seen_width, seen_height; /* of the picture of all sample points, which passes see; the
                                       * means have one value a pixel */
    bool open;       /* the environment, and no lamp, lights what the camera sees from outside */
    bool hurried;    /* the picture has more pixels than one iteration can do in the time limit */
    uint32_t voxels; /* along the scene's longest side, where voxel.resolution is 0 */
    uint32_t sky_lights; /* directions in each iteration from which the environment lights */
    lsf_islands islands; /* for techniques that draw maps over the whole scene; else none */
    lsf_plan_grain grain;
    bool orthographic;
    lsf_seen_background background;
    bool transmission; /* there are materials that transmit light */
    bool straight;     /* light goes straight through transmitting materials: the technique
                        * cannot refract it */
    bool voxel_chance; /* ... and through voxels, which are there by chance: cones march and cannot
                        * go on behind one */
    bool seen_through; /* surfaces that transmit are absent by chance where the camera sees them:
                        * all where light goes straight through them, else thin walls alone */
    bool refracted;    /* what media transmit to the eye comes by refracted paths */
    bool scattered; /* rough thin walls that are seen scatter the light that comes through them */
    bool random_samples; /* plain random numbers pick light samples, not low-discrepancy ones */
    uint32_t pattern;    /* side of the pattern in which pixels take different samples, which a
                          * filter pools; 1: no pattern */
    uint32_t interleave; /* side of the pattern in which pixels take different samples; 0: none */
    uint32_t stride;     /* sample points from point to point at which indirect light is gathered, a
                          * power of two; 0 is 1 */
    uint32_t finest_stride; /* stride to which it falls as iterations go on; used where stride is
                             * above 1 */
    uint32_t tiles;         /* of pixels, to which samples are dealt out in turn; 0 is 1 */
    bool filtered;          /* light_filter removes noise from the mean */
    bool sky_split; /* ... and from light of the environment's directions, which stays split */
    bool temporal;  /* light is kept from frame to frame */
    char *weights;  /* file of the denoiser's; NULL: the library's own, or no denoiser */
    bool failed;    /* memory ran out while the plan was filled */
    lsf_plan_pass *passes;
    uint64_t pass_count, pass_capacity;
    lsf_plan_resource *resources;
    uint64_t resource_count, resource_capacity;
    lsf_plan_omission *omissions;
    uint64_t omission_count, omission_capacity;
    char **remarks; /* sentences that tell the user what the picture leaves out or approximates */
    uint64_t remark_count, remark_capacity;
};

/* Whether surfaces send out radiance of their own: some material emits or is unlit. */
bool lsf_plan_surfaces_shine(const lsf_plan *plan);
/* Whether media absorb light on its straight way to the eye. */
bool lsf_plan_media_absorb(const lsf_plan *plan);
/* Whether the G-buffer holds motion. */
bool lsf_plan_measures_motion(const lsf_plan *plan);
/* Whether lit surfaces differ in roughness, metallic, f0 or what they transmit. */
bool lsf_plan_surfaces_differ(const lsf_plan *plan);

/* Appends a pass in the order of execution; later lsf_plan_switch_add calls belong to it. */
void lsf_plan_pass_add(lsf_plan *plan, const char *name, const char *why, ...)
    __attribute__((format(printf, 3, 4)));
/* Says what the last pass reads, beside the resources that it fills itself: names of resources,
 * or their stems ("gbuffer" for all of the G-buffer's), separated by blanks; further calls add
 * more. Of "a|b" the first that the plan lists is read. Names that the plan does not list are
 * ignored. */
void lsf_plan_reads(lsf_plan *plan, const char *names);
/* The resources that may hold the picture's indirect light, for lsf_plan_reads: the last pass
 * that makes some comes first. */
#define LSF_PLAN_INDIRECT                                                                          \
    "upsampled|blur|sparse|cone_trace|voxel_path|light_tree_sample|bidirectional_shade"
/* The stem of the resources that the last pass fills, where it differs from the pass's own name. */
void lsf_plan_fills(lsf_plan *plan, const char *stem);
/* `when` names the condition for the switch, whether or not it holds. */
void lsf_plan_switch_add(lsf_plan *plan, const char *name, int value, const char *when, ...)
    __attribute__((format(printf, 4, 5)));
void lsf_plan_texture_add(lsf_plan *plan, const char *name, GLenum internal_format, uint32_t width,
                          uint32_t height, const char *why, ...)
    __attribute__((format(printf, 6, 7)));
/* For anything but a one-level 2D texture; `desc->label` is ignored. */
void lsf_plan_texture_desc_add(lsf_plan *plan, const char *name, const lsf_texture_desc *desc,
                               const char *why, ...) __attribute__((format(printf, 4, 5)));
void lsf_plan_buffer_add(lsf_plan *plan, const char *name, uint64_t bytes, const char *why, ...)
    __attribute__((format(printf, 4, 5)));
/* A feature that the technique knows and left out. */
void lsf_plan_omit(lsf_plan *plan, const char *name, const char *why, ...)
    __attribute__((format(printf, 3, 4)));
/* Something that was planned and turns out not to be needed: a resource is no longer listed. */
void lsf_plan_leave_out(lsf_plan *plan, const char *resource, const char *why);
void lsf_plan_remark(lsf_plan *plan, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* NULL when the plan does not list it. */
const lsf_plan_pass *lsf_plan_find_pass(const lsf_plan *plan, const char *name);
const lsf_plan_resource *lsf_plan_find(const lsf_plan *plan, const char *name);
/* The switch's value, 0 when the pass does not have it. */
int lsf_plan_switch_value(const lsf_plan *plan, const char *pass, const char *name);

/* A texture of a pass, for its plan, its creation and its destruction. */
typedef struct lsf_texture_row {
    const char *name;
    GLenum format; /* GL_NONE: the format of gbuffer.specular_params, and no texture where there
                    * is none */
    size_t offset; /* of the GLuint in the pass */
    uint32_t when; /* bits that must all be given for the texture to exist; 0: it always exists */
    const char *why;
} lsf_texture_row;

#define LSF_TEXTURE_SPECULAR                                                                       \
    1u /* given where materials have a specular lobe; other bits belong to the pass */

/* Lists the textures that exist, all of one size. */
void lsf_plan_textures_add(lsf_plan *plan, const lsf_texture_row *rows, size_t count,
                           uint32_t given, uint32_t width, uint32_t height);
#endif
