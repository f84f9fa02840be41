// Four buffers: a velocity, its divergence, a pressure, a dye that is carried, each from the ones before.
vec2 size() { return iResolution.xy; }
vec4 at(sampler2D s, vec2 p) { return texture(s, p/size()); }
// @buffer a
// @channel 0 a wrap=repeat
// @channel 1 c wrap=repeat
void mainImage(out vec4 o, in vec2 p)
{
    vec2 v = at(iChannel0, p - .5*at(iChannel0, p).xy).xy;
    v -= .5*vec2(at(iChannel1, p + vec2(1, 0)).x - at(iChannel1, p - vec2(1, 0)).x,
                 at(iChannel1, p + vec2(0, 1)).x - at(iChannel1, p - vec2(0, 1)).x);
    vec2 q = p - size()*vec2(.3, .5);
    v += .6*vec2(1.2, sin(3.*iTime))*exp(-dot(q, q)/40.);
    o = vec4(.995*v, 0, 1);
}
// @buffer b
// @channel 0 a wrap=repeat
void mainImage(out vec4 o, in vec2 p)
{
    o = vec4(.5*(at(iChannel0, p + vec2(1, 0)).x - at(iChannel0, p - vec2(1, 0)).x +
                 at(iChannel0, p + vec2(0, 1)).y - at(iChannel0, p - vec2(0, 1)).y));
}
// @buffer c
// @channel 0 b wrap=repeat
// @channel 1 c wrap=repeat
void mainImage(out vec4 o, in vec2 p)
{
    o = vec4(.25*(at(iChannel1, p + vec2(1, 0)).x + at(iChannel1, p - vec2(1, 0)).x +
                  at(iChannel1, p + vec2(0, 1)).x + at(iChannel1, p - vec2(0, 1)).x - at(iChannel0, p).x));
}
// @buffer d
// @channel 0 a wrap=repeat
// @channel 1 d wrap=repeat
void mainImage(out vec4 o, in vec2 p)
{
    vec2 q = p - size()*vec2(.3, .5);
    o = max(at(iChannel1, p - .5*at(iChannel0, p).xy)*.998, vec4(1, .4, .1, 1)*exp(-dot(q, q)/30.));
}
// @image
// @channel 0 d
// @channel 1 a
void mainImage(out vec4 o, in vec2 p) { o = at(iChannel0, p) + .1*abs(at(iChannel1, p)).yzxw; }
