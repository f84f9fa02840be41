/* The filtered light with the network's change of its logarithm applied, and the sums of light in the picture
 * before and after. */
#include "passes/denoise_light.glsl"
#include "passes/denoise_sums.glsl"

layout(binding = 7) uniform sampler2D factor_textures[1 + LSF_LOBE];
layout(binding = 0, rgba32f) writeonly uniform image2D light_images[1 + LSF_LOBE];
layout(std430, binding = LSF_BINDING_DENOISE_SOURCE) readonly buffer lsf_denoise_source_block
{
    uvec4 changes[]; /* changes of the logarithms of both parts */
};

layout(location = 0) uniform uint padded_width;

/* light + unit (e^x - 1), where `unit` is the scale of the logarithm: a change of 0 keeps all bits. */
vec3 changed(vec3 light, vec3 change, float unit)
{
    return light + (max(light, 0.0) + unit) * (exp(clamp(change, -LSF_DENOISE_MOST, LSF_DENOISE_MOST)) - 1.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = all(lessThan(pixel, textureSize(filtered_textures[0], 0)));
    float scale = light_scale(totals[LSF_DENOISE_SUM_SCALE * LSF_DENOISE_SUMS]);
    uvec4 texel = inside ? changes[uint(pixel.y) * padded_width + uint(pixel.x)] : uvec4(0u);
    vec2 a = unpackHalf2x16(texel.x), b = unpackHalf2x16(texel.y), c = unpackHalf2x16(texel.z);
    vec3 change[2] = vec3[](vec3(a, b.x), vec3(b.y, c));
    for (int part = 0; part <= LSF_LOBE; part++) {
        vec4 before = vec4(0.0), after = vec4(0.0);
        if (inside) {
            vec4 light = texelFetch(light_textures[part], pixel, 0);
            vec4 filtered = texelFetch(filtered_textures[part], pixel, 0);
            vec3 factor = texelFetch(factor_textures[part], pixel, 0).rgb;
            if (filtered.a >= 0.0 && scale > 0.0) {
                filtered.rgb = max(changed(filtered.rgb, change[part], part_unit(part) * scale / LSF_DENOISE_BEND), 0.0);
                before.rgb = factor * light.rgb;
                after.rgb = factor * filtered.rgb;
            }
            imageStore(light_images[part], pixel, filtered);
        }
        sum_add(2u * uint(part), before);
        sum_add(2u * uint(part) + 1u, after);
    }
}
