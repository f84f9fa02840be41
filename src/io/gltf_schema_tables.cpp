#include "io/gltf_schema.hpp"

#include <cstdint>

/* glTF 2.0 section 5 and the schemas of the extensions that are read. Ranges that only a careless
 * exporter leaves and that do no harm (empty arrays, emission above 1) are not checked. */

namespace lsf
{

static const bool REQUIRED = true, OPTIONAL = false;
static const double POSITIVE = FLT_TRUE_MIN; /* the least float above 0 */
static const double ANY_SIZE = 9223372036854775807.0;
static const double ANY_INT = INT32_MAX; /* tinygltf keeps these in an int */

template <size_t N> static constexpr schema of(const rule (&rules)[N])
{
    return {rules, N};
}

static constexpr rule flag(const char *name)
{
    return {name, shape::boolean};
}
static constexpr rule text(const char *name, bool required = OPTIONAL)
{
    return {name, shape::string, required};
}
static constexpr rule one_of(const char *name, bool required, const char *names)
{
    return {name, shape::one_of, required, 0, 0, names};
}
static constexpr rule code(const char *name, bool required, const char *names)
{
    return {name, shape::code, required, 0, 0, names};
}
static constexpr rule integer(const char *name, bool required, double low, double high)
{
    return {name, shape::integer, required, low, high};
}
static constexpr rule number(const char *name, bool required = OPTIONAL, double low = -FLT_MAX,
                             double high = FLT_MAX)
{
    return {name, shape::number, required, low, high};
}
static constexpr rule numbers(const char *name, size_t entries, double low = -FLT_MAX,
                              double high = FLT_MAX)
{
    return {name, shape::numbers, OPTIONAL, low, high, nullptr, nullptr, entries};
}
static constexpr rule reference(const char *name, bool required, const char *array)
{
    return {name, shape::reference, required, 0, 0, array};
}
static constexpr rule references(const char *name, bool required, const char *array)
{
    return {name, shape::references, required, 0, 0, array};
}
static constexpr rule object(const char *name, bool required, const schema *child)
{
    return {name, shape::object, required, 0, 0, nullptr, child};
}
static constexpr rule objects(const char *name, bool required, const schema *child)
{
    return {name, shape::objects, required, 0, 0, nullptr, child};
}
static constexpr rule extensions(const schema *known)
{
    return {"extensions", shape::extensions, OPTIONAL, 0, 0, nullptr, known};
}

/* --- data --- */

static const rule asset_rules[] = {text("version", REQUIRED), text("minVersion"), text("generator"),
                                   text("copyright")};
static const schema asset = of(asset_rules);

static const rule buffer_fallback_rules[] = {flag("fallback")};
static const schema buffer_fallback = of(buffer_fallback_rules);
static const rule buffer_extension_rules[] = {
    object("EXT_meshopt_compression", OPTIONAL, &buffer_fallback),
    object("KHR_meshopt_compression", OPTIONAL, &buffer_fallback)};
static const schema buffer_extensions = of(buffer_extension_rules);
static const rule buffer_rules[] = {integer("byteLength", REQUIRED, 0, ANY_SIZE), text("uri"),
                                    text("name"), extensions(&buffer_extensions)};
static const schema buffer = of(buffer_rules);

static const rule meshopt_rules[] = {
    reference("buffer", REQUIRED, "buffers"),
    integer("byteOffset", OPTIONAL, 0, ANY_INT),
    integer("byteLength", REQUIRED, 1, ANY_INT),
    integer("byteStride", REQUIRED, 1, 256),
    integer("count", REQUIRED, 1, ANY_INT),
    one_of("mode", REQUIRED, "ATTRIBUTES|TRIANGLES|INDICES"),
    one_of("filter", OPTIONAL, "NONE|OCTAHEDRAL|QUATERNION|EXPONENTIAL")};
static const schema meshopt = of(meshopt_rules);
static const rule buffer_view_extension_rules[] = {
    object("EXT_meshopt_compression", OPTIONAL, &meshopt),
    object("KHR_meshopt_compression", OPTIONAL, &meshopt)};
static const schema buffer_view_extensions = of(buffer_view_extension_rules);
static const rule buffer_view_rules[] = {
    reference("buffer", REQUIRED, "buffers"),     integer("byteOffset", OPTIONAL, 0, ANY_SIZE),
    integer("byteLength", REQUIRED, 0, ANY_SIZE), integer("byteStride", OPTIONAL, 4, 252),
    integer("target", OPTIONAL, 0, ANY_INT),      text("name"),
    extensions(&buffer_view_extensions)};
static const schema buffer_view = of(buffer_view_rules);

static const rule sparse_indices_rules[] = {reference("bufferView", REQUIRED, "bufferViews"),
                                            integer("byteOffset", OPTIONAL, 0, ANY_INT),
                                            code("componentType", REQUIRED, "5121|5123|5125")};
static const schema sparse_indices = of(sparse_indices_rules);
static const rule sparse_values_rules[] = {reference("bufferView", REQUIRED, "bufferViews"),
                                           integer("byteOffset", OPTIONAL, 0, ANY_INT)};
static const schema sparse_values = of(sparse_values_rules);
static const rule sparse_rules[] = {integer("count", REQUIRED, 1, ANY_INT),
                                    object("indices", REQUIRED, &sparse_indices),
                                    object("values", REQUIRED, &sparse_values)};
static const schema sparse = of(sparse_rules);

static const rule accessor_rules[] = {
    reference("bufferView", OPTIONAL, "bufferViews"),
    integer("byteOffset", OPTIONAL, 0, ANY_SIZE),
    code("componentType", REQUIRED, "5120|5121|5122|5123|5125|5126"),
    flag("normalized"),
    integer("count", REQUIRED, 1, ANY_SIZE),
    one_of("type", REQUIRED, "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4"),
    numbers("min", 0),
    numbers("max", 0),
    object("sparse", OPTIONAL, &sparse),
    text("name")};
static const schema accessor = of(accessor_rules);

/* --- geometry --- */

static const rule mapping_rules[] = {{"variants", shape::references, REQUIRED, 0, 0, "variants"},
                                     reference("material", REQUIRED, "materials")};
static const schema mapping = of(mapping_rules);
static const rule mappings_rules[] = {objects("mappings", REQUIRED, &mapping)};
static const schema mappings = of(mappings_rules);
/* Its attributes are numbers of its own: gltf_draco.cpp checks them. */
static const rule draco_rules[] = {reference("bufferView", REQUIRED, "bufferViews"),
                                   {"attributes", shape::integers, REQUIRED, 0, ANY_INT}};
static const schema draco = of(draco_rules);
static const rule primitive_extension_rules[] = {
    object("KHR_draco_mesh_compression", OPTIONAL, &draco),
    object("KHR_materials_variants", OPTIONAL, &mappings)};
static const schema primitive_extensions = of(primitive_extension_rules);

static const rule primitive_rules[] = {{"attributes", shape::attributes, REQUIRED},
                                       reference("indices", OPTIONAL, "accessors"),
                                       reference("material", OPTIONAL, "materials"),
                                       integer("mode", OPTIONAL, 0, 6),
                                       {"targets", shape::targets},
                                       extensions(&primitive_extensions)};
static const schema primitive = of(primitive_rules);

static const rule mesh_rules[] = {objects("primitives", REQUIRED, &primitive),
                                  numbers("weights", 0), text("name")};
static const schema mesh = of(mesh_rules);

/* --- textures and materials --- */

static const rule image_rules[] = {reference("bufferView", OPTIONAL, "bufferViews"), text("uri"),
                                   text("mimeType"), text("name")};
static const schema image = of(image_rules);

static const rule sampler_rules[] = {code("magFilter", OPTIONAL, "9728|9729"),
                                     code("minFilter", OPTIONAL, "9728|9729|9984|9985|9986|9987"),
                                     code("wrapS", OPTIONAL, "33071|33648|10497"),
                                     code("wrapT", OPTIONAL, "33071|33648|10497"), text("name")};
static const schema sampler = of(sampler_rules);

static const rule texture_source_rules[] = {reference("source", OPTIONAL, "images")};
static const schema texture_source = of(texture_source_rules);
static const rule texture_extension_rules[] = {
    object("EXT_texture_webp", OPTIONAL, &texture_source)};
static const schema texture_extensions = of(texture_extension_rules);
static const rule texture_rules[] = {reference("sampler", OPTIONAL, "samplers"),
                                     reference("source", OPTIONAL, "images"), text("name"),
                                     extensions(&texture_extensions)};
static const schema texture = of(texture_rules);

static const rule texture_transform_rules[] = {numbers("offset", 2), number("rotation"),
                                               numbers("scale", 2),
                                               integer("texCoord", OPTIONAL, 0, ANY_INT)};
static const schema texture_transform = of(texture_transform_rules);
static const rule texture_info_extension_rules[] = {
    object("KHR_texture_transform", OPTIONAL, &texture_transform)};
static const schema texture_info_extensions = of(texture_info_extension_rules);

/* normalTexture's scale and occlusionTexture's strength are checked wherever they stand. */
static const rule texture_info_rules[] = {
    reference("index", REQUIRED, "textures"), integer("texCoord", OPTIONAL, 0, ANY_INT),
    number("scale"), number("strength", OPTIONAL, 0, 1), extensions(&texture_info_extensions)};
static const schema texture_info = of(texture_info_rules);

static const rule metallic_roughness_rules[] = {
    numbers("baseColorFactor", 4, 0, 1), object("baseColorTexture", OPTIONAL, &texture_info),
    number("metallicFactor", OPTIONAL, 0, 1), number("roughnessFactor", OPTIONAL, 0, 1),
    object("metallicRoughnessTexture", OPTIONAL, &texture_info)};
static const schema metallic_roughness = of(metallic_roughness_rules);

static const rule emissive_strength_rules[] = {number("emissiveStrength", OPTIONAL, 0)};
static const schema emissive_strength = of(emissive_strength_rules);
static const rule ior_rules[] = {number("ior", OPTIONAL, 0)};
static const schema ior = of(ior_rules);
static const rule transmission_rules[] = {number("transmissionFactor", OPTIONAL, 0, 1),
                                          object("transmissionTexture", OPTIONAL, &texture_info)};
static const schema transmission = of(transmission_rules);
static const rule volume_rules[] = {
    number("thicknessFactor", OPTIONAL, 0), object("thicknessTexture", OPTIONAL, &texture_info),
    number("attenuationDistance", OPTIONAL, POSITIVE), numbers("attenuationColor", 3, 0, 1)};
static const schema volume = of(volume_rules);
static const rule anisotropy_rules[] = {number("anisotropyStrength", OPTIONAL, 0, 1),
                                        number("anisotropyRotation"),
                                        object("anisotropyTexture", OPTIONAL, &texture_info)};
static const schema anisotropy = of(anisotropy_rules);
static const rule specular_rules[] = {
    number("specularFactor", OPTIONAL, 0, 1), object("specularTexture", OPTIONAL, &texture_info),
    numbers("specularColorFactor", 3, 0), object("specularColorTexture", OPTIONAL, &texture_info)};
static const schema specular = of(specular_rules);
static const rule clearcoat_rules[] = {number("clearcoatFactor", OPTIONAL, 0, 1),
                                       object("clearcoatTexture", OPTIONAL, &texture_info),
                                       number("clearcoatRoughnessFactor", OPTIONAL, 0, 1),
                                       object("clearcoatRoughnessTexture", OPTIONAL, &texture_info),
                                       object("clearcoatNormalTexture", OPTIONAL, &texture_info)};
static const schema clearcoat = of(clearcoat_rules);
static const rule sheen_rules[] = {numbers("sheenColorFactor", 3, 0, 1),
                                   object("sheenColorTexture", OPTIONAL, &texture_info),
                                   number("sheenRoughnessFactor", OPTIONAL, 0, 1),
                                   object("sheenRoughnessTexture", OPTIONAL, &texture_info)};
static const schema sheen = of(sheen_rules);
static const schema nothing = {nullptr, 0};
static const rule specular_glossiness_rules[] = {
    numbers("diffuseFactor", 4, 0, 1), object("diffuseTexture", OPTIONAL, &texture_info),
    numbers("specularFactor", 3, 0, 1), number("glossinessFactor", OPTIONAL, 0, 1),
    object("specularGlossinessTexture", OPTIONAL, &texture_info)};
static const schema specular_glossiness = of(specular_glossiness_rules);
static const rule material_extension_rules[] = {
    object("KHR_materials_pbrSpecularGlossiness", OPTIONAL, &specular_glossiness),
    object("KHR_materials_emissive_strength", OPTIONAL, &emissive_strength),
    object("KHR_materials_ior", OPTIONAL, &ior),
    object("KHR_materials_transmission", OPTIONAL, &transmission),
    object("KHR_materials_volume", OPTIONAL, &volume),
    object("KHR_materials_anisotropy", OPTIONAL, &anisotropy),
    object("KHR_materials_sheen", OPTIONAL, &sheen),
    object("KHR_materials_specular", OPTIONAL, &specular),
    object("KHR_materials_clearcoat", OPTIONAL, &clearcoat),
    object("KHR_materials_unlit", OPTIONAL, &nothing)};
static const schema material_extensions = of(material_extension_rules);

static const rule material_rules[] = {text("name"),
                                      object("pbrMetallicRoughness", OPTIONAL, &metallic_roughness),
                                      object("normalTexture", OPTIONAL, &texture_info),
                                      object("occlusionTexture", OPTIONAL, &texture_info),
                                      object("emissiveTexture", OPTIONAL, &texture_info),
                                      numbers("emissiveFactor", 3, 0),
                                      one_of("alphaMode", OPTIONAL, "OPAQUE|MASK|BLEND"),
                                      number("alphaCutoff", OPTIONAL, 0),
                                      flag("doubleSided"),
                                      extensions(&material_extensions)};
static const schema material = of(material_rules);

/* --- cameras, lights, nodes --- */

static const rule perspective_rules[] = {
    number("yfov", REQUIRED, POSITIVE, 3.14159), number("znear", REQUIRED, POSITIVE),
    number("zfar", OPTIONAL, POSITIVE), number("aspectRatio", OPTIONAL, POSITIVE)};
static const schema perspective = of(perspective_rules);
static const rule orthographic_rules[] = {number("xmag", REQUIRED), number("ymag", REQUIRED),
                                          number("znear", REQUIRED, 0),
                                          number("zfar", REQUIRED, POSITIVE)};
static const schema orthographic = of(orthographic_rules);
static const rule camera_rules[] = {one_of("type", REQUIRED, "perspective|orthographic"),
                                    object("perspective", OPTIONAL, &perspective),
                                    object("orthographic", OPTIONAL, &orthographic), text("name")};
static const schema camera = of(camera_rules);

static const rule spot_rules[] = {number("innerConeAngle", OPTIONAL, 0),
                                  number("outerConeAngle", OPTIONAL, 0)};
static const schema spot = of(spot_rules);
static const rule light_rules[] = {one_of("type", REQUIRED, "point|spot|directional"),
                                   numbers("color", 3, 0),
                                   number("intensity", OPTIONAL, 0),
                                   number("range", OPTIONAL, POSITIVE),
                                   object("spot", OPTIONAL, &spot),
                                   text("name")};
static const schema light = of(light_rules);

static const rule node_light_rules[] = {reference("light", REQUIRED, "lights")};
static const schema node_light = of(node_light_rules);
static const rule instancing_rules[] = {{"attributes", shape::attributes, REQUIRED}};
static const schema instancing = of(instancing_rules);
static const rule visibility_rules[] = {flag("visible")};
static const schema visibility = of(visibility_rules);
static const rule node_extension_rules[] = {
    object("EXT_mesh_gpu_instancing", OPTIONAL, &instancing),
    object("KHR_lights_punctual", OPTIONAL, &node_light),
    object("KHR_node_visibility", OPTIONAL, &visibility)};
static const schema node_extensions = of(node_extension_rules);

static const rule node_rules[] = {reference("camera", OPTIONAL, "cameras"),
                                  reference("mesh", OPTIONAL, "meshes"),
                                  reference("skin", OPTIONAL, "skins"),
                                  references("children", OPTIONAL, "nodes"),
                                  numbers("matrix", 16),
                                  numbers("translation", 3),
                                  numbers("rotation", 4),
                                  numbers("scale", 3),
                                  numbers("weights", 0),
                                  text("name"),
                                  extensions(&node_extensions)};
static const schema node = of(node_rules);

static const rule scene_rules[] = {references("nodes", OPTIONAL, "nodes"), text("name")};
static const schema scene = of(scene_rules);

/* --- animations, skins --- */

static const rule pointer_rules[] = {text("pointer", REQUIRED)};
static const schema pointer = of(pointer_rules);
static const rule target_extension_rules[] = {object("KHR_animation_pointer", OPTIONAL, &pointer)};
static const schema target_extensions = of(target_extension_rules);
static const rule target_rules[] = {reference("node", OPTIONAL, "nodes"), text("path", REQUIRED),
                                    extensions(&target_extensions)};
static const schema target = of(target_rules);
static const rule channel_rules[] = {integer("sampler", REQUIRED, 0, ANY_INT),
                                     object("target", REQUIRED, &target)};
static const schema channel = of(channel_rules);
static const rule animation_sampler_rules[] = {
    reference("input", REQUIRED, "accessors"), reference("output", REQUIRED, "accessors"),
    one_of("interpolation", OPTIONAL, "LINEAR|STEP|CUBICSPLINE")};
static const schema animation_sampler = of(animation_sampler_rules);
static const rule animation_rules[] = {objects("channels", REQUIRED, &channel),
                                       objects("samplers", REQUIRED, &animation_sampler),
                                       text("name")};
static const schema animation = of(animation_rules);

static const rule skin_rules[] = {reference("inverseBindMatrices", OPTIONAL, "accessors"),
                                  reference("skeleton", OPTIONAL, "nodes"),
                                  references("joints", REQUIRED, "nodes"), text("name")};
static const schema skin = of(skin_rules);

/* --- root --- */

static const rule lights_rules[] = {objects("lights", REQUIRED, &light)};
static const schema lights = of(lights_rules);
static const rule variant_rules[] = {text("name", REQUIRED)};
static const schema variant = of(variant_rules);
static const rule variants_rules[] = {objects("variants", REQUIRED, &variant)};
static const schema variants = of(variants_rules);
static const rule root_extension_rules[] = {object("KHR_lights_punctual", OPTIONAL, &lights),
                                            object("KHR_materials_variants", OPTIONAL, &variants)};
static const schema root_extensions = of(root_extension_rules);

static const rule root_rules[] = {
    object("asset", REQUIRED, &asset),         {"extensionsUsed", shape::strings},
    {"extensionsRequired", shape::strings},    extensions(&root_extensions),
    objects("buffers", OPTIONAL, &buffer),     objects("bufferViews", OPTIONAL, &buffer_view),
    objects("accessors", OPTIONAL, &accessor), objects("images", OPTIONAL, &image),
    objects("samplers", OPTIONAL, &sampler),   objects("textures", OPTIONAL, &texture),
    objects("materials", OPTIONAL, &material), objects("meshes", OPTIONAL, &mesh),
    objects("cameras", OPTIONAL, &camera),     objects("nodes", OPTIONAL, &node),
    objects("scenes", OPTIONAL, &scene),       objects("animations", OPTIONAL, &animation),
    objects("skins", OPTIONAL, &skin),         reference("scene", OPTIONAL, "scenes")};
const schema gltf_root_schema = of(root_rules);

} // namespace lsf
