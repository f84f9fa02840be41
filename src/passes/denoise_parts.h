/* What the files of the denoiser share: its layers, one after the other, and where their maps are.
 */
#ifndef LSF_PASSES_DENOISE_PARTS_H
#define LSF_PASSES_DENOISE_PARTS_H

#include "passes/denoise.h"
#include "shared/denoise_data.h"

/* One for each layer's result, and that which the first one reads. */
#define LSF_DENOISE_MAPS_MAX (4 * LSF_NET_STAGES_MAX)

/* Which buffer a feature map is in. */
typedef enum lsf_denoise_home {
    LSF_DENOISE_EXCHANGE, /* what goes into the network, and what comes out */
    LSF_DENOISE_FEATURES,
    LSF_DENOISE_STATE, /* is kept for the next frame */
} lsf_denoise_home;

typedef struct lsf_denoise_place {
    lsf_denoise_home home;
    uint32_t groups, width, height;
    uint64_t offset, bytes;
} lsf_denoise_place;

typedef struct lsf_denoise_layer {
    const lsf_net_layer *net;
    uint32_t source, beside, target; /* numbers of maps; beside 0: nothing is read beside */
    bool pooled;                     /* the source is twice as large */
    bool kept;                       /* what is beside is the target of the frame before */
    bool rectified;
    uint32_t beside_features; /* that there are weights for, after those of the source */
    uint32_t groups, first_weight, first_bias; /* of the weights: groups of what is read; vec4s */
} lsf_denoise_layer;

struct lsf_denoise_layout {
    uint32_t layer_count, map_count;
    lsf_denoise_layer layers[LSF_DENOISE_MAPS_MAX];
    lsf_denoise_place maps[LSF_DENOISE_MAPS_MAX]; /* number i is what layer i - 1 has made */
    uint64_t feature_bytes, state_bytes, weight_bytes, largest; /* largest: of one map */
};

/* Of a padded picture; `recurrent`: state is kept from frame to frame. */
void lsf_denoise_layout_make(lsf_denoise_layout *layout, const lsf_net *net, uint32_t width,
                             uint32_t height, bool recurrent);
/* `weight_bytes` of weights as shaders read them; malloc'ed, NULL without memory. */
float *lsf_denoise_pack_weights(const lsf_denoise_layout *layout);

/* Appends what goes into the network to the file that LIGHTSHEAF_DENOISER_RECORD names. */
bool lsf_denoise_record(const lsf_denoise *pass, const lsf_plan *plan,
                        const lsf_denoise_inputs *inputs, lsf_error *error);

#endif
