/* Scenes built in code: what a program adds becomes a scene like one of a file. All data is copied.
 * Each call that adds returns an index by which the rest of the program, and edits (edit.h), name
 * the thing for as long as the scene lives; LSF_NONE, and an error that says why, where it cannot
 * be: then nothing was added. */
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

/* An empty scene, to which things are added until it is committed. Of `params` (NULL: the defaults)
 * it takes the environment, default_light, diffuse_only, show_back_faces, memory_limit, for the
 * environment, and name; the rest is about files. The caller destroys it (lsf_scene_destroy),
 * committed or not. */
lsf_scene *lsf_scene_create(const lsf_scene_params *params, lsf_error *error);

typedef enum lsf_texel_type { LSF_TEXEL_U8, LSF_TEXEL_U16, LSF_TEXEL_F32 } lsf_texel_type;
typedef enum lsf_wrap { LSF_WRAP_REPEAT, LSF_WRAP_CLAMP, LSF_WRAP_MIRROR } lsf_wrap;

typedef struct lsf_scene_texture_desc {
    const char *name; /* for messages; NULL: "" */
    uint32_t width, height;
    uint32_t channels; /* 1 to 4: grey, grey and alpha, RGB, RGBA */
    lsf_texel_type type;
    const void *texels; /* rows from the top, tightly packed; floats finite and at least 0 */
    bool srgb;          /* colours, not alpha, are sRGB code values: of base colour, emission,
                         * specular and sheen colour as a rule; not of F32 */
    lsf_wrap wrap_s, wrap_t;
    bool nearest; /* enlarged without interpolation */
} lsf_scene_texture_desc;

#define LSF_SCENE_TEXTURE_DESC_DEFAULTS                                                            \
    .name = NULL, .width = 0, .height = 0, .channels = 4, .type = LSF_TEXEL_U8, .texels = NULL,    \
    .srgb = false, .wrap_s = LSF_WRAP_REPEAT, .wrap_t = LSF_WRAP_REPEAT, .nearest = false

uint32_t lsf_scene_add_texture(lsf_scene *scene, const lsf_scene_texture_desc *desc,
                               lsf_error *error);

/* What a texture of a material says, in the channels that glTF 2.0 and its extensions give it. */
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

/* `textures`: of a use each; NULL: none. */
uint32_t lsf_scene_add_material(lsf_scene *scene, const char *name, const lsf_material_desc *desc,
                                const lsf_material_texture *textures, uint32_t texture_count,
                                lsf_error *error);

/* Triangles of one material, anticlockwise seen from their front. */
typedef struct lsf_mesh_part {
    uint32_t material; /* LSF_NONE: glTF's default */
    uint32_t vertex_count;
    const float *positions; /* 3 each */
    const float *normals;   /* 3 each; NULL: triangles are shaded flat */
    const float *tangents;  /* 4 each: unit tangent, and the bitangent's sign; NULL, or without
                             * normals: made where the material needs them */
    const float *uvs[2];    /* 2 each; NULL: none */
    const float *colors; /* 4 each, linear, 0 or more: base colour is multiplied by them; NULL: 1 */
    uint32_t index_count;    /* a multiple of 3 */
    const uint32_t *indices; /* below vertex_count; NULL, with index_count 0: vertices in order */
} lsf_mesh_part;

#define LSF_MESH_PART_DEFAULTS                                                                     \
    .material = LSF_NONE, .vertex_count = 0, .positions = NULL, .normals = NULL, .tangents = NULL, \
    .uvs = {NULL, NULL}, .colors = NULL, .index_count = 0, .indices = NULL

/* However many nodes place it, a mesh is stored once. */
uint32_t lsf_scene_add_mesh(lsf_scene *scene, const char *name, const lsf_mesh_part *parts,
                            uint32_t part_count, lsf_error *error);

/* A light shines from the nodes that carry it. */
uint32_t lsf_scene_add_light(lsf_scene *scene, const char *name, const lsf_light_desc *desc,
                             lsf_error *error);

typedef struct lsf_node_desc {
    const char *name;
    uint32_t parent;      /* a node that was added before; LSF_NONE: none */
    double matrix[16];    /* to its parent, column-major, as lsf_scene_set_node takes it */
    uint32_t mesh, light; /* LSF_NONE: none */
} lsf_node_desc;

#define LSF_NODE_DESC_DEFAULTS                                                                     \
    .name = NULL, .parent = LSF_NONE, .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},  \
    .mesh = LSF_NONE, .light = LSF_NONE

uint32_t lsf_scene_add_node(lsf_scene *scene, const lsf_node_desc *desc, lsf_error *error);

/* A camera looks along the -z of its node, whose +y is up. */
typedef struct lsf_camera_desc {
    const char *name;
    uint32_t node;    /* that carries it, and no other camera */
    float fov_y;      /* degrees, of a perspective camera */
    float height;     /* that the picture shows, scene units: makes it orthographic; else 0 */
    float near_plane; /* scene units, above 0; orthographic: or 0 */
} lsf_camera_desc;

#define LSF_CAMERA_DESC_DEFAULTS                                                                   \
    .name = NULL, .node = LSF_NONE, .fov_y = 45.0f, .height = 0.0f, .near_plane = 0.01f

/* Without any, committing adds one that frames the scene. */
uint32_t lsf_scene_add_camera(lsf_scene *scene, const lsf_camera_desc *desc, lsf_error *error);

/* Radiance from all around: uniform, or of a map with u = 0.5 + atan2(z, x) / 2 pi and the zenith
 * in the top row. */
typedef struct lsf_environment_desc {
    float radiance[3]; /* [W/(m^2 sr)], where there is no map */
    uint32_t width, height;
    const float *texels; /* 3 each, linear radiance; NULL: no map */
    float rotation;      /* about +y, degrees, anticlockwise seen from above */
} lsf_environment_desc;

/* In place of the one before, if there was any. */
bool lsf_scene_set_environment(lsf_scene *scene, const lsf_environment_desc *desc,
                               lsf_error *error);

/* Ends the building: checks the whole, adds a camera and light as lsf_scene_params says, and
 * computes what the scene requires. From then on it can be rendered and edited, and nothing be
 * added. A scene that could not be committed can only be destroyed. */
bool lsf_scene_commit(lsf_scene *scene, lsf_error *error);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
