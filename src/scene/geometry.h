/* The vertices and indices of a scene while they grow. */
#ifndef LSF_SCENE_GEOMETRY_H
#define LSF_SCENE_GEOMETRY_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A stream of lsf_vertices. */
typedef struct lsf_stream {
    bool present; /* whether it is stored */
    float **array;
    uint32_t width;
    uint64_t capacity;  /* floats */
    float otherwise[4]; /* value of vertices that have none */
} lsf_stream;

typedef enum lsf_stream_kind {
    LSF_STREAM_POSITION,
    LSF_STREAM_NORMAL,
    LSF_STREAM_TANGENT,
    LSF_STREAM_UV0,
    LSF_STREAM_UV1,
    LSF_STREAM_COLOR,
    LSF_STREAM_COUNT
} lsf_stream_kind;

typedef struct lsf_geometry {
    lsf_stream streams[LSF_STREAM_COUNT];
    uint64_t index_capacity;
} lsf_geometry;

/* The streams of an empty scene: positions and normals are present, others are not. */
void lsf_geometry_begin(lsf_geometry *geometry, lsf_scene *scene);

/* Space for `count` vertices, at least 1, from `first` on, in a stream that is present; NULL
 * without memory. */
float *lsf_stream_grow(lsf_stream *stream, uint64_t first, uint64_t count);
/* Appends `count` vertices at `first`; NULL: the default for each. False without memory; does
 * nothing where the stream is not present. */
bool lsf_stream_append(lsf_stream *stream, uint64_t first, uint64_t count, const float *values);
/* Space for that many more indices, at least 1, which are counted from then on; NULL without
 * memory. */
uint32_t *lsf_geometry_grow_indices(lsf_geometry *geometry, lsf_scene *scene, uint64_t count);

/* Appends a list of triangles whose indices count from the primitive's first vertex, and finds the
 * bounds of what they use. False without memory. */
bool lsf_geometry_append_triangles(lsf_geometry *geometry, lsf_scene *scene,
                                   const uint32_t *triangles, uint32_t index_count,
                                   lsf_primitive *primitive);

#ifdef __cplusplus
}
#endif
#endif
