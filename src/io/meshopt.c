/* The module lightsheaf-meshopt: compressed buffer views by the meshoptimizer library, whose
 * decoders are made for untrusted input. They write count * stride bytes and allocate nothing. */
#include "io/mesh_modules.h"

#include <meshoptimizer.h>

/* Preconditions of the library. The limits are those of the extension. */
static bool is_allowed(const lsf_meshopt_request *request)
{
    uint32_t stride = request->stride;
    if (request->mode != LSF_MESHOPT_ATTRIBUTES)
        return (stride == 2 || stride == 4) && request->filter == LSF_MESHOPT_NONE &&
               (request->mode != LSF_MESHOPT_TRIANGLES || request->count % 3 == 0);
    if (stride == 0 || stride > 256 || stride % 4 != 0)
        return false;
    return request->filter == LSF_MESHOPT_OCTAHEDRAL   ? stride == 4 || stride == 8
           : request->filter == LSF_MESHOPT_QUATERNION ? stride == 8
                                                       : true;
}

static void undo_filter(const lsf_meshopt_request *request)
{
    if (request->filter == LSF_MESHOPT_OCTAHEDRAL)
        meshopt_decodeFilterOct(request->output, request->count, request->stride);
    else if (request->filter == LSF_MESHOPT_QUATERNION)
        meshopt_decodeFilterQuat(request->output, request->count, request->stride);
    else if (request->filter == LSF_MESHOPT_EXPONENTIAL)
        meshopt_decodeFilterExp(request->output, request->count, request->stride);
}

static bool decode(const lsf_meshopt_request *request, lsf_error *error)
{
    if (!is_allowed(request))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "elements of %u bytes cannot have this mode and filter",
                             request->stride);
    int status = -1;
    switch (request->mode) {
    case LSF_MESHOPT_ATTRIBUTES:
        status = meshopt_decodeVertexBuffer(request->output, request->count, request->stride,
                                            request->bytes, request->length);
        break;
    case LSF_MESHOPT_TRIANGLES:
        status = meshopt_decodeIndexBuffer(request->output, request->count, request->stride,
                                           request->bytes, request->length);
        break;
    case LSF_MESHOPT_INDICES:
        status = meshopt_decodeIndexSequence(request->output, request->count, request->stride,
                                             request->bytes, request->length);
        break;
    }
    if (status != 0)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "the compressed bytes are damaged, or their version, %d, is later "
                             "than what meshoptimizer %d.%d reads",
                             request->length ? ((const unsigned char *)request->bytes)[0] & 15 : 0,
                             MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION / 10 % 100);
    undo_filter(request);
    return true;
}

__attribute__((visibility("default"))) const lsf_meshopt_module lsf_meshopt = {decode};
