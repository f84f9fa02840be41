#include "io/gltf_schema.hpp"

#include "io/gltf_import.hpp"

#include <nlohmann/json.hpp>

/* Legal parts of a document that tinygltf does not read are changed in the copy that it gets. */

namespace lsf
{

using nlohmann::json;

const char *meshopt_extension_of(const json &object)
{
    auto extensions = object.find("extensions");
    if (extensions == object.end())
        return nullptr;
    for (const char *name : MESHOPT_EXTENSIONS)
        if (extensions->contains(name))
            return name;
    return nullptr;
}

std::vector<bool> placeholder_buffers(const json &root, bool has_binary)
{
    auto buffers = root.find("buffers"), views = root.find("bufferViews");
    std::vector<bool> placeholders(buffers == root.end() ? 0 : buffers->size());
    for (size_t i = 0; i < placeholders.size(); i++) {
        const json &buffer = (*buffers)[i];
        const char *name = meshopt_extension_of(buffer);
        placeholders[i] = name && buffer["extensions"][name].value("fallback", false);
    }
    /* Not every exporter marks them. */
    for (size_t i = 0; views != root.end() && i < views->size(); i++)
        if (meshopt_extension_of((*views)[i]))
            placeholders[(*views)[i]["buffer"].get<size_t>()] = true;
    /* Nothing is missing from buffers that no view reads. */
    std::vector<bool> viewed(placeholders.size());
    for (size_t i = 0; views != root.end() && i < views->size(); i++)
        viewed[(*views)[i]["buffer"].get<size_t>()] = true;
    for (size_t i = 0; i < placeholders.size(); i++) {
        const json &buffer = (*buffers)[i];
        bool has_data = buffer.contains("uri") || (i == 0 && has_binary);
        placeholders[i] =
            buffer["byteLength"] == 0 || (!has_data && (placeholders[i] || !viewed[i]));
    }
    return placeholders;
}

/* Indices of an accessor without a buffer view: legal, and what KHR_draco_mesh_compression brings.
 */
static void take_out_indices(json &root, gltf_checked &checked)
{
    auto meshes = root.find("meshes");
    for (size_t m = 0; meshes != root.end() && m < meshes->size(); m++) {
        json &primitives = (*meshes)[m]["primitives"];
        for (size_t p = 0; p < primitives.size(); p++) {
            auto indices = primitives[p].find("indices");
            if (indices == primitives[p].end())
                continue;
            size_t accessor = indices->get<size_t>();
            if (root["accessors"][accessor].contains("bufferView"))
                continue;
            checked.indices_without_view.push_back({m, p, (int)accessor});
            primitives[p].erase(indices);
        }
    }
}

/* Channels without a node are legal: extensions name their target. False when there are none. */
static bool name_no_nodes(json &root)
{
    bool any = false;
    auto animations = root.find("animations");
    for (size_t a = 0; animations != root.end() && a < animations->size(); a++)
        for (json &channel : (*animations)[a]["channels"]) {
            json &target = channel["target"];
            if (target.contains("node"))
                continue;
            target["node"] = -1;
            any = true;
        }
    return any;
}

void adapt_document(json &root, bool changed, const std::vector<bool> &placeholders,
                    gltf_checked &checked)
{
    auto buffers = root.find("buffers");
    for (size_t i = 0; buffers != root.end() && i < buffers->size(); i++) {
        const json &buffer = (*buffers)[i];
        changed = changed || placeholders[i];
        checked.buffers.push_back({buffer.value("uri", std::string()),
                                   buffer["byteLength"].get<uint64_t>(), placeholders[i]});
    }
    take_out_indices(root, checked);
    bool nodeless = name_no_nodes(root);
    if (!changed && !nodeless && checked.indices_without_view.empty())
        return;
    for (size_t i = 0; i < checked.buffers.size(); i++) {
        json &buffer = (*buffers)[i];
        if (placeholders[i])
            buffer["byteLength"] = 1;
        if (placeholders[i] || !buffer.contains("uri"))
            buffer["uri"] = "none";
    }
    checked.json = root.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace lsf
