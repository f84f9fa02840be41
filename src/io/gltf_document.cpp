#include "io/gltf_import.hpp"

#include "io/foreign_file.h"

#include <cinttypes>

/* From the file's bytes to a tinygltf model. tinygltf sees only data that has been checked, and
 * asks for buffers that have been read already: it opens no file itself. */

namespace lsf
{

/* External buffers in the file's order, which is the order in which tinygltf asks for them. */
struct buffer_queue {
    std::vector<std::vector<unsigned char>> contents;
    size_t next = 0;
};

static bool queue_has_next(const std::string &, void *user)
{
    buffer_queue *queue = static_cast<buffer_queue *>(user);
    return queue->next < queue->contents.size();
}

static std::string keep_path(const std::string &path, void *)
{
    return path;
}

static bool take_next(std::vector<unsigned char> *bytes, std::string *, const std::string &,
                      void *user)
{
    buffer_queue *queue = static_cast<buffer_queue *>(user);
    *bytes = std::move(queue->contents[queue->next++]);
    return true;
}

static bool write_nothing(std::string *, const std::string &, const std::vector<unsigned char> &,
                          void *)
{
    return false;
}

/* Images in data URIs are kept encoded: only those that a material uses will be decoded. */
static bool keep_encoded(tinygltf::Image *image, const int, std::string *, std::string *, int, int,
                         const unsigned char *bytes, int size, void *)
{
    if (image->bufferView < 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

static void check_length(uint64_t actual, uint64_t declared, const std::string &location)
{
    if (actual < declared)
        fail("BUFFER_BYTE_LENGTH_MISMATCH", location,
             "%" PRIu64 " bytes are declared, only %" PRIu64 " are there; export the file again",
             declared, actual);
}

/* As many bytes of the file as the buffer declares; a file may hold more. */
static std::vector<unsigned char>
read_buffer_file(gltf_import &import, const gltf_buffer_source &source, const std::string &location)
{
    std::string path = uri_to_path(import.folder, source.uri, location + "/uri");
    memory_loan reading(import.budget, location);
    reading.take(source.byte_length, 1);
    lsf_error error;
    file_content file;
    file.bytes.reset(lsf_file_read_start(path.c_str(), source.byte_length, &file.length, &error));
    if (!file.bytes)
        throw failure(error.message);
    if (lsf_is_git_lfs_pointer(file.bytes.get(), file.length))
        fail("IO_ERROR", location + "/uri",
             "%s: is a pointer of Git LFS, not the buffer itself; run `git lfs pull`",
             path.c_str());
    check_length(file.length, source.byte_length, location);
    lsf_scene_add_content(import.scene, file.bytes.get(), file.length);
    return {file.bytes.get(), file.bytes.get() + file.length};
}

static void read_buffers(gltf_import &import, const gltf_container &container,
                         const gltf_checked &checked, buffer_queue &queue)
{
    for (size_t i = 0; i < checked.buffers.size(); i++) {
        const gltf_buffer_source &source = checked.buffers[i];
        std::string location = location_of("buffers", i);
        import.placeholders.push_back(source.placeholder);
        if (source.placeholder) {
            queue.contents.push_back({0});
            continue;
        }
        import.budget.take(source.byte_length, 1, location);
        if (source.uri.empty()) {
            if (!container.is_glb || i != 0)
                fail("UNDEFINED_PROPERTY", location,
                     "\"uri\" is missing; only the first buffer of a .glb may leave it out");
            check_length(container.binary.size(), source.byte_length, location);
            if (!checked.json.empty())
                queue.contents.emplace_back(container.binary.begin(),
                                            container.binary.begin() +
                                                (ptrdiff_t)source.byte_length);
        } else if (uri_is_data(source.uri)) {
            uint64_t size = uri_data_size(source.uri, location + "/uri");
            if (size != source.byte_length)
                fail("BUFFER_BYTE_LENGTH_MISMATCH", location,
                     "%" PRIu64 " bytes are declared, the data URI holds %" PRIu64,
                     source.byte_length, size);
            if (!tinygltf::IsDataURI(source.uri)) { /* a media type that it does not know */
                std::string decoded = uri_data(source.uri, location + "/uri");
                queue.contents.emplace_back(decoded.begin(), decoded.end());
            }
        } else {
            queue.contents.push_back(read_buffer_file(import, source, location));
        }
    }
}

static void refuse_other_formats(const std::string &path, std::string_view bytes)
{
    const lsf_foreign_file *foreign =
        lsf_foreign_file_find(path.c_str(), bytes.data(), bytes.size());
    if (foreign)
        throw failure(path + ": only .gltf and .glb are read, and this is " + foreign->what + "; " +
                      foreign->remedy);
}

void gltf_document_read(gltf_import &import)
{
    file_content file;
    std::string_view bytes = import.memory;
    if (!bytes.data()) {
        file = file_read(import.path, import.budget);
        bytes = {file.bytes.get(), file.length};
    }
    lsf_scene_add_content(import.scene, bytes.data(), bytes.size());
    memory_loan content_loan(import.budget, "/");
    content_loan.take(bytes.size(), 1);
    refuse_other_formats(import.path, bytes);
    gltf_container container = gltf_container_split(bytes);
    gltf_checked checked = gltf_schema_check(container, import.params->lenient, import.budget);
    import.repairs.json = checked.repairs;
    import.repairs.trailing_bytes = container.trailing;
    import.repairs.unpadded_chunks = container.unpadded;
    buffer_queue queue;
    read_buffers(import, container, checked, queue);
    if (!checked.json.empty()) {
        container.json = checked.json;
        container.binary = {};
    }

    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({queue_has_next, keep_path, take_next, write_nothing, &queue});
    parser.SetImageLoader(keep_encoded, nullptr);
    std::string error, warning;
    /* tinygltf refuses an empty binary chunk, which the specification only advises against. */
    bool parsed =
        container.binary.empty()
            ? parser.LoadASCIIFromString(&import.model, &error, &warning, container.json.data(),
                                         (unsigned int)container.json.size(), "")
            : parser.LoadBinaryFromMemory(
                  &import.model, &error, &warning,
                  reinterpret_cast<const unsigned char *>(container.bytes.data()),
                  (unsigned int)container.bytes.size(), "");
    for (const gltf_checked::indices &indices : checked.indices_without_view)
        if (parsed)
            import.model.meshes[indices.mesh].primitives[indices.primitive].indices =
                indices.accessor;
    if (!parsed)
        fail("INVALID_JSON", "/", "%s",
             error.empty() ? "the document cannot be read" : error.c_str());
}

} // namespace lsf
