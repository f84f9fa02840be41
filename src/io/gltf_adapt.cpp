#include "io/gltf_schema.hpp"

#include "io/gltf_import.hpp"

#include <nlohmann/json.hpp>

/* Legal parts of a document that tinygltf does not read are changed in the copy that it gets. */

namespace lsf
{

using nlohmann::json;

/* EXT_meshopt_compression: the buffer of views that are compressed in another one. */
bool is_placeholder(const json &buffer)
{
    static const json::json_pointer fallback("/extensions/EXT_meshopt_compression/fallback");
    return !buffer.contains("uri") && buffer.value(fallback, false);
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

void adapt_document(json &root, bool changed, gltf_checked &checked)
{
    bool placeholders = false;
    auto buffers = root.find("buffers");
    for (size_t i = 0; buffers != root.end() && i < buffers->size(); i++) {
        const json &buffer = (*buffers)[i];
        bool placeholder = is_placeholder(buffer);
        placeholders = placeholders || placeholder;
        checked.buffers.push_back({buffer.value("uri", std::string()),
                                   buffer["byteLength"].get<uint64_t>(), placeholder});
    }
    take_out_indices(root, checked);
    bool nodeless = name_no_nodes(root);
    if (!changed && !placeholders && !nodeless && checked.indices_without_view.empty())
        return;
    for (size_t i = 0; i < checked.buffers.size(); i++) {
        json &buffer = (*buffers)[i];
        if (checked.buffers[i].placeholder)
            buffer["byteLength"] = 1;
        if (!buffer.contains("uri"))
            buffer["uri"] = "none";
    }
    checked.json = root.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace lsf
