/* The network's layers one after the other, with the feature maps that they read and make, for a
 * picture of one size. Whoever runs them says how many bytes a map takes; maps share bytes where
 * they are not needed at the same time. */
#ifndef LSF_DENOISER_CHAIN_H
#define LSF_DENOISER_CHAIN_H

#include "denoiser/net.h"

/* One for each layer's result, and that which the first one reads. */
#define LSF_NET_MAPS_MAX (4 * LSF_NET_STAGES_MAX)

typedef enum lsf_net_home {
    LSF_NET_OUTSIDE, /* what goes into the network, and what comes out */
    LSF_NET_SHARED,  /* bytes that others have before and after */
    LSF_NET_STATE,   /* is kept for the next frame */
} lsf_net_home;

typedef struct lsf_net_map {
    lsf_net_home home;
    uint32_t features, width, height;
    uint64_t bytes;  /* for the caller to set */
    uint64_t offset; /* among those of its home, by lsf_net_chain_assign_offsets */
} lsf_net_map;

typedef struct lsf_net_step {
    const lsf_net_layer *layer;
    uint32_t source; /* number of a map */
    uint32_t beside; /* likewise, 0: none; with `kept` the step's target of the frame before */
    uint32_t beside_features; /* that there are weights for, after those of the source */
    bool kept;
    bool pooled; /* the source is twice as large, and the most of 2 x 2 pixels counts */
    bool last;   /* its result is left as it is: not rectified */
} lsf_net_step;

/* Step i makes map i + 1. */
typedef struct lsf_net_chain {
    uint32_t step_count;
    lsf_net_step steps[LSF_NET_MAPS_MAX];
    lsf_net_map maps[LSF_NET_MAPS_MAX];
    uint64_t shared_bytes, state_bytes;
} lsf_net_chain;

/* `width`, `height`: multiples of lsf_net_granularity; `recurrent`: state is kept. */
void lsf_net_chain_make(lsf_net_chain *chain, const lsf_net *net, uint32_t width, uint32_t height,
                        bool recurrent);
/* Sets offsets, each a multiple of `alignment`, and how many bytes there are. */
void lsf_net_chain_assign_offsets(lsf_net_chain *chain, uint64_t alignment);

#endif
