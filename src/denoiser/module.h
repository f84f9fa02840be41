/* The C interface of the module lightsheaf-denoiser, which runs the network on the CPU by oneDNN.
 */
#ifndef LSF_DENOISER_MODULE_H
#define LSF_DENOISER_MODULE_H

#include "denoiser/net.h"

typedef struct lsf_denoiser_module {
    /* For pictures of one size, multiples of lsf_net_granularity. `recurrent`: state is kept from
     * one picture to the next. NULL with LSF_ERROR_RENDER. */
    void *(*create)(const lsf_net *net, uint32_t width, uint32_t height, bool recurrent,
                    lsf_error *error);
    /* Maps of LSF_NET_INPUTS and LSF_NET_OUTPUTS features, one after the other, rows of width. With
     * `kept` it goes on from the state that was kept. */
    bool (*run)(void *self, const float *input, float *output, bool kept, lsf_error *error);
    /* What the last run has made is the state that is kept. */
    void (*keep)(void *self);
    void (*destroy)(void *self); /* NULL allowed */
} lsf_denoiser_module;

/* Loads the module on the first call; safe from any thread. NULL with LSF_ERROR_FILE when it is not
 * installed. */
const lsf_denoiser_module *lsf_denoiser_module_get(lsf_error *error);

#endif
