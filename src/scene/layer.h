/* The layers of a result: the picture, its coverage, and those that lsf_aov names. */
#ifndef LSF_SCENE_LAYER_H
#define LSF_SCENE_LAYER_H

#include <lightsheaf/image.h>
#include <lightsheaf/renderer.h>

/* Beside the bits of lsf_aov: channel A of the picture, which a transparent background asks for. */
#define LSF_LAYER_COVERAGE (1u << 31)
#define LSF_LAYER_COUNT (2 + LSF_AOV_COUNT)

typedef struct lsf_layer {
    uint32_t bit;         /* of lsf_aov, or LSF_LAYER_COVERAGE; 0: the picture */
    const char *name;     /* "picture", "albedo", ... */
    const char *channels; /* a letter each, as OpenEXR has it: "RGB", "XYZ" */
} lsf_layer;

/* In the order of an image's channels. */
extern const lsf_layer lsf_layers[LSF_LAYER_COUNT];

const lsf_layer *lsf_layer_of(uint32_t bit);
/* Names of an image's channels: "R" of the picture, "albedo.R" of a layer. Returns their number. */
uint32_t lsf_layer_channels(const lsf_layer *layer, char names[3][LSF_CHANNEL_NAME_SIZE]);

#endif
