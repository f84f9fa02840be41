#include "io/gltf_primitive.hpp"

#include <algorithm>
#include <cinttypes>

namespace lsf
{

bool mode_is_triangles(int mode)
{
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

int find_attribute(const tinygltf::Primitive &primitive, const char *name)
{
    auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

/* --- vertex arrays --- */

static void gather_stream(std::vector<float> &stream, size_t width,
                          const std::vector<uint32_t> &sources)
{
    if (stream.empty())
        return;
    std::vector<float> gathered(sources.size() * width);
    for (size_t i = 0; i < sources.size(); i++)
        std::copy_n(&stream[sources[i] * width], width, &gathered[i * width]);
    stream = std::move(gathered);
}

void vertex_arrays::gather(const std::vector<uint32_t> &from)
{
    gather_stream(position, 3, from);
    gather_stream(normal, 3, from);
    gather_stream(tangent, 4, from);
    gather_stream(uv0, 2, from);
    gather_stream(uv1, 2, from);
    gather_stream(color, 4, from);
    std::vector<uint32_t> gathered(from.size());
    for (size_t i = 0; i < from.size(); i++)
        gathered[i] = source(from[i]);
    sources = std::move(gathered);
    count = from.size();
}

static void append_stream(std::vector<float> &stream, size_t width, const uint32_t *sources,
                          uint64_t count)
{
    if (stream.empty())
        return;
    size_t first = stream.size();
    stream.resize(first + count * width);
    for (uint64_t i = 0; i < count; i++)
        std::copy_n(&stream[sources[i] * width], width, &stream[first + i * width]);
}

void vertex_arrays::append_copies(const uint32_t *from, uint64_t copies)
{
    append_stream(position, 3, from, copies);
    append_stream(normal, 3, from, copies);
    append_stream(tangent, 4, from, copies);
    append_stream(uv0, 2, from, copies);
    append_stream(uv1, 2, from, copies);
    append_stream(color, 4, from, copies);
    if (sources.empty()) {
        sources.resize(count);
        for (uint64_t i = 0; i < count; i++)
            sources[i] = (uint32_t)i;
    }
    for (uint64_t i = 0; i < copies; i++)
        sources.push_back(sources[from[i]]);
    count += copies;
}

/* --- attributes --- */

enum format : unsigned {
    FLOAT = 1,
    SIGNED = 2, /* integers as they are: KHR_mesh_quantization */
    UNSIGNED = 4,
    SIGNED_NORMALIZED = 8,
    UNSIGNED_NORMALIZED = 16,
};

static unsigned format_of(const tinygltf::Accessor &accessor)
{
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return FLOAT;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return accessor.normalized ? SIGNED_NORMALIZED : SIGNED;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return accessor.normalized ? UNSIGNED_NORMALIZED : UNSIGNED;
    default:
        return 0;
    }
}

static const unsigned ANY_FORMAT =
    FLOAT | SIGNED | UNSIGNED | SIGNED_NORMALIZED | UNSIGNED_NORMALIZED;

struct attribute {
    const char *name;
    int type, other_type; /* TINYGLTF_TYPE_VEC3, ... */
    unsigned formats;
    bool direction;
};
static const attribute position_attribute = {"POSITION", TINYGLTF_TYPE_VEC3, 0, ANY_FORMAT, false};
static const attribute normal_attribute = {"NORMAL", TINYGLTF_TYPE_VEC3, 0,
                                           FLOAT | SIGNED_NORMALIZED, true};
static const attribute tangent_attribute = {"TANGENT", TINYGLTF_TYPE_VEC4, 0,
                                            FLOAT | SIGNED_NORMALIZED, true};
static const attribute uv0_attribute = {"TEXCOORD_0", TINYGLTF_TYPE_VEC2, 0, ANY_FORMAT, false};
static const attribute uv1_attribute = {"TEXCOORD_1", TINYGLTF_TYPE_VEC2, 0, ANY_FORMAT, false};
static const attribute color_attribute = {"COLOR_0", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4,
                                          FLOAT | UNSIGNED_NORMALIZED, false};

static bool read_attribute(gltf_import &import, const tinygltf::Primitive &primitive,
                           const attribute &wanted, uint64_t count, const std::string &location,
                           std::vector<float> &values)
{
    int index = find_attribute(primitive, wanted.name);
    if (index < 0)
        return false;
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)index];
    std::string where = location + "/attributes/" + wanted.name;
    if ((accessor.type != wanted.type && accessor.type != wanted.other_type) ||
        !(format_of(accessor) & wanted.formats))
        fail("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", where,
             "accessor %d is %s, which this attribute cannot be", index,
             accessor_format(accessor).c_str());
    if (accessor.count != count)
        fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", where,
             "accessor %d has %zu elements, POSITION has %" PRIu64, index, accessor.count, count);
    (wanted.direction ? accessor_read_directions : accessor_read_floats)(import, index, values);
    return true;
}

static void widen_colors(std::vector<float> &colors, uint64_t count)
{
    if (colors.size() == count * 4)
        return;
    std::vector<float> widened(count * 4);
    for (uint64_t i = 0; i < count; i++) {
        std::copy_n(&colors[i * 3], 3, &widened[i * 4]);
        widened[i * 4 + 3] = 1.0f;
    }
    colors = std::move(widened);
}

uint64_t vertex_bytes(const stream_choice &streams)
{
    return sizeof(float) * (6 + (streams.tangent ? 4 : 0) + (streams.uv0 ? 2 : 0) +
                            (streams.uv1 ? 2 : 0) + (streams.color ? 4 : 0));
}

vertex_arrays read_vertices(gltf_import &import, const tinygltf::Primitive &primitive,
                            const stream_choice &streams, const std::string &location,
                            memory_loan &loan)
{
    vertex_arrays arrays;
    int position = find_attribute(primitive, "POSITION");
    arrays.count = import.model.accessors[(size_t)position].count;
    if (arrays.count >= UINT32_MAX)
        fail("ACCESSOR_TOO_LONG", location, "%" PRIu64 " vertices are more than an index can name",
             arrays.count);
    import.budget.take(arrays.count, vertex_bytes(streams), location);
    loan.take(arrays.count, vertex_bytes(streams));
    if (streams.color)
        loan.take(arrays.count, 3 * sizeof(float)); /* those without alpha are copied once */

    read_attribute(import, primitive, position_attribute, arrays.count, location, arrays.position);
    bool normals =
        read_attribute(import, primitive, normal_attribute, arrays.count, location, arrays.normal);
    /* glTF: tangents without normals are to be ignored. */
    if (streams.tangent && normals)
        read_attribute(import, primitive, tangent_attribute, arrays.count, location,
                       arrays.tangent);
    if (streams.uv0)
        read_attribute(import, primitive, uv0_attribute, arrays.count, location, arrays.uv0);
    if (streams.uv1)
        read_attribute(import, primitive, uv1_attribute, arrays.count, location, arrays.uv1);
    if (streams.color &&
        read_attribute(import, primitive, color_attribute, arrays.count, location, arrays.color))
        widen_colors(arrays.color, arrays.count);
    for (float &color : arrays.color) {
        import.repairs.negative_colors += color < 0.0f;
        color = std::max(color, 0.0f);
    }
    return arrays;
}

/* --- triangles --- */

std::vector<uint32_t> read_triangles(gltf_import &import, const tinygltf::Primitive &primitive,
                                     uint64_t vertex_count, const std::string &location,
                                     memory_loan &loan)
{
    uint64_t source_count = primitive.indices >= 0
                                ? import.model.accessors[(size_t)primitive.indices].count
                                : vertex_count;
    bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    uint64_t triangle_count = list ? source_count / 3 : source_count < 3 ? 0 : source_count - 2;
    if (triangle_count > UINT32_MAX / 3)
        fail("ACCESSOR_TOO_LONG", location, "%" PRIu64 " triangles in one primitive",
             triangle_count);
    import.budget.take(triangle_count, 3 * sizeof(uint32_t), location);
    loan.take(source_count, sizeof(uint32_t));
    if (!list)
        loan.take(triangle_count, 3 * sizeof(uint32_t));
    if (list)
        import.repairs.trailing_indices += source_count % 3;

    std::vector<uint32_t> sources;
    if (primitive.indices >= 0) {
        accessor_read_indices(import, primitive.indices, vertex_count,
                              list ? &import.repairs.highest_indices : nullptr, sources);
    } else {
        sources.resize(vertex_count);
        for (uint64_t i = 0; i < vertex_count; i++)
            sources[i] = (uint32_t)i;
    }
    if (list) {
        sources.resize(triangle_count * 3);
        return sources;
    }
    std::vector<uint32_t> triangles(triangle_count * 3);
    bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (uint64_t i = 0; i < triangle_count; i++) {
        uint32_t *t = &triangles[3 * i];
        t[0] = sources[fan ? i + 1 : i];
        t[1] = sources[fan ? i + 2 : i + 1 + i % 2];
        t[2] = sources[fan ? 0 : i + 2 - i % 2];
    }
    return triangles;
}

} // namespace lsf
