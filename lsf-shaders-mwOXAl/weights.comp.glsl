#include "lib/mis.glsl"
layout(local_size_x = 65) in;
layout(std430, binding = 0) buffer block { vec4 p[]; };
void main()
{
    vec4 q = p[gl_GlobalInvocationID.x];
    p[gl_GlobalInvocationID.x].zw =
        vec2(mis_weight(q.x, q.y), mis_weight(q.y, q.x));
}
