#include "io/gltf_import.hpp"

#include "io/mesh_modules.h"

#include <algorithm>
#include <cinttypes>

/* EXT_meshopt_compression and KHR_meshopt_compression: buffer views that are stored compressed in
 * another place. Each becomes a view of a buffer of its own, so that whatever reads it afterwards
 * finds plain elements. */

namespace lsf
{

using tinygltf::Value;

static uint64_t number_in(const Value &extension, const char *key)
{
    return extension.Has(key) ? (uint64_t)extension.Get(key).GetNumberAsDouble() : 0;
}

/* Index of the text among `names`, or 0 where the extension does not have it. */
static int index_in(const Value &extension, const char *key,
                    std::initializer_list<const char *> names)
{
    if (!extension.Has(key))
        return 0;
    const std::string &text = extension.Get(key).Get<std::string>();
    auto found = std::find(names.begin(), names.end(), text);
    return (int)(found - names.begin());
}

static void decode_view(gltf_import &import, size_t index, const Value &extension,
                        const std::string &location)
{
    tinygltf::Model &model = import.model;
    const tinygltf::Buffer &source = model.buffers[number_in(extension, "buffer")];
    uint64_t offset = number_in(extension, "byteOffset");
    lsf_error error;
    const lsf_meshopt_module *module = lsf_meshopt_module_get(&error);
    if (!module)
        fail("UNSUPPORTED_EXTENSION", location, "%s", error.message);

    uint64_t size = model.bufferViews[index].byteLength;
    import.budget.take(size, 1, location);
    tinygltf::Buffer decoded;
    decoded.data.resize(size);
    lsf_meshopt_request request = {};
    request.bytes = source.data.data() + offset;
    request.length = number_in(extension, "byteLength");
    request.count = number_in(extension, "count");
    request.stride = (uint32_t)number_in(extension, "byteStride");
    request.mode =
        (lsf_meshopt_mode)index_in(extension, "mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    request.filter = (lsf_meshopt_filter)index_in(
        extension, "filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    request.output = decoded.data.data();
    if (!module->decode(&request, &error))
        fail("COMPRESSED_DATA_INVALID", location, "%s; export the file again", error.message);

    model.buffers.push_back(std::move(decoded));
    tinygltf::BufferView &view = model.bufferViews[index];
    view.buffer = (int)model.buffers.size() - 1;
    view.byteOffset = 0;
    view.byteStride = request.mode == LSF_MESHOPT_ATTRIBUTES ? request.stride : 0;
}

/* The file may hold the same data uncompressed, for readers without the extension. */
static bool must_be_decoded(const gltf_import &import, const tinygltf::BufferView &view,
                            const char *extension)
{
    const std::vector<std::string> &required = import.model.extensionsRequired;
    return import.placeholders[(size_t)view.buffer] ||
           std::find(required.begin(), required.end(), extension) != required.end();
}

void gltf_meshopt_decode(gltf_import &import)
{
    std::vector<tinygltf::BufferView> &views = import.model.bufferViews;
    for (size_t i = 0; i < views.size(); i++) {
        const char *name = nullptr;
        for (const char *candidate : MESHOPT_EXTENSIONS)
            if (!name && views[i].extensions.count(candidate))
                name = candidate;
        if (name && must_be_decoded(import, views[i], name))
            decode_view(import, i, views[i].extensions.at(name),
                        location_of("bufferViews", i) + "/extensions/" + name);
        else if (import.placeholders[(size_t)views[i].buffer] && views[i].byteLength > 0)
            fail("UNDEFINED_PROPERTY", location_of("bufferViews", i),
                 "buffer %d has no data, and the view does not say where they are; export the file "
                 "again",
                 views[i].buffer);
    }
}

} // namespace lsf
