/* Prefix sums of the rows' totals, and from the last one the factor from importance to density. One work group:
 * each invocation adds up a run of rows, then starts from the sum of the runs before. */
#include "shared/light_data.h"
#include "shared/scene_data.h"

#define RUNS 256

layout(local_size_x = RUNS) in;

layout(std430, binding = 1) buffer sum_block
{
    float sums[];
};
layout(std430, binding = 2) buffer light_block
{
    lsf_light_data light;
};

shared float run_sums[RUNS];

void main()
{
    int run = int(gl_LocalInvocationID.x);
    int texels = int(light.map_shape.z);
    int rows = texels * int(light.map_origin.w);
    int totals = rows * texels;
    int length = (rows + RUNS - 1) / RUNS;
    int first = min(run * length, rows), end = min(first + length, rows);
    float sum = 0.0;
    for (int row = first; row < end; row++)
        sum += sums[totals + row];
    run_sums[run] = sum;
    barrier();
    sum = 0.0;
    for (int before = 0; before < run; before++)
        sum += run_sums[before];
    for (int row = first; row < end; row++) {
        sum += sums[totals + row];
        sums[totals + row] = sum;
    }
    if (run == RUNS - 1)
        light.position.w = sum > 0.0 ? 0.25 * light.map_shape.z * light.map_shape.z / sum : 0.0;
}
