#include "io/gltf_deform.hpp"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <map>

namespace lsf
{

/* --- weights of morph targets --- */

/* A primitive may have fewer targets than others: those that it lacks move nothing. */
static uint64_t target_count(gltf_import &import, const tinygltf::Mesh &mesh)
{
    size_t count = 0;
    for (const tinygltf::Primitive &primitive : mesh.primitives)
        count = std::max(count, primitive.targets.size());
    for (const tinygltf::Primitive &primitive : mesh.primitives)
        import.repairs.targets_missing += primitive.targets.size() < count;
    return count;
}

/* The node's weights, else the mesh's, else 0. */
static void set_weights(const gltf_import &import, size_t node, uint64_t count, float *weights)
{
    const tinygltf::Node &source = import.model.nodes[node];
    const tinygltf::Mesh &mesh = import.model.meshes[(size_t)source.mesh];
    bool own = !source.weights.empty();
    const std::vector<double> &values = own ? source.weights : mesh.weights;
    if (!values.empty() && values.size() != count)
        fail(own ? "NODE_WEIGHTS_INVALID" : "MESH_INVALID_WEIGHTS_COUNT",
             own ? location_of("nodes", node) + "/weights"
                 : location_of("meshes", (size_t)source.mesh) + "/weights",
             "%zu weights for %" PRIu64 " morph targets", values.size(), count);
    for (size_t i = 0; i < values.size(); i++)
        weights[i] = (float)values[i];
}

void weights_import(gltf_import &import)
{
    const tinygltf::Model &model = import.model;
    std::vector<uint32_t> first(model.nodes.size(), LSF_NONE);
    std::vector<float> weights;
    std::vector<uint64_t> counts(model.meshes.size());
    for (size_t mesh = 0; mesh < counts.size(); mesh++)
        counts[mesh] = import.mesh_used[mesh] ? target_count(import, model.meshes[mesh]) : 0;
    for (uint32_t i = 0; i < import.scene->node_count; i++) {
        size_t node = import.source_of[i];
        if (model.nodes[node].mesh < 0)
            continue;
        uint64_t count = counts[(size_t)model.nodes[node].mesh];
        if (count == 0)
            continue;
        if (first[node] == LSF_NONE) {
            import.budget.take(count, 2 * sizeof(float), location_of("nodes", node));
            first[node] = (uint32_t)weights.size();
            weights.resize(weights.size() + count);
            set_weights(import, node, count, &weights[first[node]]);
        }
        import.scene->nodes[i].first_weight = first[node];
        import.scene->nodes[i].weight_count = (uint32_t)count;
    }
    import.scene->weights = copy_array(weights);
    import.scene->weight_count = (uint32_t)weights.size();
}

/* --- skins --- */

/* Column-major; the last row of an inverse bind matrix is not used. */
static void read_inverse_bind(gltf_import &import, const tinygltf::Skin &source,
                              const std::string &location, std::vector<lsf_joint> &joints)
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (lsf_joint &joint : joints)
        std::copy_n(identity, 16, joint.inverse_bind);
    if (source.inverseBindMatrices < 0)
        return;
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)source.inverseBindMatrices];
    std::string where = location + "/inverseBindMatrices";
    if (accessor.type != TINYGLTF_TYPE_MAT4 ||
        accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fail("SKIN_IBM_INVALID_FORMAT", where, "accessor %d is %s; it must be MAT4 of FLOAT",
             source.inverseBindMatrices, accessor_format(accessor).c_str());
    if (accessor.count < joints.size())
        fail("INVALID_IBM_ACCESSOR_COUNT", where, "%zu matrices for %zu joints", accessor.count,
             joints.size());
    memory_loan loan(import.budget, where);
    loan.take(accessor.count, 16 * sizeof(float));
    std::vector<float> values;
    accessor_read_floats(import, source.inverseBindMatrices, values);
    for (size_t i = 0; i < joints.size(); i++)
        std::copy_n(&values[16 * i], 16, joints[i].inverse_bind);
}

uint32_t skin_import(gltf_import &import, int index)
{
    lsf_scene *scene = import.scene;
    uint32_t &known = import.skin_of[(size_t)index];
    if (known != LSF_NONE)
        return known;
    const tinygltf::Skin &source = import.model.skins[(size_t)index];
    std::string location = location_of("skins", (size_t)index);
    if (source.joints.empty())
        fail("EMPTY_ENTITY", location + "/joints", "a skin needs at least one joint");
    /* Poses take a matrix for each, now and before, and a copy of what was drawn of both. */
    import.budget.take(source.joints.size(), sizeof(lsf_joint) + 4 * 12 * sizeof(float), location);
    std::vector<lsf_joint> joints(source.joints.size());
    for (size_t i = 0; i < joints.size(); i++) {
        joints[i].node = import.node_of[(size_t)source.joints[i]];
        if (joints[i].node == LSF_NONE)
            fail("NODE_SKIN_NO_SCENE", location + "/joints/" + std::to_string(i),
                 "joint node %d is not in the scene that its mesh is in; choose another scene, or "
                 "add the joint's root to it",
                 source.joints[i]);
    }
    read_inverse_bind(import, source, location, joints);
    void *grown = realloc(scene->joints, (scene->joint_count + joints.size()) * sizeof(lsf_joint));
    if (!grown)
        throw std::bad_alloc();
    scene->joints = static_cast<lsf_joint *>(grown);
    std::copy(joints.begin(), joints.end(), scene->joints + scene->joint_count);
    if (!scene->skins)
        scene->skins =
            static_cast<lsf_skin *>(allocate(import.model.skins.size(), sizeof(lsf_skin)));
    scene->skins[scene->skin_count] = {scene->joint_count, (uint32_t)joints.size()};
    scene->joint_count += (uint32_t)joints.size();
    return known = scene->skin_count++;
}

/* --- shapes --- */

static bool format_is_signed(const tinygltf::Accessor &accessor, bool any)
{
    bool integer = accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                   accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
    return accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           (integer && (any || accessor.normalized));
}

static bool format_is_unsigned(const tinygltf::Accessor &accessor, bool normalized)
{
    return accessor.normalized == normalized &&
           (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
            accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

/* Values of an accessor for each of the file's vertices. */
static std::vector<float> read_checked(gltf_import &import, int index, int type, bool allowed,
                                       uint64_t count, const std::string &where)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)index];
    if (accessor.type != type || !allowed)
        fail("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", where,
             "accessor %d is %s, which this attribute cannot be", index,
             accessor_format(accessor).c_str());
    if (accessor.count != count)
        fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", where,
             "accessor %d has %zu elements, POSITION has %" PRIu64, index, accessor.count, count);
    std::vector<float> values;
    accessor_read_floats(import, index, values);
    return values;
}

static uint64_t source_vertices(const gltf_import &import, const tinygltf::Primitive &primitive)
{
    return import.model.accessors[(size_t)find_attribute(primitive, "POSITION")].count;
}

/* The deltas of one attribute, of all targets. */
static float *read_deltas(gltf_import &import, const tinygltf::Primitive &primitive,
                          const char *name, const vertex_arrays &arrays,
                          const std::string &location)
{
    bool any = false;
    for (const auto &target : primitive.targets)
        any = any || target.count(name) > 0;
    if (!any)
        return nullptr;
    uint64_t width = 3 * arrays.count, sources = source_vertices(import, primitive);
    import.budget.take(primitive.targets.size(), width * sizeof(float), location);
    memory_loan loan(import.budget, location);
    loan.take(sources, 3 * sizeof(float));
    auto deltas = std::unique_ptr<float, decltype(&std::free)>(
        static_cast<float *>(allocate(primitive.targets.size() * width, sizeof(float))), std::free);
    for (size_t t = 0; t < primitive.targets.size(); t++) {
        auto found = primitive.targets[t].find(name);
        if (found == primitive.targets[t].end())
            continue;
        const tinygltf::Accessor &accessor = import.model.accessors[(size_t)found->second];
        bool is_position = std::string(name) == "POSITION";
        std::vector<float> values = read_checked(
            import, found->second, TINYGLTF_TYPE_VEC3, format_is_signed(accessor, is_position),
            sources, location + "/targets/" + std::to_string(t) + "/" + name);
        for (uint64_t i = 0; i < arrays.count; i++)
            std::copy_n(&values[3 * arrays.source(i)], 3, deltas.get() + t * width + 3 * i);
    }
    return deltas.release();
}

/* Joints and weights of the file's vertices in one set of four. */
struct influence_set {
    std::vector<float> joints, weights;
};

static influence_set read_set(gltf_import &import, const tinygltf::Primitive &primitive,
                              uint32_t set, const std::string &location)
{
    std::string joints = "JOINTS_" + std::to_string(set),
                weights = "WEIGHTS_" + std::to_string(set);
    int joint_index = find_attribute(primitive, joints.c_str());
    int weight_index = find_attribute(primitive, weights.c_str());
    if (weight_index < 0)
        fail("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", location + "/attributes",
             "there is %s, but no %s", joints.c_str(), weights.c_str());
    const tinygltf::Accessor &joint_accessor = import.model.accessors[(size_t)joint_index];
    const tinygltf::Accessor &weight_accessor = import.model.accessors[(size_t)weight_index];
    bool is_float = weight_accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    uint64_t count = source_vertices(import, primitive);
    influence_set result;
    result.joints = read_checked(import, joint_index, TINYGLTF_TYPE_VEC4,
                                 format_is_unsigned(joint_accessor, false), count,
                                 location + "/attributes/" + joints);
    result.weights = read_checked(import, weight_index, TINYGLTF_TYPE_VEC4,
                                  is_float || format_is_unsigned(weight_accessor, true), count,
                                  location + "/attributes/" + weights);
    for (size_t i = 0; i < result.weights.size(); i++)
        if (result.weights[i] < 0.0f)
            fail("ACCESSOR_WEIGHTS_NEGATIVE", location + "/attributes/" + weights,
                 "vertex %zu has weight %g", i / 4, (double)result.weights[i]);
    return result;
}

/* Makes weights sum to 1, and names joint 0 where they are 0. A vertex without any follows its
 * first joint. */
static void normalise_weights(gltf_import &import, lsf_shape &shape)
{
    const double off = 0.01; /* weights of 8 bits are rounded by less */
    for (uint64_t i = 0; i < shape.vertex_count; i++) {
        uint16_t *joints = shape.joints + i * shape.influences;
        float *weights = shape.weights + i * shape.influences;
        double sum = 0.0;
        for (uint32_t k = 0; k < shape.influences; k++)
            sum += (double)weights[k];
        import.repairs.weights_scaled += std::fabs(sum - 1.0) > off;
        if (!(sum > 0.0))
            weights[0] = 1.0f;
        for (uint32_t k = 0; k < shape.influences; k++) {
            weights[k] = sum > 0.0 ? (float)((double)weights[k] / sum) : weights[k];
            joints[k] = weights[k] > 0.0f ? joints[k] : (uint16_t)0;
        }
    }
}

static void read_influences(gltf_import &import, const tinygltf::Primitive &primitive,
                            const vertex_arrays &arrays, const std::string &location,
                            lsf_shape &shape)
{
    uint32_t sets = 0;
    while (find_attribute(primitive, ("JOINTS_" + std::to_string(sets)).c_str()) >= 0)
        sets++;
    shape.influences = 4 * sets;
    if (sets == 0)
        return;
    import.budget.take(arrays.count, shape.influences * (sizeof(uint16_t) + sizeof(float)),
                       location);
    memory_loan loan(import.budget, location);
    loan.take(source_vertices(import, primitive), 8 * sizeof(float));
    shape.joints =
        static_cast<uint16_t *>(allocate(arrays.count * shape.influences, sizeof(uint16_t)));
    shape.weights = static_cast<float *>(allocate(arrays.count * shape.influences, sizeof(float)));
    for (uint32_t set = 0; set < sets; set++) {
        influence_set values = read_set(import, primitive, set, location);
        for (uint64_t i = 0; i < arrays.count; i++)
            for (uint32_t k = 0; k < 4; k++) {
                uint64_t from = 4 * arrays.source(i) + k;
                uint64_t to = i * shape.influences + 4 * set + k;
                shape.joints[to] = (uint16_t)values.joints[from];
                shape.weights[to] = values.weights[from];
            }
    }
    normalise_weights(import, shape);
}

bool has_shape(const tinygltf::Primitive &primitive, bool skinned)
{
    return !primitive.targets.empty() || (skinned && find_attribute(primitive, "JOINTS_0") >= 0);
}

uint32_t shape_import(gltf_import &import, const tinygltf::Primitive &primitive, bool skinned,
                      bool flat, const vertex_arrays &arrays, const std::string &location)
{
    lsf_scene *scene = import.scene;
    void *grown = scene->shapes;
    if (!lsf_grow(&grown, &import.shape_capacity, scene->shape_count + 1, sizeof(lsf_shape)))
        throw std::bad_alloc();
    scene->shapes = static_cast<lsf_shape *>(grown);
    lsf_shape &shape = scene->shapes[scene->shape_count++];
    shape = {};
    shape.vertex_count = (uint32_t)arrays.count;
    shape.target_count = (uint32_t)primitive.targets.size();
    shape.flat = flat;
    shape.position_deltas = read_deltas(import, primitive, "POSITION", arrays, location);
    if (!flat)
        shape.normal_deltas = read_deltas(import, primitive, "NORMAL", arrays, location);
    /* glTF: where the mesh has none, they are to be ignored. */
    if (scene->vertices.tangent && !flat && find_attribute(primitive, "TANGENT") >= 0)
        shape.tangent_deltas = read_deltas(import, primitive, "TANGENT", arrays, location);
    if (skinned)
        read_influences(import, primitive, arrays, location, shape);
    return scene->shape_count - 1;
}

void check_joints(const gltf_import &import, uint32_t index, uint32_t skin,
                  const std::string &location)
{
    const lsf_shape &shape = import.scene->shapes[index];
    uint32_t count = import.scene->skins[skin].joint_count;
    for (uint64_t i = 0; i < (uint64_t)shape.vertex_count * shape.influences; i++)
        if (shape.joints[i] >= count)
            fail("ACCESSOR_JOINTS_INDEX_OOB", location,
                 "a vertex of its mesh follows joint %u; its skin has %u", shape.joints[i], count);
}

} // namespace lsf
