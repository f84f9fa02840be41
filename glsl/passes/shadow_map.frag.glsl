#include "lib/light_projection.glsl"
#include "lib/mask.glsl"

#if LSF_GRADIENT
layout(location = 0) out vec2 gradient;
#endif

void main()
{
#if LSF_GRADIENT
    /* Derivatives come before any discard, while the whole quad is alive. */
    float z = gl_FragCoord.z;
    gradient = vec2(dFdx(z), dFdy(z)) / light_projection_depth_unit(z);
#endif
    if (masked_out())
        discard;
}
