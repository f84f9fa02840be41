// All ways to read a channel; their sizes and times.
// @channel 0 noise
// @channel 1 noise filter=nearest wrap=clamp
// @channel 2 noise filter=linear wrap=mirror flip=no
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord/iChannelResolution[0].xy, big = 2.*fragCoord/iResolution.xy - .5;
    ivec2 texels = textureSize(iChannel1, 0);
    vec4 s = uv.x < .1 ? texture(iChannel0, uv) : textureLod(iChannel0, uv, 3.);
    s += textureGrad(iChannel0, uv, vec2(.01, 0), vec2(0, .01));
    s += texelFetch(iChannel1, ivec2(fragCoord) % texels, 0) + texture(iChannel2, big);
    fragColor = vec4(s.rgb/4., 1.)*step(0., iChannelTime[1])*float(texels.x == int(iChannelResolution[1].x));
}
