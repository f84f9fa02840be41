/* Files at the boundary to C++ libraries; everything here has a C interface and lets no exception
 * out. */
#ifndef LSF_IO_IO_H
#define LSF_IO_IO_H

#include "base/base.h"
#include "scene/scene.h"
#include <lightsheaf/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The source of a scene. */
typedef struct lsf_gltf_source {
    const char *path; /* of the file; of memory the name for messages */
    const void *data; /* memory; NULL: the file */
    size_t size;
    const char *folder; /* of what memory refers to; NULL: nothing may be there */
} lsf_gltf_source;

/* glTF 2.0, .gltf or .glb, validated and converted (gltf_*.cpp). Requirements, default light and
 * default camera are the caller's. `scene` is zeroed before; on failure the caller destroys it.
 * `memory_left` gets what of the memory limit the scene does not take. */
bool lsf_gltf_load(lsf_scene *scene, const lsf_gltf_source *source, const lsf_scene_params *params,
                   uint64_t *memory_left, lsf_error *error);

/* Decodes PNG, JPEG, WebP, HDR or EXR from memory into `image` (name is kept). Type and channel
 * count as in the file (palettes expanded; half becomes F32). Non-finite texels are set to 0 and
 * counted. `byte_limit` bounds what decoding takes at any moment, checked before anything is
 * allocated. `name` is for messages. */
bool lsf_texture_image_decode(lsf_texture_image *image, const void *bytes, size_t length,
                              uint64_t byte_limit, const char *name, lsf_error *error);

/* Reads a lat-long environment; negative values are set to 0 and non-finite ones too, with a
 * count of both in *repaired. `byte_limit` bounds what it takes at any moment. */
bool lsf_environment_load(lsf_environment *environment, const char *path, uint64_t byte_limit,
                          uint64_t *repaired, lsf_error *error);

/* Largest width or height of any image that is read or written, and most bytes of one decoded. */
#define LSF_IMAGE_MAX_SIZE 65535u
#define LSF_IMAGE_MAX_BYTES ((uint64_t)2 << 30)

#ifdef __cplusplus
}
#endif
#endif
