#include "io/gltf_primitive.hpp"

#include "io/mesh_modules.h"

#include <algorithm>
#include <cinttypes>
#include <map>

/* KHR_draco_mesh_compression: primitives whose attributes and indices are stored as one compressed
 * mesh. Each accessor gets a buffer view of its own with what was decoded, so that whatever reads
 * it afterwards finds plain elements. */

namespace lsf
{

using tinygltf::Value;

/* Which part of which buffer view an accessor was decoded from; the indices have no attribute. */
static const int INDICES = -1;
using source_of_accessor = std::pair<int, int>;

struct draco_primitive {
    int view;
    std::map<int, int> attributes; /* accessor -> attribute's unique id */
    int indices;                   /* accessor */
};

static draco_primitive read_extension(const tinygltf::Primitive &primitive, const Value &extension,
                                      const std::string &location)
{
    draco_primitive result = {};
    result.view = extension.Get("bufferView").GetNumberAsInt();
    result.indices = primitive.indices;
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES || primitive.indices < 0)
        fail("COMPRESSED_DATA_INVALID", location,
             "only lists of triangles with indices are decompressed; export the file again");
    const Value &attributes = extension.Get("attributes");
    for (const std::string &name : attributes.Keys()) {
        int accessor = find_attribute(primitive, name.c_str());
        if (accessor >= 0)
            result.attributes[accessor] = attributes.Get(name).GetNumberAsInt();
    }
    if (result.attributes.empty())
        fail("COMPRESSED_DATA_INVALID", location, "none of its attributes is the primitive's");
    return result;
}

/* The file may hold the same data uncompressed, for readers without the extension. */
static bool must_be_decoded(const tinygltf::Model &model,
                            const std::map<int, source_of_accessor> &known,
                            const draco_primitive &primitive)
{
    auto is_compressed = [&](int accessor) {
        return model.accessors[(size_t)accessor].bufferView < 0 || known.count(accessor);
    };
    if (is_compressed(primitive.indices))
        return true;
    for (const auto &[accessor, id] : primitive.attributes)
        if (is_compressed(accessor))
            return true;
    return false;
}

static void set_view(tinygltf::Model &model, int accessor_index, tinygltf::Buffer &&buffer,
                     uint64_t count)
{
    tinygltf::BufferView view;
    view.buffer = (int)model.buffers.size();
    view.byteLength = buffer.data.size();
    model.buffers.push_back(std::move(buffer));
    tinygltf::Accessor &accessor = model.accessors[(size_t)accessor_index];
    accessor.bufferView = (int)model.bufferViews.size();
    accessor.byteOffset = 0;
    accessor.count = count;
    model.bufferViews.push_back(view);
}

/* The number of elements that all attributes declare. */
static uint32_t count_points(const tinygltf::Model &model, const draco_primitive &primitive,
                             const std::string &location)
{
    uint64_t count = model.accessors[(size_t)primitive.attributes.begin()->first].count;
    for (const auto &[accessor, id] : primitive.attributes)
        if (model.accessors[(size_t)accessor].count != count)
            fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", location,
                 "accessor %d has %zu elements, another one %" PRIu64, accessor,
                 model.accessors[(size_t)accessor].count, count);
    if (count >= UINT32_MAX)
        fail("ACCESSOR_TOO_LONG", location, "%" PRIu64 " vertices are more than an index can name",
             count);
    return (uint32_t)count;
}

static void decode_primitive(gltf_import &import, const draco_primitive &primitive,
                             const std::string &location)
{
    tinygltf::Model &model = import.model;
    lsf_error error;
    const lsf_draco_module *module = lsf_draco_module_get(&error);
    if (!module)
        fail("UNSUPPORTED_EXTENSION", location, "%s", error.message);

    const tinygltf::BufferView &view = model.bufferViews[(size_t)primitive.view];
    tinygltf::Accessor &indices = model.accessors[(size_t)primitive.indices];
    lsf_draco_request request = {};
    request.bytes = model.buffers[(size_t)view.buffer].data.data() + view.byteOffset;
    request.length = view.byteLength;
    request.point_count = count_points(model, primitive, location);
    if (indices.count > UINT32_MAX)
        fail("ACCESSOR_TOO_LONG", location, "%zu indices in one primitive", indices.count);
    request.triangle_count = (uint32_t)(indices.count / 3);

    std::vector<tinygltf::Buffer> buffers(primitive.attributes.size() + 1);
    std::vector<lsf_draco_output> outputs;
    for (const auto &[accessor_index, id] : primitive.attributes) {
        const tinygltf::Accessor &accessor = model.accessors[(size_t)accessor_index];
        lsf_draco_output output = {};
        output.unique_id = (uint32_t)id;
        output.width = (uint32_t)tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
        output.component_type = accessor.componentType;
        uint64_t size = output.width * (uint64_t)tinygltf::GetComponentSizeInBytes(
                                           (uint32_t)accessor.componentType);
        import.budget.take(request.point_count, size, location);
        std::vector<unsigned char> &data = buffers[outputs.size()].data;
        data.resize(request.point_count * size);
        output.values = data.data();
        outputs.push_back(output);
    }
    import.budget.take(request.triangle_count, 3 * sizeof(uint32_t), location);
    std::vector<unsigned char> &index_data = buffers.back().data;
    index_data.resize((uint64_t)request.triangle_count * 3 * sizeof(uint32_t));
    request.outputs = outputs.data();
    request.output_count = (uint32_t)outputs.size();
    request.indices = reinterpret_cast<uint32_t *>(index_data.data());
    request.memory_limit = import.budget.left();
    if (!module->decode(&request, &error))
        fail("COMPRESSED_DATA_INVALID", location, "%s; export the file again", error.message);
    if (request.point_count == 0 || request.triangle_count == 0)
        fail("COMPRESSED_DATA_INVALID", location, "there is no triangle in it");

    /* Encoders drop triangles without area and points that coincide, not always in the accessors.
     */
    size_t next = 0;
    for (const auto &[accessor, id] : primitive.attributes)
        set_view(model, accessor, std::move(buffers[next++]), request.point_count);
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    set_view(model, primitive.indices, std::move(buffers.back()),
             (uint64_t)request.triangle_count * 3);
}

/* Primitives may share accessors when they share the compressed mesh. */
static bool is_known(std::map<int, source_of_accessor> &known, const draco_primitive &primitive,
                     const std::string &location)
{
    std::map<int, int> parts = primitive.attributes;
    parts[primitive.indices] = INDICES;
    size_t found = 0;
    for (const auto &[accessor, part] : parts) {
        auto [entry, is_new] = known.insert({accessor, {primitive.view, part}});
        if (!is_new && entry->second != source_of_accessor(primitive.view, part))
            fail("COMPRESSED_DATA_INVALID", location,
                 "accessor %d belongs to another compressed mesh, too", accessor);
        found += !is_new;
    }
    return found == parts.size();
}

void gltf_draco_decode(gltf_import &import)
{
    std::map<int, source_of_accessor> known;
    for (size_t m = 0; m < import.model.meshes.size(); m++)
        for (size_t p = 0; import.mesh_used[m] && p < import.model.meshes[m].primitives.size();
             p++) {
            const tinygltf::Primitive &source = import.model.meshes[m].primitives[p];
            auto extension = source.extensions.find("KHR_draco_mesh_compression");
            if (extension == source.extensions.end())
                continue;
            std::string location = location_of("meshes", m) + "/primitives/" + std::to_string(p) +
                                   "/extensions/KHR_draco_mesh_compression";
            draco_primitive primitive = read_extension(source, extension->second, location);
            if (must_be_decoded(import.model, known, primitive) &&
                !is_known(known, primitive, location))
                decode_primitive(import, primitive, location);
        }
}

} // namespace lsf
