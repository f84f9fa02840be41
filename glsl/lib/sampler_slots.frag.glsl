/* Uses all sampler slots of a fragment shader; nothing is stored. */
#include "lib/sampler_slots.glsl"

layout(location = 0) out vec4 sum_out;

void main()
{
    sum_out = vec4(slots_sum(), 0.0, 0.0);
}
