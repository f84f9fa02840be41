#include "io/gltf_import.hpp"

#include <cinttypes>

/* GLB: glTF 2.0 section 4.4. */

namespace lsf
{

static const uint32_t CHUNK_JSON = 0x4e4f534au, CHUNK_BIN = 0x004e4942u;

static uint32_t little_endian_u32(std::string_view bytes, size_t offset)
{
    uint32_t value = 0;
    for (size_t i = 0; i < 4; i++)
        value |= (uint32_t)(unsigned char)bytes[offset + i] << (8 * i);
    return value;
}

/* Returns the declared length. */
static uint32_t check_header(std::string_view bytes)
{
    if (bytes.size() < 12)
        fail("GLB_UNEXPECTED_END_OF_HEADER", "GLB header",
             "the file ends after %zu of 12 bytes; copy or export it again", bytes.size());
    uint32_t version = little_endian_u32(bytes, 4), length = little_endian_u32(bytes, 8);
    if (version != 2)
        fail("GLB_INVALID_VERSION", "GLB header",
             "version %" PRIu32 " is not supported; export the file as glTF 2.0", version);
    if (length < 12 || length > bytes.size())
        fail("GLB_LENGTH_MISMATCH", "GLB header",
             "%" PRIu32 " bytes are declared, the file has %zu; copy or export it again", length,
             bytes.size());
    return length;
}

/* After a chunk whose length is no multiple of 4: some exporters leave out the padding, others do
 * not count it. */
static size_t skip_padding(std::string_view bytes, size_t offset)
{
    size_t padded = (offset + 3) / 4 * 4;
    if (padded >= bytes.size())
        return bytes.size();
    bool header = padded + 8 <= bytes.size() && little_endian_u32(bytes, padded + 4) == CHUNK_BIN;
    return header ? padded : offset;
}

gltf_container gltf_container_split(std::string_view bytes)
{
    gltf_container container;
    container.bytes = bytes;
    if (bytes.substr(0, 4) != "glTF") {
        container.json = bytes;
        return container;
    }
    container.is_glb = true;
    uint32_t declared = check_header(bytes);
    container.trailing = bytes.size() - declared;
    bytes = container.bytes = bytes.substr(0, declared);

    size_t offset = 12;
    for (uint32_t chunk = 0; offset < bytes.size(); chunk++) {
        std::string location = "GLB chunk " + std::to_string(chunk);
        if (bytes.size() - offset < 8)
            fail("GLB_UNEXPECTED_END_OF_CHUNK_HEADER", location,
                 "the file ends inside the chunk's header; copy or export it again");
        uint32_t length = little_endian_u32(bytes, offset);
        uint32_t type = little_endian_u32(bytes, offset + 4);
        offset += 8;
        if (length > bytes.size() - offset)
            fail("GLB_UNEXPECTED_END_OF_CHUNK_DATA", location,
                 "%" PRIu32 " bytes are declared, %zu follow; copy or export the file again",
                 length, bytes.size() - offset);
        container.unpadded += length % 4 != 0;
        if ((chunk == 0) != (type == CHUNK_JSON))
            fail(chunk == 0 ? "GLB_UNEXPECTED_FIRST_CHUNK" : "GLB_DUPLICATE_CHUNK", location,
                 "chunk type 0x%08" PRIx32 "; the JSON chunk, and only it, comes first", type);
        if (type == CHUNK_BIN && chunk != 1)
            fail("GLB_UNEXPECTED_BIN_CHUNK", location,
                 "the binary chunk must be the second one; export the file again");
        if (type == CHUNK_JSON)
            container.json = bytes.substr(offset, length);
        else if (type == CHUNK_BIN)
            container.binary = bytes.substr(offset, length);
        offset = skip_padding(bytes, offset + length);
    }
    if (container.json.empty())
        fail("GLB_EMPTY_CHUNK", "GLB chunk 0", "there is no JSON; export the file again");
    return container;
}

} // namespace lsf
