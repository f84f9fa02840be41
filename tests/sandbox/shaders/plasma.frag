// Sines of sines, by the pixel's place alone.
#define TAU 6.2831853
#define ring(d, w) smoothstep(w, 0.0, abs(d))

void mainImage( out vec4 O, vec2 U )
{
    vec2 R = iResolution.xy, p = (U + U - R) / R.y;
    float v = sin(3.*p.x + iTime) + sin(4.*p.y - 1.3*iTime) + sin(5.*length(p) - 2.*iTime);
    O = .5 + .5*cos(TAU*(v*.2 + vec4(0, .33, .67, 0)));
    O += ring(length(p) - .7, .02);
}
