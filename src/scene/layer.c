#include "scene/layer.h"

#include <stdio.h>
#include <string.h>

const lsf_layer lsf_layers[LSF_LAYER_COUNT] = {
    {0, "picture", "RGB"},
    {LSF_LAYER_COVERAGE, "coverage", "A"},
    {LSF_AOV_ALBEDO, "albedo", "RGB"},
    {LSF_AOV_NORMAL, "normal", "XYZ"},
    {LSF_AOV_DEPTH, "depth", "Z"},
    {LSF_AOV_EMISSION, "emission", "RGB"},
    {LSF_AOV_DIRECT, "direct", "RGB"},
    {LSF_AOV_INDIRECT_DIFFUSE, "indirect_diffuse", "RGB"},
    {LSF_AOV_INDIRECT_SPECULAR, "indirect_specular", "RGB"},
    {LSF_AOV_MOTION, "motion", "XY"},
    {LSF_AOV_VOXEL_ALBEDO, "voxel_albedo", "RGB"},
    {LSF_AOV_VOXEL_NORMAL, "voxel_normal", "XYZ"},
    {LSF_AOV_VOXEL_RADIANCE, "voxel_radiance", "RGB"},
};

static bool is_aov(const lsf_layer *layer)
{
    return layer->bit != 0 && layer->bit != LSF_LAYER_COVERAGE;
}

const lsf_layer *lsf_layer_of(uint32_t bit)
{
    for (size_t i = 1; i < LSF_LAYER_COUNT; i++)
        if (lsf_layers[i].bit == bit)
            return &lsf_layers[i];
    return &lsf_layers[0];
}

uint32_t lsf_layer_channels(const lsf_layer *layer, char names[3][LSF_CHANNEL_NAME_SIZE])
{
    uint32_t count = 0;
    for (const char *letter = layer->channels; *letter; letter++, count++)
        snprintf(names[count], LSF_CHANNEL_NAME_SIZE, "%s%s%c", is_aov(layer) ? layer->name : "",
                 is_aov(layer) ? "." : "", *letter);
    return count;
}

uint32_t lsf_aov_from_name(const char *name)
{
    for (size_t i = 0; name && i < LSF_LAYER_COUNT; i++)
        if (is_aov(&lsf_layers[i]) && strcmp(lsf_layers[i].name, name) == 0)
            return lsf_layers[i].bit;
    return 0;
}

const char *lsf_aov_name(uint32_t aovs)
{
    for (size_t i = 0; i < LSF_LAYER_COUNT; i++)
        if (is_aov(&lsf_layers[i]) && (aovs & lsf_layers[i].bit))
            return lsf_layers[i].name;
    return NULL;
}
