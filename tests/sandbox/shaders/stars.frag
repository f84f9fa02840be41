#version 300 es
// As a page of one's own would have it: a version, a main, its own uniforms and output.
precision mediump float;
uniform vec3 iResolution;
uniform float iTime;
uniform float density; // @slider 1 20
uniform ivec2 twinkle;
out vec4 color;
float h(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7)))*43758.5453123); }
void main()
{
    vec2 p = gl_FragCoord.xy/iResolution.y*(density + 6.), i = floor(p), f = fract(p) - .5;
    float size = h(i), star = smoothstep(.12*size, 0., length(f)) * (size > .5 ? 1. : 0.);
    color = vec4(vec3(star*(.7 + .3*sin(3.*iTime + 9.*size))) + vec3(0, 0, .1) + vec3(twinkle, 0), 1.);
}
