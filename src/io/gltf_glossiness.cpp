#include "io/gltf_import.hpp"

#include <cmath>

/* The roughness that KHR_materials_pbrSpecularGlossiness keeps as glossiness in a texture's alpha.
 */

namespace lsf
{

/* 0 to 1. */
static double alpha_at(const lsf_texture_image &image, uint64_t texel)
{
    uint64_t at = texel * image.channels + image.channels - 1;
    switch (image.type) {
    case LSF_TEXEL_U8:
        return static_cast<const uint8_t *>(image.texels)[at] / 255.0;
    case LSF_TEXEL_U16:
        return static_cast<const uint16_t *>(image.texels)[at] / 65535.0;
    case LSF_TEXEL_F32:
        break;
    }
    return std::min(std::max((double)static_cast<const float *>(image.texels)[at], 0.0), 1.0);
}

void make_roughness_image(gltf_import &import, const lsf_texture_image &source, double factor,
                          lsf_texture_image &result)
{
    uint64_t count = (uint64_t)source.width * source.height;
    bool alpha = source.channels == 2 || source.channels == 4;
    bool small = source.type == LSF_TEXEL_U8;
    result.name = copy_text(std::string(source.name) + ", roughness");
    result.type = small ? LSF_TEXEL_U8 : LSF_TEXEL_U16;
    import.budget.take(count, small ? 1 : 2, source.name);
    result.texels = allocate(count, small ? 1 : 2);
    result.width = source.width;
    result.height = source.height;
    result.channels = 1;
    for (uint64_t i = 0; i < count; i++) {
        double roughness = 1.0 - factor * (alpha ? alpha_at(source, i) : 1.0);
        if (small)
            static_cast<uint8_t *>(result.texels)[i] = (uint8_t)std::lround(255.0 * roughness);
        else
            static_cast<uint16_t *>(result.texels)[i] = (uint16_t)std::lround(65535.0 * roughness);
    }
}

} // namespace lsf
