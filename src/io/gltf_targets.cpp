#include "io/gltf_import.hpp"

#include <algorithm>
#include <cstring>
#include <map>

/* The targets of animation channels: a node's path or, by KHR_animation_pointer, the property
 * that a pointer into the document names. */

namespace lsf
{

static bool path_of(const std::string &name, lsf_animation_path &path)
{
    static const char *const names[] = {"translation", "rotation", "scale", "weights"};
    static const lsf_animation_path paths[] = {LSF_PATH_TRANSLATION, LSF_PATH_ROTATION,
                                               LSF_PATH_SCALE, LSF_PATH_WEIGHTS};
    for (size_t i = 0; i < 4; i++)
        if (name == names[i]) {
            path = paths[i];
            return true;
        }
    return false;
}

/* Reads digits from `at` on and moves it behind them; false where there are none. */
static bool read_index(const std::string &text, size_t &at, size_t &index)
{
    size_t first = at;
    index = 0;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && at - first < 10; at++)
        index = 10 * index + (size_t)(text[at] - '0');
    return at > first;
}

struct root {
    const char *prefix;
    lsf_kind of;
    size_t count;
};

/* The kind, number and property that the pointer names; false: it names none that is read. */
static bool split_pointer(const tinygltf::Model &model, gltf_target &target, std::string &name)
{
    const root roots[] = {
        {"/nodes/", LSF_KIND_NODE, model.nodes.size()},
        {"/materials/", LSF_KIND_MATERIAL, model.materials.size()},
        {"/cameras/", LSF_KIND_CAMERA, model.cameras.size()},
        {"/extensions/KHR_lights_punctual/lights/", LSF_KIND_LIGHT, model.lights.size()},
    };
    for (const root &each : roots) {
        size_t at = strlen(each.prefix);
        if (target.pointer.compare(0, at, each.prefix) != 0)
            continue;
        target.of = each.of;
        if (!read_index(target.pointer, at, target.index) || target.index >= each.count)
            fail("UNRESOLVED_REFERENCE", target.location,
                 "\"%s\" names nothing: the file has %zu of them", target.pointer.c_str(),
                 each.count);
        if (at >= target.pointer.size() || target.pointer[at] != '/')
            return false;
        name = target.pointer.substr(at + 1);
        return true;
    }
    return false;
}

/* "weights/2" of a node. */
static bool read_weight(const std::string &name, gltf_target &target)
{
    static const char prefix[] = "weights/";
    size_t at = sizeof prefix - 1, index;
    if (name.compare(0, at, prefix) != 0 || !read_index(name, at, index) || at != name.size())
        return false;
    target.path = LSF_PATH_WEIGHTS;
    target.weight = (int)std::min(index, (size_t)INT32_MAX);
    return true;
}

/* Specular-glossiness, which becomes another model, has its factors elsewhere. */
static bool is_converted(const gltf_import &import, const gltf_target &target)
{
    return target.of == LSF_KIND_MATERIAL &&
           import.model.materials[target.index].extensions.count(
               "KHR_materials_pbrSpecularGlossiness") != 0 &&
           (target.property->surface || target.pointer.find("pbrMetallic") != std::string::npos);
}

static bool resolve_pointer(const gltf_import &import, gltf_target &target)
{
    std::string name;
    if (!split_pointer(import.model, target, name))
        return false;
    if (target.of == LSF_KIND_NODE && (path_of(name, target.path) || read_weight(name, target)))
        return true;
    target.property = lsf_property_find(target.of, name.c_str(), &target.slot);
    return target.property && !is_converted(import, target);
}

/* File's nodes that take their weights from a mesh, by mesh; found when first asked for. */
using weight_takers = std::map<size_t, std::vector<size_t>>;

static const std::vector<size_t> &takers_of(const tinygltf::Model &model, size_t mesh,
                                            weight_takers &takers)
{
    for (size_t i = 0; takers.empty() && i < model.nodes.size(); i++)
        if (model.nodes[i].mesh >= 0 && model.nodes[i].weights.empty())
            takers[(size_t)model.nodes[i].mesh].push_back(i);
    return takers[mesh];
}

/* "/meshes/1/weights" are those of the nodes that have the mesh and no weights of their own: the
 * target becomes one for each. False: it is another pointer. */
static bool add_mesh_weights(gltf_import &import, const gltf_target &target, weight_takers &takers)
{
    static const char prefix[] = "/meshes/";
    size_t at = sizeof prefix - 1, mesh;
    if (target.pointer.compare(0, at, prefix) != 0 || !read_index(target.pointer, at, mesh) ||
        target.pointer.substr(at) != "/weights")
        return false;
    for (size_t i : takers_of(import.model, mesh, takers)) {
        import.budget.take(1, sizeof target + target.pointer.size() + target.location.size(),
                           target.location);
        import.targets.push_back(target);
        import.targets.back().index = i;
        import.targets.back().path = LSF_PATH_WEIGHTS;
    }
    return true;
}

/* False: the property is not read, or was added already. */
static bool read_target(gltf_import &import, const tinygltf::AnimationChannel &channel,
                        weight_takers &takers, gltf_target &target)
{
    auto extension = channel.target_extensions.find("KHR_animation_pointer");
    bool pointed = channel.target_path == "pointer";
    if (pointed && extension != channel.target_extensions.end()) {
        target.pointer = extension->second.Get("pointer").Get<std::string>();
        if (resolve_pointer(import, target))
            return true;
        if (add_mesh_weights(import, target, takers))
            return false;
        lsf_scene_add_note(import.scene, "animations of %s are ignored", target.pointer.c_str());
        return false;
    }
    if (!path_of(channel.target_path, target.path)) {
        lsf_scene_add_note(import.scene, "animations of anything but a node's translation, "
                                         "rotation, scale and weights are ignored");
        return false;
    }
    target.index = (size_t)channel.target_node;
    return channel.target_node >= 0; /* without a node: glTF 2.0, section 5.8 */
}

void gltf_targets_read(gltf_import &import)
{
    weight_takers takers;
    for (size_t a = 0; a < import.model.animations.size(); a++) {
        if (!import.scene->animations.items[a].chosen)
            continue;
        const tinygltf::Animation &animation = import.model.animations[a];
        for (size_t c = 0; c < animation.channels.size(); c++) {
            gltf_target target;
            target.animation = a;
            target.channel = c;
            target.location = location_of("animations", a) + "/channels/" + std::to_string(c);
            if ((size_t)animation.channels[c].sampler >= animation.samplers.size())
                fail("UNRESOLVED_REFERENCE", target.location, "there is no sampler %d",
                     animation.channels[c].sampler);
            if (!read_target(import, animation.channels[c], takers, target))
                continue;
            if (target.property)
                import.animated.insert({target.of, target.index, target.property});
            import.targets.push_back(target);
        }
    }
}

bool is_animated(const gltf_import &import, lsf_kind of, size_t index, const char *name)
{
    uint32_t slot;
    return import.animated.count({of, index, lsf_property_find(of, name, &slot)}) != 0;
}

} // namespace lsf
