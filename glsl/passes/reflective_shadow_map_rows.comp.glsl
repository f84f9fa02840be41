/* Importance of a map's texels, from the flux that each reflects and the share of it that would reach visible
 * points without occlusion, and its prefix sums along a row. One row per invocation. */
#include "lib/emission_pdf.glsl"
#include "lib/gbuffer.glsl"
#include "lib/hash.glsl"
#include "lib/luminance.glsl"
#include "lib/view.glsl"

/* Visible points on a square grid, one in each cell of the picture. */
#define POINTS_SIDE 4
#define POINTS (POINTS_SIDE * POINTS_SIDE)

layout(local_size_x = 64) in;

layout(location = 0) uniform uvec2 viewed; /* whether there are visible points; their random seed */

layout(binding = 0) uniform sampler2DArray depth_texture;
layout(binding = 1) uniform usampler2DArray surface_texture;
layout(binding = 2) uniform sampler2D seen_depth;
layout(binding = 3) uniform usampler2D seen_surface;
layout(binding = 0, r32f) writeonly uniform image2DArray importance_image;
layout(std430, binding = 1) writeonly buffer sum_block
{
    float sums[]; /* prefix sums of the rows; then each row's total */
};

shared vec4 points[POINTS]; /* position; smallest squared distance that counts */
shared vec3 normals[POINTS]; /* 0: the cell is empty */
shared uint point_count;

/* Loads the visible point of a cell, where there is one. A point stands for the area that its cell shows, and no
 * disc of that area receives more than pi times the light that arrives at its centre from straight above: the
 * squared distance is clamped to the disc's squared radius. */
void find_point(uint cell)
{
    vec3 random = hash_unit(hash(uvec3(cell, viewed.y, 0u)));
    vec2 face_position = (vec2(cell % POINTS_SIDE, cell / POINTS_SIDE) + random.xy) / float(POINTS_SIDE);
    ivec2 pixel = min(ivec2(face_position * view.size.xy), ivec2(view.size.xy) - 1);
    float depth = texelFetch(seen_depth, pixel, 0).r;
    normals[cell] = vec3(0.0);
    if (depth == 0.0)
        return;
    vec2 ndc = sample_ndc(vec2(pixel) + 0.5);
    float along = view_depth_from_start(depth);
    vec3 ray = view_ray_direction(ndc);
    vec3 normal = surface_unpack(texelFetch(seen_surface, pixel, 0)).geometric_normal;
    vec3 across = cross(view.start_dx.xyz + along * view.forward_dx.xyz,
                        view.start_dy.xyz + along * view.forward_dy.xyz);
    float area = 4.0 / float(POINTS) * abs(dot(across, ray) / min(dot(normal, ray), -1e-6));
    points[cell] = vec4(view_ray_start(ndc) + along * ray, area / LSF_PI);
    normals[cell] = normal;
    atomicAdd(point_count, 1u);
}

/* Average light at the visible points from a Lambertian element at that position. */
float share_of_view(vec3 position, vec3 normal)
{
    if (point_count == 0u)
        return 1.0;
    float sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        vec3 to_point = points[i].xyz - position;
        float distance2 = dot(to_point, to_point);
        float cosines = max(dot(normal, to_point), 0.0) * max(-dot(normals[i], to_point), 0.0);
        if (cosines > 0.0)
            sum += cosines / (distance2 * max(distance2, points[i].w));
    }
    return sum / float(POINTS);
}

float importance(int face, ivec2 at)
{
    float depth = texelFetch(depth_texture, ivec3(at, face), 0).r;
    vec2 face_position = (vec2(at) + 0.5) * (2.0 * light.map_shape.w) - 1.0;
    surface s = surface_unpack(texelFetch(surface_texture, ivec3(at, face), 0));
    if (depth == 0.0 || s.unlit)
        return 0.0;
    vec3 position = light_projection_position(face, face_position, depth);
    vec3 reflectance = s.base_color;
#if LSF_SPECULAR
    reflectance = max(reflectance, vec3(s.f0));
#endif
    vec3 flux = light.intensity.rgb * reflectance;
    if (light_projection_perspective()) {
        /* Texels differ by the solid angle of their position alone. */
        vec3 to_point = position - light.position.xyz;
        float distance2 = max(dot(to_point, to_point), LSF_LIGHT_DISTANCE2_MIN);
        flux *= lsf_distance_attenuation(distance2, light.attenuation.x) * distance2 /
                emission_face_density(face, position);
#if LSF_SPOT_LIGHT
        if (light.attenuation.w == LSF_LIGHT_TYPE_SPOT)
            flux *= lsf_spot_attenuation(dot(to_point, light.direction.xyz) *
                                             inversesqrt(distance2),
                                         light.attenuation.y, light.attenuation.z);
#endif
    }
    float power = max(luminance(flux), 0.0);
    return power > 0.0 ? power * share_of_view(position, s.geometric_normal) : 0.0;
}

void main()
{
    if (gl_LocalInvocationIndex == 0u)
        point_count = 0u;
    barrier();
    if (viewed.x != 0u && gl_LocalInvocationIndex < POINTS)
        find_point(gl_LocalInvocationIndex);
    barrier();
    int texels = int(light.map_shape.z);
    int rows = texels * int(light.map_origin.w);
    int row = int(gl_GlobalInvocationID.x);
    if (row >= rows)
        return;
    int face = row / texels;
    float sum = 0.0;
    for (int x = 0; x < texels; x++) {
        ivec2 at = ivec2(x, row - face * texels);
        float value = importance(face, at);
        sum += value;
        imageStore(importance_image, ivec3(at, face), vec4(value, 0.0, 0.0, 0.0));
        sums[row * texels + x] = sum;
    }
    sums[rows * texels + row] = sum;
}
