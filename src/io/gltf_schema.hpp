/* The part of glTF 2.0's JSON schema that the importer reads, as tables. */
#ifndef LSF_IO_GLTF_SCHEMA_HPP
#define LSF_IO_GLTF_SCHEMA_HPP

#include <cfloat>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lsf
{

enum class shape {
    boolean,
    string,
    strings,
    one_of,     /* a string among `names`, separated by '|' */
    integer,    /* low..high */
    code,       /* an integer among `names`, separated by '|' */
    number,     /* low..high, finite as a float; 0..1 with a margin for rounding */
    numbers,    /* `entries` numbers; 0: any count */
    reference,  /* an index into the root array `names` */
    references, /* an array of them */
    object,
    objects,    /* an array of objects */
    integers,   /* an object whose members are integers, low..high */
    attributes, /* an object whose members are references into accessors */
    targets,    /* an array of such objects */
    extensions, /* an object whose members are objects, `child` naming the known ones */
};

struct schema;

struct rule {
    const char *name;
    shape kind;
    bool required = false;
    double low = -FLT_MAX, high = FLT_MAX;
    const char *names = nullptr;
    const schema *child = nullptr;
    size_t entries = 0;
};

struct schema {
    const rule *rules;
    size_t rule_count;
};

extern const schema gltf_root_schema;

/* gltf_adapt.cpp */
struct gltf_checked;
/* Name of the extension by which a view, or a buffer, is compressed; NULL: by none. */
const char *meshopt_extension_of(const nlohmann::json &object);
/* By buffer: whether it has no data because its views are compressed in other buffers.
 * `has_binary`: the file has a binary chunk, the data of its first buffer. */
std::vector<bool> placeholder_buffers(const nlohmann::json &root, bool has_binary);
/* Fills `checked`; changes the document, which has been checked, where tinygltf needs it.
 * `changed`: whether it is not the file's any more. */
void adapt_document(nlohmann::json &root, bool changed, const std::vector<bool> &placeholders,
                    gltf_checked &checked);

} // namespace lsf

#endif
