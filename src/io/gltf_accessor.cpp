#include "io/gltf_import.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstring>

namespace lsf
{

/* Elements in a buffer, checked to lie inside it. */
struct element_span {
    const unsigned char *data; /* NULL: all zeros */
    uint64_t stride;
};

static uint64_t component_size(int type)
{
    return (uint64_t)tinygltf::GetComponentSizeInBytes((uint32_t)type);
}

static const char *component_name(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return "BYTE";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return "UNSIGNED_BYTE";
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return "SHORT";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return "UNSIGNED_SHORT";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return "UNSIGNED_INT";
    default:
        return "FLOAT";
    }
}

std::string accessor_format(const tinygltf::Accessor &accessor)
{
    const char *type = accessor.type == TINYGLTF_TYPE_SCALAR ? "SCALAR"
                       : accessor.type == TINYGLTF_TYPE_VEC2 ? "VEC2"
                       : accessor.type == TINYGLTF_TYPE_VEC3 ? "VEC3"
                       : accessor.type == TINYGLTF_TYPE_VEC4 ? "VEC4"
                                                             : "MAT";
    return std::string(type) + " of " + (accessor.normalized ? "normalised " : "") +
           component_name(accessor.componentType);
}

/* Checks that `count` elements of `size` bytes lie inside the buffer view. The schema check
 * compared the view with its buffer. */
static element_span find_elements(const gltf_import &import, int view_index, uint64_t offset,
                                  uint64_t count, uint64_t size, const std::string &location)
{
    const tinygltf::BufferView &view = import.model.bufferViews[(size_t)view_index];
    const tinygltf::Buffer &buffer = import.model.buffers[(size_t)view.buffer];
    uint64_t stride = view.byteStride ? view.byteStride : size;
    if (stride < size)
        fail("ACCESSOR_SMALL_BYTESTRIDE", location,
             "elements of %" PRIu64 " bytes stand %" PRIu64 " bytes apart", size, stride);
    uint64_t length;
    if (__builtin_mul_overflow(count - 1, stride, &length) ||
        __builtin_add_overflow(length, size, &length) ||
        __builtin_add_overflow(length, offset, &length) || length > view.byteLength)
        fail("ACCESSOR_TOO_LONG", location,
             "%" PRIu64 " elements from byte %" PRIu64 " on do not fit into buffer view %d of %zu "
             "bytes",
             count, offset, view_index, view.byteLength);
    return {buffer.data.data() + view.byteOffset + offset, stride};
}

template <typename T> static T load(const unsigned char *bytes)
{
    T value;
    memcpy(&value, bytes, sizeof(T)); /* glTF and all supported machines are little-endian */
    return value;
}

/* Section 3.11 of glTF 2.0; the divisions are exact up to the last rounding. */
template <typename T> static float to_float(T value, bool normalized)
{
    if constexpr (std::is_floating_point_v<T>)
        return value;
    else
        return normalized ? std::max((float)value / (float)std::numeric_limits<T>::max(), -1.0f)
                          : (float)value;
}

template <typename T>
static void convert(const element_span &span, uint64_t count, uint64_t width, bool normalized,
                    float *values)
{
    for (uint64_t i = 0; i < count; i++) {
        const unsigned char *element = span.data + i * span.stride;
        for (uint64_t c = 0; c < width; c++)
            values[i * width + c] = to_float(load<T>(element + c * sizeof(T)), normalized);
    }
}

static void convert_any(const element_span &span, const tinygltf::Accessor &accessor,
                        uint64_t count, uint64_t width, float *values)
{
    bool normalized = accessor.normalized;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convert<int8_t>(span, count, width, normalized, values);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convert<uint8_t>(span, count, width, normalized, values);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convert<int16_t>(span, count, width, normalized, values);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convert<uint16_t>(span, count, width, normalized, values);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return convert<uint32_t>(span, count, width, normalized, values);
    default:
        return convert<float>(span, count, width, normalized, values);
    }
}

static uint32_t load_unsigned(const unsigned char *bytes, int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes);
    default:
        return load<uint32_t>(bytes);
    }
}

/* Calls `replace(element, bytes)` for each element that the sparse part replaces. */
template <typename Replace>
static void for_each_sparse(const gltf_import &import, const tinygltf::Accessor &accessor,
                            uint64_t element_size, const std::string &location, Replace replace)
{
    const auto &sparse = accessor.sparse;
    uint64_t count = (uint64_t)sparse.count;
    if (count > accessor.count)
        fail("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", location + "/sparse/count",
             "%" PRIu64 " of %zu elements cannot be replaced", count, accessor.count);
    uint64_t index_size = component_size(sparse.indices.componentType);
    element_span indices =
        find_elements(import, sparse.indices.bufferView, (uint64_t)sparse.indices.byteOffset, count,
                      index_size, location + "/sparse/indices");
    element_span values =
        find_elements(import, sparse.values.bufferView, (uint64_t)sparse.values.byteOffset, count,
                      element_size, location + "/sparse/values");
    uint64_t previous = 0;
    for (uint64_t i = 0; i < count; i++) {
        uint64_t element =
            load_unsigned(indices.data + i * indices.stride, sparse.indices.componentType);
        if (element >= accessor.count)
            fail("ACCESSOR_SPARSE_INDEX_OOB", location + "/sparse/indices",
                 "entry %" PRIu64 " names element %" PRIu64 " of %zu", i, element, accessor.count);
        if (i > 0 && element <= previous)
            fail("ACCESSOR_SPARSE_INDICES_NON_INCREASING", location + "/sparse/indices",
                 "entry %" PRIu64 " is %" PRIu64 " after %" PRIu64, i, element, previous);
        previous = element;
        replace(element, element_span{values.data + i * values.stride, element_size});
    }
}

/* Whether data begin off their components' alignment. Values are copied byte by byte, so that this
 * is no obstacle. */
static bool is_unaligned(const gltf_import &import, int view, uint64_t offset, uint64_t component)
{
    uint64_t start = import.model.bufferViews[(size_t)view].byteOffset + offset;
    return offset % component != 0 || start % component != 0;
}

/* Element count and bounds of every accessor, before any memory is taken for one. */
void accessors_check(gltf_import &import)
{
    for (size_t i = 0; i < import.model.accessors.size(); i++) {
        const tinygltf::Accessor &accessor = import.model.accessors[i];
        uint64_t component = component_size(accessor.componentType);
        uint64_t width = (uint64_t)tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
        bool unaligned = false;
        if (accessor.bufferView >= 0) {
            find_elements(import, accessor.bufferView, accessor.byteOffset, accessor.count,
                          component * width, location_of("accessors", i));
            unaligned = is_unaligned(import, accessor.bufferView, accessor.byteOffset, component);
        }
        if (const auto &sparse = accessor.sparse; sparse.isSparse)
            unaligned =
                unaligned ||
                is_unaligned(import, sparse.indices.bufferView, (uint64_t)sparse.indices.byteOffset,
                             component_size(sparse.indices.componentType)) ||
                is_unaligned(import, sparse.values.bufferView, (uint64_t)sparse.values.byteOffset,
                             component);
        import.repairs.unaligned_accessors += unaligned;
    }
}

/* Appends count * width floats, whatever they are, and returns the width. */
static uint64_t read_any_floats(const gltf_import &import, int index, std::vector<float> &values)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)index];
    std::string location = location_of("accessors", (size_t)index);
    uint64_t component = component_size(accessor.componentType);
    uint64_t width = (uint64_t)tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    uint64_t size = component * width;

    element_span span = {nullptr, 0};
    if (accessor.bufferView >= 0)
        span = find_elements(import, accessor.bufferView, accessor.byteOffset, accessor.count, size,
                             location);
    size_t first = values.size();
    values.resize(first + accessor.count * width);
    if (span.data)
        convert_any(span, accessor, accessor.count, width, &values[first]);
    if (accessor.sparse.isSparse)
        for_each_sparse(
            import, accessor, size, location, [&](uint64_t element, element_span value) {
                convert_any(value, accessor, 1, width, &values[first + element * width]);
            });
    return width;
}

void accessor_read_floats(const gltf_import &import, int index, std::vector<float> &values)
{
    size_t first = values.size();
    uint64_t width = read_any_floats(import, index, values);
    for (size_t i = first; i < values.size(); i++)
        if (!std::isfinite(values[i]))
            fail("ACCESSOR_INVALID_FLOAT", location_of("accessors", (size_t)index),
                 "element %zu holds NaN or infinity; export the file again", (i - first) / width);
}

void accessor_read_directions(const gltf_import &import, int index, std::vector<float> &values)
{
    size_t first = values.size();
    uint64_t width = read_any_floats(import, index, values);
    for (size_t i = first; i < values.size(); i++)
        if (!std::isfinite(values[i]))
            std::fill_n(&values[i - (i - first) % width], width, 0.0f);
}

void accessor_read_indices(const gltf_import &import, int index, uint64_t limit, uint64_t *highest,
                           std::vector<uint32_t> &values)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)index];
    std::string location = location_of("accessors", (size_t)index);
    uint64_t size = component_size(accessor.componentType);
    bool integer = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                   accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                   accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !integer || accessor.normalized)
        fail("MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", location,
             "%s cannot be vertex indices", accessor_format(accessor).c_str());

    size_t first = values.size();
    values.resize(first + accessor.count);
    if (accessor.bufferView >= 0) {
        element_span span = find_elements(import, accessor.bufferView, accessor.byteOffset,
                                          accessor.count, size, location);
        for (uint64_t i = 0; i < accessor.count; i++)
            values[first + i] = load_unsigned(span.data + i * span.stride, accessor.componentType);
    }
    if (accessor.sparse.isSparse)
        for_each_sparse(
            import, accessor, size, location, [&](uint64_t element, element_span value) {
                values[first + element] = load_unsigned(value.data, accessor.componentType);
            });

    uint32_t restart = size == 1 ? UINT8_MAX : size == 2 ? UINT16_MAX : UINT32_MAX;
    for (uint64_t i = 0; i < accessor.count; i++) {
        if (values[first + i] == restart && (!highest || restart >= limit))
            fail("ACCESSOR_INDEX_PRIMITIVE_RESTART", location,
                 "index %" PRIu64 " is the primitive-restart value %" PRIu32
                 "; export the file with wider indices",
                 i, restart);
        if (values[first + i] == restart)
            ++*highest;
        if (values[first + i] >= limit)
            fail("ACCESSOR_INDEX_OOB", location,
                 "index %" PRIu64 " names vertex %" PRIu32 " of %" PRIu64, i, values[first + i],
                 limit);
    }
}

} // namespace lsf
