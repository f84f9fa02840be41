/* Accounts for the nodes: after each build, and at the end of an iteration, where it decides whether the
 * iteration's picture may be kept. Sums have two words each, the low one first. */
#include "shared/bundle_data.h"
#include "shared/scene_data.h"

layout(local_size_x = 1) in;

layout(std430, binding = LSF_BINDING_BUNDLE_STATUS) buffer lsf_status_block
{
    lsf_bundle_status status;
};
layout(std430, binding = LSF_BINDING_BUNDLE_NODES) readonly buffer lsf_head_block
{
    uint heads[];
};

layout(location = 0) uniform uint chain_capacity;
layout(location = 1) uniform bool iteration_ends;
layout(location = 2) uniform uint iterations_done; /* including this one if it succeeds */

void add(inout uint low, inout uint high, uint count)
{
    uint carry;
    low = uaddCarry(low, count, carry);
    high += carry;
}

void main()
{
    if (!iteration_ends) {
        uint nodes = status.drawn_low; /* a map has fewer than 2^32 of them */
        for (int i = LSF_BUNDLE_RASTERISED; i < LSF_BUNDLE_COUNTERS; i += 16)
            nodes += heads[i];
        add(status.new_nodes_low, status.new_nodes_high, nodes);
        add(status.new_chained_low, status.new_chained_high, heads[LSF_BUNDLE_CHAINED]);
        status.needed = max(status.needed, heads[LSF_BUNDLE_CHAINED]);
        return;
    }
    bool good = status.needed <= chain_capacity;
    status.draw_vertices = good ? 3u : 0u;
    status.draw_instances = 1u;
    status.draw_first = 0u;
    status.draw_base = 0u;
    if (!good && status.first_needed == 0u)
        status.first_needed = status.needed;
    if (good) {
        status.iterations_done = iterations_done;
        add(status.nodes_low, status.nodes_high, status.new_nodes_low);
        status.nodes_high += status.new_nodes_high;
        add(status.chained_low, status.chained_high, status.new_chained_low);
        status.chained_high += status.new_chained_high;
    }
    status.new_nodes_low = status.new_nodes_high = 0u;
    status.new_chained_low = status.new_chained_high = 0u;
}
