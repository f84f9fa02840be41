#include "io/gltf_import.hpp"

#include <map>
#include <set>

/* Animations of nodes, weights and properties; what else an animation may target is noted and
 * ignored. */

namespace lsf
{

/* --- curves --- */

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

static void read_times(gltf_import &import, int input, const std::string &location,
                       lsf_curve &curve)
{
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)input];
    if (accessor.type != TINYGLTF_TYPE_SCALAR ||
        accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        fail("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", location,
             "key times are %s; they must be SCALAR of FLOAT", accessor_format(accessor).c_str());
    curve.times = copy_floats(import, input, location);
    if (accessor.count > UINT32_MAX)
        fail("ACCESSOR_TOO_LONG", location, "too many keys");
    curve.key_count = (uint32_t)accessor.count;
    for (uint32_t i = 0; i < curve.key_count; i++) {
        if (curve.times[i] < 0.0f)
            fail("ACCESSOR_ANIMATION_INPUT_NEGATIVE", location, "key %u has time %g", i,
                 (double)curve.times[i]);
        if (i > 0 && !(curve.times[i] > curve.times[i - 1]))
            fail("ACCESSOR_ANIMATION_INPUT_NON_INCREASING", location,
                 "key %u is not later than the one before", i);
    }
}

static void check_format(const tinygltf::Accessor &accessor, const gltf_target &target,
                         uint32_t width)
{
    static const int types[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                                TINYGLTF_TYPE_VEC4};
    const char *wanted = nullptr;
    bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (target.property == lsf_property_visible) {
        if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.normalized ||
            accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
            wanted = "visibility must be SCALAR of UNSIGNED_BYTE";
    } else if (target.property) {
        if (accessor.type != types[width - 1])
            wanted = "there must be as many components as the property has";
    } else if (target.path == LSF_PATH_ROTATION) {
        if (accessor.type != TINYGLTF_TYPE_VEC4 || !(is_float || accessor.normalized))
            wanted = "rotations must be VEC4 of FLOAT or normalised integers";
    } else if (target.path == LSF_PATH_WEIGHTS) {
        if (accessor.type != TINYGLTF_TYPE_SCALAR || !(is_float || accessor.normalized))
            wanted = "weights must be SCALAR of FLOAT or normalised integers";
    } else if (accessor.type != TINYGLTF_TYPE_VEC3 || !is_float) {
        wanted = "translations and scales must be VEC3 of FLOAT";
    }
    if (wanted)
        fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", target.location,
             "values are %s; %s", accessor_format(accessor).c_str(), wanted);
}

/* The curve owns the arrays that were read, also when the rest fails. */
static void read_curve(gltf_import &import, const gltf_target &target, uint32_t width,
                       lsf_curve &curve)
{
    const tinygltf::Animation &animation = import.model.animations[target.animation];
    const tinygltf::AnimationSampler &sampler =
        animation.samplers[(size_t)animation.channels[target.channel].sampler];
    curve.width = width;
    curve.interpolation = sampler.interpolation == "STEP"          ? LSF_STEP
                          : sampler.interpolation == "CUBICSPLINE" ? LSF_CUBIC
                                                                   : LSF_LINEAR;
    if (target.property == lsf_property_visible && curve.interpolation != LSF_STEP)
        fail("ANIMATION_SAMPLER_INTERPOLATION_INVALID", target.location,
             "visibility must change by STEP");
    read_times(import, sampler.input, target.location, curve);
    const tinygltf::Accessor &accessor = import.model.accessors[(size_t)sampler.output];
    check_format(accessor, target, width);
    bool weights = !target.property && target.path == LSF_PATH_WEIGHTS;
    uint64_t wanted = (uint64_t)curve.key_count * (curve.interpolation == LSF_CUBIC ? 3 : 1) *
                      (weights ? width : 1);
    if (accessor.count != wanted)
        fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", target.location,
             "%zu values for %u keys; there must be %llu", accessor.count, curve.key_count,
             (unsigned long long)wanted);
    curve.values = copy_floats(import, sampler.output, target.location);
}

/* --- what they animate --- */

/* The things of the scene that an animation already changes; several animations may play. */
class taken_targets
{
  public:
    explicit taken_targets(gltf_import &import) : import_(import)
    {
    }
    /* Whether the target is free: an animation may change it once. */
    bool take(const gltf_target &target)
    {
        if (target.animation != animation_)
            own_.clear();
        animation_ = target.animation;
        key k = {target.of, target.index, target.property,
                 target.property ? (int)target.slot : (int)target.path, target.weight};
        if (!own_.insert(k).second)
            fail("ANIMATION_DUPLICATE_TARGETS", target.location,
                 "another channel of the animation has the same target");
        bool is_free = all_.insert(k).second;
        if (!is_free)
            lsf_scene_add_note(import_.scene,
                               "several animations move the same node or property: the first one "
                               "is used, the others where they move others; those that play can "
                               "be chosen");
        return is_free;
    }

  private:
    using key = std::tuple<lsf_kind, size_t, const lsf_property *, int, int>;
    gltf_import &import_;
    size_t animation_ = SIZE_MAX;
    std::set<key> own_, all_;
};

/* Adds a curve to a node that is in the scene. */
static void add_channel(gltf_import &import, const gltf_target &target, taken_targets &taken)
{
    uint32_t node = import.node_of[target.index];
    if (node == LSF_NONE)
        return;
    const lsf_node &animated = import.scene->nodes[node];
    bool weights = target.path == LSF_PATH_WEIGHTS;
    if (weights && (animated.weight_count == 0 || target.weight >= (int)animated.weight_count)) {
        import.repairs.weights_animated++;
        return;
    }
    if (!weights && animated.has_matrix)
        fail("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", target.location,
             "node %zu has a matrix; animated nodes need translation, rotation and scale",
             target.index);
    if (!taken.take(target))
        return;
    lsf_animation_channel &channel = import.scene->channels[import.scene->channel_count++];
    channel.node = node;
    channel.path = target.path;
    channel.first_weight = target.weight > 0 ? (uint32_t)target.weight : 0;
    read_curve(import, target,
               target.weight >= 0                 ? 1
               : weights                          ? animated.weight_count
               : target.path == LSF_PATH_ROTATION ? 4
                                                  : 3,
               channel.curve);
}

/* Scene's cameras by the file's: one for each node that carries it. */
using camera_lists = std::map<size_t, std::vector<uint32_t>>;

/* The scene's things that stand for a thing of the file. */
static std::vector<uint32_t> things_of(const gltf_import &import, const camera_lists &cameras,
                                       const gltf_target &target)
{
    if (target.of == LSF_KIND_CAMERA) {
        auto found = cameras.find(target.index);
        return found == cameras.end() ? std::vector<uint32_t>() : found->second;
    }
    uint32_t thing = target.of == LSF_KIND_NODE    ? import.node_of[target.index]
                     : target.of == LSF_KIND_LIGHT ? import.light_of[target.index]
                                                   : import.material_of[target.index];
    return thing == LSF_NONE ? std::vector<uint32_t>() : std::vector<uint32_t>(1, thing);
}

static void note_range(gltf_import &import, const gltf_target &target, const lsf_curve &curve)
{
    bool cubic = curve.interpolation == LSF_CUBIC;
    uint64_t outside = 0;
    for (uint64_t k = 0; k < curve.key_count; k++)
        for (uint32_t c = 0; c < curve.width; c++) {
            float value = curve.values[(k * (cubic ? 3 : 1) + cubic) * curve.width + c];
            outside += !(value >= target.property->least && value <= target.property->most);
        }
    if (outside > 0 && target.property != lsf_property_visible)
        lsf_scene_add_note(import.scene,
                           "animation of %s: %llu value%s below %g or above %g: brought to that",
                           target.pointer.c_str(), (unsigned long long)outside, lsf_plural(outside),
                           (double)target.property->least, (double)target.property->most);
}

/* Adds a curve to each of the things. */
static void add_values(gltf_import &import, const gltf_target &target,
                       const std::vector<uint32_t> &things)
{
    lsf_scene *scene = import.scene;
    for (uint32_t thing : things) {
        lsf_animated_value &value = scene->animated[scene->animated_count++];
        value.property = target.property;
        value.index = thing;
        value.slot = target.slot;
        read_curve(import, target, target.property->width, value.curve);
        note_range(import, target, value.curve);
    }
}

static void import_channels(gltf_import &import, taken_targets &taken)
{
    lsf_scene *scene = import.scene;
    scene->channels = static_cast<lsf_animation_channel *>(
        allocate(import.targets.size(), sizeof(lsf_animation_channel)));
    for (const gltf_target &target : import.targets)
        if (!target.property)
            add_channel(import, target, taken);
}

static void import_values(gltf_import &import, taken_targets &taken)
{
    lsf_scene *scene = import.scene;
    camera_lists cameras;
    for (size_t i = 0; i < import.camera_source.size(); i++)
        cameras[import.camera_source[i]].push_back((uint32_t)i);
    std::vector<std::pair<const gltf_target *, std::vector<uint32_t>>> wanted;
    uint64_t count = 0;
    for (const gltf_target &target : import.targets) {
        if (!target.property || (target.property->surface && scene->diffuse_only))
            continue;
        std::vector<uint32_t> things = things_of(import, cameras, target);
        if (things.empty() || !taken.take(target))
            continue;
        import.budget.take(things.size(), sizeof(lsf_animated_value) + sizeof(uint32_t),
                           target.location);
        count += things.size();
        wanted.push_back({&target, things});
    }
    scene->animated =
        static_cast<lsf_animated_value *>(allocate(count, sizeof(lsf_animated_value)));
    for (const auto &each : wanted)
        add_values(import, *each.first, each.second);
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        scene->animated[i].first = scene->animated_width;
        scene->animated_width += scene->animated[i].curve.width;
    }
}

void gltf_animations_import(gltf_import &import)
{
    import.budget.take(import.targets.size(), sizeof(lsf_animation_channel), "/animations");
    taken_targets taken(import);
    import_channels(import, taken);
    import_values(import, taken);
}

} // namespace lsf
