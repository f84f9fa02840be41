/* The network of src/passes/denoise.md as a file has it: layers of a recurrent autoencoder and
 * their weights. */
#ifndef LSF_DENOISER_NET_H
#define LSF_DENOISER_NET_H

#include "base/base.h"

/* What a pixel gives to the network, and gets of it. */
#define LSF_NET_INPUTS 20
#define LSF_NET_OUTPUTS 6

#define LSF_NET_STAGES_MAX 8
#define LSF_NET_FEATURES_MAX 1024

/* A convolution of 3 x 3 pixels, or one of 2 x 2 that doubles width and height. */
typedef struct lsf_net_layer {
    char name[32];
    uint32_t out, in, side;
    float *weights; /* [out][in][side][side], of one that doubles [in][out][side][side] */
    float *bias;    /* [out] */
} lsf_net_layer;

/* Stages 1 to `stages`, each at half the width and height of the one before it. Layers as in the
 * file: enc1a, enc1b, ... of all stages; of the last stage but one down to the first: decNa, decNb;
 * out. */
typedef struct lsf_net {
    uint32_t stages, layer_count;
    float leak;     /* what negative numbers are multiplied by after a convolution; 0: rectified */
    bool recurrent; /* there are weights for what was made in the frame before */
    lsf_net_layer *layers;
} lsf_net;

/* `path` is a file of weights; NULL: those that the library was built with. LSF_ERROR_FILE says
 * what is wrong. */
lsf_net *lsf_net_load(const char *path, lsf_error *error);
/* The same of bytes in memory, of which `name` is the file. */
lsf_net *lsf_net_read(const void *bytes, size_t length, const char *name, lsf_error *error);
void lsf_net_destroy(lsf_net *net); /* NULL allowed */

/* By the number of the stage, from 1; `second`: the one that also reads what was kept. */
const lsf_net_layer *lsf_net_encode(const lsf_net *net, uint32_t stage, bool second);
/* Of a stage but the last; `second`: the one after the doubling. */
const lsf_net_layer *lsf_net_decode(const lsf_net *net, uint32_t stage, bool second);
const lsf_net_layer *lsf_net_out(const lsf_net *net);

/* Pixels to a side that the network takes for one in the last stage: widths and heights are
 * multiples of it. */
uint32_t lsf_net_granularity(const lsf_net *net);

#endif
