/* Scenes made by hand. */
#ifndef LSF_TESTS_SCENE_BUILD_SCENE_H
#define LSF_TESTS_SCENE_BUILD_SCENE_H

#include "math/vector.h"
#include "scene/scene.h"

/* An empty scene with one perspective camera and glTF's default material as material 0 would be
 * too many choices: materials come from build_material. The caller destroys it. */
lsf_scene *build_scene(void);
void destroy_scene(lsf_scene *scene);

/* A dielectric of roughness 1; change what differs. The pointer lasts until the next call. */
lsf_material *build_material(lsf_scene *scene, float r, float g, float b);

/* Adds a node at the root with these triangles in the last material made. Normals are flat. */
lsf_node *build_triangles(lsf_scene *scene, const lsf_float3 *corners, uint32_t triangle_count);
/* A quadrilateral a, b, c, d, anticlockwise seen from its front. */
lsf_node *build_quad(lsf_scene *scene, lsf_float3 a, lsf_float3 b, lsf_float3 c, lsf_float3 d);
/* The square of half width `size` in y = height that faces up. */
lsf_node *build_floor(lsf_scene *scene, float height, float size);
/* An axis-aligned box; its front is its inside or its outside. */
lsf_node *build_box(lsf_scene *scene, lsf_float3 low, lsf_float3 high, bool inside);
/* An icosphere of radius 1 with 20 * 4^levels triangles. */
lsf_node *build_sphere(lsf_scene *scene, uint32_t levels, bool inside);

/* Adds a light at the root. */
lsf_light *build_light(lsf_scene *scene, lsf_light_type type, lsf_float3 position,
                       lsf_float3 direction, float intensity);

/* Lets the vertices of the last triangles follow two joints, new nodes at their foot and at half
 * their height along y: the higher the more the second one, whose number is returned. One morph
 * target, with weight 0, shifts them by `shift`. */
uint32_t build_deformer(lsf_scene *scene, lsf_float3 shift);

/* Animates a node from the first to the second of two values within a second. */
void build_channel(lsf_scene *scene, uint32_t node, lsf_animation_path path, const float *values,
                   size_t bytes);

/* Animates what KHR_animation_pointer calls by that name, behind the thing's index, from the first
 * to the second of two values within a second; visibility by a step. */
void build_value(lsf_scene *scene, lsf_kind kind, uint32_t index, const char *name,
                 const float *values);

/* A uniform environment. */
void build_environment(lsf_scene *scene, float radiance);
/* A black environment map; returns its texels, three floats each, which the scene owns. */
float *build_environment_map(lsf_scene *scene, uint32_t width, uint32_t height);

/* A smooth or rough dielectric that lets all light through, of that base colour. `ior` 0: a thin
 * wall. */
lsf_material *build_glass(lsf_scene *scene, float base, float roughness, float ior);

/* A corner of three walls with a glossy box in it. */
void build_corner(lsf_scene *scene);

/* The same with a lamp, a pane of rough glass and a point light. */
void build_lit_corner(lsf_scene *scene);

/* A texture of `channels` bytes a texel; returns its index. */
uint32_t build_texture(lsf_scene *scene, uint32_t width, uint32_t height, uint32_t channels,
                       const uint8_t *texels, bool srgb);

/* Sets the normalised space from the bounds; call after the last triangle. */
void finish_scene(lsf_scene *scene);

#endif
