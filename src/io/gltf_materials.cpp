#include "io/gltf_import.hpp"

#include "scene/material.h"

#include <climits>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include <glm/glm.hpp>

/* Materials that the scene's meshes use, then glTF's default; and the textures and images that
 * those materials read. */

namespace lsf
{

using tinygltf::Value;

/* --- textures and images --- */

class texture_importer
{
  public:
    explicit texture_importer(gltf_import &import) : import_(import)
    {
    }
    uint32_t add(int texture, bool srgb);
    /* The image of roughness 1 - factor * alpha for the alpha of `texture`, which was added. */
    uint32_t add_roughness(uint32_t texture, float factor);
    void finish();

  private:
    bool is_absent(size_t image);
    uint32_t add_image(size_t image);
    void decode(size_t image, lsf_texture_image &decoded);

    gltf_import &import_;
    std::map<std::pair<int, bool>, uint32_t> known_;
    std::map<size_t, uint32_t> known_images_;
    std::vector<lsf_texture> textures_;
    std::vector<size_t> images_;
    std::set<size_t> absent_;

    /* Images that are made of others; the image of their textures is set when all others are
     * known. */
    struct roughness {
        uint32_t source, texture; /* into images_, textures_ */
        float factor;
    };
    std::vector<roughness> made_;
    std::map<std::pair<uint32_t, float>, uint32_t> known_roughness_;
};

static lsf_wrap wrap_of(int code)
{
    return code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? LSF_WRAP_CLAMP
           : code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? LSF_WRAP_MIRROR
                                                           : LSF_WRAP_REPEAT;
}

/* EXT_texture_webp: `source` is for readers without it. */
static int image_of(const tinygltf::Texture &texture)
{
    auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end() && webp->second.Has("source"))
        return webp->second.Get("source").GetNumberAsInt();
    return texture.source;
}

static bool is_ktx2(const tinygltf::Image &image)
{
    const std::string &uri = image.uri;
    return image.mimeType == "image/ktx2" || uri.compare(0, 16, "data:image/ktx2;") == 0 ||
           (!uri_is_data(uri) && uri.size() > 5 && uri.compare(uri.size() - 5, 5, ".ktx2") == 0);
}

/* Whether it is left out because its file does not exist. */
bool texture_importer::is_absent(size_t image)
{
    std::string location = location_of("images", image) + "/uri";
    const std::string &uri = import_.model.images[image].uri;
    if (!uri_file_is_absent(import_.folder, uri, location))
        return false;
    if (!import_.params->lenient)
        fail("IO_ERROR", location,
             "%s/%s: cannot be found; put the file there, correct the path, or load the scene "
             "leniently to see how it looks without",
             import_.folder.c_str(), uri.c_str());
    if (absent_.insert(image).second)
        import_.repairs.images_absent++;
    return true;
}

uint32_t texture_importer::add(int index, bool srgb)
{
    auto found = known_.find({index, srgb});
    if (found != known_.end())
        return found->second;
    const tinygltf::Texture &source = import_.model.textures[(size_t)index];
    int image = image_of(source);
    bool ktx2 = image >= 0 && is_ktx2(import_.model.images[(size_t)image]);
    if (ktx2 && !import_.params->lenient)
        fail("UNSUPPORTED_EXTENSION", location_of("images", (size_t)image),
             "the image is KTX2 (KHR_texture_basisu), which is not read; export the file with PNG, "
             "JPEG or WebP textures, or load it leniently to see how it looks without");
    if (image < 0 || ktx2) {
        import_.repairs.textures_without_image++;
        return known_[{index, srgb}] = LSF_NONE;
    }
    if (is_absent((size_t)image))
        return known_[{index, srgb}] = LSF_NONE;
    lsf_texture texture = {};
    texture.srgb = srgb;
    texture.image = add_image((size_t)image);
    if (source.sampler >= 0) {
        const tinygltf::Sampler &sampler = import_.model.samplers[(size_t)source.sampler];
        texture.wrap_s = wrap_of(sampler.wrapS);
        texture.wrap_t = wrap_of(sampler.wrapT);
        texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    textures_.push_back(texture);
    return known_[{index, srgb}] = (uint32_t)textures_.size() - 1;
}

uint32_t texture_importer::add_image(size_t image)
{
    auto found = known_images_.find(image);
    if (found != known_images_.end())
        return found->second;
    images_.push_back(image);
    return known_images_[image] = (uint32_t)images_.size() - 1;
}

uint32_t texture_importer::add_roughness(uint32_t texture, float factor)
{
    auto found = known_roughness_.find({texture, factor});
    if (found != known_roughness_.end())
        return found->second;
    lsf_texture made = textures_[texture];
    made.srgb = false;
    uint32_t index = (uint32_t)textures_.size();
    made_.push_back({made.image, index, factor});
    textures_.push_back(made);
    return known_roughness_[{texture, factor}] = index;
}

void texture_importer::decode(size_t index, lsf_texture_image &decoded)
{
    const tinygltf::Image &source = import_.model.images[index];
    std::string location = location_of("images", index);
    file_content file;
    std::string decoded_uri;
    const void *bytes;
    size_t length;
    memory_loan loan(import_.budget, location);
    if (source.bufferView >= 0) {
        const tinygltf::BufferView &view = import_.model.bufferViews[(size_t)source.bufferView];
        bytes = import_.model.buffers[(size_t)view.buffer].data.data() + view.byteOffset;
        length = view.byteLength;
    } else if (!source.image.empty()) {
        bytes = source.image.data();
        length = source.image.size();
    } else if (uri_is_data(source.uri)) { /* its type is unknown to tinygltf */
        loan.take(source.uri.size(), 2);
        decoded_uri = uri_data(source.uri, location + "/uri");
        bytes = decoded_uri.data();
        length = decoded_uri.size();
    } else {
        file =
            file_read(uri_to_path(import_.folder, source.uri, location + "/uri"), import_.budget);
        bytes = file.bytes.get();
        length = file.length;
        loan.take(length, 1);
        lsf_scene_add_content(import_.scene, bytes, length);
    }

    bool has_file = !source.uri.empty() && !uri_is_data(source.uri);
    std::string name = has_file ? source.uri : "image " + std::to_string(index);
    decoded.name = copy_text(name);
    lsf_error error;
    if (!lsf_texture_image_decode(&decoded, bytes, length, import_.budget.left(), name.c_str(),
                                  &error))
        fail("IMAGE_DATA_INVALID", location, "%s", error.message);
    static const uint64_t texel_bytes[] = {1, 2, 4};
    import_.budget.take((uint64_t)decoded.width * decoded.height * decoded.channels,
                        texel_bytes[decoded.type], location);
    if (decoded.non_finite)
        lsf_scene_add_note(import_.scene, "%s: %llu texels that were NaN or infinite were set to 0",
                           name.c_str(), (unsigned long long)decoded.non_finite);
}

void texture_importer::finish()
{
    lsf_scene *scene = import_.scene;
    for (size_t i = 0; i < made_.size(); i++)
        textures_[made_[i].texture].image = (uint32_t)(images_.size() + i);
    scene->textures = copy_array(textures_);
    scene->texture_count = (uint32_t)textures_.size();
    scene->images = static_cast<lsf_texture_image *>(
        allocate(images_.size() + made_.size(), sizeof(lsf_texture_image)));
    for (size_t image : images_) {
        scene->image_count++;
        decode(image, scene->images[scene->image_count - 1]);
    }
    for (const roughness &made : made_) {
        scene->image_count++;
        make_roughness_image(import_, scene->images[made.source], made.factor,
                             scene->images[scene->image_count - 1]);
    }
}

/* --- texture slots --- */

static const lsf_texture_slot empty_slot = lsf_default_material(false).normal_texture;

static double number_in(const Value &object, const char *key, double otherwise)
{
    return object.IsObject() && object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

static void apply_transform(const tinygltf::ExtensionMap &extensions, lsf_texture_slot &slot)
{
    auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end())
        return;
    const Value &transform = found->second;
    double offset[2] = {0.0, 0.0}, scale[2] = {1.0, 1.0};
    for (int i = 0; i < 2; i++) {
        if (transform.Has("offset"))
            offset[i] = transform.Get("offset").Get(i).GetNumberAsDouble();
        if (transform.Has("scale"))
            scale[i] = transform.Get("scale").Get(i).GetNumberAsDouble();
    }
    lsf_texture_slot_set_transform(&slot, offset, number_in(transform, "rotation", 0.0), scale);
    slot.uv_set = (uint32_t)number_in(transform, "texCoord", slot.uv_set);
}

static lsf_texture_slot make_slot(texture_importer &textures, int texture, int uv_set, bool srgb,
                                  const tinygltf::ExtensionMap &extensions,
                                  const std::string &location)
{
    lsf_texture_slot slot = empty_slot;
    if (texture < 0)
        return slot;
    slot.uv_set = (uint32_t)uv_set;
    apply_transform(extensions, slot);
    if (slot.uv_set > 1)
        fail("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", location,
             "a texture reads TEXCOORD_%u; only TEXCOORD_0 and TEXCOORD_1 are supported",
             slot.uv_set);
    slot.texture = textures.add(texture, srgb);
    return slot.texture == LSF_NONE ? empty_slot : slot;
}

template <typename Info>
static lsf_texture_slot core_slot(texture_importer &textures, const Info &info, bool srgb,
                                  const std::string &location)
{
    return make_slot(textures, info.index, info.texCoord, srgb, info.extensions, location);
}

/* A texture inside a material extension, which tinygltf keeps as plain values. */
static lsf_texture_slot extension_slot(texture_importer &textures, const Value &extension,
                                       const char *key, const std::string &location,
                                       bool srgb = false)
{
    if (!extension.IsObject() || !extension.Has(key))
        return empty_slot;
    const Value &info = extension.Get(key);
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
        extensions["KHR_texture_transform"] = info.Get("extensions").Get("KHR_texture_transform");
    return make_slot(textures, info.Get("index").GetNumberAsInt(),
                     (int)number_in(info, "texCoord", 0.0), srgb, extensions, location);
}

/* --- materials --- */

/* A value stays as it is where the extension does not give it. */
static void read_color(const Value &extension, const char *key, float *color, int channels = 3)
{
    if (extension.IsObject() && extension.Has(key))
        for (int c = 0; c < channels; c++)
            color[c] = (float)extension.Get(key).Get(c).GetNumberAsDouble();
}

static const char SPECULAR_GLOSSINESS[] = "KHR_materials_pbrSpecularGlossiness";

static void read_base(texture_importer &textures, const tinygltf::Material &source,
                      const std::string &location, lsf_material &material)
{
    const tinygltf::PbrMetallicRoughness &pbr = source.pbrMetallicRoughness;
    auto glossiness = source.extensions.find(SPECULAR_GLOSSINESS);
    if (glossiness != source.extensions.end()) {
        read_color(glossiness->second, "diffuseFactor", material.base_color, 4);
        material.base_color_texture =
            extension_slot(textures, glossiness->second, "diffuseTexture", location, true);
    } else {
        for (size_t c = 0; c < 4; c++)
            material.base_color[c] = (float)pbr.baseColorFactor[c];
        material.base_color_texture = core_slot(textures, pbr.baseColorTexture, true, location);
    }
    material.emissive_texture = core_slot(textures, source.emissiveTexture, true, location);
    material.alpha_mode = source.alphaMode == "MASK"    ? LSF_ALPHA_MASK
                          : source.alphaMode == "BLEND" ? LSF_ALPHA_BLEND
                                                        : LSF_ALPHA_OPAQUE;
    material.alpha_cutoff = (float)source.alphaCutoff;
    material.double_sided = source.doubleSided;
    material.unlit = source.extensions.count("KHR_materials_unlit") != 0;

    double strength = 1.0;
    auto found = source.extensions.find("KHR_materials_emissive_strength");
    if (found != source.extensions.end())
        strength = number_in(found->second, "emissiveStrength", 1.0);
    material.emissive_strength = (float)strength;
    for (size_t c = 0; c < 3; c++) {
        material.emissive_factor[c] = (float)source.emissiveFactor[c];
        material.emission[c] = (float)(source.emissiveFactor[c] * strength);
        if (!std::isfinite(material.emission[c]))
            fail("VALUE_NOT_IN_RANGE", location,
                 "emissiveFactor times emissiveStrength is too large for a float");
    }
}

static void read_specular(texture_importer &textures, const Value &extension,
                          const std::string &location, lsf_material &material)
{
    material.specular = (float)number_in(extension, "specularFactor", 1.0);
    read_color(extension, "specularColorFactor", material.specular_color);
    material.specular_texture = extension_slot(textures, extension, "specularTexture", location);
    material.specular_color_texture =
        extension_slot(textures, extension, "specularColorTexture", location, true);
}

static void read_sheen(texture_importer &textures, const Value &extension,
                       const std::string &location, bool animated, lsf_material &material)
{
    read_color(extension, "sheenColorFactor", material.sheen_color);
    material.sheen_roughness = (float)number_in(extension, "sheenRoughnessFactor", 0.0);
    const float *color = material.sheen_color;
    if (!(color[0] > 0.0f || color[1] > 0.0f || color[2] > 0.0f || animated))
        return;
    material.sheen_color_texture =
        extension_slot(textures, extension, "sheenColorTexture", location, true);
    material.sheen_roughness_texture =
        extension_slot(textures, extension, "sheenRoughnessTexture", location);
}

static void read_coat(texture_importer &textures, const Value &extension,
                      const std::string &location, bool animated, lsf_material &material)
{
    material.coat = (float)number_in(extension, "clearcoatFactor", 0.0);
    material.coat_roughness = (float)number_in(extension, "clearcoatRoughnessFactor", 0.0);
    if (!(material.coat > 0.0f || animated))
        return;
    material.coat_texture = extension_slot(textures, extension, "clearcoatTexture", location);
    material.coat_roughness_texture =
        extension_slot(textures, extension, "clearcoatRoughnessTexture", location);
    material.coat_normal_texture =
        extension_slot(textures, extension, "clearcoatNormalTexture", location);
    if (extension.Has("clearcoatNormalTexture"))
        material.coat_normal_scale =
            (float)number_in(extension.Get("clearcoatNormalTexture"), "scale", 1.0);
}

/* The mesh gives the thickness of its medium: the extension's thickness, a substitute for
 * renderers that do not know what is behind a surface, only tells whether there is a medium at
 * all. */
static void read_volume(const Value &extension, lsf_material &material)
{
    material.volume = number_in(extension, "thicknessFactor", 0.0) > 0.0;
    material.attenuation_distance = (float)number_in(extension, "attenuationDistance", INFINITY);
    read_color(extension, "attenuationColor", material.attenuation_color);
}

/* As a dielectric whose reflection has the specular colour: KHR_materials_ior keeps the index 0 for
 * this, by which KHR_materials_specular's colour is that of the reflection at normal incidence. The
 * diffuse part is (1 - F) (1 - max specular) diffuse in the extension's appendix, and
 * (1 - max F) diffuse here. */
static void read_specular_glossiness(texture_importer &textures, const Value &extension,
                                     const std::string &location, lsf_material &material)
{
    double glossiness = number_in(extension, "glossinessFactor", 1.0);
    material.metallic = 0.0f;
    material.roughness = (float)(1.0 - glossiness);
    material.ior = 0.0f;
    read_color(extension, "specularFactor", material.specular_color);
    lsf_texture_slot slot =
        extension_slot(textures, extension, "specularGlossinessTexture", location, true);
    if (slot.texture == LSF_NONE)
        return;
    material.specular_color_texture = material.metallic_roughness_texture = slot;
    material.metallic_roughness_texture.texture =
        textures.add_roughness(slot.texture, (float)glossiness);
    material.roughness = 1.0f;
}

static void read_metallic_roughness(texture_importer &textures,
                                    const tinygltf::PbrMetallicRoughness &pbr,
                                    const std::string &location, lsf_material &material)
{
    material.metallic = (float)pbr.metallicFactor;
    material.roughness = (float)pbr.roughnessFactor;
    material.metallic_roughness_texture =
        core_slot(textures, pbr.metallicRoughnessTexture, false, location);
}

static void read_surface(const gltf_import &import, texture_importer &textures, size_t index,
                         lsf_material &material)
{
    static const char SHEEN_COLOR[] = "extensions/KHR_materials_sheen/sheenColorFactor";
    static const char COAT[] = "extensions/KHR_materials_clearcoat/clearcoatFactor";
    static const char ANISOTROPY[] = "extensions/KHR_materials_anisotropy/anisotropyStrength";
    const tinygltf::Material &source = import.model.materials[index];
    std::string location = location_of("materials", index);
    auto glossiness = source.extensions.find(SPECULAR_GLOSSINESS);
    if (glossiness == source.extensions.end())
        read_metallic_roughness(textures, source.pbrMetallicRoughness, location, material);
    material.normal_texture = core_slot(textures, source.normalTexture, false, location);
    material.normal_scale = (float)source.normalTexture.scale;
    material.occlusion_texture = core_slot(textures, source.occlusionTexture, false, location);

    for (const auto &[name, extension] : source.extensions) {
        if (name == "KHR_materials_ior") {
            material.ior = (float)number_in(extension, "ior", 1.5);
            if (material.ior > 0.0f && material.ior < 1.0f)
                fail("VALUE_NOT_IN_RANGE", location + "/extensions/KHR_materials_ior/ior",
                     "%g must be 0 or at least 1", (double)material.ior);
        } else if (name == "KHR_materials_transmission") {
            material.transmission = (float)number_in(extension, "transmissionFactor", 0.0);
            material.transmission_texture =
                extension_slot(textures, extension, "transmissionTexture", location);
        } else if (name == "KHR_materials_volume") {
            read_volume(extension, material);
        } else if (name == "KHR_materials_specular") {
            read_specular(textures, extension, location, material);
        } else if (name == "KHR_materials_sheen") {
            read_sheen(textures, extension, location,
                       is_animated(import, LSF_KIND_MATERIAL, index, SHEEN_COLOR), material);
        } else if (name == "KHR_materials_clearcoat") {
            read_coat(textures, extension, location,
                      is_animated(import, LSF_KIND_MATERIAL, index, COAT), material);
        } else if (name == "KHR_materials_anisotropy") {
            material.anisotropy_strength = (float)number_in(extension, "anisotropyStrength", 0.0);
            material.anisotropy_rotation = (float)number_in(extension, "anisotropyRotation", 0.0);
            material.anisotropy_texture =
                extension_slot(textures, extension, "anisotropyTexture", location);
        }
    }
    if (glossiness != source.extensions.end())
        read_specular_glossiness(textures, glossiness->second, location, material);
    material.has_tangents = lsf_material_wants_tangents(&material) ||
                            is_animated(import, LSF_KIND_MATERIAL, index, ANISOTROPY);
}

static std::vector<bool> find_used(const gltf_import &import)
{
    std::vector<bool> used(import.model.materials.size());
    for (size_t i = 0; i < import.model.meshes.size(); i++)
        if (import.mesh_used[i])
            for (const tinygltf::Primitive &primitive : import.model.meshes[i].primitives)
                if (primitive.material >= 0)
                    used[(size_t)primitive.material] = true;
    return used;
}

void gltf_materials_import(gltf_import &import)
{
    texture_importer textures(import);
    std::vector<bool> used = find_used(import);
    std::vector<lsf_material> materials;
    std::vector<std::string> names;
    import.material_of.assign(import.model.materials.size(), LSF_NONE);
    for (size_t i = 0; i < used.size(); i++) {
        if (!used[i])
            continue;
        const tinygltf::Material &source = import.model.materials[i];
        std::string location = location_of("materials", i);
        lsf_material material = lsf_default_material(import.params->diffuse_only);
        read_base(textures, source, location, material);
        if (!import.params->diffuse_only)
            read_surface(import, textures, i, material);
        import.material_of[i] = (uint32_t)materials.size();
        materials.push_back(material);
        names.push_back(source.name);
    }
    materials.push_back(lsf_default_material(import.params->diffuse_only));
    names.push_back("default");

    import.scene->materials = copy_array(materials);
    for (const std::string &name : names)
        import.scene->materials[import.scene->material_count++].name = copy_text(name);
    textures.finish();
}

} // namespace lsf
