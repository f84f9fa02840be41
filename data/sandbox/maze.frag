// Rings that grow into a maze: a reaction of two substances, kept in a buffer. The mouse adds some of one.
//
//     lightsheaf sandbox maze.frag --frame 3000 -r 256,160 -o maze.png
//
// P. Gray and S. K. Scott, "Autocatalytic reactions in the isothermal, continuous stirred tank reactor", 1984; as a
// picture J. E. Pearson, "Complex Patterns in a Simple System", 1993.

uniform float feed = 0.037; // @slider 0.01 0.08
uniform float kill = 0.06;  // @slider 0.04 0.07

// @buffer a
// @channel 0 a filter=nearest wrap=repeat

// x and y: the two substances.
vec2 at(ivec2 p)
{
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(iChannel0, (p + size) % size, 0).xy;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    ivec2 p = ivec2(fragCoord);
    vec2 s = at(p);
    vec2 around = 0.2 * (at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1))) +
                  0.05 * (at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) + at(p + ivec2(-1, 1)));
    float reaction = s.x * s.y * s.y;
    s += vec2(1.0, 0.5) * (around - s) + vec2(feed * (1.0 - s.x) - reaction, reaction - (feed + kill) * s.y);
    // Three drops to begin with.
    vec2 uv = fragCoord / iResolution.y, aspect = vec2(iResolution.x / iResolution.y, 1.0);
    if (iFrame == 0) {
        float drop = min(length(uv - aspect * vec2(0.3, 0.4)),
                         min(length(uv - aspect * vec2(0.65, 0.6)), length(uv - aspect * vec2(0.5, 0.25))));
        s = drop < 0.05 ? vec2(0.5, 0.25) : vec2(1.0, 0.0);
    }
    if (iMouse.z > 0.0 && distance(fragCoord, iMouse.xy) < 6.0)
        s = vec2(0.5, 0.25);
    fragColor = vec4(s, 0.0, 1.0);
}

// @image
// @channel 0 a filter=linear

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iResolution.xy, e = vec2(1.5, 0.0) / iResolution.xy;
    float v = texture(iChannel0, uv).y;
    vec2 slope = vec2(texture(iChannel0, uv + e).y - texture(iChannel0, uv - e).y,
                      texture(iChannel0, uv + e.yx).y - texture(iChannel0, uv - e.yx).y);
    float light = 0.7 + 0.3 * dot(normalize(vec3(-6.0 * slope, 1.0)), normalize(vec3(-0.6, 0.7, 0.6)));
    vec3 color = mix(vec3(0.93, 0.89, 0.80), vec3(0.10, 0.22, 0.30), smoothstep(0.05, 0.32, v));
    fragColor = vec4(color * light, 1.0);
}
