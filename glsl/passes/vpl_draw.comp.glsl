/* Samples virtual point lights from the reflective shadow map of a light. */
#include "lib/light_ray.glsl"
#include "lib/vpl_write.glsl"

layout(local_size_x = 64) in;

layout(location = 0) uniform uvec2 range; /* the first VPL, and their number */
layout(location = 1) uniform vec2 map_shape; /* as in vpl_map_write */

layout(std430, binding = 3) readonly buffer random_block
{
    vec4 random[]; /* two numbers for the direction, one for the map's rotation; the probability of having chosen
                    * the light */
};

/* Distance of a VPL from its surface beyond the rounding of its position: the error of an octahedral normal (see
 * lib/octahedral.glsl) over the distance from the texel's centre, and four roundings (2^-24) of the distance from
 * the light: of the texel's depth and centre, the ray's direction and its length. */
#define NORMAL_ERROR 1e-4
#define DISTANCE_ERROR 2.4e-7

void main()
{
    if (gl_GlobalInvocationID.x >= range.y)
        return;
    uint index = range.x + gl_GlobalInvocationID.x;
    vec4 drawn = random[index];
    light_hit h = light_ray_draw(drawn.xy);
    surface s = h.s;
    bool directional = !light_projection_perspective();
    float distance2 = directional ? 1.0 : max(h.distance * h.distance, LSF_LIGHT_DISTANCE2_MIN);
    float transmission = 0.0;
#if LSF_TRANSMISSION
    transmission = s.transmission;
#endif
    vpls[index] = lsf_vpl_data(
        vec4(h.position, h.lit ? LSF_VPL_REFLECTS : LSF_VPL_DARK), vec4(s.geometric_normal, h.pdf * drawn.w),
        vec4(s.normal, s.metallic), vec4(s.base_color, directional ? 1.0 : 0.0),
        vec4(s.roughness, s.f0, s.anisotropy, s.anisotropy_angle), vec4(-h.direction, distance2),
        vec4(h.intensity, transmission));
    float error = NORMAL_ERROR * length(h.apart) + DISTANCE_ERROR * h.distance +
                  light_projection_raster_error(h.face, s.geometric_normal, h.distance);
    vpl_map_write(index, h.position, s.geometric_normal, error, drawn.z, map_shape);
}
