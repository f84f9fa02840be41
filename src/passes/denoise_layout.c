/* Where feature maps lie: bytes are used anew as soon as no layer reads them any more. */
#include <stdlib.h>
#include <string.h>

#include "passes/denoise_parts.h"

/* Buffers are bound by parts that begin at multiples of it (GL 4.5, table 23.64: at most 256). */
#define ALIGNMENT 256

static uint32_t groups_of(uint32_t features)
{
    return (features + LSF_DENOISE_GROUP - 1) / LSF_DENOISE_GROUP;
}

static uint32_t add_map(lsf_denoise_layout *layout, uint32_t features, uint32_t width,
                        uint32_t height)
{
    lsf_denoise_place *map = &layout->maps[layout->map_count];
    *map = (lsf_denoise_place){.home = LSF_DENOISE_FEATURES,
                               .groups = groups_of(features),
                               .width = width,
                               .height = height};
    uint64_t bytes = (uint64_t)map->groups * width * height * 2 * LSF_DENOISE_GROUP;
    map->bytes = (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (map->bytes > layout->largest)
        layout->largest = map->bytes;
    return layout->map_count++;
}

/* Returns the number of the layer's map. */
static uint32_t add_layer(lsf_denoise_layout *layout, const lsf_net_layer *net, uint32_t source,
                          uint32_t beside, uint32_t width, uint32_t height)
{
    const lsf_denoise_place *maps = layout->maps;
    lsf_denoise_layer *layer = &layout->layers[layout->layer_count++];
    uint32_t target = add_map(layout, net->out, width, height);
    *layer = (lsf_denoise_layer){.net = net,
                                 .source = source,
                                 .beside = beside,
                                 .target = target,
                                 .pooled = net->side == 3 && maps[source].width != width,
                                 .rectified = net->side == 3,
                                 .groups = maps[source].groups};
    return target;
}

/* The last layer has weights for so many more features. */
static void reads_beside(lsf_denoise_layout *layout, uint32_t features)
{
    lsf_denoise_layer *layer = &layout->layers[layout->layer_count - 1];
    layer->beside_features = features;
    layer->groups += groups_of(features);
}

static void add_layers(lsf_denoise_layout *layout, const lsf_net *net, uint32_t width,
                       uint32_t height, bool recurrent)
{
    uint32_t skips[LSF_NET_STAGES_MAX + 1];
    uint32_t last = add_map(layout, LSF_NET_INPUTS, width, height);
    for (uint32_t stage = 1; stage <= net->stages; stage++) {
        uint32_t w = width >> (stage - 1), h = height >> (stage - 1);
        last = add_layer(layout, lsf_net_encode(net, stage, false), last, 0, w, h);
        last = skips[stage] = add_layer(layout, lsf_net_encode(net, stage, true), last, 0, w, h);
        layout->layers[layout->layer_count - 1].kept = recurrent;
        reads_beside(layout, lsf_net_encode(net, stage, true)->out);
    }
    for (uint32_t stage = net->stages - 1; stage > 0; stage--) {
        uint32_t w = width >> (stage - 1), h = height >> (stage - 1);
        last = add_layer(layout, lsf_net_decode(net, stage, false), last, 0, w, h);
        last = add_layer(layout, lsf_net_decode(net, stage, true), last, skips[stage], w, h);
        reads_beside(layout, lsf_net_encode(net, stage, true)->out);
    }
    add_layer(layout, lsf_net_out(net), last, 0, width, height);
    layout->layers[layout->layer_count - 1].rectified = false;
}

/* The last layer that reads a map. */
static uint32_t last_use(const lsf_denoise_layout *layout, uint32_t map)
{
    uint32_t last = 0;
    for (uint32_t i = 0; i < layout->layer_count; i++)
        if (layout->layers[i].source == map || (layout->layers[i].beside == map && map > 0))
            last = i;
    return last;
}

/* The lowest place that is free while the map is needed: from the layer that makes it, map - 1, to
 * its last use. */
static uint64_t find_place(const lsf_denoise_layout *layout, uint32_t map)
{
    uint64_t at = 0;
    uint32_t end = last_use(layout, map);
    for (bool moved = true; moved;) {
        moved = false;
        for (uint32_t other = 1; other < map; other++) {
            const lsf_denoise_place *o = &layout->maps[other];
            bool needed = o->home == LSF_DENOISE_FEATURES && last_use(layout, other) + 1 >= map &&
                          other - 1 <= end;
            if (needed && at < o->offset + o->bytes && o->offset < at + layout->maps[map].bytes) {
                at = o->offset + o->bytes;
                moved = true;
            }
        }
    }
    return at;
}

static void place_maps(lsf_denoise_layout *layout, bool recurrent)
{
    layout->maps[0].home = layout->maps[layout->map_count - 1].home = LSF_DENOISE_EXCHANGE;
    for (uint32_t i = 0; recurrent && i < layout->layer_count; i++)
        if (layout->layers[i].kept)
            layout->maps[layout->layers[i].target].home = LSF_DENOISE_STATE;
    for (uint32_t i = 1; i < layout->map_count; i++) {
        lsf_denoise_place *map = &layout->maps[i];
        if (map->home == LSF_DENOISE_STATE) {
            map->offset = layout->state_bytes;
            layout->state_bytes += map->bytes;
        } else if (map->home == LSF_DENOISE_FEATURES) {
            map->offset = find_place(layout, i);
            uint64_t end = map->offset + map->bytes;
            layout->feature_bytes = end > layout->feature_bytes ? end : layout->feature_bytes;
        }
    }
}

void lsf_denoise_layout_make(lsf_denoise_layout *layout, const lsf_net *net, uint32_t width,
                             uint32_t height, bool recurrent)
{
    *layout = (lsf_denoise_layout){0};
    add_layers(layout, net, width, height, recurrent);
    place_maps(layout, recurrent);
    uint32_t at = 0; /* vec4s */
    for (uint32_t i = 0; i < layout->layer_count; i++) {
        lsf_denoise_layer *layer = &layout->layers[i];
        uint32_t targets = groups_of(layer->net->out), places = layer->net->side * layer->net->side;
        layer->first_weight = at;
        layer->first_bias = at + targets * layer->groups * places * LSF_DENOISE_GROUP * 2;
        at = layer->first_bias + targets * 2;
    }
    layout->weight_bytes = (uint64_t)at * 4 * sizeof(float);
}

/* Features of what is read beside begin at a group of their own. */
static void pack_layer(float *weights, const lsf_denoise_layer *layer)
{
    const lsf_net_layer *net = layer->net;
    uint32_t places = net->side * net->side, first = net->in - layer->beside_features;
    float *packed = weights + (size_t)4 * layer->first_weight;
    for (uint32_t o = 0; o < net->out; o++)
        for (uint32_t i = 0; i < net->in; i++)
            for (uint32_t p = 0; p < places; p++) {
                uint32_t in = i < first ? i : i - first + groups_of(first) * LSF_DENOISE_GROUP;
                size_t from = net->side == 2 ? ((size_t)i * net->out + o) * places + p
                                             : ((size_t)o * net->in + i) * places + p;
                size_t group =
                    (size_t)(o / LSF_DENOISE_GROUP) * layer->groups + in / LSF_DENOISE_GROUP;
                size_t row = (group * places + p) * LSF_DENOISE_GROUP + o % LSF_DENOISE_GROUP;
                packed[row * LSF_DENOISE_GROUP + in % LSF_DENOISE_GROUP] = net->weights[from];
            }
    memcpy(weights + (size_t)4 * layer->first_bias, net->bias, net->out * sizeof *net->bias);
}

float *lsf_denoise_pack_weights(const lsf_denoise_layout *layout)
{
    float *weights = lsf_alloc(layout->weight_bytes, 1);
    for (uint32_t i = 0; weights && i < layout->layer_count; i++)
        pack_layer(weights, &layout->layers[i]);
    return weights;
}
