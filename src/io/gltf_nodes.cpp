#include "io/gltf_import.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

/* The node hierarchy, walked without recursion: a chain may be a million nodes long. */

namespace lsf
{

/* Every node's parent, LSF_NONE for roots; a forest, or an error. */
static std::vector<uint32_t> find_parents(const tinygltf::Model &model)
{
    std::vector<uint32_t> parents(model.nodes.size(), LSF_NONE);
    for (size_t i = 0; i < model.nodes.size(); i++)
        for (int child : model.nodes[i].children) {
            if (parents[(size_t)child] != LSF_NONE)
                fail("NODE_PARENT_OVERRIDE", location_of("nodes", i) + "/children",
                     "node %d has another parent, node %u", child, parents[(size_t)child]);
            parents[(size_t)child] = (uint32_t)i;
        }
    return parents;
}

/* Nodes below `roots`, each parent before its children, siblings in the file's order. */
static std::vector<uint32_t> walk(const tinygltf::Model &model, const std::vector<uint32_t> &roots)
{
    std::vector<uint32_t> order, stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
        uint32_t node = stack.back();
        stack.pop_back();
        order.push_back(node);
        const std::vector<int> &children = model.nodes[node].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    return order;
}

static std::vector<uint32_t> forest_roots(const std::vector<uint32_t> &parents)
{
    std::vector<uint32_t> roots;
    for (size_t i = 0; i < parents.size(); i++)
        if (parents[i] == LSF_NONE)
            roots.push_back((uint32_t)i);
    return roots;
}

/* All nodes, parents before children. With at most one parent each, nodes that no root reaches are
 * in a loop or below one. */
static std::vector<uint32_t> walk_forest(const tinygltf::Model &model,
                                         const std::vector<uint32_t> &parents)
{
    std::vector<uint32_t> order = walk(model, forest_roots(parents));
    std::vector<bool> reached(parents.size());
    for (uint32_t node : order)
        reached[node] = true;
    for (size_t i = 0; i < parents.size(); i++)
        if (!reached[i])
            fail("NODE_LOOP", location_of("nodes", i),
                 "the node is its own ancestor, or below one that is");
    return order;
}

/* The topmost nodes of the chosen scene; of a file without scenes, all roots. A scene may only list
 * nodes without a parent (glTF 2.0, 3.5.1), but some exporters (UniGLTF 1.27) list children. These
 * are drawn where their parent puts them if an ancestor is listed, too, else as roots without the
 * parent's transform, as in other renderers. */
static std::vector<uint32_t> scene_roots(gltf_import &import, const std::vector<uint32_t> &parents)
{
    const tinygltf::Model &model = import.model;
    std::vector<uint32_t> order = walk_forest(model, parents), roots;
    if (model.scenes.empty())
        return forest_roots(parents);
    const std::vector<int> &nodes = model.scenes[import.chosen_scene].nodes;
    std::vector<bool> listed(parents.size()), below(parents.size()); /* a listed node */
    for (int node : nodes) {
        if (listed[(size_t)node])
            fail("DUPLICATE_ELEMENTS", location_of("scenes", import.chosen_scene) + "/nodes",
                 "node %d is listed twice", node);
        listed[(size_t)node] = true;
        import.repairs.scene_children += parents[(size_t)node] != LSF_NONE;
    }
    for (uint32_t node : order)
        below[node] = parents[node] != LSF_NONE && (listed[parents[node]] || below[parents[node]]);
    for (int node : nodes)
        if (!below[(size_t)node])
            roots.push_back((uint32_t)node);
    return roots;
}

void set_trs(gltf_import &import, const double translation[3], const double rotation_xyzw[4],
             const double scale[3], lsf_node &node)
{
    for (int i = 0; i < 16; i++)
        node.matrix[i] = i % 5 == 0 ? 1.0 : 0.0;
    std::copy_n(translation, 3, node.translation);
    std::copy_n(scale, 3, node.scale);
    glm::dquat rotation(rotation_xyzw[3], rotation_xyzw[0], rotation_xyzw[1],
                        rotation_xyzw[2]); /* w first */
    /* Files hold rotations as floats: up to 1e-6 is rounding. */
    if (std::fabs(glm::length(rotation) - 1.0) > 1e-4)
        import.repairs.rotations_scaled++;
    rotation = glm::normalize(rotation); /* of no length: the identity */
    const double components[4] = {rotation.x, rotation.y, rotation.z, rotation.w};
    std::copy(components, components + 4, node.rotation);
}

static void set_transform(gltf_import &import, const tinygltf::Node &source,
                          const std::string &location, lsf_node &node)
{
    const double origin[3] = {0, 0, 0}, upright[4] = {0, 0, 0, 1}, unscaled[3] = {1, 1, 1};
    set_trs(import, source.translation.empty() ? origin : source.translation.data(),
            source.rotation.empty() ? upright : source.rotation.data(),
            source.scale.empty() ? unscaled : source.scale.data(), node);
    node.has_matrix = !source.matrix.empty();
    if (!node.has_matrix)
        return;
    std::copy(source.matrix.begin(), source.matrix.end(), node.matrix);
    if (node.matrix[3] != 0.0 || node.matrix[7] != 0.0 || node.matrix[11] != 0.0 ||
        node.matrix[15] != 1.0)
        fail("NODE_MATRIX_NON_TRS", location + "/matrix",
             "the last row must be 0, 0, 0, 1; export the file again");
}

/* KHR_node_visibility, unless an animation shows it. */
static bool is_never_seen(const gltf_import &import, uint32_t index)
{
    auto extension = import.model.nodes[index].extensions.find("KHR_node_visibility");
    return extension != import.model.nodes[index].extensions.end() &&
           extension->second.Has("visible") && !extension->second.Get("visible").Get<bool>() &&
           !is_animated(import, LSF_KIND_NODE, index, lsf_property_visible->name);
}

uint64_t node_bytes(const char *name)
{
    const uint64_t block_bytes = 32; /* memory of a short text on the heap */
    return sizeof(lsf_node) + sizeof(double[16]) + block_bytes + strlen(name);
}

void gltf_nodes_import(gltf_import &import)
{
    const tinygltf::Model &model = import.model;
    lsf_scene *scene = import.scene;
    std::vector<uint32_t> parents = find_parents(model);
    std::vector<uint32_t> order = walk(model, scene_roots(import, parents));

    import.node_of.assign(model.nodes.size(), LSF_NONE);
    import.source_of = order;
    import.skin_of.assign(model.skins.size(), LSF_NONE);
    import.mesh_used.assign(model.meshes.size(), false);
    import.budget.take(order.size(), node_bytes("") + sizeof(uint32_t),
                       "/nodes"); /* names are part of the document */
    scene->nodes = static_cast<lsf_node *>(allocate(order.size(), sizeof(lsf_node)));
    for (size_t i = 0; i < order.size(); i++) {
        const tinygltf::Node &source = model.nodes[order[i]];
        import.node_of[order[i]] = (uint32_t)i;
        lsf_node &node = scene->nodes[i];
        node.name = copy_text(source.name);
        scene->node_count++;
        uint32_t parent = parents[order[i]];
        node.parent = parent == LSF_NONE ? LSF_NONE : import.node_of[parent];
        node.mesh = source.mesh >= 0 ? (uint32_t)source.mesh : LSF_NONE;
        node.camera = node.light = LSF_NONE;
        set_transform(import, source, location_of("nodes", order[i]), node);
        bool below = node.parent != LSF_NONE && import.never_seen[node.parent];
        import.never_seen.push_back(below || is_never_seen(import, order[i]));
        if (import.never_seen[i])
            node.mesh = LSF_NONE;
        if (node.mesh != LSF_NONE)
            import.mesh_used[node.mesh] = true;
    }
}

} // namespace lsf
