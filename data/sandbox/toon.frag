// A drawing: light in three steps, and lines where depth or normal jump.
//
//     lightsheaf sandbox toon.frag scene.gltf -o toon.png

uniform float line = 1.0;  // @slider 0 3     width of lines in pixels
uniform float steps = 3.0; // @slider 1 8

// How much the pixel's neighbours differ from the plane that it sees.
float edge(vec2 p)
{
    vec3 position = lsf_position(p), n = lsf_normal(p);
    float depth = lsf_depth(p), jump = 0.0;
    for (int i = 0; i < 4; i++) {
        vec2 q = p + line * vec2(ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1))[i]);
        if (!lsf_seen(q))
            return 1.0;
        float off = abs(dot(lsf_position(q) - position, n)) / depth;
        jump = max(jump, max(40.0 * off - 0.3, 1.6 * (1.0 - dot(n, lsf_normal(q))) - 0.1));
    }
    return clamp(jump, 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 paper = vec3(0.96, 0.94, 0.88);
    fragColor = vec4(paper * (0.9 + 0.1 * fragCoord.y / iResolution.y), 1.0);
    if (!lsf_seen(fragCoord))
        return;
    vec3 n = lsf_normal(fragCoord), to_light = normalize(vec3(0.5, 0.9, 0.4));
    float lit = 0.5 + 0.5 * dot(n, to_light);
    lit = (floor(lit * steps) + smoothstep(0.45, 0.55, fract(lit * steps))) / steps;
    vec3 color = sqrt(lsf_albedo(fragCoord)) * mix(vec3(0.45, 0.45, 0.6), vec3(1.05, 1.03, 0.98), lit);
    fragColor.rgb = mix(color, vec3(0.08, 0.07, 0.1), edge(fragCoord));
}
