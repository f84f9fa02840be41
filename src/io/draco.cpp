/* The module lightsheaf-draco: KHR_draco_mesh_compression by the Draco library. No exception leaves
 * this file. A few bytes can declare any number of faces, points and attributes: the library's
 * decoders are stopped where they have read such a number and before they allocate by it. */
#include "io/mesh_modules.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <cinttypes>
#include <exception>
#include <new>

namespace
{

/* Memory that the edgebreaker keeps for each face: three corners and at most four vertices, each
 * with opposite corner, vertex, traversal and seams; twice, for vectors that grow. And the
 * memory for each set of attributes with connectivity of its own. */
const uint64_t FACE_BYTES = 256, FACE_BYTES_PER_SET = 192;
/* Memory of any attribute for each point and component beside the value itself: its integer
 * before the transform, and as much again for the prediction; and for each point the maps. */
const uint64_t COMPONENT_BYTES = 8, POINT_BYTES = 32;

const int SEQUENTIAL = 0, EDGEBREAKER = 1; /* encoder methods of meshes */

struct refusal {
    lsf_error error;
};

[[noreturn]] void refuse(const char *format, ...) __attribute__((format(printf, 1, 2)));
void refuse(const char *format, ...)
{
    refusal refused = {};
    va_list arguments;
    va_start(arguments, format);
    char text[512];
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    lsf_error_set(&refused.error, LSF_ERROR_FILE, "%s", text);
    throw refused;
}

/* Bytes that are about to be allocated, checked against the limit. */
class allowance
{
  public:
    explicit allowance(uint64_t limit) : limit_(limit)
    {
    }
    void take(uint64_t count, uint64_t size)
    {
        uint64_t bytes;
        if (__builtin_mul_overflow(count, size, &bytes) || bytes > limit_ - used_)
            refuse("decoding it takes more than the %" PRIu64
                   " bytes that the memory limit leaves; raise the limit or simplify the scene",
                   limit_);
        used_ += bytes;
    }

  private:
    uint64_t limit_, used_ = 0;
};

/* A number of the connectivity's header: 32 bits before version `varint_since`, a varint after. */
uint32_t read_count(draco::DecoderBuffer &buffer, uint16_t version, uint16_t varint_since)
{
    uint32_t value = 0;
    bool good =
        version < varint_since ? buffer.Decode(&value) : draco::DecodeVarint(&value, &buffer);
    if (!good)
        refuse("the compressed bytes end too early");
    return value;
}

template <class Base> class bounded_decoder : public Base
{
  public:
    explicit bounded_decoder(const lsf_draco_request &request)
        : request_(request), allowance_(request.memory_limit)
    {
    }

  protected:
    bool DecodeGeometryData() override
    {
        draco::DecoderBuffer header = *this->buffer(); /* reads on by itself */
        check_header(header);
        if (!Base::DecodeGeometryData())
            return false;
        if (this->point_cloud()->num_points() > request_.point_count)
            refuse("it holds %u points, the accessors have %u", this->point_cloud()->num_points(),
                   request_.point_count);
        return true;
    }

    bool DecodeAllAttributes() override
    {
        const draco::PointCloud *cloud = this->point_cloud();
        uint64_t points = cloud->num_points();
        allowance_.take((uint64_t)this->num_attributes_decoders() * POINT_BYTES, points);
        for (int i = 0; i < cloud->num_attributes(); i++) {
            const draco::PointAttribute *attribute = cloud->attribute(i);
            uint64_t components = (uint8_t)attribute->num_components();
            uint64_t value = (uint64_t)draco::DataTypeLength(attribute->data_type());
            allowance_.take(components * (value + COMPONENT_BYTES) + POINT_BYTES, points);
        }
        return Base::DecodeAllAttributes();
    }

  private:
    void check_faces(uint32_t faces)
    {
        if (faces > request_.triangle_count)
            refuse("it holds %u triangles, the accessor of the indices has %u", faces,
                   request_.triangle_count);
        allowance_.take(faces, FACE_BYTES);
    }

    /* Bitstream specification of Draco, "DecodeEdgebreakerConnectivityData" and
     * "DecodeSequentialConnectivityData"; older versions as the library reads them. */
    void check_header(draco::DecoderBuffer &header)
    {
        uint16_t version = this->bitstream_version();
        if constexpr (std::is_same_v<Base, draco::MeshEdgebreakerDecoder>) {
            const uint16_t varint_since = DRACO_BITSTREAM_VERSION(2, 0);
            if (version < DRACO_BITSTREAM_VERSION(2, 2))
                read_count(header, version, varint_since); /* new vertices */
            read_count(header, version, varint_since);     /* vertices, at most three a face */
            uint32_t faces = read_count(header, version, varint_since);
            check_faces(faces);
            uint8_t sets;
            if (!header.Decode(&sets))
                refuse("the compressed bytes end too early");
            allowance_.take((uint64_t)sets * FACE_BYTES_PER_SET, faces);
        } else {
            const uint16_t varint_since = DRACO_BITSTREAM_VERSION(2, 2);
            check_faces(read_count(header, version, varint_since));
            uint32_t points = read_count(header, version, varint_since);
            allowance_.take(points, POINT_BYTES);
        }
    }

    const lsf_draco_request &request_;
    allowance allowance_;
};

template <class Base>
void decode_mesh(const lsf_draco_request &request, draco::DecoderBuffer &buffer, draco::Mesh &mesh)
{
    bounded_decoder<Base> decoder(request);
    draco::DecoderOptions options;
    draco::Status status = decoder.Decode(options, &buffer, &mesh);
    if (!status.ok())
        refuse("%s", status.error_msg());
}

void decode_any_mesh(const lsf_draco_request &request, draco::Mesh &mesh)
{
    draco::DecoderBuffer buffer;
    buffer.Init(static_cast<const char *>(request.bytes), request.length);
    draco::DecoderBuffer copy = buffer;
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&copy, &header).ok())
        refuse("it does not begin as Draco data do");
    if (header.encoder_type != draco::TRIANGULAR_MESH)
        refuse("it holds points and no triangles");
    if (header.encoder_method == EDGEBREAKER)
        decode_mesh<draco::MeshEdgebreakerDecoder>(request, buffer, mesh);
    else if (header.encoder_method == SEQUENTIAL)
        decode_mesh<draco::MeshSequentialDecoder>(request, buffer, mesh);
    else
        refuse("its encoding is unknown");
}

template <typename T>
void copy_values(const draco::PointAttribute &attribute, uint32_t points,
                 const lsf_draco_output &output)
{
    T *values = static_cast<T *>(output.values);
    for (uint32_t p = 0; p < points; p++) {
        draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(p));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(index, static_cast<int8_t>(output.width),
                                       values + (size_t)p * output.width))
            refuse("attribute %u does not fit its accessor's type", output.unique_id);
    }
}

void copy_attribute(const draco::Mesh &mesh, const lsf_draco_output &output)
{
    const draco::PointAttribute *attribute = mesh.GetAttributeByUniqueId(output.unique_id);
    if (!attribute)
        refuse("there is no attribute %u in it", output.unique_id);
    if ((uint8_t)attribute->num_components() != output.width)
        refuse("attribute %u has %u components, its accessor %u", output.unique_id,
               (unsigned)(uint8_t)attribute->num_components(), output.width);
    uint32_t points = mesh.num_points();
    switch (output.component_type) {
    case 5120:
        return copy_values<int8_t>(*attribute, points, output);
    case 5121:
        return copy_values<uint8_t>(*attribute, points, output);
    case 5122:
        return copy_values<int16_t>(*attribute, points, output);
    case 5123:
        return copy_values<uint16_t>(*attribute, points, output);
    case 5125:
        return copy_values<uint32_t>(*attribute, points, output);
    default:
        return copy_values<float>(*attribute, points, output);
    }
}

void decode_unguarded(lsf_draco_request &request)
{
    draco::Mesh mesh;
    decode_any_mesh(request, mesh);
    if (mesh.num_faces() > request.triangle_count || mesh.num_points() > request.point_count)
        refuse("its header contradicts itself");
    for (uint32_t f = 0; f < mesh.num_faces(); f++)
        for (uint32_t corner = 0; corner < 3; corner++)
            request.indices[3 * (size_t)f + corner] =
                mesh.face(draco::FaceIndex(f))[corner].value();
    for (uint32_t i = 0; i < request.output_count; i++)
        copy_attribute(mesh, request.outputs[i]);
    request.point_count = mesh.num_points();
    request.triangle_count = mesh.num_faces();
}

bool decode(lsf_draco_request *request, lsf_error *error)
{
    try {
        decode_unguarded(*request);
        return true;
    } catch (const refusal &refused) {
        return lsf_error_set(error, LSF_ERROR_FILE, "%s", refused.error.message);
    } catch (const std::bad_alloc &) {
        return lsf_error_set(error, LSF_ERROR_FILE, "there is not enough memory to decode it");
    } catch (const std::exception &exception) {
        return lsf_error_set(error, LSF_ERROR_FILE, "%s", exception.what());
    } catch (...) {
        return lsf_error_set(error, LSF_ERROR_FILE, "decoding it failed");
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) const lsf_draco_module lsf_draco = {decode};
