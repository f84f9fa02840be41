/* The scene as loaded: geometry in object space, a node hierarchy, materials, textures, lights,
 * cameras, animations, environment. Plain arrays, owned by lsf_scene. Everything has been
 * validated by the importer: indices are in range, floats are finite, the hierarchy is a forest. */
#ifndef LSF_SCENE_SCENE_H
#define LSF_SCENE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/build.h>
#include <lightsheaf/edit.h>
#include <lightsheaf/scene.h>

#include "scene/mesh_frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Vertex streams of all primitives, one after the other. `position` and `normal` always exist.
 * Texture coordinates exist when some material reads that set, colours when some primitive has
 * them; where a primitive lacks them they hold the stated default. */
typedef struct lsf_vertices {
    uint64_t count;
    float *position; /* 3 each, object space */
    float *normal;   /* 3 each, object space, unit length; flat where the file had none */
    float *tangent;  /* 4 each: unit tangent, and the bitangent's sign in w; only with normal maps
                      * or anisotropy; computed where the file had none; default 1,0,0,1 */
    float *uv0;      /* 2 each; default 0,0 */
    float *uv1;      /* 2 each; default 0,0 */
    float *color;    /* 4 each, linear; default 1,1,1,1 */
} lsf_vertices;

/* A list of triangles of one material. Indices count from the stream's start. */
typedef struct lsf_primitive {
    uint64_t first_index;
    uint32_t index_count; /* a multiple of 3 */
    uint64_t first_vertex;
    uint32_t vertex_count;
    uint32_t material;
    uint32_t deformer;                  /* the deformer that moves its vertices; LSF_NONE: none
                                         * does */
    float bounds_min[3], bounds_max[3]; /* object space, of the vertices that its triangles use */
} lsf_primitive;

typedef struct lsf_mesh {
    char *name; /* "" when the file gives none */
    uint32_t first_primitive, primitive_count;
} lsf_mesh;

typedef struct lsf_node {
    char *name;
    uint32_t parent; /* LSF_NONE: a root; otherwise smaller than the node's own index */
    uint32_t mesh, camera, light; /* LSF_NONE: none */
    bool has_matrix;              /* local transform is `matrix`, else T * R * S */
    double matrix[16];            /* column-major */
    double translation[3], rotation[4] /* x,y,z,w unit */, scale[3];
    uint32_t first_weight, weight_count; /* weights of its mesh's morph targets in scene->weights */
    bool edited; /* a program has set `matrix` (edit.c): animations leave it alone */
} lsf_node;

/* One primitive placed by one node. Instances of nodes outside the file's scene do not exist. */
typedef struct lsf_instance {
    uint32_t node, primitive;
} lsf_instance;

/* Joints that vertices follow. A joint brings a point from the mesh to the scene by its node's
 * transform times its inverse bind matrix (glTF 2.0, section 3.7.3). */
typedef struct lsf_skin {
    uint32_t first_joint, joint_count; /* in scene->joints; at least 1 */
} lsf_skin;

typedef struct lsf_joint {
    uint32_t node;
    float inverse_bind[16]; /* column-major, affine */
} lsf_joint;

/* How vertices at rest become others: by morph targets, then by joints. Deltas are those of one
 * target after the other, 3 floats a vertex; NULL: no target has any. */
typedef struct lsf_shape {
    uint32_t vertex_count;
    uint32_t target_count;
    float *position_deltas, *normal_deltas, *tangent_deltas;
    uint32_t influences; /* joints for each vertex; 0: no skin */
    uint16_t *joints;    /* indices into the skin's joints, `influences` a vertex, like the
                          * weights */
    float *weights;      /* 0 or more, and 1 in all for each vertex */
    bool flat; /* each triangle has vertices of its own, whose normals are recomputed as the
                * triangle's */
} lsf_shape;

/* Vertices that a node deforms. */
typedef struct lsf_deformer {
    uint32_t shape;
    uint32_t node; /* the node with the weights of the morph targets */
    uint32_t skin; /* LSF_NONE: the node's transform places the vertices, as for other meshes */
    uint64_t first_vertex;
} lsf_deformer;

/* Decoded pixels, rows from the top (glTF: uv 0,0 is the first texel's upper left corner). */
typedef struct lsf_texture_image {
    char *name; /* URI or "image N", for messages */
    uint32_t width, height;
    uint32_t channels; /* 1 to 4: grey, grey+alpha, RGB, RGBA */
    lsf_texel_type type;
    void *texels;        /* width * height * channels, tightly packed */
    uint64_t non_finite; /* NaN or Inf texels that were set to 0 */
} lsf_texture_image;

/* An image with its sampler and colour space. */
typedef struct lsf_texture {
    uint32_t image;
    lsf_wrap wrap_s, wrap_t;
    bool nearest; /* magFilter NEAREST */
    bool srgb;    /* colour channels hold sRGB-encoded values; alpha is linear */
} lsf_texture;

typedef struct lsf_texture_slot {
    uint32_t texture;   /* LSF_NONE: none */
    uint32_t uv_set;    /* 0 or 1 */
    float transform[6]; /* u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5 (KHR_texture_transform) */
    float offset[2], rotation, scale[2]; /* the file's parts of it, for animations of them */
} lsf_texture_slot;

/* glTF 2.0 metallic-roughness with the extensions that Lightsheaf reads. */
typedef struct lsf_material {
    char *name;
    float base_color[4];                         /* linear factor */
    float metallic, roughness;                   /* factors */
    float emission[3];                           /* radiance [W/(m^2 sr)] */
    float emissive_factor[3], emissive_strength; /* whose product it is in a file, for animations */
    float normal_scale;
    lsf_alpha_mode alpha_mode;
    float alpha_cutoff;
    bool double_sided; /* also emits from its back */
    bool unlit;        /* shown as emission of its base colour */
    bool has_tangents; /* vertices of its surfaces have tangents, read or computed */
    bool edited;       /* by a program: animations leave it alone */
    float ior;
    float specular, specular_color[3];     /* weight of the dielectric's reflection; tint of f0 */
    float sheen_color[3], sheen_roughness; /* factors */
    float coat, coat_roughness, coat_normal_scale; /* a clear coat; factors */
    float transmission;                            /* share of the light that is not reflected
                                                    * [1] */
    bool volume;                /* bounds a medium that light is refracted into; else a thin wall */
    bool open;                  /* ... and its triangles enclose nothing, as those of a plane */
    float attenuation_distance; /* distance after which white light has attenuation_color; scene
                                 * units */
    float attenuation_color[3];
    float anisotropy_strength, anisotropy_rotation; /* 0..1, radians from the tangent */
    lsf_texture_slot base_color_texture, metallic_roughness_texture, normal_texture,
        occlusion_texture, emissive_texture, anisotropy_texture, transmission_texture,
        specular_texture, specular_color_texture, coat_texture, coat_roughness_texture,
        coat_normal_texture, sheen_color_texture, sheen_roughness_texture;
} lsf_material;

/* KHR_lights_punctual. Placed by nodes; shines along the node's -z. */
typedef struct lsf_light {
    char *name;
    lsf_light_type type;
    float intensity[3];           /* W/sr, directional W/m^2 */
    float color[3], strength;     /* factors of intensity in a file, for animations */
    float range;                  /* scene units; INFINITY: none */
    float inner_cone, outer_cone; /* radians, spot only */
    bool edited;                  /* by a program: animations leave it alone */
} lsf_light;

typedef struct lsf_camera {
    char *name;
    uint32_t node;     /* LSF_NONE: `matrix` places it */
    double matrix[16]; /* column-major camera-to-scene, only when node is LSF_NONE */
    bool frames_scene; /* `matrix` gives only the orientation: position and near plane follow
                        * from the picture's aspect (framing.h) */
    bool orthographic;
    float fov_y;                            /* radians */
    float x_magnification, y_magnification; /* half width and height, scene units */
    float near_plane;                       /* scene units, > 0 (orthographic: >= 0) */
} lsf_camera;

typedef enum lsf_animation_path {
    LSF_PATH_TRANSLATION,
    LSF_PATH_ROTATION,
    LSF_PATH_SCALE,
    LSF_PATH_WEIGHTS, /* weights of all morph targets */
} lsf_animation_path;
typedef enum lsf_interpolation { LSF_STEP, LSF_LINEAR, LSF_CUBIC } lsf_interpolation;

/* Values over time. */
typedef struct lsf_curve {
    lsf_interpolation interpolation;
    uint32_t key_count;
    uint32_t width; /* values a key */
    float *times;   /* seconds, strictly increasing */
    float *values;  /* `width` values a key; cubic: in-tangent, value, out-tangent */
} lsf_curve;

typedef struct lsf_animation_channel {
    uint32_t node;
    lsf_animation_path path;
    uint32_t first_weight; /* first of the node's weights that it changes, for weights */
    lsf_curve curve;       /* of 3 values, 4 for a rotation, or as many as it changes weights */
} lsf_animation_channel;

/* A property of a material, a light, a camera, or the visibility of a node, that an animation
 * changes (animated.h). */
typedef struct lsf_animated_value {
    const struct lsf_property *property;
    uint32_t index; /* number of the material, light, camera or node */
    uint32_t slot;  /* a material's texture; LSF_NONE: the property is none of a texture's */
    uint32_t first; /* index among the values of all properties at one instant */
    lsf_curve curve;
} lsf_animated_value;

/* Radiance from outside. Direction to texel: u = 0.5 + atan2(z, x) / 2pi + u_offset,
 * v = acos(y) / pi from the top row. width == 0: uniform `radiance`. */
typedef struct lsf_environment {
    bool present;
    bool by_default; /* the sky of default_light.c */
    float radiance[3];
    float rotation; /* of the map about +y, anticlockwise seen from above, in degrees */
    float u_offset; /* the same in full rotations, 0..1 */
    uint32_t width, height;
    float *texels;  /* 3 each, linear radiance */
    float *given;   /* texels, or radiance, as they were before an edit scaled them; NULL: none */
    float strength; /* by which it did */
} lsf_environment;

/* A directional light that no node carries (default_light.c). */
typedef struct lsf_key_light {
    bool present;
    float irradiance;    /* of what faces it, grey [W/m^2] */
    double direction[3]; /* unit, the way it shines */
} lsf_key_light;

/* A point light that no node carries, in a room that the key light does not reach (default_lamp.h).
 */
typedef struct lsf_default_lamp {
    bool present;
    float intensity;    /* grey [W/sr] */
    double position[3]; /* scene units */
} lsf_default_lamp;

/* What a file offers to choose from, in its order. */
typedef struct lsf_choice {
    char *name; /* "" when the file gives none */
    bool chosen;
} lsf_choice;

typedef struct lsf_choices {
    uint32_t count;
    lsf_choice *items;
} lsf_choices;

/* An extension that the file says it uses. */
typedef struct lsf_extension {
    char *name;
    bool required; /* by the file, of whoever reads it */
    bool honoured; /* read as far as it has an effect on the picture */
} lsf_extension;

/* Counts of a program's edits by kind: whoever keeps something made of the scene can tell
 * whether it is out of date. */
typedef struct lsf_edits {
    uint64_t nodes, lights, materials;
    uint64_t environment; /* rotated or scaled */
    uint64_t radiance;    /* ... scaled */
    uint64_t movable;     /* number of nodes that were ever set, which may all move */
} lsf_edits;

/* Only what the chosen scene of the file uses: its nodes, the lights and cameras they carry, the
 * primitives of the meshes they place (other meshes are listed without any), the materials of
 * those, and the textures and images that those read. Primitives that share accessors share
 * vertices and indices, unless they are deformed. */
struct lsf_scene {
    char *path;
    lsf_vertices vertices;
    uint64_t index_count;
    uint32_t *indices;
    uint32_t primitive_count, mesh_count, node_count, instance_count, material_count;
    lsf_primitive *primitives;
    lsf_mesh *meshes;
    lsf_node *nodes; /* parents before children */
    lsf_instance *instances;
    lsf_material *materials; /* the last one is glTF's default material */
    uint32_t image_count, texture_count;
    lsf_texture_image *images;
    lsf_texture *textures;
    uint32_t light_count, camera_count, channel_count;
    lsf_light *lights;
    lsf_camera *cameras; /* at least 1: the last one frames the scene */
    lsf_animation_channel *channels;
    uint32_t animated_count, animated_width; /* width: of all their values */
    lsf_animated_value *animated;
    uint32_t skin_count, joint_count, shape_count, deformer_count, weight_count;
    lsf_skin *skins;
    lsf_joint *joints;
    lsf_shape *shapes;
    lsf_deformer *deformers;
    float *weights; /* of morph targets where no animation says otherwise; nodes may share them */
    lsf_environment environment;
    lsf_key_light key_light;
    lsf_default_lamp default_lamp;
    lsf_choices scenes, animations, variants;
    uint32_t extension_count;
    lsf_extension *extensions;
    uint32_t note_count;
    char **notes;
    bool note_lost; /* for want of memory: loading fails */
    bool diffuse_only, show_back_faces;
    uint64_t content[2]; /* hash of all bytes that it was loaded from; 0: none were */
    lsf_requirements requirements;
    lsf_edits edits;         /* made since it was loaded */
    struct lsf_draft *draft; /* of a scene that is being built (draft.h); NULL: it is whole */
    bool borrows; /* lsf_scene_without made it: only materials, nodes and notes are its own */
};

/* Takes more of the bytes that the scene is loaded from into its hash, in a fixed order. */
void lsf_scene_add_content(lsf_scene *scene, const void *bytes, size_t length);

/* Logs a warning and keeps it as a note. The same text is kept once, and a few hundred texts in
 * all. */
void lsf_scene_add_note(lsf_scene *scene, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* "3 normals of ..."; `what` is one of them. Nothing for 0. */
void lsf_scene_add_count_note(lsf_scene *scene, uint64_t count, const char *what,
                              const char *finding);
/* What was repaired of normals and tangents. */
void lsf_scene_note_frames(lsf_scene *scene, const lsf_frame_repairs *repairs);

/* Sets which instances an animation or a program moves or deforms: one bool for each. False without
 * memory. */
bool lsf_scene_moving_instances(const lsf_scene *scene, bool *moves);

/* Whether the camera sees only its front: of single-sided materials, as glTF asks (2.0,
 * section 3.9.6), but of none that transmits, whose far side is seen through the near one. Light
 * meets both sides of any surface, or it would leak through walls. */
bool lsf_material_hides_back(const lsf_scene *scene, const lsf_material *material);

/* Whether light passes it and no medium lies behind it. */
bool lsf_material_is_thin_wall(const lsf_material *material);
/* ... and it scatters: it is rougher than what lets light straight through. */
bool lsf_material_is_rough_wall(const lsf_material *material);

/* Finds the materials whose media are open. False without memory. */
bool lsf_scene_find_open_media(lsf_scene *scene);
/* Absorption coefficient of the medium that a material bounds, per unit of normalised space: exp(-a
 * d) of the light is left after the distance d (KHR_materials_volume, "Attenuation"). */
void lsf_scene_absorption(const lsf_scene *scene, const lsf_material *material,
                          float absorption[3]);

/* Makes blended materials opaque whose alpha is 1 wherever they are used: factor, texture and
 * vertex colours (alpha.c). */
void lsf_scene_settle_alpha(lsf_scene *scene);

/* Of one that lsf_scene_without has made. */
void lsf_scene_without_destroy(lsf_scene *scene);

/* Fills scene->requirements from what the instances use (requirements.c). False without memory. */
bool lsf_scene_compute_requirements(lsf_scene *scene);
/* The same after lights, materials or nodes were edited. What geometry says stays, and so does
 * normalised space: it is that of loading. */
bool lsf_scene_update_requirements(lsf_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
