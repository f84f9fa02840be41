/* Scenes: the contents of a glTF file, and its requirements of a renderer. */
#ifndef LIGHTSHEAF_SCENE_H
#define LIGHTSHEAF_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef struct lsf_scene lsf_scene;

#define LSF_NONE UINT32_MAX /* no such index */

/* Condition for adding a soft sky and a key light, and, where the file has no lamp and these two do
 * not reach what its first camera shows, a point light. */
typedef enum lsf_default_light {
    LSF_DEFAULT_LIGHT_AUTO,   /* when the file has no light, its emissive materials do not light it,
                               * and no environment is given; with a note */
    LSF_DEFAULT_LIGHT_ALWAYS, /* also beside the file's lights; a given environment replaces the
                               * sky */
    LSF_DEFAULT_LIGHT_NEVER,
} lsf_default_light;

typedef struct lsf_scene_params {
    const char *environment_path;      /* lat-long .hdr or .exr; NULL: none */
    const float *environment_radiance; /* three floats, uniform radiance [W/(m^2 sr)]; NULL: none */
    float environment_rotation; /* of the environment about +y, degrees, anticlockwise seen from
                                 * above */
    float environment_strength; /* factor on its radiance, at least 0 */
    lsf_default_light default_light;
    bool diffuse_only;     /* read every material as Lambertian with its base colour, without normal
                            * maps */
    bool show_back_faces;  /* show single-sided materials from behind, too; glTF hides their back
                            * faces from cameras. For light they are two-sided either way */
    bool lenient;          /* ignore required extensions that affect appearance alone, leave out
                            * images whose files do not exist, and clamp factors to 0 to 1, with
                            * notes; else these are errors, but for factors beyond by rounding */
    uint64_t memory_limit; /* bytes that loading may use at any moment: document, buffers,
                            * geometry, decoded images, and temporary memory */
    const char *name; /* of a scene from memory, in messages and descriptions; NULL: "memory" */
    /* A name, or an index from 0, of something in the file; names take precedence. */
    const char *scene;             /* NULL: the file's default, else the first */
    const char *variant;           /* KHR_materials_variants; NULL: the file's own materials */
    const char *const *animations; /* those that play; NULL: all */
    uint32_t animation_count;
    const struct lsf_placed_light *lights; /* in addition to the file's lights: edit.h; they get
                                            * nodes of their own, the last ones */
    uint32_t light_count;
} lsf_scene_params;

#define LSF_SCENE_PARAMS_DEFAULTS                                                                  \
    .environment_path = NULL, .environment_radiance = NULL, .environment_rotation = 0.0f,          \
    .environment_strength = 1.0f, .default_light = LSF_DEFAULT_LIGHT_AUTO, .diffuse_only = false,  \
    .show_back_faces = false, .lenient = false, .memory_limit = (uint64_t)8 << 30, .name = NULL,   \
    .scene = NULL, .variant = NULL, .animations = NULL, .animation_count = 0, .lights = NULL,      \
    .light_count = 0

/* Loads .gltf or .glb with its buffers and textures (paths confined to the file's folder), and
 * the environment. Ignored parts are each logged as a warning and kept for lsf_scene_note. The
 * caller destroys it. LSF_ERROR_FILE names file, JSON location and cause; LSF_ERROR_USAGE names
 * an invalid choice, and the valid ones. */
lsf_scene *lsf_scene_load(const char *path, const lsf_scene_params *params, lsf_error *error);

/* The same for the content of a .gltf or .glb in memory, borrowed until it returns; it counts
 * against the memory limit as a file's content does. Buffers and textures in separate files are
 * read from `folder`; with NULL there may be none. */
lsf_scene *lsf_scene_load_memory(const void *data, size_t size, const char *folder,
                                 const lsf_scene_params *params, lsf_error *error);
void lsf_scene_destroy(lsf_scene *scene); /* NULL allowed */

/* 32 hexadecimal digits and a NUL, a hash of all bytes that the scene was loaded from: its file,
 * the buffers and images that it names, the environment. Equal files have equal hashes wherever
 * they are; lsf_scene_params (except the environment's map) and edits do not count. False for a
 * scene built in code. */
bool lsf_scene_content_hash(const lsf_scene *scene, char hash[33]);

/* The scene's requirements of a renderer; computed once, at load. */
typedef struct lsf_requirements {
    uint32_t point_lights, spot_lights, directional_lights;
    bool environment;     /* there is radiance from outside the scene */
    bool environment_map; /* ... and varies with direction */
    bool emissive;        /* some visible material emits */
    bool unlit;           /* some visible material is KHR_materials_unlit */
    bool specular;        /* materials have a specular lobe at all (not diffuse_only) */
    bool glossy;          /* some roughness < 1 or metallic > 0, by factor or texture */
    bool smooth_metal;    /* some metallic >= 1/2 at a roughness below 0.71, likewise */
    bool anisotropic;     /* KHR_materials_anisotropy with strength > 0 */
    bool transmissive;    /* KHR_materials_transmission with factor > 0 */
    bool refractive;      /* ... on the surface of a medium: KHR_materials_volume */
    bool thin_walls;      /* ... on one that does not bound a medium */
    bool rough_walls;     /* ... and is rough: it scatters what it transmits */
    uint32_t bounces;     /* of light that show the scene as expected: 3, and 4 more where
                           * materials transmit, for the two sides of each of a hollow vessel's
                           * two walls */
    bool variable_ior;    /* some dielectric has another index than 1.5 */
    bool sheened;         /* KHR_materials_sheen with a color above 0 */
    bool coated;          /* KHR_materials_clearcoat with factor > 0 */
    bool specular_varied; /* KHR_materials_specular with factors or textures that have an effect */
    bool masked;          /* alphaMode MASK */
    bool blended;         /* alphaMode BLEND, where some alpha is below 1 */
    bool normal_mapped;
    bool smooth; /* some vertex normal differs from its triangle's */
    bool base_color_textured, metallic_roughness_textured, emissive_textured;
    bool anisotropy_textured, transmission_textured;
    bool specular_textured, specular_color_textured;
    bool sheen_color_textured, sheen_roughness_textured;
    bool coat_textured, coat_roughness_textured, coat_normal_mapped;
    bool texture_transformed; /* KHR_texture_transform other than identity */
    bool second_uv;           /* some texture in use reads TEXCOORD_1 */
    bool vertex_colored;
    bool skinned, morphed;         /* some vertices follow joints; morph targets */
    bool moving;                   /* some geometry, light or camera is animated */
    uint64_t triangles;            /* of all instances */
    uint64_t unique_triangles;     /* stored once each */
    uint64_t degenerate_triangles; /* without area; they are included above, and not drawn */
    uint64_t vertices;             /* stored */
    uint32_t instances, primitives, materials, textures;
    double center[3]; /* scene units (metres): centre of the normalised space */
    double scale;     /* power of two: normalised = (position - center) * scale */
    double bounds_min[3], bounds_max[3]; /* scene units, at the load time; min > max when empty */
} lsf_requirements;

/* NULL for a scene that is still being built (build.h). */
const lsf_requirements *lsf_scene_get_requirements(const lsf_scene *scene);

/* Features of a scene that cost rendering time or memory. */
typedef enum lsf_feature {
    LSF_FEATURE_EMISSION,
    LSF_FEATURE_UNLIT,
    LSF_FEATURE_MASKS, /* alphaMode MASK */
    LSF_FEATURE_BLENDING,
    LSF_FEATURE_ROUGHNESS_METALLIC, /* roughness and metallic, and lobes that depend on them: coats,
                                     * sheens */
    LSF_FEATURE_NORMAL_MAPS,        /* of coats, too */
    LSF_FEATURE_ANISOTROPY,
    LSF_FEATURE_TINTED_REFLECTION, /* KHR_materials_specular and _ior */
    LSF_FEATURE_COATS,
    LSF_FEATURE_SHEENS,
    LSF_FEATURE_TRANSMISSION,
    LSF_FEATURE_TEXTURES,
    LSF_FEATURE_VERTEX_COLORS,
    LSF_FEATURE_LIGHTS, /* punctual, and the key light */
    LSF_FEATURE_ENVIRONMENT_MAP,
    LSF_FEATURE_ENVIRONMENT,
    LSF_FEATURE_MOTION, /* animations */
    LSF_FEATURE_COUNT,
} lsf_feature;

const char *lsf_feature_name(lsf_feature feature); /* "normal maps"; NULL past the end */
bool lsf_scene_has(const lsf_scene *scene, lsf_feature feature);
/* The same scene without a feature, to measure its cost: blended and masked materials become
 * opaque, an environment map uniform. It borrows from `scene`, which is unchanged and has to
 * outlive it. NULL with LSF_ERROR_USAGE where an animation brings the feature back. */
lsf_scene *lsf_scene_without(const lsf_scene *scene, lsf_feature feature, lsf_error *error);

/* Those of the file or the program, in their order, then "default", which frames the scene. */
uint32_t lsf_scene_camera_count(const lsf_scene *scene); /* at least 1 */
const char *lsf_scene_camera_name(const lsf_scene *scene, uint32_t index);

/* Seconds until the last key of its animations; 0 without animations. */
double lsf_scene_duration(const lsf_scene *scene);

/* Parts that were ignored or repaired while loading, one sentence each. */
uint32_t lsf_scene_note_count(const lsf_scene *scene);
const char *lsf_scene_note(const lsf_scene *scene, uint32_t index);

/* Describes the contents of the file, ignored parts, and requirements; as text or JSON.
 * malloc'ed; NULL when memory is exhausted, and for a scene that is still being built. */
char *lsf_scene_describe(const lsf_scene *scene, bool json);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
