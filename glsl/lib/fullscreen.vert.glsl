/* One triangle that covers the viewport: (-1,-1), (3,-1), (-1,3), from gl_VertexID alone. A single
 * triangle leaves no diagonal along which helper lanes would shade twice. */

out vec2 uv; /* 0..1 over the viewport, origin at the lower left */

void main()
{
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
