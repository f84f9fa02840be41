#include "denoiser/chain.h"

/* Returns the number of the map that it makes. */
static uint32_t add(lsf_net_chain *chain, const lsf_net_layer *layer, uint32_t source,
                    uint32_t width, uint32_t height)
{
    uint32_t target = chain->step_count + 1;
    chain->steps[chain->step_count++] =
        (lsf_net_step){.layer = layer,
                       .source = source,
                       .pooled = layer->side == 3 && chain->maps[source].width != width};
    chain->maps[target] = (lsf_net_map){
        .home = LSF_NET_SHARED, .features = layer->out, .width = width, .height = height};
    return target;
}

void lsf_net_chain_make(lsf_net_chain *chain, const lsf_net *net, uint32_t width, uint32_t height,
                        bool recurrent)
{
    uint32_t skips[LSF_NET_STAGES_MAX + 1] = {0}, last = 0;
    *chain =
        (lsf_net_chain){.maps = {{.features = LSF_NET_INPUTS, .width = width, .height = height}}};
    for (uint32_t stage = 1; stage <= net->stages; stage++) {
        uint32_t w = width >> (stage - 1), h = height >> (stage - 1);
        last = add(chain, lsf_net_encode(net, stage, false), last, w, h);
        last = skips[stage] = add(chain, lsf_net_encode(net, stage, true), last, w, h);
        lsf_net_step *step = &chain->steps[last - 1];
        step->beside_features = step->layer->out;
        step->kept = recurrent;
        step->beside = recurrent ? last : 0;
        chain->maps[last].home = recurrent ? LSF_NET_STATE : LSF_NET_SHARED;
    }
    for (uint32_t stage = net->stages - 1; stage > 0; stage--) {
        uint32_t w = width >> (stage - 1), h = height >> (stage - 1);
        last = add(chain, lsf_net_decode(net, stage, false), last, w, h);
        last = add(chain, lsf_net_decode(net, stage, true), last, w, h);
        chain->steps[last - 1].beside = skips[stage];
        chain->steps[last - 1].beside_features = chain->maps[skips[stage]].features;
    }
    last = add(chain, lsf_net_out(net), last, width, height);
    chain->steps[last - 1].last = true;
    chain->maps[last].home = LSF_NET_OUTSIDE;
}

/* The last step that reads a map; of the last map, that which makes it. */
static uint32_t last_use(const lsf_net_chain *chain, uint32_t map)
{
    uint32_t last = map - 1;
    for (uint32_t i = 0; i < chain->step_count; i++)
        if (chain->steps[i].source == map || chain->steps[i].beside == map)
            last = i;
    return last;
}

/* Of maps that share their bytes; step `map` - 1 makes it. */
static bool needed_together(const lsf_net_chain *chain, uint32_t map, uint32_t other)
{
    return last_use(chain, other) >= map - 1 && last_use(chain, map) >= other - 1;
}

/* The lowest that is free for as long as the map is needed, where those before it in `order` are.
 */
static uint64_t free_offset(const lsf_net_chain *chain, const uint32_t *order, uint32_t index)
{
    uint64_t at = 0, bytes = chain->maps[order[index]].bytes;
    for (bool moved = true; moved;) {
        moved = false;
        for (uint32_t i = 0; i < index; i++) {
            const lsf_net_map *o = &chain->maps[order[i]];
            if (needed_together(chain, order[index], order[i]) && at < o->offset + o->bytes &&
                o->offset < at + bytes) {
                at = o->offset + o->bytes;
                moved = true;
            }
        }
    }
    return at;
}

/* The largest of those that share bytes first, so that the small ones fill what these leave. */
static uint32_t sort_shared(const lsf_net_chain *chain, uint32_t order[LSF_NET_MAPS_MAX])
{
    uint32_t count = 0;
    for (uint32_t map = 1; map <= chain->step_count; map++) {
        if (chain->maps[map].home != LSF_NET_SHARED)
            continue;
        uint32_t at = count++;
        for (; at > 0 && chain->maps[order[at - 1]].bytes < chain->maps[map].bytes; at--)
            order[at] = order[at - 1];
        order[at] = map;
    }
    return count;
}

void lsf_net_chain_assign_offsets(lsf_net_chain *chain, uint64_t alignment)
{
    uint32_t order[LSF_NET_MAPS_MAX];
    chain->shared_bytes = chain->state_bytes = 0;
    for (uint32_t i = 1; i <= chain->step_count; i++) {
        lsf_net_map *map = &chain->maps[i];
        map->bytes = (map->bytes + alignment - 1) / alignment * alignment;
        map->offset = 0;
        if (map->home == LSF_NET_STATE) {
            map->offset = chain->state_bytes;
            chain->state_bytes += map->bytes;
        }
    }
    uint32_t count = sort_shared(chain, order);
    for (uint32_t i = 0; i < count; i++) {
        lsf_net_map *map = &chain->maps[order[i]];
        map->offset = free_offset(chain, order, i);
        if (map->offset + map->bytes > chain->shared_bytes)
            chain->shared_bytes = map->offset + map->bytes;
    }
}
