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

/* Between filtered light and the mean of its neighbours' logarithms: the network chooses how far light is blended, and a
 * dark reflection beside a bright one stays dark. */
vec3 blended(ivec2 pixel, int part, vec3 own, vec3 light, float unit)
{
    ivec2 size = textureSize(filtered_textures[part], 0);
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int j = -LSF_DENOISE_NEAR; j <= LSF_DENOISE_NEAR; j++)
        for (int i = -LSF_DENOISE_NEAR; i <= LSF_DENOISE_NEAR; i++) {
            ivec2 at = pixel + ivec2(i, j), nearest = clamp(at, ivec2(0), size - 1);
            vec4 filtered = texelFetch(filtered_textures[part], nearest, 0);
            if (at == nearest && filtered.a >= 0.0) {
                sum += log(1.0 + min(max(filtered.rgb, 0.0) / unit, 1e30));
                count += 1.0;
            }
        }
    vec3 mean = count > 0.0 ? unit * (exp(sum / count) - 1.0) : own;
    return clamp(light, min(own, mean), max(own, mean));
}

/* `part` is a constant in each call: not every driver finds images by a number that it has to compute. */
void apply(ivec2 pixel, int part, vec3 change)
{
    vec4 before = vec4(0.0), after = vec4(0.0);
    if (all(lessThan(pixel, textureSize(filtered_textures[part], 0)))) {
        float scale = light_scale(totals[LSF_DENOISE_SUM_SCALE * LSF_DENOISE_SUMS]);
        vec4 light = texelFetch(light_textures[part], pixel, 0);
        vec4 filtered = texelFetch(filtered_textures[part], pixel, 0);
        vec3 factor = texelFetch(factor_textures[part], pixel, 0).rgb;
        if (filtered.a >= 0.0 && scale > 0.0) {
            float unit = part_unit(part) * scale / LSF_DENOISE_BEND;
            vec3 after_change = max(changed(filtered.rgb, change, unit), 0.0);
            filtered.rgb = part == 1 ? blended(pixel, part, filtered.rgb, after_change, unit) : after_change;
            before.rgb = factor * light.rgb;
            after.rgb = factor * filtered.rgb;
        }
        imageStore(light_images[part], pixel, filtered);
    }
    sum_add(2u * uint(part), before);
    sum_add(2u * uint(part) + 1u, after);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inside = all(lessThan(pixel, textureSize(filtered_textures[0], 0)));
    uvec4 texel = inside ? changes[uint(pixel.y) * padded_width + uint(pixel.x)] : uvec4(0u);
    vec2 a = unpackHalf2x16(texel.x), b = unpackHalf2x16(texel.y), c = unpackHalf2x16(texel.z);
    apply(pixel, 0, vec3(a, b.x));
#if LSF_LOBE
    apply(pixel, 1, vec3(b.y, c));
#endif
}
