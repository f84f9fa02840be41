/* The first vertices of light paths from the current light. One of n paths of a light, drawn with the density p,
 * carries the flux I / (n p). The surface that it hits reflects a part of that, diffusely or in a lobe: the
 * intensity is that part over pi. */
#include "lib/reflectance.glsl" /* its table is included by light_ray.glsl under a condition */
#include "lib/light_ray.glsl"
#include "lib/vpl_cloud.glsl"

layout(location = 2) uniform float share; /* 1 / n */

void main()
{
    if (gl_GlobalInvocationID.x >= cloud_shape.w)
        return;
    uint path = cloud_shape.z + gl_GlobalInvocationID.x;
    vec3 u = cloud_random(gl_GlobalInvocationID.x, 0u);
    light_hit h = light_ray_draw(u.xy);
    if (!h.lit)
        return;
    surface s = h.s;
    float transmission = 0.0;
#if LSF_TRANSMISSION
    transmission = s.transmission;
#endif
    reflector m = reflector(s.base_color, transmission, s.roughness, s.f0, s.metallic);
    vec3 flux = h.intensity * (share / h.pdf);
    lsf_vpl_record v = cloud_reflect(h.position, s.geometric_normal, s.normal, h.direction, m, flux, 1u, u.z);
    v.intensity /= LSF_PI;
    cloud[cloud_slot(path, 0u)] = v;
}
