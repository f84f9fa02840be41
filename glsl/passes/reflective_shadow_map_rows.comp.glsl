/* Importance of a map's texels, by the flux that each reflects, and its running sums along a row. A
 * row an invocation. */
#include "lib/emission_pdf.glsl"
#include "lib/gbuffer.glsl"

layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler2DArray depth_texture;
layout(binding = 1) uniform usampler2DArray surface_texture;
layout(binding = 0, r32f) writeonly uniform image2DArray importance_image;
layout(std430, binding = 1) writeonly buffer sum_block
{
    float sums[]; /* rows of running sums; then each row's total */
};

float importance(int face, ivec2 at)
{
    float depth = texelFetch(depth_texture, ivec3(at, face), 0).r;
    vec2 place = (vec2(at) + 0.5) * (2.0 * light.map_shape.w) - 1.0;
    surface s = surface_unpack(texelFetch(surface_texture, ivec3(at, face), 0));
    if (depth == 0.0 || s.unlit)
        return 0.0;
    vec3 position = light_map_position(face, place, depth);
    vec3 reflectance = s.base_color;
#if LSF_SPECULAR
    reflectance = max(reflectance, vec3(s.f0));
#endif
    vec3 flux = light.intensity.rgb * reflectance;
    if (light_map_perspective()) {
        /* Texels are alike but for the place's solid angle. */
        vec3 to_point = position - light.position.xyz;
        float distance2 = max(dot(to_point, to_point), LSF_LIGHT_DISTANCE2_MIN);
        flux *= lsf_distance_attenuation(distance2, light.attenuation.x) * distance2 /
                emission_place_density(face, position);
#if LSF_SPOT_LIGHT
        if (light.attenuation.w == LSF_LIGHT_TYPE_SPOT)
            flux *= lsf_spot_attenuation(dot(to_point, light.direction.xyz) *
                                             inversesqrt(distance2),
                                         light.attenuation.y, light.attenuation.z);
#endif
    }
    return max(dot(flux, vec3(0.2126, 0.7152, 0.0722)), 0.0);
}

void main()
{
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
