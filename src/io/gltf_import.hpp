/* Declarations that the files of the glTF importer share. Errors travel as exceptions inside the
 * importer and stop at lsf_gltf_load. Findings carry the names that Khronos' glTF-Validator
 * gives them. */
#ifndef LSF_IO_GLTF_IMPORT_HPP
#define LSF_IO_GLTF_IMPORT_HPP

#include "io/io.h"
#include "scene/mesh_frame.h"
#include "scene/property.h"

/* Images are decoded elsewhere. */
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace lsf
{

/* --- failures --- */

class failure : public std::exception
{
  public:
    explicit failure(std::string text) : text_(std::move(text))
    {
    }
    const char *what() const noexcept override
    {
        return text_.c_str();
    }

  private:
    std::string text_;
};

/* The caller chose something that the file does not have: LSF_ERROR_USAGE. */
class no_such_choice : public failure
{
  public:
    using failure::failure;
};

/* Throws "FINDING at LOCATION: cause and remedy". The location is a JSON pointer. */
[[noreturn]] void fail(const char *finding, const std::string &location, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "/accessors/7" */
std::string location_of(const char *array, size_t index);

/* The memory that loading may take at any moment, requested before it is allocated. */
class memory_budget
{
  public:
    explicit memory_budget(uint64_t limit) : limit_(limit)
    {
    }
    void take(uint64_t count, uint64_t size, const std::string &location);
    void give_back(uint64_t bytes)
    {
        used_ -= bytes;
    }
    uint64_t left() const
    {
        return limit_ - used_;
    }

  private:
    uint64_t limit_, used_ = 0;
};

/* Memory that is given back at the end of its scope. */
class memory_loan
{
  public:
    memory_loan(memory_budget &budget, const std::string &location)
        : budget_(budget), location_(location)
    {
    }
    memory_loan(const memory_loan &) = delete;
    ~memory_loan()
    {
        budget_.give_back(bytes_);
    }
    void take(uint64_t count, uint64_t size)
    {
        budget_.take(count, size, location_);
        bytes_ += count * size;
    }

  private:
    memory_budget &budget_;
    std::string location_;
    uint64_t bytes_ = 0;
};

/* --- the file --- */

/* The bytes of a .gltf or .glb, told apart by the magic, with the chunks of the latter. */
struct gltf_container {
    std::string_view bytes, json, binary; /* `bytes` without what follows the declared length */
    bool is_glb = false;
    uint64_t trailing = 0; /* bytes that follow it */
    uint64_t unpadded = 0; /* chunks whose length is no multiple of 4: tinygltf refuses them */
};

gltf_container gltf_container_split(std::string_view bytes); /* gltf_container.cpp */

/* Checks everything in the JSON that can be checked without the binary data: types, ranges,
 * references, buffer views against buffers (gltf_schema.cpp). */
struct gltf_buffer_source {
    std::string uri; /* empty: the GLB's binary chunk */
    uint64_t byte_length;
    bool placeholder; /* it has no data: the views into it say where their data are */
};
/* How many things in the JSON were repaired. */
struct gltf_json_repairs {
    uint64_t shares_clamped = 0;     /* factors beyond 0 to 1 */
    uint64_t integers_rewritten = 0; /* that were written with a point, as 1.0 */
    uint64_t alphas_cut = 0;         /* of emissive factors */
};
struct gltf_checked {
    std::vector<gltf_buffer_source> buffers;
    /* The document in a form that tinygltf reads, when it would not read it as it is; else
     * empty. tinygltf needs a URI and a byte for every buffer, and a buffer view for all
     * indices: indices without one are taken out of their primitive and listed. The GLB's binary
     * chunk gets a URI, too. */
    std::string json;
    struct indices {
        size_t mesh, primitive;
        int accessor;
    };
    std::vector<indices> indices_without_view;
    gltf_json_repairs repairs;
};
bool extension_is_supported(const std::string &name);
gltf_checked gltf_schema_check(const gltf_container &container, bool lenient,
                               memory_budget &budget);

/* The names of the extension by which buffer views are stored compressed. Their members are the
 * same; data of the second may be of a later version. */
inline constexpr const char *MESHOPT_EXTENSIONS[] = {"EXT_meshopt_compression",
                                                     "KHR_meshopt_compression"};

/* gltf_uri.cpp */
bool uri_is_data(const std::string &uri);
/* Throws unless it is well-formed base64; returns the decoded size. */
uint64_t uri_data_size(const std::string &uri, const std::string &location);
/* What it holds. */
std::string uri_data(const std::string &uri, const std::string &location);
/* Path of a file below `folder`; refuses schemes, absolute paths and ways out of the folder, and
 * every path without a folder. */
std::string uri_to_path(const std::string &folder, const std::string &uri,
                        const std::string &location);
/* Whether it names a file that does not exist. */
bool uri_file_is_absent(const std::string &folder, const std::string &uri,
                        const std::string &location);
/* The whole file; fails when it is not a regular one or longer than what is left of the budget. */
struct file_content {
    std::unique_ptr<char, decltype(&std::free)> bytes{nullptr, std::free};
    size_t length = 0;
};
file_content file_read(const std::string &path, const memory_budget &budget);

/* --- the import --- */

/* Counts of repairs, so that a file gives one note for each kind. */
struct gltf_repairs {
    lsf_frame_repairs frames = {};
    uint64_t rotations_scaled = 0, scene_children = 0;
    uint64_t trailing_indices = 0, highest_indices = 0, no_position = 0;
    uint64_t weights_scaled = 0, joints_missing = 0, weights_animated = 0;
    uint64_t point_primitives = 0, points = 0, line_primitives = 0, lines = 0;
    uint64_t further_vertex_colors = 0, further_uv_sets = 0, missing_uv_sets = 0;
    uint64_t textures_without_image = 0, images_absent = 0, negative_colors = 0;
    gltf_json_repairs json;
    uint64_t trailing_bytes = 0, unpadded_chunks = 0, unaligned_accessors = 0;
    uint64_t targets_missing = 0;
};

/* The property that a channel of an animation changes. */
struct gltf_target {
    std::string location, pointer; /* no pointer: a node's own path */
    size_t animation = 0, channel = 0;
    lsf_kind of = LSF_KIND_NODE;
    size_t index = 0;                       /* number of the file's node, material, light or
                                             * camera */
    const lsf_property *property = nullptr; /* NULL: `path` of the node */
    uint32_t slot = LSF_NONE;
    lsf_animation_path path = LSF_PATH_TRANSLATION;
    int weight = -1; /* a weight of the node's, -1: all */
};

struct gltf_import {
    gltf_import(lsf_scene *s, const lsf_scene_params *p)
        : scene(s), params(p), budget(p->memory_limit)
    {
    }

    lsf_scene *scene;
    const lsf_scene_params *params;
    std::string path, folder; /* no folder: the scene may refer to no file */
    std::string_view memory;  /* the content; without data: it is read from the file */
    memory_budget budget;
    tinygltf::Model model;
    std::vector<bool> placeholders;   /* by file's buffer */
    std::vector<gltf_target> targets; /* targets of the animations that play */
    /* Kind, index and property of targets that are not a node's path. */
    std::set<std::tuple<lsf_kind, size_t, const lsf_property *>> animated;
    gltf_repairs repairs;

    size_t chosen_scene = 0;         /* by file's index; no meaning without scenes */
    std::vector<uint32_t> node_of;   /* file's node -> scene's node, LSF_NONE outside the scene */
    std::vector<uint32_t> source_of; /* scene's node -> file's node */
    std::vector<bool> mesh_used;     /* by file's index */
    std::vector<uint32_t> skin_of;   /* file's skin -> scene's; LSF_NONE: not used yet */
    uint64_t shape_capacity = 0;
    std::vector<uint32_t> material_of; /* file's material -> scene's; LSF_NONE: not used */
    std::vector<uint32_t> light_of;    /* file's light -> scene's; LSF_NONE: not used */
    std::vector<size_t> camera_source; /* scene's camera -> file's */
    std::vector<bool> never_seen;      /* scene's nodes that no animation shows, with their
                                        * descendants */
};

/* Memory that a node of that name takes, including its matrix once all are placed
 * (gltf_nodes.cpp). */
uint64_t node_bytes(const char *name);

void gltf_document_read(gltf_import &import);     /* gltf_document.cpp */
void gltf_meshopt_decode(gltf_import &import);    /* gltf_meshopt.cpp */
void gltf_choices_make(gltf_import &import);      /* gltf_choices.cpp */
void gltf_targets_read(gltf_import &import);      /* gltf_targets.cpp: of animations */
void gltf_nodes_import(gltf_import &import);      /* gltf_nodes.cpp */
void gltf_draco_decode(gltf_import &import);      /* gltf_draco.cpp */
void gltf_instancing_import(gltf_import &import); /* gltf_instancing.cpp */
void gltf_placed_import(gltf_import &import);     /* gltf_placed.cpp: cameras and lights */
void gltf_materials_import(gltf_import &import);  /* gltf_materials.cpp */
void gltf_geometry_import(gltf_import &import);   /* gltf_geometry.cpp */
void gltf_animations_import(gltf_import &import); /* gltf_animations.cpp */
void gltf_notes_add(gltf_import &import);         /* gltf_notes.cpp */

/* Whether an animation that plays changes what stands there in the object model, behind the index.
 */
bool is_animated(const gltf_import &import, lsf_kind of, size_t index, const char *name);

/* Sets the transform of a node without a matrix; the rotation (x, y, z, w) is made unit. */
void set_trs(gltf_import &import, const double translation[3], const double rotation[4],
             const double scale[3], lsf_node &node);

/* --- accessors, gltf_accessor.cpp --- */

/* Checks that every accessor lies within its buffer view. */
void accessors_check(gltf_import &import);
/* Appends count * width floats; normalised integers become -1..1 or 0..1. Fails at NaN and
 * infinity. */
void accessor_read_floats(const gltf_import &import, int accessor, std::vector<float> &values);
/* The same for normals and tangents, which exporters leave undefined where triangles have no area:
 * an element that holds NaN or infinity becomes zeros. */
void accessor_read_directions(const gltf_import &import, int accessor, std::vector<float> &values);
/* Appends unsigned indices of any width; each must be below `limit`. The highest value of a width
 * may mean that a strip starts anew, and names no vertex; where no strip is possible, `highest`
 * counts how often it names one all the same. NULL: that is an error. */
void accessor_read_indices(const gltf_import &import, int accessor, uint64_t limit,
                           uint64_t *highest, std::vector<uint32_t> &values);
std::string accessor_format(const tinygltf::Accessor &accessor); /* "VEC3 of FLOAT" */

/* --- images, gltf_glossiness.cpp --- */

/* 1 - factor * alpha of each texel, in one channel. */
void make_roughness_image(gltf_import &import, const lsf_texture_image &source, double factor,
                          lsf_texture_image &result);

/* --- into the scene's C arrays --- */

/* malloc'ed, freed by lsf_scene_destroy. */
char *copy_text(const std::string &text);
void *allocate(uint64_t count, uint64_t size);
template <typename T> T *copy_array(const std::vector<T> &values)
{
    T *copy = static_cast<T *>(allocate(values.size(), sizeof(T)));
    std::copy(values.begin(), values.end(), copy);
    return copy;
}

} // namespace lsf

#endif
