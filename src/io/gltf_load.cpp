#include "io/gltf_import.hpp"

#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace lsf
{

void fail(const char *finding, const std::string &location, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = nullptr;
    int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    std::string message = std::string(finding) + " at " + location + ": ";
    if (length >= 0)
        message += text;
    free(text);
    throw failure(message);
}

std::string location_of(const char *array, size_t index)
{
    return "/" + std::string(array) + "/" + std::to_string(index);
}

void memory_budget::take(uint64_t count, uint64_t size, const std::string &location)
{
    uint64_t bytes, sum;
    if (__builtin_mul_overflow(count, size, &bytes) || __builtin_add_overflow(used_, bytes, &sum) ||
        sum > limit_)
        fail("MEMORY_LIMIT", location,
             "%" PRIu64 " elements of %" PRIu64 " bytes do not fit into the %" PRIu64
             " bytes that are left of the memory limit of %" PRIu64
             "; raise the limit or simplify the scene",
             count, size, limit_ - used_, limit_);
    used_ = sum;
}

void *allocate(uint64_t count, uint64_t size)
{
    void *memory = lsf_alloc(count, size);
    if (!memory)
        throw std::bad_alloc();
    return memory;
}

char *copy_text(const std::string &text)
{
    char *copy = strdup(text.c_str());
    if (!copy)
        throw std::bad_alloc();
    lsf_make_printable(copy);
    return copy;
}

static std::string folder_of(const lsf_gltf_source &source)
{
    if (source.data)
        return source.folder ? source.folder : "";
    std::string path = source.path;
    size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

/* Returns what is left of the memory limit. */
static uint64_t import_scene(lsf_scene *scene, const lsf_gltf_source &source,
                             const lsf_scene_params *params)
{
    gltf_import import(scene, params);
    import.path = source.path;
    import.folder = folder_of(source);
    if (source.data)
        import.memory = {static_cast<const char *>(source.data), source.size};
    scene->path = copy_text(import.path);
    scene->diffuse_only = params->diffuse_only;
    scene->show_back_faces = params->show_back_faces;
    gltf_document_read(import);
    gltf_meshopt_decode(import);
    accessors_check(import);
    gltf_choices_make(import);
    gltf_targets_read(import);
    gltf_nodes_import(import);
    gltf_draco_decode(import);
    gltf_instancing_import(import);
    gltf_placed_import(import);
    gltf_materials_import(import);
    gltf_geometry_import(import);
    gltf_animations_import(import);
    gltf_notes_add(import);
    return import.budget.left();
}

} // namespace lsf

bool lsf_gltf_load(lsf_scene *scene, const lsf_gltf_source *source, const lsf_scene_params *params,
                   uint64_t *memory_left, lsf_error *error)
{
    const char *path = source->path;
    try {
        *memory_left = lsf::import_scene(scene, *source, params);
        return true;
    } catch (const std::bad_alloc &) {
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: not enough memory to read it; close other programs or simplify "
                             "the scene",
                             path);
    } catch (const lsf::no_such_choice &choice) {
        return lsf_error_set(error, LSF_ERROR_USAGE, "%s: %s", path, choice.what());
    } catch (const std::exception &exception) {
        /* Failures of the file itself begin with its path. */
        std::string shown = exception.what();
        lsf_make_printable(shown.data());
        const char *text = shown.c_str();
        size_t length = strlen(path);
        if (strncmp(text, path, length) == 0 && text[length] == ':')
            return lsf_error_set(error, LSF_ERROR_FILE, "%s", text);
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: %s", path, text);
    }
}
