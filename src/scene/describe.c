#include "scene/scene.h"

#include "base/base.h"

#include <math.h>
#include <stdlib.h>

/* The text of `lightsheaf info`. */

static uint32_t count_placed(const lsf_scene *scene, lsf_light_type type)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        uint32_t light = scene->nodes[i].light;
        count += light != LSF_NONE && scene->lights[light].type == type;
    }
    return count;
}

static double last_key(const lsf_curve *curve)
{
    return (double)curve->times[curve->key_count - 1];
}

/* The time of the last key of all animations. */
double lsf_scene_duration(const lsf_scene *scene)
{
    if (!scene)
        return 0.0;
    double duration = 0.0;
    for (uint32_t i = 0; i < scene->channel_count; i++)
        duration = fmax(duration, last_key(&scene->channels[i].curve));
    for (uint32_t i = 0; i < scene->animated_count; i++)
        duration = fmax(duration, last_key(&scene->animated[i].curve));
    return duration;
}

static const char *kind_of(const lsf_extension *extension)
{
    return extension->honoured ? extension->required ? "required" : "used" : "ignored";
}

/* --- the requirements, for both forms --- */

typedef struct flag {
    const char *name;
    bool value;
} flag;

enum { FLAG_COUNT = 39 };

static void list_flags(const lsf_requirements *r, flag flags[FLAG_COUNT])
{
    const flag list[FLAG_COUNT] = {
        {"environment", r->environment},
        {"environment_map", r->environment_map},
        {"emissive", r->emissive},
        {"unlit", r->unlit},
        {"specular", r->specular},
        {"glossy", r->glossy},
        {"smooth_metal", r->smooth_metal},
        {"smooth", r->smooth},
        {"anisotropic", r->anisotropic},
        {"transmissive", r->transmissive},
        {"refractive", r->refractive},
        {"thin_walls", r->thin_walls},
        {"rough_walls", r->rough_walls},
        {"variable_ior", r->variable_ior},
        {"specular_varied", r->specular_varied},
        {"coated", r->coated},
        {"sheened", r->sheened},
        {"masked", r->masked},
        {"blended", r->blended},
        {"normal_mapped", r->normal_mapped},
        {"base_color_textured", r->base_color_textured},
        {"metallic_roughness_textured", r->metallic_roughness_textured},
        {"emissive_textured", r->emissive_textured},
        {"anisotropy_textured", r->anisotropy_textured},
        {"transmission_textured", r->transmission_textured},
        {"specular_textured", r->specular_textured},
        {"specular_color_textured", r->specular_color_textured},
        {"sheen_color_textured", r->sheen_color_textured},
        {"sheen_roughness_textured", r->sheen_roughness_textured},
        {"coat_textured", r->coat_textured},
        {"coat_roughness_textured", r->coat_roughness_textured},
        {"coat_normal_mapped", r->coat_normal_mapped},
        {"texture_transformed", r->texture_transformed},
        {"second_uv", r->second_uv},
        {"vertex_colored", r->vertex_colored},
        {"skinned", r->skinned},
        {"morphed", r->morphed},
        {"moving", r->moving},
        {"bounded", r->bounds_min[0] <= r->bounds_max[0]},
    };
    for (int i = 0; i < FLAG_COUNT; i++)
        flags[i] = list[i];
}

/* --- JSON --- */

static void add_vector(lsf_string *out, const char *key, const double v[3])
{
    lsf_string_add(out, "\"%s\": [", key);
    for (int c = 0; c < 3; c++) {
        lsf_string_add(out, "%s", c ? ", " : "");
        lsf_string_add_json_number(out, v[c]);
    }
    lsf_string_add(out, "]");
}

static void add_images_json(lsf_string *out, const lsf_scene *scene)
{
    static const char *const types[] = {"u8", "u16", "f32"};
    lsf_string_add(out, "  \"images\": [");
    for (uint32_t i = 0; i < scene->image_count; i++) {
        const lsf_texture_image *image = &scene->images[i];
        lsf_string_add(out, "%s\n    {\"name\": ", i ? "," : "");
        lsf_string_add_json(out, image->name);
        lsf_string_add(out, ", \"width\": %u, \"height\": %u, \"channels\": %u, \"type\": \"%s\"}",
                       image->width, image->height, image->channels, types[image->type]);
    }
    lsf_string_add(out, "%s],\n", scene->image_count ? "\n  " : "");
}

static void add_cameras_json(lsf_string *out, const lsf_scene *scene)
{
    lsf_string_add(out, "  \"cameras\": [");
    for (uint32_t i = 0; i < scene->camera_count; i++) {
        lsf_string_add(out, "%s\n    {\"name\": ", i ? "," : "");
        lsf_string_add_json(out, scene->cameras[i].name);
        lsf_string_add(out, ", \"type\": \"%s\", \"from_file\": %s}",
                       scene->cameras[i].orthographic ? "orthographic" : "perspective",
                       scene->cameras[i].node == LSF_NONE ? "false" : "true");
    }
    lsf_string_add(out, "\n  ],\n");
}

static void add_choices_json(lsf_string *out, const char *key, const lsf_choices *choices)
{
    lsf_string_add(out, "  \"%s\": [", key);
    for (uint32_t i = 0; i < choices->count; i++) {
        lsf_string_add(out, "%s\n    {\"name\": ", i ? "," : "");
        lsf_string_add_json(out, choices->items[i].name);
        lsf_string_add(out, ", \"chosen\": %s}", choices->items[i].chosen ? "true" : "false");
    }
    lsf_string_add(out, "%s],\n", choices->count ? "\n  " : "");
}

static void add_extensions_json(lsf_string *out, const lsf_scene *scene)
{
    lsf_string_add(out, "  \"extensions\": [");
    for (uint32_t i = 0; i < scene->extension_count; i++) {
        const lsf_extension *extension = &scene->extensions[i];
        lsf_string_add(out, "%s\n    {\"name\": ", i ? "," : "");
        lsf_string_add_json(out, extension->name);
        lsf_string_add(out, ", \"required\": %s, \"honoured\": %s}",
                       extension->required ? "true" : "false",
                       extension->honoured ? "true" : "false");
    }
    lsf_string_add(out, "%s],\n", scene->extension_count ? "\n  " : "");
}

static void add_requirements_json(lsf_string *out, const lsf_requirements *r)
{
    flag flags[FLAG_COUNT];
    list_flags(r, flags);
    lsf_string_add(out, "  \"requirements\": {\n");
    lsf_string_add(out,
                   "    \"point_lights\": %u, \"spot_lights\": %u, \"directional_lights\": %u,\n",
                   r->point_lights, r->spot_lights, r->directional_lights);
    for (int i = 0; i < FLAG_COUNT; i++)
        lsf_string_add(out, "    \"%s\": %s,\n", flags[i].name, flags[i].value ? "true" : "false");
    lsf_string_add(out,
                   "    \"triangles\": %llu, \"unique_triangles\": %llu, "
                   "\"degenerate_triangles\": %llu, \"vertices\": %llu,\n"
                   "    \"instances\": %u, \"primitives\": %u, \"materials\": %u, "
                   "\"textures\": %u, \"bounces\": %u,\n    ",
                   (unsigned long long)r->triangles, (unsigned long long)r->unique_triangles,
                   (unsigned long long)r->degenerate_triangles, (unsigned long long)r->vertices,
                   r->instances, r->primitives, r->materials, r->textures, r->bounces);
    add_vector(out, "center", r->center);
    lsf_string_add(out, ", \"scale\": ");
    lsf_string_add_json_number(out, r->scale);
    lsf_string_add(out, "\n  }\n");
}

static void describe_json(lsf_string *out, const lsf_scene *scene)
{
    const lsf_requirements *r = &scene->requirements;
    lsf_string_add(out, "{\n  \"scene\": ");
    lsf_string_add_json(out, scene->path);
    lsf_string_add(out,
                   ",\n  \"nodes\": %u, \"meshes\": %u, \"primitives\": %u, \"instances\": %u,\n"
                   "  \"triangles\": %llu, \"unique_triangles\": %llu, \"vertices\": %llu,\n"
                   "  \"materials\": %u, \"textures\": %u,\n",
                   scene->node_count, scene->mesh_count, scene->primitive_count,
                   scene->instance_count, (unsigned long long)r->triangles,
                   (unsigned long long)r->unique_triangles, (unsigned long long)r->vertices,
                   scene->material_count, scene->texture_count);
    add_images_json(out, scene);
    lsf_string_add(out, "  \"lights\": {\"point\": %u, \"spot\": %u, \"directional\": %u},\n",
                   count_placed(scene, LSF_LIGHT_POINT), count_placed(scene, LSF_LIGHT_SPOT),
                   count_placed(scene, LSF_LIGHT_DIRECTIONAL));
    lsf_string_add(out, "  \"default_light\": {\"sky\": %s, \"key\": %s, \"lamp\": %s},\n",
                   scene->environment.by_default ? "true" : "false",
                   scene->key_light.present ? "true" : "false",
                   scene->default_lamp.present ? "true" : "false");
    add_cameras_json(out, scene);
    add_choices_json(out, "scenes", &scene->scenes);
    add_choices_json(out, "animations", &scene->animations);
    add_choices_json(out, "variants", &scene->variants);
    add_extensions_json(out, scene);
    lsf_string_add(out, "  \"animation\": {\"channels\": %u, \"seconds\": ",
                   scene->channel_count + scene->animated_count);
    lsf_string_add_json_number(out, lsf_scene_duration(scene));
    lsf_string_add(out, "},\n  \"bounds\": {");
    add_vector(out, "min", r->bounds_min);
    lsf_string_add(out, ", ");
    add_vector(out, "max", r->bounds_max);
    lsf_string_add(out, "},\n  \"diffuse_only\": %s,\n  \"notes\": [",
                   scene->diffuse_only ? "true" : "false");
    for (uint32_t i = 0; i < scene->note_count; i++) {
        lsf_string_add(out, "%s\n    ", i ? "," : "");
        lsf_string_add_json(out, scene->notes[i]);
    }
    lsf_string_add(out, "%s],\n", scene->note_count ? "\n  " : "");
    add_requirements_json(out, r);
    lsf_string_add(out, "}\n");
}

/* --- text --- */

static void add_images_text(lsf_string *out, const lsf_scene *scene)
{
    static const int bits[] = {8, 16, 32};
    lsf_string_add(out, "textures     %u, from %u image%s\n", scene->texture_count,
                   scene->image_count, lsf_plural(scene->image_count));
    for (uint32_t i = 0; i < scene->image_count; i++) {
        const lsf_texture_image *image = &scene->images[i];
        lsf_string_add(out, "             %u x %u, %u x %d bit  %s\n", image->width, image->height,
                       image->channels, bits[image->type], image->name);
    }
}

static void add_choices_text(lsf_string *out, const char *kind, const lsf_choices *choices,
                             const char *chosen)
{
    for (uint32_t i = 0; i < choices->count; i++)
        lsf_string_add(out, "%-9s %-2u \"%s\"%s\n", kind, i, choices->items[i].name,
                       choices->items[i].chosen ? chosen : "");
}

static void add_requirements_text(lsf_string *out, const lsf_requirements *r)
{
    flag flags[FLAG_COUNT];
    list_flags(r, flags);
    lsf_string_add(out, "requires    ");
    for (int i = 0; i < FLAG_COUNT; i++)
        if (flags[i].value)
            lsf_string_add(out, " %s", flags[i].name);
    lsf_string_add(out, "\nleft out    ");
    for (int i = 0; i < FLAG_COUNT; i++)
        if (!flags[i].value)
            lsf_string_add(out, " %s", flags[i].name);
    lsf_string_add(out, "\nbounces      %u", r->bounces);
    lsf_string_add(out, "\nnormalised   (position - (%.9g, %.9g, %.9g)) * %.9g\n", r->center[0],
                   r->center[1], r->center[2], r->scale);
}

static void describe_text(lsf_string *out, const lsf_scene *scene)
{
    const lsf_requirements *r = &scene->requirements;
    lsf_string_add(out, "%s\n", scene->path);
    lsf_string_add(out, "nodes        %u\n", scene->node_count);
    lsf_string_add(out, "meshes       %u, %u primitive%s, %u instance%s\n", scene->mesh_count,
                   scene->primitive_count, lsf_plural(scene->primitive_count),
                   scene->instance_count, lsf_plural(scene->instance_count));
    lsf_string_add(out, "triangles    %llu, %llu of them stored, %llu of those without area\n",
                   (unsigned long long)r->triangles, (unsigned long long)r->unique_triangles,
                   (unsigned long long)r->degenerate_triangles);
    lsf_string_add(out, "vertices     %llu\n", (unsigned long long)r->vertices);
    if (scene->skin_count > 0)
        lsf_string_add(out, "skins        %u, %u joint%s\n", scene->skin_count, scene->joint_count,
                       lsf_plural(scene->joint_count));
    if (scene->weight_count > 0)
        lsf_string_add(out, "morphed by   %u weight%s\n", scene->weight_count,
                       lsf_plural(scene->weight_count));
    lsf_string_add(out, "materials    %u in use\n", r->materials);
    add_images_text(out, scene);
    lsf_string_add(out, "lights       %u point, %u spot, %u directional\n",
                   count_placed(scene, LSF_LIGHT_POINT), count_placed(scene, LSF_LIGHT_SPOT),
                   count_placed(scene, LSF_LIGHT_DIRECTIONAL));
    if (scene->key_light.present)
        lsf_string_add(out, "key light    directional, added by default\n");
    if (scene->default_lamp.present) {
        const double *p = scene->default_lamp.position;
        lsf_string_add(out, "lamp         a point light at %.3g %.3g %.3g, added by default\n",
                       p[0], p[1], p[2]);
    }
    const lsf_environment *environment = &scene->environment;
    if (environment->by_default)
        lsf_string_add(out, "environment  a soft sky, added by default\n");
    else if (environment->width > 0)
        lsf_string_add(out, "environment  map of %u x %u\n", environment->width,
                       environment->height);
    else if (environment->present)
        lsf_string_add(out, "environment  uniform, %g %g %g\n", (double)environment->radiance[0],
                       (double)environment->radiance[1], (double)environment->radiance[2]);
    else
        lsf_string_add(out, "environment  none\n");
    for (uint32_t i = 0; i < scene->camera_count; i++)
        lsf_string_add(out, "camera %-4u  \"%s\", %s%s\n", i, scene->cameras[i].name,
                       scene->cameras[i].orthographic ? "orthographic" : "perspective",
                       scene->cameras[i].node == LSF_NONE ? ", made to frame the scene" : "");
    add_choices_text(out, "scene", &scene->scenes, ", shown");
    add_choices_text(out, "variant", &scene->variants, ", shown");
    add_choices_text(out, "animation", &scene->animations, ", plays");
    for (uint32_t i = 0; i < scene->extension_count; i++)
        lsf_string_add(out, "extension    %s, %s\n", scene->extensions[i].name,
                       kind_of(&scene->extensions[i]));
    uint32_t channels = scene->channel_count + scene->animated_count;
    if (channels > 0)
        lsf_string_add(out, "animated     %u channel%s, %.9g s\n", channels, lsf_plural(channels),
                       lsf_scene_duration(scene));
    if (r->bounds_min[0] <= r->bounds_max[0])
        lsf_string_add(out, "bounds       %.9g %.9g %.9g to %.9g %.9g %.9g\n", r->bounds_min[0],
                       r->bounds_min[1], r->bounds_min[2], r->bounds_max[0], r->bounds_max[1],
                       r->bounds_max[2]);
    else
        lsf_string_add(out, "bounds       empty\n");
    if (scene->diffuse_only)
        lsf_string_add(out, "diffuse only\n");
    for (uint32_t i = 0; i < scene->note_count; i++)
        lsf_string_add(out, "note         %s\n", scene->notes[i]);
    add_requirements_text(out, r);
}

char *lsf_scene_describe(const lsf_scene *scene, bool json)
{
    if (!scene || scene->draft)
        return NULL;
    lsf_string out = {0};
    if (json)
        describe_json(&out, scene);
    else
        describe_text(&out, scene);
    if (out.failed) {
        free(out.text);
        return NULL;
    }
    return out.text;
}
