/* What the files of the denoiser share: its layers as OpenGL runs them. */
#ifndef LSF_PASSES_DENOISE_PARTS_H
#define LSF_PASSES_DENOISE_PARTS_H

#include "denoiser/chain.h"
#include "passes/denoise.h"
#include "shared/denoise_data.h"

/* Where the weights of a step are: groups that it reads, and vec4s. */
typedef struct lsf_denoise_weights {
    uint32_t groups, first_weight, first_bias;
} lsf_denoise_weights;

struct lsf_denoise_layout {
    lsf_net_chain chain;
    lsf_denoise_weights weights[LSF_NET_MAPS_MAX]; /* of each step */
    uint64_t weight_bytes, largest;                /* largest: of one map */
};

uint32_t lsf_denoise_groups(uint32_t features);
/* Bytes of a map, without what follows it. */
uint64_t lsf_denoise_map_bytes(const lsf_net_map *map);

/* Of a padded picture; `recurrent`: state is kept from frame to frame. */
void lsf_denoise_layout_make(lsf_denoise_layout *layout, const lsf_net *net, uint32_t width,
                             uint32_t height, bool recurrent);
/* `weight_bytes` of weights as shaders read them; malloc'ed, NULL without memory. */
float *lsf_denoise_pack_weights(const lsf_denoise_layout *layout);

/* Appends what goes into the network to the file that LIGHTSHEAF_DENOISER_RECORD names. */
bool lsf_denoise_record(const lsf_denoise *pass, const lsf_plan *plan,
                        const lsf_denoise_inputs *inputs, lsf_error *error);

#endif
