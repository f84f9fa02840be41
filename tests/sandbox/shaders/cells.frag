// Cells of a hash, with the unsigned arithmetic of GLSL ES 3.00 and derivatives.
precision highp float;
precision highp int;

uvec2 pcg2d(uvec2 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * 1664525u; v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u; v.y += v.x * 1664525u;
    return v ^ (v >> 16u);
}

vec2 rnd(ivec2 c) { return vec2(pcg2d(uvec2(c + 32768))) / float(0xffffffffu); }

void mainImage( out vec4 fragColor, in vec2 fragCoord )
{
    vec2 p = 8.*fragCoord/iResolution.y, f = fract(p); ivec2 i = ivec2(floor(p));
    float best = 9., second = 9.; ivec2 owner;
    for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
        ivec2 o = ivec2(x, y); vec2 q = vec2(o) + .5 + .45*sin(iTime + 6.28*rnd(i + o)) - f;
        float d = dot(q, q);
        if (d < best) { second = best; best = d; owner = i + o; } else if (d < second) second = d;
    }
    float edge = sqrt(second) - sqrt(best), w = fwidth(p.x) * 2.;
    fragColor = vec4(vec3(rnd(owner), .6) * smoothstep(0., w + .04, edge), 1);
    switch (owner.x & 3) { case 0: fragColor.r *= .5; break; case 1: fragColor.g *= .5; default: break; }
}
