// Islands in a sea, without any scene: a height field of noise, marched by rays, in one pass.
//
//     lightsheaf sandbox islands.frag --frame 60 -o islands.png

uniform float sea = 0.5;    // @slider 0 1
uniform float height = 2.4; // @slider 0.2 3

#include <lightsheaf/hash.glsl>

float value_noise(vec2 p)
{
    uvec2 i = uvec2(ivec2(floor(p)) + 4096);
    vec2 f = fract(p), w = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
    float a = hash_unit(hash(uvec3(i, 7u))).x, b = hash_unit(hash(uvec3(i + uvec2(1u, 0u), 7u))).x;
    float c = hash_unit(hash(uvec3(i + uvec2(0u, 1u), 7u))).x, d = hash_unit(hash(uvec3(i + 1u, 7u))).x;
    return mix(mix(a, b, w.x), mix(c, d, w.x), w.y);
}

// 0 to 1, and mostly about 0.5; each octave is turned, so that no lattice shows.
float relief(vec2 p, int octaves)
{
    float sum = 0.0, weight = 0.5;
    for (int i = 0; i < octaves; i++) {
        sum += weight * value_noise(p);
        p = mat2(1.6, 1.2, -1.2, 1.6) * p + 3.1;
        weight *= 0.5;
    }
    return sum;
}

float ground(vec2 p, int octaves)
{
    return height * (relief(0.35 * p, octaves) - sea);
}

vec3 sky(vec3 d, vec3 sun)
{
    vec3 color = mix(vec3(0.75, 0.82, 0.88), vec3(0.25, 0.45, 0.75), sqrt(max(d.y, 0.0)));
    return color + vec3(1.0, 0.7, 0.4) * (0.25 * pow(max(dot(d, sun), 0.0), 16.0) + 3.0 * pow(max(dot(d, sun), 0.0), 900.0));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 eye = vec3(0.4 * iTime, 1.3, 0.6 * iTime), sun = normalize(vec3(0.5, 0.28, 0.8));
    vec3 d = normalize(vec3(uv.x, uv.y - 0.25, 1.8));
    vec3 color = sky(d, sun);
    float t = 0.02, before = 0.0;
    bool met = false;
    for (int i = 0; i < 220 && t < 30.0 && !met; i++) {
        vec3 q = eye + t * d;
        float above = q.y - max(ground(q.xz, 7), 0.0);
        met = above < 0.001 * t;
        before = t;
        t += met ? 0.0 : max(0.35 * above, 0.002 * t);
    }
    if (met) {
        vec3 q = eye + t * d;
        vec2 e = vec2(0.002 * t, 0.0);
        float h = ground(q.xz, 7);
        vec3 n = normalize(vec3(ground(q.xz - e, 9) - ground(q.xz + e, 9), 2.0 * e.x,
                                ground(q.xz - e.yx, 9) - ground(q.xz + e.yx, 9)));
        if (h <= 0.0) {
            // Waves are two moving noises; below them the ground shows as far as light gets.
            vec2 ripple = vec2(value_noise(14.0 * q.xz + iTime), value_noise(13.0 * q.zx - 1.3 * iTime)) - 0.5;
            n = normalize(vec3(0.12 * ripple.x, 1.0, 0.12 * ripple.y));
            float mirror = 0.02 + 0.98 * pow(1.0 - max(dot(-d, n), 0.0), 5.0);
            vec3 water = mix(vec3(0.35, 0.55, 0.45), vec3(0.02, 0.12, 0.2), 1.0 - exp(9.0 * h));
            vec3 r = reflect(d, n);
            color = mix(water, sky(vec3(r.x, abs(r.y), r.z), sun), mirror);
        } else {
            float shade = 1.0;
            for (float s = 0.05; s < 2.5 && shade > 0.0; s *= 1.35)
                shade = min(shade, 0.5 + 12.0 * ((q + s * sun).y - ground((q + s * sun).xz, 5)) / s);
            vec3 sand = vec3(0.76, 0.68, 0.48), grass = vec3(0.22, 0.33, 0.12), rock = vec3(0.36, 0.33, 0.3);
            vec3 albedo = mix(sand, grass, smoothstep(0.02, 0.07, h));
            albedo = mix(albedo, rock, smoothstep(0.85, 0.7, n.y));
            color = albedo * (vec3(2.2, 1.9, 1.5) * max(dot(n, sun), 0.0) * clamp(shade, 0.0, 1.0) +
                              vec3(0.22, 0.3, 0.42) * (0.6 + 0.4 * n.y));
        }
        color = mix(sky(normalize(vec3(d.x, 0.02, d.z)), sun), color, exp(-0.0018 * t * t));
    }
    color = 1.0 - exp(-1.4 * color);
    fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
