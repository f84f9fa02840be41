#include "io/gltf_import.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdlib>

/* EXT_mesh_gpu_instancing: a node whose mesh is shown many times, each time with a translation,
 * rotation and scale of its own below that of the node. Each time becomes a child node, so that
 * whatever moves the node moves them all. */

namespace lsf
{

struct instance_attribute {
    const char *name;
    int type;
    size_t width;
    bool may_be_integer; /* normalised bytes and shorts */
};
static const instance_attribute translation_attribute = {"TRANSLATION", TINYGLTF_TYPE_VEC3, 3,
                                                         false};
static const instance_attribute rotation_attribute = {"ROTATION", TINYGLTF_TYPE_VEC4, 4, true};
static const instance_attribute scale_attribute = {"SCALE", TINYGLTF_TYPE_VEC3, 3, false};

static int accessor_of(const tinygltf::Value &attributes, const char *name)
{
    return attributes.Has(name) ? attributes.Get(name).GetNumberAsInt() : -1;
}

static bool format_is_allowed(const tinygltf::Accessor &accessor,
                              const instance_attribute &attribute)
{
    bool integer = accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT);
    return accessor.type == attribute.type &&
           (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
            (attribute.may_be_integer && integer));
}

/* Empty where the node lacks the attribute. */
static std::vector<float> read_attribute(gltf_import &import, const tinygltf::Value &attributes,
                                         const instance_attribute &attribute, uint64_t count,
                                         const std::string &location, memory_loan &loan)
{
    std::vector<float> values;
    int index = accessor_of(attributes, attribute.name);
    if (index < 0)
        return values;
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)index];
    std::string where = location + "/attributes/" + attribute.name;
    if (!format_is_allowed(accessor, attribute))
        fail("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", where,
             "accessor %d is %s, which this attribute cannot be", index,
             accessor_format(accessor).c_str());
    if (accessor.count != count)
        fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", where,
             "accessor %d has %zu elements, the other attributes have %" PRIu64, index,
             accessor.count, count);
    loan.take(count, attribute.width * sizeof(float));
    accessor_read_floats(import, index, values);
    return values;
}

/* Number of instances; 0: no attribute says how many, and the node is an ordinary one. */
static uint64_t count_instances(const gltf_import &import, const tinygltf::Value &attributes)
{
    for (const instance_attribute *attribute :
         {&translation_attribute, &rotation_attribute, &scale_attribute}) {
        int index = accessor_of(attributes, attribute->name);
        if (index >= 0)
            return import.model.accessors[(size_t)index].count;
    }
    return 0;
}

static void copy_values(const std::vector<float> &values, uint64_t index, size_t width,
                        double *result)
{
    if (!values.empty())
        std::copy_n(&values[index * width], width, result);
}

static void add_instances(gltf_import &import, uint32_t parent, const tinygltf::Value &attributes,
                          const std::string &location)
{
    lsf_scene *scene = import.scene;
    uint64_t count = count_instances(import, attributes);
    if (count == 0)
        return;
    import.budget.take(count, node_bytes(scene->nodes[parent].name) + sizeof(uint32_t), location);
    memory_loan loan(import.budget, location);
    std::vector<float> translations =
        read_attribute(import, attributes, translation_attribute, count, location, loan);
    std::vector<float> rotations =
        read_attribute(import, attributes, rotation_attribute, count, location, loan);
    std::vector<float> scales =
        read_attribute(import, attributes, scale_attribute, count, location, loan);
    if (count >= LSF_NONE - scene->node_count)
        fail("MEMORY_LIMIT", location, "%" PRIu64 " instances are too many", count);

    void *grown = realloc(scene->nodes, (scene->node_count + count) * sizeof(lsf_node));
    if (!grown)
        throw std::bad_alloc();
    scene->nodes = static_cast<lsf_node *>(grown);
    for (uint64_t i = 0; i < count; i++) {
        double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
        copy_values(translations, i, 3, translation);
        copy_values(rotations, i, 4, rotation);
        copy_values(scales, i, 3, scale);
        lsf_node &node = scene->nodes[scene->node_count];
        node = {};
        node.name = copy_text(scene->nodes[parent].name);
        scene->node_count++;
        node.parent = parent;
        import.source_of.push_back(import.source_of[parent]);
        node.mesh = scene->nodes[parent].mesh;
        node.camera = node.light = LSF_NONE;
        set_trs(import, translation, rotation, scale, node);
    }
    scene->nodes[parent].mesh = LSF_NONE;
}

void gltf_instancing_import(gltf_import &import)
{
    for (size_t i = 0; i < import.model.nodes.size(); i++) {
        const tinygltf::Node &source = import.model.nodes[i];
        auto extension = source.extensions.find("EXT_mesh_gpu_instancing");
        if (extension == source.extensions.end() || source.mesh < 0 ||
            import.node_of[i] == LSF_NONE || import.never_seen[import.node_of[i]])
            continue;
        add_instances(import, import.node_of[i], extension->second.Get("attributes"),
                      location_of("nodes", i) + "/extensions/EXT_mesh_gpu_instancing");
    }
}

} // namespace lsf
