#include "io/gltf_schema.hpp"

#include "io/gltf_import.hpp"
#include "io/json_scan.h"

#include <nlohmann/json.hpp>

#include <cinttypes>
#include <cmath>
#include <cstring>
#include <map>

namespace lsf
{

using nlohmann::json;

/* How far exporters may exceed 0 to 1 by rounding: NASA's Ingenuity.glb has a colour of 1.00000012.
 */
static const double ROUNDING = 1e-5;

/* Nothing that is read nests deeper than 10; extras may, within reason. */
static const uint64_t DEPTH_MAX = 64;

static const char *const supported_extensions[] = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",
    "EXT_texture_webp",           "KHR_animation_pointer",
    "KHR_draco_mesh_compression", "KHR_node_visibility",
    "KHR_lights_punctual",        "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants",     "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_meshopt_compression",
    "KHR_texture_transform",
};

bool extension_is_supported(const std::string &name)
{
    for (const char *supported : supported_extensions)
        if (name == supported)
            return true;
    return false;
}

/* --- parsing --- */

/* Builds the document as json::parse does and remembers where it failed. */
class locating_parser : public nlohmann::detail::json_sax_dom_parser<json>
{
  public:
    explicit locating_parser(json &root) : json_sax_dom_parser(root, false)
    {
    }

    template <class Exception>
    bool parse_error(std::size_t position, const std::string &token, const Exception &error)
    {
        position_ = position;
        message_ = error.what();
        return json_sax_dom_parser::parse_error(position, token, error);
    }

    std::size_t position_ = 0;
    std::string message_;
};

/* The most memory that the document and the structures made of it take: measured on documents of
 * little but extras, which become tinygltf::Value of 152 bytes, and of little but entries in the
 * root's arrays. It stays requested, though part of it is free again after parsing. */
static void take_document(memory_budget &budget, std::string_view text, const lsf_json_shape &shape)
{
    budget.take(text.size(), 6, "/"); /* base64 is copied most often */
    budget.take(shape.objects, 512, "/");
    budget.take(shape.arrays + shape.commas, 240, "/");
    budget.take(shape.strings, 160, "/");
}

static void take_entries(memory_budget &budget, const json &root)
{
    for (const auto &[key, member] : root.items())
        if (member.is_array() && key != "extras")
            budget.take(member.size(), key == "materials" ? 4096 : 1024, "/" + key);
    json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (root.contains(lights))
        budget.take(root[lights].size(), 1024, lights.to_string());
}

/* Nesting is bounded by DEPTH_MAX. */
static void take_apart(json &value)
{
    while (value.is_array() && !value.empty()) {
        json &last = value.get_ref<json::array_t &>().back();
        take_apart(last);
        value.get_ref<json::array_t &>().pop_back();
    }
    while (value.is_object() && !value.empty()) {
        take_apart(value.begin().value());
        value.erase(value.begin());
    }
}

/* nlohmann's destructor makes a list of the children of a value; without memory for the list it
 * would end the process. A document that was taken apart first has no children to list. */
struct json_document {
    json root;
    ~json_document()
    {
        take_apart(root);
    }
};

static void parse(std::string_view text, memory_budget &budget, json &root)
{
    lsf_json_shape shape = lsf_json_scan(text.data(), text.size());
    if (shape.depth > DEPTH_MAX)
        fail("INVALID_JSON", "/", "nested %" PRIu64 " deep; at most %" PRIu64 " levels are read",
             shape.depth, DEPTH_MAX);
    take_document(budget, text, shape);

    locating_parser parser(root);
    if (!json::sax_parse(text.begin(), text.end(), &parser)) {
        uint64_t line, column;
        lsf_json_location(text.data(), text.size(), parser.position_ ? parser.position_ - 1 : 0,
                          &line, &column);
        /* nlohmann-json begins with "[json.exception...] ". */
        size_t skip = parser.message_.find("] ");
        std::string cause = parser.message_.substr(skip == std::string::npos ? 0 : skip + 2);
        fail("INVALID_JSON", "line " + std::to_string(line) + ", column " + std::to_string(column),
             "%s", cause.c_str());
    }
    if (!root.is_object())
        fail("TYPE_MISMATCH", "/", "the document is %s, not an object; is this a glTF file?",
             root.type_name());
}

/* --- checking against the tables --- */

class checker
{
  public:
    checker(json &root, bool lenient) : root_(root), lenient_(lenient)
    {
        for (auto &member : root.items())
            if (member.value().is_array())
                counts_[member.key()] = member.value().size();
        count_in_extension("lights", "/extensions/KHR_lights_punctual/lights");
        count_in_extension("variants", "/extensions/KHR_materials_variants/variants");
    }

    void check_object(json &value, const schema &rules, bool extension = false);
    /* Whether anything in the document was replaced, if only a factor that rounding has put out of
     * its range, which is no repair. */
    bool changed() const
    {
        return changed_;
    }
    const gltf_json_repairs &repairs() const
    {
        return repairs_;
    }

    uint64_t count(const char *array) const
    {
        auto found = counts_.find(array);
        return found == counts_.end() ? 0 : found->second;
    }

  private:
    void count_in_extension(const char *array, const char *path)
    {
        json::json_pointer pointer(path);
        if (root_.contains(pointer) && root_[pointer].is_array())
            counts_[array] = root_[pointer].size();
    }
    void check(json &value, const rule &rule, bool extension);
    void check_integer(json &value, double low, double high);
    void check_number(json &value, double low, double high, bool extension);
    void check_share(json &value);
    void check_code(json &value, const char *names);
    void check_name(const json &value, const char *names);
    void cut_alpha(json &value, const rule &rule);
    void check_reference(json &value, const char *array);
    void expect(bool holds, const json &value, const char *wanted);
    void expect_integer(json &value, const char *wanted);
    /* Runs `each` on all entries with the location extended by their index. */
    template <class Each> void check_entries(json &value, Each each);
    /* The same for the members of an object. */
    template <class Each> void check_members(json &value, Each each);

    json &root_;
    bool lenient_;
    bool changed_ = false;
    gltf_json_repairs repairs_;
    std::map<std::string, uint64_t> counts_;
    std::string location_; /* a JSON pointer, extended and cut while descending */
};

/* The value as JSON, short enough for a message. */
static std::string shown(const json &value)
{
    if (value.is_structured())
        return value.is_array() ? "an array" : "an object";
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

void checker::expect(bool holds, const json &value, const char *wanted)
{
    if (!holds)
        fail("TYPE_MISMATCH", location_, "%s is not %s", shown(value).c_str(), wanted);
}

template <class Each> void checker::check_entries(json &value, Each each)
{
    expect(value.is_array(), value, "an array");
    size_t length = location_.size();
    for (size_t i = 0; i < value.size(); i++) {
        location_ += "/" + std::to_string(i);
        each(value[i]);
        location_.resize(length);
    }
}

/* An integer may be written as 1.0, which the specification forbids and tinygltf does not read. */
void checker::expect_integer(json &value, const char *wanted)
{
    if (value.is_number_float()) {
        double number = value.get<double>();
        if (number == std::floor(number) && std::fabs(number) <= 0x1p53) {
            if (number < 0.0)
                value = (int64_t)number;
            else
                value = (uint64_t)number;
            changed_ = true;
            repairs_.integers_rewritten++;
        }
    }
    expect(value.is_number_integer(), value, wanted);
}

void checker::check_integer(json &value, double low, double high)
{
    expect_integer(value, "an integer");
    bool inside = value.is_number_unsigned() && (double)value.get<uint64_t>() >= low &&
                  (double)value.get<uint64_t>() <= high;
    if (!inside)
        fail("VALUE_NOT_IN_RANGE", location_, "%s is not within %.0f to %.0f", shown(value).c_str(),
             low, high);
}

/* A factor from 0 to 1. */
void checker::check_share(json &value)
{
    double number = value.get<double>(), nearest = number > 1.0 ? 1.0 : 0.0;
    if (number >= 0.0 && number <= 1.0)
        return;
    bool rounding = std::fabs(number - nearest) <= ROUNDING;
    if (!rounding && !lenient_)
        fail("VALUE_NOT_IN_RANGE", location_,
             "%s is not within 0 to 1; correct it, or load the file leniently to use %.0f",
             shown(value).c_str(), nearest);
    value = nearest;
    changed_ = true;
    repairs_.shares_clamped += !rounding;
}

void checker::check_number(json &value, double low, double high, bool extension)
{
    expect(value.is_number(), value, "a number");
    if (low == 0.0 && high == 1.0)
        return check_share(value);
    double number = value.get<double>();
    if (!(number >= low && number <= high))
        fail("VALUE_NOT_IN_RANGE", location_, "%s is not within %.9g to %.9g", shown(value).c_str(),
             low, high);
    /* tinygltf keeps integers inside extensions in an int. */
    if (extension && value.is_number_integer() && (number < INT32_MIN || number > INT32_MAX))
        fail("VALUE_NOT_IN_RANGE", location_, "%s is too large an integer; write %s.0",
             shown(value).c_str(), shown(value).c_str());
}

/* True when `text` is one of the names between '|'. */
static bool among(const std::string &text, const char *names)
{
    for (const char *name = names; name;) {
        const char *end = strchr(name, '|');
        size_t length = end ? (size_t)(end - name) : strlen(name);
        if (text.size() == length && text.compare(0, length, name, length) == 0)
            return true;
        name = end ? end + 1 : nullptr;
    }
    return false;
}

void checker::check_code(json &value, const char *names)
{
    expect_integer(value, "an integer");
    if (!among(value.dump(), names))
        fail("VALUE_NOT_IN_LIST", location_, "%s is not one of %s", shown(value).c_str(), names);
}

void checker::check_name(const json &value, const char *names)
{
    expect(value.is_string(), value, "a string");
    if (!among(value.get_ref<const std::string &>(), names))
        fail("VALUE_NOT_IN_LIST", location_, "%s is not one of %s", shown(value).c_str(), names);
}

void checker::check_reference(json &value, const char *array)
{
    expect_integer(value, "an index");
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= count(array))
        fail("UNRESOLVED_REFERENCE", location_,
             "there is no entry %s in \"%s\", which has %" PRIu64, shown(value).c_str(), array,
             count(array));
}

template <class Each> void checker::check_members(json &value, Each each)
{
    expect(value.is_object(), value, "an object");
    size_t length = location_.size();
    for (auto &member : value.items()) {
        location_ += "/" + member.key();
        each(member.value());
        location_.resize(length);
    }
}

/* Some exporters write emissive colours with an alpha. */
void checker::cut_alpha(json &value, const rule &rule)
{
    if (value.size() != 4 || strcmp(rule.name, "emissiveFactor") != 0)
        return;
    value.erase(3);
    changed_ = true;
    repairs_.alphas_cut++;
}

void checker::check(json &value, const rule &rule, bool extension)
{
    switch (rule.kind) {
    case shape::boolean:
        return expect(value.is_boolean(), value, "true or false");
    case shape::string:
        return expect(value.is_string(), value, "a string");
    case shape::strings:
        return check_entries(
            value, [&](const json &entry) { expect(entry.is_string(), entry, "a string"); });
    case shape::one_of:
        return check_name(value, rule.names);
    case shape::integer:
        return check_integer(value, rule.low, rule.high);
    case shape::code:
        return check_code(value, rule.names);
    case shape::number:
        return check_number(value, rule.low, rule.high, extension);
    case shape::numbers:
        expect(value.is_array(), value, "an array");
        cut_alpha(value, rule);
        if (rule.entries && value.size() != rule.entries)
            fail("ARRAY_LENGTH_NOT_IN_LIST", location_, "%zu entries instead of %zu", value.size(),
                 rule.entries);
        return check_entries(
            value, [&](json &entry) { check_number(entry, rule.low, rule.high, extension); });
    case shape::reference:
        return check_reference(value, rule.names);
    case shape::integers:
        return check_members(value,
                             [&](json &member) { check_integer(member, rule.low, rule.high); });
    case shape::references:
        return check_entries(value, [&](json &entry) { check_reference(entry, rule.names); });
    case shape::object:
        return check_object(value, *rule.child, extension);
    case shape::objects:
        return check_entries(value,
                             [&](json &entry) { check_object(entry, *rule.child, extension); });
    case shape::attributes:
        return check_members(value, [&](json &member) { check_reference(member, "accessors"); });
    case shape::targets:
        return check_entries(value, [&](json &entry) {
            check_members(entry, [&](json &member) { check_reference(member, "accessors"); });
        });
    case shape::extensions:
        return check_object(value, *rule.child, true);
    }
}

void checker::check_object(json &value, const schema &schema, bool extension)
{
    expect(value.is_object(), value, "an object");
    size_t length = location_.size();
    for (size_t i = 0; i < schema.rule_count; i++) {
        const rule &rule = schema.rules[i];
        auto member = value.find(rule.name);
        if (member == value.end()) {
            if (rule.required)
                fail("UNDEFINED_PROPERTY", location_.empty() ? "/" : location_, "\"%s\" is missing",
                     rule.name);
            continue;
        }
        location_ += "/";
        location_ += rule.name;
        check(*member, rule, extension);
        location_.resize(length);
    }
}

/* --- rules that the tables cannot state --- */

static void check_version(const json &root)
{
    const json &asset = root["asset"];
    std::string wanted = asset["version"].get<std::string>();
    if (asset.contains("minVersion"))
        wanted = asset["minVersion"].get<std::string>();
    if (wanted.compare(0, 2, "2.") != 0 || (asset.contains("minVersion") && wanted != "2.0"))
        fail("UNKNOWN_ASSET_MAJOR_VERSION", "/asset",
             "glTF version \"%s\" is not supported; export the file as glTF 2.0", wanted.c_str());
}

/* A file of glTF 1.0 may name no version, and keys its buffers by their names. */
static void refuse_version_1(const json &root)
{
    auto asset = root.find("asset");
    bool named = asset != root.end() && asset->is_object() && asset->contains("version");
    const json version = named ? (*asset)["version"] : json();
    bool stated = (version.is_string() && version.get<std::string>().compare(0, 2, "1.") == 0) ||
                  (version.is_number() && version.get<double>() < 2);
    if (stated || (version.is_null() && root.contains("buffers") && root["buffers"].is_object()))
        fail("UNKNOWN_ASSET_MAJOR_VERSION", "/asset",
             "glTF version 1.0 is not supported; export the file as glTF 2.0");
}

static const char *remedy_for(const std::string &extension)
{
    if (extension == "KHR_texture_basisu" || extension == "EXT_texture_avif" ||
        extension == "MSFT_texture_dds")
        return "export the file with PNG or JPEG textures";
    return "export the file without it";
}

/* Extensions of materials, textures and lights, and extensions that only describe: without them
 * the scene has the same shapes in the same positions. */
static bool changes_look_alone(const std::string &extension)
{
    for (const char *part : {"_materials_", "_technique", "_texture_", "_lights_", "_xmp"})
        if (extension.find(part) != std::string::npos)
            return true;
    return false;
}

static void check_required_extensions(const json &root, bool lenient)
{
    auto required = root.find("extensionsRequired");
    if (required == root.end() || !required->is_array())
        return;
    for (size_t i = 0; i < required->size(); i++) {
        if (!(*required)[i].is_string())
            continue;
        std::string name = (*required)[i].get<std::string>();
        bool optional = changes_look_alone(name);
        if (!extension_is_supported(name) && !(optional && lenient))
            fail("UNSUPPORTED_EXTENSION", "/extensionsRequired/" + std::to_string(i),
                 "the file requires %s, which is not supported; %s%s", name.c_str(),
                 remedy_for(name),
                 optional ? ", or load it leniently to see how it looks without" : "");
    }
}

static void check_compressed_view(const json &root, const json &view, const json &extension,
                                  const std::vector<bool> &placeholders,
                                  const std::string &location)
{
    uint64_t offset = extension.value("byteOffset", (uint64_t)0), end, size;
    uint64_t length = extension["byteLength"].get<uint64_t>();
    size_t source = extension["buffer"].get<size_t>();
    const json &buffer = root["buffers"][source];
    if (__builtin_add_overflow(offset, length, &end) ||
        end > buffer["byteLength"].get<uint64_t>() || placeholders[source])
        fail("BUFFER_VIEW_TOO_LONG", location,
             "bytes from %" PRIu64 " on, %" PRIu64 " of them, are not in buffer %zu", offset,
             length, source);
    if (__builtin_mul_overflow(extension["count"].get<uint64_t>(),
                               extension["byteStride"].get<uint64_t>(), &size) ||
        size != view["byteLength"].get<uint64_t>())
        fail("COMPRESSED_DATA_INVALID", location,
             "%" PRIu64 " elements of %" PRIu64 " bytes are not the view's %" PRIu64 " bytes",
             extension["count"].get<uint64_t>(), extension["byteStride"].get<uint64_t>(),
             view["byteLength"].get<uint64_t>());
}

static void check_buffer_views(const json &root, const std::vector<bool> &placeholders)
{
    auto views = root.find("bufferViews");
    if (views == root.end())
        return;
    for (size_t i = 0; i < views->size(); i++) {
        const json &view = (*views)[i];
        uint64_t offset = view.value("byteOffset", (uint64_t)0), end;
        uint64_t available = root["buffers"][view["buffer"].get<size_t>()]["byteLength"];
        if (__builtin_add_overflow(offset, view["byteLength"].get<uint64_t>(), &end) ||
            end > available)
            fail("BUFFER_VIEW_TOO_LONG", location_of("bufferViews", i),
                 "bytes from %" PRIu64 " on, %" PRIu64 " of them, do not fit into buffer %" PRIu64
                 " of %" PRIu64 " bytes",
                 offset, view["byteLength"].get<uint64_t>(), view["buffer"].get<uint64_t>(),
                 available);
        if (view.contains("byteStride") && view["byteStride"].get<uint64_t>() % 4 != 0)
            fail("VALUE_NOT_IN_RANGE", location_of("bufferViews", i) + "/byteStride",
                 "%" PRIu64 " is not a multiple of 4", view["byteStride"].get<uint64_t>());
        if (const char *name = meshopt_extension_of(view))
            check_compressed_view(root, view, view["extensions"][name], placeholders,
                                  location_of("bufferViews", i) + "/extensions/" + name);
    }
}

/* tinygltf decodes those of known types, and names no cause where it cannot. */
static void check_image_uri(const std::string &uri, const std::string &location)
{
    if (tinygltf::IsDataURI(uri))
        uri_data_size(uri, location);
}

static void check_sources(const json &root)
{
    auto images = root.find("images");
    for (size_t i = 0; images != root.end() && i < images->size(); i++) {
        auto uri = (*images)[i].find("uri");
        if ((uri != (*images)[i].end()) == (*images)[i].contains("bufferView"))
            fail("ONE_OF_MISMATCH", location_of("images", i),
                 "exactly one of \"uri\" and \"bufferView\" must be given");
        if (uri != (*images)[i].end())
            check_image_uri(uri->get_ref<const std::string &>(), location_of("images", i) + "/uri");
    }
    auto accessors = root.find("accessors");
    if (accessors != root.end())
        for (size_t i = 0; i < accessors->size(); i++)
            if ((*accessors)[i].contains("byteOffset") && !(*accessors)[i].contains("bufferView"))
                fail("UNSATISFIED_DEPENDENCY", location_of("accessors", i),
                     "\"byteOffset\" without \"bufferView\"");
}

static void check_choices(const json &root)
{
    auto cameras = root.find("cameras");
    if (cameras != root.end())
        for (size_t i = 0; i < cameras->size(); i++) {
            std::string type = (*cameras)[i]["type"].get<std::string>();
            if (!(*cameras)[i].contains(type))
                fail("UNDEFINED_PROPERTY", location_of("cameras", i), "\"%s\" is missing",
                     type.c_str());
        }
    json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (root.contains(lights))
        for (size_t i = 0; i < root[lights].size(); i++)
            if (root[lights][i]["type"] == "spot" && !root[lights][i].contains("spot"))
                fail("UNDEFINED_PROPERTY",
                     "/extensions/KHR_lights_punctual/lights/" + std::to_string(i),
                     "\"spot\" is missing");
    auto nodes = root.find("nodes");
    if (nodes != root.end())
        for (size_t i = 0; i < nodes->size(); i++) {
            const json &node = (*nodes)[i];
            if (node.contains("matrix") && (node.contains("translation") ||
                                            node.contains("rotation") || node.contains("scale")))
                fail("NODE_MATRIX_TRS", location_of("nodes", i),
                     "a node has either \"matrix\" or translation, rotation and scale");
        }
}

gltf_checked gltf_schema_check(const gltf_container &container, bool lenient, memory_budget &budget)
{
    json_document document;
    json &root = document.root;
    parse(container.json, budget, root);
    refuse_version_1(root);
    checker checker(root, lenient);
    /* Checked first: data missing from such a file may be what the extension brings. */
    check_required_extensions(root, lenient);

    take_entries(budget, root);
    checker.check_object(root, gltf_root_schema);
    check_version(root);
    std::vector<bool> placeholders = placeholder_buffers(root, !container.binary.empty());
    check_buffer_views(root, placeholders);
    check_sources(root);
    check_choices(root);

    gltf_checked checked;
    checked.repairs = checker.repairs();
    adapt_document(root, checker.changed() || container.unpadded > 0, placeholders, checked);
    return checked;
}

} // namespace lsf
