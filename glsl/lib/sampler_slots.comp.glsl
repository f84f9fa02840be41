/* Uses all sampler slots of a compute shader; nothing is stored beyond the work group. */
#include "lib/sampler_slots.glsl"

layout(local_size_x = 1) in;

shared int sum; /* atomic, or the compiler would see that nobody reads it */

void main()
{
    ivec2 sizes = slots_sum();
    atomicAdd(sum, sizes.x + sizes.y);
}
