#include "io/gltf_import.hpp"

#include <algorithm>
#include <cstdlib>

/* The choices that a file offers: scenes, animations and variants of materials; and the
 * extensions that it uses. */

namespace lsf
{

using tinygltf::Value;

/* Enough for a message. */
static const uint32_t CHOICES_NAMED_MAX = 24;

static std::string list_of(const lsf_choices &choices)
{
    std::string list;
    for (uint32_t i = 0; i < choices.count; i++) {
        if (i == CHOICES_NAMED_MAX)
            return list + " and others that `lightsheaf info` lists";
        list += (i ? ", " : "") + std::to_string(i);
        if (*choices.items[i].name)
            list += " \"" + std::string(choices.items[i].name) + "\"";
    }
    return list;
}

/* Marks the one named or numbered `which`; a name goes first. */
static uint32_t choose(lsf_choices &choices, const char *kind, const char *which)
{
    uint32_t found = 0;
    while (found < choices.count && std::string(choices.items[found].name) != which)
        found++;
    if (found == choices.count) {
        char *end;
        unsigned long index = strtoul(which, &end, 10);
        bool number = *which >= '0' && *which <= '9' && *end == '\0';
        if (number && index < choices.count)
            found = (uint32_t)index;
    }
    if (found == choices.count && choices.count == 0)
        throw no_such_choice(std::string("there is no ") + kind + " \"" + which +
                             "\": the file has none");
    if (found == choices.count)
        throw no_such_choice(std::string("there is no ") + kind + " \"" + which +
                             "\"; the file has " + list_of(choices));
    choices.items[found].chosen = true;
    return found;
}

template <typename NameOf>
static void list_names(gltf_import &import, size_t count, NameOf name_of, lsf_choices &choices)
{
    import.budget.take(count, sizeof(lsf_choice), "/");
    choices.items = static_cast<lsf_choice *>(allocate(count, sizeof(lsf_choice)));
    for (size_t i = 0; i < count; i++) {
        choices.items[i].name = copy_text(name_of(i));
        choices.count++;
    }
}

static void choose_scene(gltf_import &import)
{
    const tinygltf::Model &model = import.model;
    lsf_choices &scenes = import.scene->scenes;
    list_names(
        import, model.scenes.size(), [&](size_t i) { return model.scenes[i].name; }, scenes);
    if (import.params->scene) {
        import.chosen_scene = choose(scenes, "scene", import.params->scene);
    } else if (scenes.count > 0) {
        import.chosen_scene = model.defaultScene >= 0 ? (size_t)model.defaultScene : 0;
        scenes.items[import.chosen_scene].chosen = true;
    }
}

static void choose_animations(gltf_import &import)
{
    const tinygltf::Model &model = import.model;
    lsf_choices &animations = import.scene->animations;
    list_names(
        import, model.animations.size(), [&](size_t i) { return model.animations[i].name; },
        animations);
    const lsf_scene_params *params = import.params;
    for (uint32_t i = 0; !params->animations && i < animations.count; i++)
        animations.items[i].chosen = true;
    for (uint32_t i = 0; params->animations && i < params->animation_count; i++)
        choose(animations, "animation", params->animations[i]);
}

/* KHR_materials_variants: the material of the first mapping that names the variant. */
static void apply_variant(tinygltf::Primitive &primitive, uint32_t variant)
{
    auto extension = primitive.extensions.find("KHR_materials_variants");
    if (extension == primitive.extensions.end())
        return;
    const Value &mappings = extension->second.Get("mappings");
    for (size_t m = 0; m < mappings.ArrayLen(); m++) {
        const Value &mapping = mappings.Get((int)m), &variants = mapping.Get("variants");
        for (size_t v = 0; v < variants.ArrayLen(); v++)
            if (variants.Get((int)v).GetNumberAsInt() == (int)variant) {
                primitive.material = mapping.Get("material").GetNumberAsInt();
                return;
            }
    }
}

static void choose_variant(gltf_import &import)
{
    lsf_choices &variants = import.scene->variants;
    auto extension = import.model.extensions.find("KHR_materials_variants");
    if (extension != import.model.extensions.end()) {
        const Value &list = extension->second.Get("variants");
        list_names(
            import, list.ArrayLen(),
            [&](size_t i) { return list.Get((int)i).Get("name").Get<std::string>(); }, variants);
    }
    if (!import.params->variant)
        return;
    uint32_t variant = choose(variants, "variant", import.params->variant);
    for (tinygltf::Mesh &mesh : import.model.meshes)
        for (tinygltf::Primitive &primitive : mesh.primitives)
            apply_variant(primitive, variant);
}

static void list_extensions(gltf_import &import)
{
    std::vector<std::string> names = import.model.extensionsUsed;
    const std::vector<std::string> &required = import.model.extensionsRequired;
    names.insert(names.end(), required.begin(), required.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());

    lsf_scene *scene = import.scene;
    import.budget.take(names.size(), sizeof(lsf_extension), "/extensionsUsed");
    scene->extensions = static_cast<lsf_extension *>(allocate(names.size(), sizeof(lsf_extension)));
    std::vector<std::string> sorted = required;
    std::sort(sorted.begin(), sorted.end());
    for (const std::string &name : names) {
        lsf_extension &extension = scene->extensions[scene->extension_count];
        extension.name = copy_text(name);
        extension.required = std::binary_search(sorted.begin(), sorted.end(), name);
        extension.honoured = extension_is_supported(name);
        scene->extension_count++;
    }
}

void gltf_choices_make(gltf_import &import)
{
    list_extensions(import);
    choose_scene(import);
    choose_animations(import);
    choose_variant(import);
}

} // namespace lsf
