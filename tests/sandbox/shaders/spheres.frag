// Distance fields with shadows: structs, globals that are no constants, functions with inout.
#define MAX_STEPS 80
const float FAR = 20.0;
struct Hit { float d; int id; };
vec3 sunDirection = normalize(vec3(.6, .7, -.4));

mat2 rot(float a) { float s = sin(a), c = cos(a); return mat2(c, -s, s, c); }
float sphere(vec3 p, float r) { return length(p) - r; }
float box(vec3 p, vec3 b) { vec3 q = abs(p) - b; return length(max(q, 0.)) + min(max(q.x, max(q.y, q.z)), 0.); }

void join(inout Hit h, float d, int id) { if (d < h.d) h = Hit(d, id); }

Hit map(vec3 p)
{
    Hit h = Hit(p.y + 1., 0);
    join(h, sphere(p - vec3(-.8, -.2, 0), .8), 1);
    p.xz *= rot(iTime);
    join(h, box(p - vec3(.9, -.4, 0), vec3(.5)) - .1, 2);
    return h;
}

vec3 normalAt(vec3 p)
{
    const vec2 e = vec2(.001, 0);
    return normalize(map(p).d - vec3(map(p - e.xyy).d, map(p - e.yxy).d, map(p - e.yyx).d));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = (fragCoord - .5*iResolution.xy)/iResolution.y;
    vec3 ro = vec3(0, .5, -4), rd = normalize(vec3(uv, 1.2)), col = vec3(.6, .75, .9) - .4*uv.y;
    float t = 0.; Hit h;
    for (int i = 0; i < MAX_STEPS; i++) { h = map(ro + rd*t); if (h.d < .001 || t > FAR) break; t += h.d; }
    if (t < FAR) {
        vec3 p = ro + rd*t, n = normalAt(p);
        float shade = 1.;
        for (float s = .05; s < 4.; s += .12) shade = min(shade, 8.*map(p + sunDirection*s).d/s);
        vec3 albedo = h.id == 0 ? vec3(mod(floor(p.x) + floor(p.z), 2.)*.3 + .3) : h.id == 1 ? vec3(.8, .2, .1) : vec3(.1, .4, .8);
        col = albedo*(max(dot(n, sunDirection), 0.)*clamp(shade, 0., 1.) + .25 + .15*n.y);
    }
    fragColor = vec4(sqrt(col), 1.);
}
