// Conway's game of life, at once in the picture's own past.
// @channel 0 a filter=nearest wrap=repeat
// @buffer a
// @channel 0 a filter=nearest wrap=repeat
#define cell(x,y) int(texelFetch(iChannel0, (I + ivec2(x,y) + S) % S, 0).r)
void mainImage(out vec4 O, in vec2 U)
{
    ivec2 I = ivec2(U), S = ivec2(iResolution.xy);
    if (iFrame == 0) { O = vec4(fract(sin(dot(U, vec2(12.9898, 78.233)))*43758.5453) > .6); return; }
    int k = cell(-1,-1) + cell(-1,0) + cell(-1,1) + cell(0,-1) + cell(0,1) + cell(1,-1) + cell(1,0) + cell(1,1);
    O = vec4(k == 3 || (k == 2 && cell(0,0) == 1));
}
// @image
// @channel 0 a filter=nearest
void mainImage(out vec4 O, in vec2 U) { O = texture(iChannel0, U/iResolution.xy).rrrr; }
