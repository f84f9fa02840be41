// A set of Julia about the mouse; a loop whose end no constant says.
vec3 palette(in float t) { const vec3 a = vec3(.5), d = vec3(.0, .1, .2); return a + a*cos(6.28318*(t + d)); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 z = 1.5*(2.*fragCoord - iResolution.xy)/iResolution.y;
    vec2 c = iMouse.z > 0. ? 2.*iMouse.xy/iResolution.xy - 1. : vec2(-.76, .15 + .02*sin(iTime));
    float n = 0., m = dot(z, z);
    while (n < 96. && m < 64.) { z = vec2(z.x*z.x - z.y*z.y, 2.*z.x*z.y) + c; m = dot(z, z); n++; }
    fragColor.rgb = n < 96. ? palette((n - log2(.5*log2(m)))/48.) : vec3(0);
    fragColor.a = 1.;
}
