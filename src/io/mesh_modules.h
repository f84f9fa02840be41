/* The C interfaces of the modules lightsheaf-draco and lightsheaf-meshopt, which decompress meshes.
 * Each is loaded when the first file needs it. */
#ifndef LSF_IO_MESH_MODULES_H
#define LSF_IO_MESH_MODULES_H

#include "base/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- KHR_draco_mesh_compression --- */

/* The output for an attribute of the mesh. */
typedef struct lsf_draco_output {
    uint32_t unique_id; /* the attribute's, in the compressed mesh */
    uint32_t width;     /* components */
    int component_type; /* glTF's code: 5120 BYTE to 5126 FLOAT */
    void *values;       /* room for point_count * width components */
} lsf_draco_output;

typedef struct lsf_draco_request {
    const void *bytes;
    size_t length;
    uint64_t memory_limit; /* bytes that decoding may take beside the outputs */
    /* On entry the sizes of the outputs, on return the numbers decoded. */
    uint32_t point_count, triangle_count;
    lsf_draco_output *outputs;
    uint32_t output_count;
    uint32_t *indices; /* room for 3 * triangle_count */
} lsf_draco_request;

typedef struct lsf_draco_module {
    /* Indices are not compared with the number of points. The message says what is wrong with
     * the data. */
    bool (*decode)(lsf_draco_request *request, lsf_error *error);
} lsf_draco_module;

/* --- EXT_meshopt_compression, KHR_meshopt_compression --- */

typedef enum lsf_meshopt_mode {
    LSF_MESHOPT_ATTRIBUTES,
    LSF_MESHOPT_TRIANGLES,
    LSF_MESHOPT_INDICES,
} lsf_meshopt_mode;

typedef enum lsf_meshopt_filter {
    LSF_MESHOPT_NONE,
    LSF_MESHOPT_OCTAHEDRAL,
    LSF_MESHOPT_QUATERNION,
    LSF_MESHOPT_EXPONENTIAL,
} lsf_meshopt_filter;

typedef struct lsf_meshopt_request {
    const void *bytes;
    size_t length;
    uint64_t count;  /* elements */
    uint32_t stride; /* bytes of each, as the mode and the filter allow */
    lsf_meshopt_mode mode;
    lsf_meshopt_filter filter;
    void *output; /* count * stride bytes */
} lsf_meshopt_request;

typedef struct lsf_meshopt_module {
    bool (*decode)(const lsf_meshopt_request *request, lsf_error *error);
} lsf_meshopt_module;

/* --- loading --- */

/* Load the module on the first call; safe from any thread. NULL with LSF_ERROR_FILE when it is not
 * installed. */
const lsf_draco_module *lsf_draco_module_get(lsf_error *error);
const lsf_meshopt_module *lsf_meshopt_module_get(lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
