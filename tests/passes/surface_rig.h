/* A G-buffer made by hand: planes that pixels see, of which positions are known in closed form. */
#ifndef LSF_TESTS_PASSES_SURFACE_RIG_H
#define LSF_TESTS_PASSES_SURFACE_RIG_H

#include "frame/maps.h"
#include "render_gl.h"
#include "techniques/setup.h"

/* What a pixel sees: the plane n.p = offset, and shading normal `normal`. */
typedef struct seen {
    bool background, unlit;
    lsf_float3 plane, normal;
    float offset, roughness, anisotropy;
} seen;

typedef struct surface_rig {
    lsf_context *context;
    lsf_scene *scene;
    lsf_setup setup;
    lsf_scene_gpu scene_gpu;
    lsf_iteration iteration;
    uint32_t width, height;
    lsf_surface_maps maps;
    float *depths;
    uint32_t (*surfaces)[4], (*glosses)[2];
} surface_rig;

/* A picture of anisotropic glossy surfaces with nothing planned yet but the G-buffer. */
void surface_rig_begin(surface_rig *rig, uint32_t width, uint32_t height, bool orthographic);
/* Once the test has planned its passes; iteration 0. */
void surface_rig_start(surface_rig *rig);
void surface_rig_end(surface_rig *rig);

/* Along the view ray of a pixel's sample, not normalised: view depth grows by 1. */
lsf_float3 surface_rig_ray(const surface_rig *rig, uint32_t x, uint32_t y);
/* A pixel's width at view depth 1; in perspective. */
float surface_rig_pixel(const surface_rig *rig);

void surface_rig_see(surface_rig *rig, uint32_t x, uint32_t y, const seen *s);
void surface_rig_upload(surface_rig *rig);

/* A wall across the view, `distance` from the eye. */
seen surface_rig_wall(const surface_rig *rig, float distance);
/* The floor, which the view meets at a slant. */
seen surface_rig_ground(void);

GLuint surface_rig_texture(surface_rig *rig, GLenum format, uint32_t width, uint32_t height);
/* Four floats a texel. */
void surface_rig_write(GLuint texture, uint32_t width, uint32_t height, const float *texels);
void surface_rig_read(GLuint texture, uint32_t width, uint32_t height, float *texels);

#endif
