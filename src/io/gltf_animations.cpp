#include "io/gltf_import.hpp"

#include <cstring>
#include <set>

/* Node animations; what else an animation may target is noted and ignored. */

namespace lsf
{

struct channel_source {
    lsf_animation_channel channel;
    int input, output;
    std::string location;
};

static bool path_of(const std::string &name, lsf_animation_path &path)
{
    if (name == "translation")
        path = LSF_PATH_TRANSLATION;
    else if (name == "rotation")
        path = LSF_PATH_ROTATION;
    else if (name == "scale")
        path = LSF_PATH_SCALE;
    else if (name == "weights")
        path = LSF_PATH_WEIGHTS;
    else
        return false;
    return true;
}

static float *copy_floats(gltf_import &import, int accessor, const std::string &location)
{
    std::vector<float> values;
    uint64_t count = import.model.accessors[(size_t)accessor].count;
    memory_loan loan(import.budget, location);
    loan.take(count, 4 * sizeof(float));
    import.budget.take(count, 4 * sizeof(float), location);
    accessor_read_floats(import, accessor, values);
    return copy_array(values);
}

static void read_times(gltf_import &import, const channel_source &source,
                       lsf_animation_channel &channel)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)source.input];
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fail("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", source.location,
             "key times are %s; they must be SCALAR of FLOAT", accessor_format(accessor).c_str());
    channel.times = copy_floats(import, source.input, source.location);
    if (accessor.count > UINT32_MAX)
        fail("ACCESSOR_TOO_LONG", source.location, "too many keys");
    channel.key_count = (uint32_t)accessor.count;
    for (uint32_t i = 0; i < channel.key_count; i++) {
        if (channel.times[i] < 0.0f)
            fail("ACCESSOR_ANIMATION_INPUT_NEGATIVE", source.location, "key %u has time %g", i,
                 (double)channel.times[i]);
        if (i > 0 && !(channel.times[i] > channel.times[i - 1]))
            fail("ACCESSOR_ANIMATION_INPUT_NON_INCREASING", source.location,
                 "key %u is not later than the one before", i);
    }
}

static void read_values(gltf_import &import, const channel_source &source,
                        lsf_animation_channel &channel)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)source.output];
    bool rotation = channel.path == LSF_PATH_ROTATION, weights = channel.path == LSF_PATH_WEIGHTS;
    bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    int type = rotation ? TINYGLTF_TYPE_VEC4 : weights ? TINYGLTF_TYPE_SCALAR : TINYGLTF_TYPE_VEC3;
    if (accessor.type != type || !(is_float || ((rotation || weights) && accessor.normalized)))
        fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", source.location,
             "values are %s; %s", accessor_format(accessor).c_str(),
             rotation  ? "rotations must be VEC4 of FLOAT or normalised integers"
             : weights ? "weights must be SCALAR of FLOAT or normalised integers"
                       : "translations and scales must be VEC3 of FLOAT");
    uint64_t wanted = (uint64_t)channel.key_count * (channel.interpolation == LSF_CUBIC ? 3 : 1) *
                      (weights ? channel.weight_count : 1);
    if (accessor.count != wanted)
        fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", source.location,
             "%zu values for %u keys; there must be %llu", accessor.count, channel.key_count,
             (unsigned long long)wanted);
    channel.values = copy_floats(import, source.output, source.location);
}

static std::vector<channel_source> find_channels(gltf_import &import)
{
    std::vector<channel_source> channels;
    std::set<std::pair<uint32_t, int>> taken;
    bool other = false, overlapping = false;
    for (size_t a = 0; a < import.model.animations.size(); a++) {
        if (!import.scene->animations.items[a].chosen)
            continue;
        const tinygltf::Animation &animation = import.model.animations[a];
        std::set<std::pair<uint32_t, int>> own;
        for (size_t c = 0; c < animation.channels.size(); c++) {
            const tinygltf::AnimationChannel &source = animation.channels[c];
            std::string location = location_of("animations", a) + "/channels/" + std::to_string(c);
            if ((size_t)source.sampler >= animation.samplers.size())
                fail("UNRESOLVED_REFERENCE", location, "there is no sampler %d", source.sampler);
            channel_source found = {};
            if (!path_of(source.target_path, found.channel.path)) {
                other = true;
                continue;
            }
            uint32_t node = import.node_of[(size_t)source.target_node];
            if (node == LSF_NONE)
                continue;
            const lsf_node &target = import.scene->nodes[node];
            bool weights = found.channel.path == LSF_PATH_WEIGHTS;
            if (weights && target.weight_count == 0) {
                import.repairs.weights_animated++;
                continue;
            }
            if (!weights && target.has_matrix)
                fail("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", location,
                     "node %d has a matrix; animated nodes need translation, rotation and scale",
                     source.target_node);
            if (!own.insert({node, found.channel.path}).second)
                fail("ANIMATION_DUPLICATE_TARGETS", location,
                     "another channel of the animation has the same target");
            if (!taken.insert({node, found.channel.path}).second) {
                overlapping = true;
                continue;
            }
            const tinygltf::AnimationSampler &sampler = animation.samplers[(size_t)source.sampler];
            found.channel.node = node;
            found.channel.weight_count = target.weight_count;
            found.channel.interpolation = sampler.interpolation == "STEP"          ? LSF_STEP
                                          : sampler.interpolation == "CUBICSPLINE" ? LSF_CUBIC
                                                                                   : LSF_LINEAR;
            found.input = sampler.input;
            found.output = sampler.output;
            found.location = location;
            channels.push_back(found);
        }
    }
    if (other)
        lsf_scene_add_note(import.scene, "animations of anything but a node's translation, "
                                         "rotation, scale and weights are ignored");
    if (overlapping)
        lsf_scene_add_note(import.scene, "several animations move the same node: the first one is "
                                         "used, the others where they move other nodes; "
                                         "those that play can be chosen");
    return channels;
}

void gltf_animations_import(gltf_import &import)
{
    std::vector<channel_source> channels = find_channels(import);
    import.scene->channels = static_cast<lsf_animation_channel *>(
        allocate(channels.size(), sizeof(lsf_animation_channel)));
    for (const channel_source &source : channels) {
        lsf_animation_channel &channel = import.scene->channels[import.scene->channel_count++];
        channel = source.channel;
        read_times(import, source, channel);
        read_values(import, source, channel);
    }
}

} // namespace lsf
