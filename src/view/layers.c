#include "view/app.h"

#include "base/base.h"

#include <math.h>

static const struct {
    const char *name;
    lsf_tint tint;
} layers[] = {
    {"Picture", LSF_TINT_COLOR},
    {"Albedo", LSF_TINT_COLOR},
    {"Normal", LSF_TINT_SIGNED},
    {"Depth", LSF_TINT_DISTANCE},
    {"Emission", LSF_TINT_COLOR},
    {"Direct light", LSF_TINT_COLOR},
    {"Indirect diffuse light", LSF_TINT_COLOR},
    {"Indirect specular light", LSF_TINT_COLOR},
    {"Motion", LSF_TINT_MOTION},
    {"Voxels: albedo", LSF_TINT_COLOR},
    {"Voxels: normal", LSF_TINT_SIGNED},
    {"Voxels: radiance", LSF_TINT_COLOR},
};
_Static_assert(LSF_COUNT(layers) == LSF_AOV_COUNT + 1, "one for each AOV");

const char *lsf_viewer_layer_name(int layer)
{
    return layer >= 0 && (size_t)layer < LSF_COUNT(layers) ? layers[layer].name : NULL;
}

void lsf_viewer_show_layer(lsf_viewer *viewer, uint32_t texture, lsf_canvas *canvas)
{
    lsf_tint tint = layers[viewer->settings.layer].tint;
    float scale = 1.0f;
    bool radiance = viewer->settings.layer != 1 && viewer->settings.layer != 9;
    if (tint == LSF_TINT_COLOR && radiance)
        scale = exp2f(viewer->settings.exposure);
    else if (tint == LSF_TINT_DISTANCE)
        scale = 1.0f / viewer->camera.extent;
    else if (tint == LSF_TINT_MOTION)
        scale = 0.05f; /* 20 pixels a frame are as bright as it gets */
    lsf_canvas_tint(canvas, texture, tint, scale);
}
