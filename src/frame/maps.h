/* Textures that passes hand to each other, of the size of the picture or of a grid. Names are
 * borrowed. */
#ifndef LSF_FRAME_MAPS_H
#define LSF_FRAME_MAPS_H

#include "frame/resources.h"

/* Points on surfaces: those that the picture's pixels show, or the same in another order or of
 * fewer pixels. Formats are in lib/gbuffer.glsl. */
typedef struct lsf_surface_maps {
    GLuint depth;   /* reverse-Z, 0 where no surface is: DEPTH_COMPONENT32F, or a copy in R32F */
    GLuint surface; /* RGBA32UI */
    GLuint specular_params; /* R32UI or RG32UI; 0: roughness and metallic are the same everywhere */
    GLuint pixels; /* R32UI, x | y << 16: the pixel that shows each point; 0: it follows from
                    * the position in the texture */
} lsf_surface_maps;

/* Light at such points, RGBA32F; both 0: there is none. */
typedef struct lsf_split_light {
    GLuint irradiance; /* for the diffuse lobe, without its albedo */
    GLuint specular;   /* radiance of the specular lobe; 0: there is no such lobe */
} lsf_split_light;

/* What the G-buffer holds. */
typedef struct lsf_gbuffer_maps {
    lsf_surface_maps seen;
    GLuint emission; /* RGBA32F, radiance; 0: nothing emits */
    GLuint motion;   /* RG32F, pixels; 0 unless asked for. Where light is kept, RGBA32F: B the
                      * reverse-Z depth in the frame before, A the instance's number and 1 */
    GLuint tint, absorption; /* RGBA16F, RGBA32F: of light between the surface and the eye; 0:
                              * none is lost */
    GLuint far_side;  /* DEPTH_COMPONENT32F, like depth, of the nearest back of a medium behind the
                       * surface; 0 where there is none. 0: no medium is refracted */
    GLuint far_color; /* RGBA16F, base colour and transmission there; undefined where it is 0 */
} lsf_gbuffer_maps;

/* The parts of an iteration's picture before they are added up. */
typedef struct lsf_light_parts {
    const lsf_gbuffer_maps *gbuffer;
    GLuint direct;                /* RGBA32F, reflected radiance of direct light; 0: none */
    lsf_split_light split_direct; /* direct light that filters take apart, to be added to
                                   * `direct` */
    lsf_split_light sky;          /* the same of the environment's directions */
    lsf_split_light indirect;
} lsf_light_parts;

/* The format of the G-buffer's specular parameters, once that is planned; GL_NONE: it has none. */
GLenum lsf_gbuffer_specular_params(const lsf_plan *plan);

/* Guides of filters of light, which keep them on one surface; lib/light_guide.glsl says what
 * they hold. */
typedef struct lsf_guide_maps {
    GLuint guide, slope; /* RGBA32F */
    GLuint curvature;    /* RG16F */
} lsf_guide_maps;

/* For lib/light_guide.glsl, to units 0, 1 and 15. */
void lsf_guide_maps_bind(const lsf_guide_maps *maps);

/* For lib/gbuffer_textures.glsl, to units 0 to 2, and lib/sparse.glsl. */
void lsf_surface_maps_bind(const lsf_surface_maps *maps);

#endif
