/* Scenes built in code: they behave like scenes loaded from a file. All data is copied. Each
 * call that adds something returns an index by which the rest of the program, and edits
 * (edit.h), refer to it for the lifetime of the scene; on failure it returns LSF_NONE, fills in
 * the error, and adds nothing. */
#ifndef LIGHTSHEAF_BUILD_H
#define LIGHTSHEAF_BUILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/edit.h>
#include <lightsheaf/error.h>
#include <lightsheaf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* An empty scene, to which things are added until it is committed. Of `params` (NULL: the
 * defaults) it uses the environment, default_light, diffuse_only, show_back_faces, memory_limit
 * (for the environment) and name; the rest is about files. The caller destroys it
 * (lsf_scene_destroy), committed or not. */
lsf_scene *lsf_scene_create(const lsf_scene_params *params, lsf_error *error);

typedef enum lsf_texel_type { LSF_TEXEL_U8, LSF_TEXEL_U16, LSF_TEXEL_F32 } lsf_texel_type;
typedef enum lsf_wrap { LSF_WRAP_REPEAT, LSF_WRAP_CLAMP, LSF_WRAP_MIRROR } lsf_wrap;

typedef struct lsf_scene_texture_desc {
    const char *name; /* for messages; NULL: "" */
    uint32_t width, height;
    uint32_t channels; /* 1 to 4: grey, grey and alpha, RGB, RGBA */
    lsf_texel_type type;
    const void *texels; /* rows from the top, tightly packed; floats finite and at least 0 */
    bool srgb;          /* colours, not alpha, are sRGB code values: usual for base colour,
                         * emission, specular and sheen colour; not for F32 */
    lsf_wrap wrap_s, wrap_t;
    bool nearest; /* magnified without interpolation */
} lsf_scene_texture_desc;

#define LSF_SCENE_TEXTURE_DESC_DEFAULTS                                                            \
    .name = NULL, .width = 0, .height = 0, .channels = 4, .type = LSF_TEXEL_U8, .texels = NULL,    \
    .srgb = false, .wrap_s = LSF_WRAP_REPEAT, .wrap_t = LSF_WRAP_REPEAT, .nearest = false

uint32_t lsf_scene_add_texture(lsf_scene *scene, const lsf_scene_texture_desc *desc,
                               lsf_error *error);

/* The use of a texture in a material, with the channels that glTF 2.0 and its extensions assign. */
typedef enum lsf_texture_use {
    LSF_TEXTURE_BASE_COLOR,         /* RGB, alpha */
    LSF_TEXTURE_METALLIC_ROUGHNESS, /* B, G */
    LSF_TEXTURE_NORMAL,             /* RGB */
    LSF_TEXTURE_EMISSION,           /* RGB */
    LSF_TEXTURE_ANISOTROPY,         /* RG direction, B strength */
    LSF_TEXTURE_TRANSMISSION,       /* R */
    LSF_TEXTURE_SPECULAR,           /* alpha */
    LSF_TEXTURE_SPECULAR_COLOR,     /* RGB */
    LSF_TEXTURE_COAT,               /* R */
    LSF_TEXTURE_COAT_ROUGHNESS,     /* G */
    LSF_TEXTURE_COAT_NORMAL,        /* RGB */
    LSF_TEXTURE_SHEEN_COLOR,        /* RGB */
    LSF_TEXTURE_SHEEN_ROUGHNESS,    /* alpha */
    LSF_TEXTURE_USE_COUNT
} lsf_texture_use;

typedef struct lsf_material_texture {
    lsf_texture_use use;
    uint32_t texture;
    uint32_t uv_set;    /* 0 or 1 */
    float transform[6]; /* u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5; 0,0 is the upper left */
} lsf_material_texture;

#define LSF_MATERIAL_TEXTURE_DEFAULTS                                                              \
    .use = LSF_TEXTURE_BASE_COLOR, .texture = LSF_NONE, .uv_set = 0,                               \
    .transform = {1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}

/* `textures`: at most one for each use; NULL: none. */
uint32_t lsf_scene_add_material(lsf_scene *scene, const char *name, const lsf_material_desc *desc,
                                const lsf_material_texture *textures, uint32_t texture_count,
                                lsf_error *error);

/* Triangles of one material, anticlockwise seen from their front. */
typedef struct lsf_mesh_part {
    uint32_t material; /* LSF_NONE: glTF's default */
    uint32_t vertex_count;
    const float *positions;  /* 3 each */
    const float *normals;    /* 3 each; NULL: triangles are shaded flat */
    const float *tangents;   /* 4 each: unit tangent, and the bitangent's sign; NULL, or without
                              * normals: computed where the material needs them */
    const float *uvs[2];     /* 2 each; NULL: none */
    const float *colors;     /* 4 each, linear, 0 or more: factors on the base colour; NULL: 1 */
    uint32_t index_count;    /* a multiple of 3 */
    const uint32_t *indices; /* below vertex_count; NULL, with index_count 0: vertices in order */
} lsf_mesh_part;

#define LSF_MESH_PART_DEFAULTS                                                                     \
    .material = LSF_NONE, .vertex_count = 0, .positions = NULL, .normals = NULL, .tangents = NULL, \
    .uvs = {NULL, NULL}, .colors = NULL, .index_count = 0, .indices = NULL

/* A mesh is stored once, whatever the number of nodes that place it. */
uint32_t lsf_scene_add_mesh(lsf_scene *scene, const char *name, const lsf_mesh_part *parts,
                            uint32_t part_count, lsf_error *error);

/* A light shines from the nodes that carry it. */
uint32_t lsf_scene_add_light(lsf_scene *scene, const char *name, const lsf_light_desc *desc,
                             lsf_error *error);

typedef struct lsf_node_desc {
    const char *name;
    uint32_t parent;      /* a node that was added earlier; LSF_NONE: none */
    double matrix[16];    /* to its parent, column-major, as in lsf_scene_set_node */
    uint32_t mesh, light; /* LSF_NONE: none */
} lsf_node_desc;

#define LSF_NODE_DESC_DEFAULTS                                                                     \
    .name = NULL, .parent = LSF_NONE, .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},  \
    .mesh = LSF_NONE, .light = LSF_NONE

uint32_t lsf_scene_add_node(lsf_scene *scene, const lsf_node_desc *desc, lsf_error *error);

/* A camera looks along the -z of its node, whose +y is up. */
typedef struct lsf_camera_desc {
    const char *name;
    uint32_t node;    /* that carries it, and carries no other camera */
    float fov_y;      /* degrees, of a perspective camera */
    float height;     /* of the visible region, scene units: makes it orthographic; else 0 */
    float near_plane; /* scene units, above 0; orthographic: 0 allowed */
} lsf_camera_desc;

#define LSF_CAMERA_DESC_DEFAULTS                                                                   \
    .name = NULL, .node = LSF_NONE, .fov_y = 45.0f, .height = 0.0f, .near_plane = 0.01f

/* Committing adds one more, "default", that frames the scene. */
uint32_t lsf_scene_add_camera(lsf_scene *scene, const lsf_camera_desc *desc, lsf_error *error);

/* Radiance from all directions: uniform, or a map with u = 0.5 + atan2(z, x) / 2 pi and the
 * zenith in the top row. */
typedef struct lsf_environment_desc {
    float radiance[3]; /* [W/(m^2 sr)], without a map */
    uint32_t width, height;
    const float *texels; /* 3 each, linear radiance; NULL: no map */
    float rotation;      /* about +y, degrees, anticlockwise seen from above */
} lsf_environment_desc;

/* Replaces the previous environment, if there was one. */
bool lsf_scene_set_environment(lsf_scene *scene, const lsf_environment_desc *desc,
                               lsf_error *error);

/* Finishes the scene: checks it, adds a camera and light according to lsf_scene_params, and
 * computes its requirements. From then on it can be rendered and edited, and nothing can be
 * added. A scene that could not be committed can only be destroyed. */
bool lsf_scene_commit(lsf_scene *scene, lsf_error *error);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
