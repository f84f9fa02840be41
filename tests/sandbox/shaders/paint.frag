// The mouse paints, keys wipe: conventions of iMouse, the keyboard, the frame before.
// @channel 0 previous
// @channel 1 keyboard
const int KEY_SPACE = 32;
bool isDown(int key) { return texelFetch(iChannel1, ivec2(key, 0), 0).x > .5; }
bool toggled(int key) { return texelFetch(iChannel1, ivec2(key, 2), 0).x > .5; }
float segment(vec2 p, vec2 a, vec2 b) { vec2 h = b - a; return length(p - a - h*clamp(dot(p - a, h)/max(dot(h, h), 1e-6), 0., 1.)); }
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = isDown(KEY_SPACE) ? vec4(0) : texture(iChannel0, fragCoord/iResolution.xy);
    if (iMouse.z > 0. && segment(fragCoord, abs(iMouse.zw), iMouse.xy) < 3.)
        fragColor = toggled(66) ? vec4(0, 0, 1, 1) : vec4(1, .8, .2, 1);
    if (fragCoord.y < 2.)
        fragColor = vec4(iDate.w > 0. ? .5 : .25, iMouse.w > 0., 0, 1);
}
