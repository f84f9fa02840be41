/* Edits of a scene: changes between frames. Every renderer of the scene uses an edit from its
 * next frame on (lsf_renderer_begin_frame); a scene that is being rendered on another thread
 * must not be edited. Indices stay valid for the lifetime of the scene. */
#ifndef LIGHTSHEAF_EDIT_H
#define LIGHTSHEAF_EDIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>
#include <lightsheaf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef enum lsf_kind {
    LSF_KIND_NODE,
    LSF_KIND_LIGHT,
    LSF_KIND_MATERIAL, /* the last one is that of surfaces without a material in the file */
    LSF_KIND_CAMERA,
} lsf_kind;

#define LSF_NOT_FOUND LSF_NONE

uint32_t lsf_scene_count(const lsf_scene *scene, lsf_kind kind);
/* "" where the file has no name; NULL past the end. */
const char *lsf_scene_name(const lsf_scene *scene, lsf_kind kind, uint32_t index);
/* The first index with that name, or LSF_NOT_FOUND. */
uint32_t lsf_scene_find(const lsf_scene *scene, lsf_kind kind, const char *name);

/* A node's transform, column-major, from the node to its parent, in scene units; that of the
 * file, without animations, until it is set. */
bool lsf_scene_get_node(const lsf_scene *scene, uint32_t node, double matrix[16], lsf_error *error);
/* Sets the transform, which animations do not change from then on; children follow it. The
 * matrix must be finite and affine: its last row 0, 0, 0, 1. */
bool lsf_scene_set_node(lsf_scene *scene, uint32_t node, const double matrix[16], lsf_error *error);

/* What a node is. */
typedef struct lsf_node_info {
    uint32_t parent;              /* a node with a lower index; LSF_NONE: none */
    uint32_t mesh, light, camera; /* carried by it; LSF_NONE: none */
} lsf_node_info;

bool lsf_scene_get_node_info(const lsf_scene *scene, uint32_t node, lsf_node_info *info,
                             lsf_error *error);
/* The transform from the node to the scene at a time of its animations, column-major. */
bool lsf_scene_get_node_world(const lsf_scene *scene, uint32_t node, double time, double matrix[16],
                              lsf_error *error);

/* The hit of a ray. */
typedef struct lsf_hit {
    uint32_t node, material; /* LSF_NONE: there is no hit, and the rest is 0 */
    double distance;         /* from its origin, scene units */
    double position[3];
    float normal[3]; /* of the triangle, unit, facing the ray's origin */
} lsf_hit;

/* Picking: the nearest triangle along a ray at a time of the animations, whatever its alpha. It
 * tests every triangle whose instance's box the ray hits: milliseconds for some hundred
 * thousand. A zero direction is LSF_ERROR_USAGE. */
bool lsf_scene_trace(const lsf_scene *scene, double time, const double origin[3],
                     const double direction[3], lsf_hit *hit, lsf_error *error);

typedef enum lsf_light_type {
    LSF_LIGHT_POINT,
    LSF_LIGHT_SPOT,
    LSF_LIGHT_DIRECTIONAL
} lsf_light_type;

/* A punctual light, which shines from each node that carries it, along the node's -z. */
typedef struct lsf_light_desc {
    lsf_light_type type;
    float intensity[3];           /* W/sr; directional: W/m^2; 0 switches it off */
    float range;                  /* scene units; INFINITY: none */
    float inner_cone, outer_cone; /* radians from the axis, spot lights only */
} lsf_light_desc;

bool lsf_scene_get_light(const lsf_scene *scene, uint32_t light, lsf_light_desc *desc,
                         lsf_error *error);
/* LSF_ERROR_USAGE names the value that is out of range. */
bool lsf_scene_set_light(lsf_scene *scene, uint32_t light, const lsf_light_desc *desc,
                         lsf_error *error);

/* A light and its transform, for lsf_scene_params.lights. */
typedef struct lsf_placed_light {
    lsf_light_desc light;
    double matrix[16]; /* from the light, which shines along -z, to the scene, column-major */
} lsf_placed_light;

typedef enum lsf_alpha_mode { LSF_ALPHA_OPAQUE, LSF_ALPHA_MASK, LSF_ALPHA_BLEND } lsf_alpha_mode;

/* A material's factors, by which its textures, if any, are multiplied. */
typedef struct lsf_material_desc {
    float base_color[4];       /* linear, and alpha; 0..1 */
    float metallic, roughness; /* 0..1 */
    float emission[3];         /* radiance [W/(m^2 sr)] */
    lsf_alpha_mode alpha_mode;
    float alpha_cutoff;
    bool double_sided;
    float ior;                  /* at least 1, or 0 as in KHR_materials_ior */
    float transmission;         /* 0..1 */
    float coat, coat_roughness; /* 0..1 */
    bool unlit;                 /* shown as emission of its base colour, without lighting */
    float normal_scale, coat_normal_scale;
    float specular, specular_color[3];     /* of the dielectric's reflection: weight, 0..1; tint
                                            * at normal incidence, 0 or more */
    float sheen_color[3], sheen_roughness; /* 0..1 */
    bool volume; /* bounds a medium that refracts light; else a thin wall */
    float attenuation_distance, attenuation_color[3]; /* of the medium: colour of white light
                                                       * after that distance in scene units;
                                                       * above 0; 0..1 */
    float anisotropy, anisotropy_rotation;            /* 0..1; radians from the tangent */
} lsf_material_desc;

/* glTF's defaults: a white metal of roughness 1. */
#define LSF_MATERIAL_DESC_DEFAULTS                                                                 \
    .base_color = {1.0f, 1.0f, 1.0f, 1.0f}, .metallic = 1.0f, .roughness = 1.0f, .emission = {0},  \
    .alpha_mode = LSF_ALPHA_OPAQUE, .alpha_cutoff = 0.5f, .double_sided = false, .ior = 1.5f,      \
    .transmission = 0.0f, .coat = 0.0f, .coat_roughness = 0.0f, .unlit = false,                    \
    .normal_scale = 1.0f, .coat_normal_scale = 1.0f, .specular = 1.0f,                             \
    .specular_color = {1.0f, 1.0f, 1.0f}, .sheen_color = {0}, .sheen_roughness = 0.0f,             \
    .volume = false, .attenuation_distance = 1.0f / 0.0f, .attenuation_color = {1.0f, 1.0f, 1.0f}, \
    .anisotropy = 0.0f, .anisotropy_rotation = 0.0f

bool lsf_scene_get_material(const lsf_scene *scene, uint32_t material, lsf_material_desc *desc,
                            lsf_error *error);
/* LSF_ERROR_USAGE names the value that is out of range. Anisotropy needs tangents: a material
 * whose surfaces have none cannot become anisotropic. */
bool lsf_scene_set_material(lsf_scene *scene, uint32_t material, const lsf_material_desc *desc,
                            lsf_error *error);

/* The environment's rotation in degrees, and the factor that an edit has set on its radiance.
 * LSF_ERROR_USAGE where the scene has none. */
bool lsf_scene_get_environment(const lsf_scene *scene, float *rotation, float *strength,
                               lsf_error *error);
/* Rotates the environment about +y, in degrees, anticlockwise seen from above; replaces
 * lsf_scene_params.environment_rotation. */
bool lsf_scene_set_environment_rotation(lsf_scene *scene, float degrees, lsf_error *error);
/* Multiplies the radiance that the environment was loaded with, including environment_strength;
 * 1 until it is set. The original radiance is kept as a copy. */
bool lsf_scene_set_environment_strength(lsf_scene *scene, float strength, lsf_error *error);

/* An edit as text, in the command line's syntax: KIND/WHICH/VALUE=NUMBERS, with a kind "node",
 * "light" or "material", an index or a name, and a value of the structs above. "node" has
 * matrix; "light" has intensity, range, inner_cone, outer_cone and type, which is one of the
 * words point, spot and directional; "material" has base_color (three numbers, or four),
 * metallic, roughness, emission, ior, transmission, coat and coat_roughness.
 * "light/0/intensity=3,3,2.5". There is only one environment: "environment/rotation=90" and
 * "environment/strength=2". LSF_ERROR_USAGE says what is wrong with it. */
bool lsf_scene_edit(lsf_scene *scene, const char *edit, lsf_error *error);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
