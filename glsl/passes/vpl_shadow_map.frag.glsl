#include "lib/mask.glsl"

layout(location = 0) out vec2 gradient;

void main()
{
    /* Relative to the depth, and before any discard, while the whole quad is alive. */
    float z = gl_FragCoord.z;
    gradient = vec2(dFdx(z), dFdy(z)) / z;
    if (masked_out())
        discard;
}
