#include "scene/scene.h"

#include <stdlib.h>

#include "base/base.h"
#include "scene/animated.h"

/* Channel of a texel's alpha; 0: the image has none. */
static uint32_t alpha_channel(const lsf_texture_image *image)
{
    return image->channels == 2 || image->channels == 4 ? image->channels - 1 : 0;
}

static bool image_is_opaque(const lsf_texture_image *image)
{
    uint32_t alpha = alpha_channel(image);
    uint64_t end = (uint64_t)image->width * image->height * image->channels;
    if (alpha == 0)
        return true;
    for (uint64_t i = alpha; i < end; i += image->channels) {
        bool full = image->type == LSF_TEXEL_U8 ? ((const uint8_t *)image->texels)[i] == UINT8_MAX
                    : image->type == LSF_TEXEL_U16
                        ? ((const uint16_t *)image->texels)[i] == UINT16_MAX
                        : ((const float *)image->texels)[i] >= 1.0f;
        if (!full)
            return false;
    }
    return true;
}

/* Whether an image's alpha is 1 everywhere. */
typedef enum found { UNKNOWN, OPAQUE, NOT_OPAQUE } found;

static bool is_opaque(const lsf_scene *scene, const lsf_material *material, found *known)
{
    uint32_t texture = material->base_color_texture.texture;
    if (!(material->base_color[3] >= 1.0f) || texture == LSF_NONE)
        return material->base_color[3] >= 1.0f;
    uint32_t image = scene->textures[texture].image;
    if (known[image] == UNKNOWN)
        known[image] = image_is_opaque(&scene->images[image]) ? OPAQUE : NOT_OPAQUE;
    return known[image] == OPAQUE;
}

/* `known` has an entry for each vertex; a primitive uses that of its first vertex, as primitives
 * may share their vertices. */
static bool vertices_are_opaque(const lsf_scene *scene, const lsf_primitive *primitive,
                                uint8_t *known)
{
    const float *colors = scene->vertices.color;
    if (!colors || primitive->vertex_count == 0)
        return true;
    uint8_t *answer = &known[primitive->first_vertex];
    if (*answer == UNKNOWN) {
        *answer = OPAQUE;
        for (uint64_t i = 0; *answer == OPAQUE && i < primitive->vertex_count; i++)
            if (colors[4 * (primitive->first_vertex + i) + 3] < 1.0f)
                *answer = NOT_OPAQUE;
    }
    return *answer == OPAQUE;
}

/* Without memory blended materials stay blended, which is right but slower. */
void lsf_scene_settle_alpha(lsf_scene *scene)
{
    found *known = lsf_alloc(scene->image_count, sizeof *known);
    bool *opaque = lsf_alloc(scene->material_count, sizeof *opaque);
    uint8_t *vertices_known = lsf_alloc(scene->vertices.color ? scene->vertices.count : 0, 1);
    lsf_animated_range range;
    if (!lsf_animated_find_range(&range, scene))
        goto done;
    for (uint32_t m = 0; known && opaque && m < scene->material_count; m++)
        opaque[m] = scene->materials[m].alpha_mode == LSF_ALPHA_BLEND &&
                    is_opaque(scene, &range.materials[0][m], known);
    for (uint32_t p = 0; known && opaque && vertices_known && p < scene->primitive_count; p++) {
        const lsf_primitive *primitive = &scene->primitives[p];
        if (opaque[primitive->material])
            opaque[primitive->material] = vertices_are_opaque(scene, primitive, vertices_known);
    }
    for (uint32_t m = 0; known && opaque && vertices_known && m < scene->material_count; m++)
        if (opaque[m])
            scene->materials[m].alpha_mode = LSF_ALPHA_OPAQUE;
    lsf_animated_range_finish(&range);
done:
    free(known);
    free(opaque);
    free(vertices_known);
}
