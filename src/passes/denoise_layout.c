/* Feature maps and weights in groups of 8 features, as shaders read them. */
#include <string.h>

#include "passes/denoise_parts.h"

/* Buffers are bound by parts that begin at multiples of it (GL 4.5, table 23.64: at most 256). */
#define ALIGNMENT 256

/* vec4s of a row of weights, or of biases. */
#define ROW (LSF_DENOISE_GROUP / 4)

uint32_t lsf_denoise_groups(uint32_t features)
{
    return (features + LSF_DENOISE_GROUP - 1) / LSF_DENOISE_GROUP;
}

uint64_t lsf_denoise_map_bytes(const lsf_net_map *map)
{
    uint64_t pixels = (uint64_t)map->width * map->height;
    return lsf_denoise_groups(map->features) * pixels * LSF_DENOISE_GROUP * sizeof(uint16_t);
}

void lsf_denoise_layout_make(lsf_denoise_layout *layout, const lsf_net *net, uint32_t width,
                             uint32_t height, bool recurrent)
{
    *layout = (lsf_denoise_layout){0};
    lsf_net_chain *chain = &layout->chain;
    lsf_net_chain_make(chain, net, width, height, recurrent);
    for (uint32_t i = 0; i <= chain->step_count; i++) {
        chain->maps[i].bytes = lsf_denoise_map_bytes(&chain->maps[i]);
        if (chain->maps[i].bytes > layout->largest)
            layout->largest = chain->maps[i].bytes;
    }
    lsf_net_chain_assign_offsets(chain, ALIGNMENT);
    uint32_t at = 0; /* vec4s */
    for (uint32_t i = 0; i < chain->step_count; i++) {
        const lsf_net_step *step = &chain->steps[i];
        const lsf_net_layer *layer = step->layer;
        uint32_t targets = lsf_denoise_groups(layer->out), beside = step->beside_features;
        lsf_denoise_weights *weights = &layout->weights[i];
        weights->groups = lsf_denoise_groups(layer->in - beside) + lsf_denoise_groups(beside);
        weights->first_weight = at;
        at += targets * weights->groups * layer->side * layer->side * LSF_DENOISE_GROUP * ROW;
        weights->first_bias = at;
        at += targets * ROW;
    }
    layout->weight_bytes = (uint64_t)at * 4 * sizeof(float);
}

/* What is read beside the source begins at a group of its own. */
static void pack_layer(float *all, const lsf_net_step *step, const lsf_denoise_weights *weights)
{
    const lsf_net_layer *layer = step->layer;
    uint32_t taps = layer->side * layer->side, first = layer->in - step->beside_features;
    float *packed = all + (size_t)4 * weights->first_weight;
    for (uint32_t o = 0; o < layer->out; o++)
        for (uint32_t i = 0; i < layer->in; i++)
            for (uint32_t p = 0; p < taps; p++) {
                uint32_t in =
                    i < first ? i : i - first + lsf_denoise_groups(first) * LSF_DENOISE_GROUP;
                size_t from = layer->side == 2 ? ((size_t)i * layer->out + o) * taps + p
                                               : ((size_t)o * layer->in + i) * taps + p;
                size_t group =
                    (size_t)(o / LSF_DENOISE_GROUP) * weights->groups + in / LSF_DENOISE_GROUP;
                size_t row = (group * taps + p) * LSF_DENOISE_GROUP + o % LSF_DENOISE_GROUP;
                packed[row * LSF_DENOISE_GROUP + in % LSF_DENOISE_GROUP] = layer->weights[from];
            }
    memcpy(all + (size_t)4 * weights->first_bias, layer->bias, layer->out * sizeof *layer->bias);
}

float *lsf_denoise_pack_weights(const lsf_denoise_layout *layout)
{
    float *weights = lsf_alloc(layout->weight_bytes, 1);
    for (uint32_t i = 0; weights && i < layout->chain.step_count; i++)
        pack_layer(weights, &layout->chain.steps[i], &layout->weights[i]);
    return weights;
}
