/* The inputs of the network for each pixel, without units; outside the picture those of the nearest pixel. */
#include "lib/luminance.glsl"
#include "lib/view.glsl"
#include "passes/denoise_light.glsl"

layout(local_size_x = LSF_DENOISE_TILE, local_size_y = LSF_DENOISE_TILE) in;

layout(binding = 0) uniform sampler2D mean_texture; /* normal, reverse-Z depth */
#if LSF_LOBE
layout(binding = 6) uniform sampler2D specular_factor_texture; /* A: mean roughness */
#endif
layout(std430, binding = LSF_BINDING_DENOISE_TOTAL) readonly buffer lsf_denoise_total_block
{
    vec4 totals[];
};
layout(std430, binding = LSF_BINDING_DENOISE_TARGET) writeonly buffer lsf_denoise_target_block
{
    uvec4 maps[];
};

layout(location = 0) uniform uvec2 padded_size;

float features[LSF_DENOISE_INPUT_GROUPS * LSF_DENOISE_GROUP];

/* A dimensionless logarithm: doubling the light adds the same amount wherever it is bright. */
vec3 compressed(vec3 light, float scale)
{
    return scale > 0.0 ? log(1.0 + min(LSF_DENOISE_BEND * max(light, 0.0) / scale, 1e30)) : vec3(0.0);
}

void set(int first, vec3 value)
{
    features[first] = value.x;
    features[first + 1] = value.y;
    features[first + 2] = value.z;
}

void set_light(ivec2 pixel, int part, float scale)
{
    vec4 light = texelFetch(light_textures[part], pixel, 0);
    if (light.a < 0.0)
        return;
    float unit = part_unit(part) * scale;
    set(3 * part, compressed(light.rgb, unit));
    set(6 + 3 * part, compressed(texelFetch(filtered_textures[part], pixel, 0).rgb, unit));
    features[18 + part] = compressed(vec3(sqrt(light.a)), unit).x;
}

void set_surface(ivec2 pixel, vec4 mean)
{
    /* One of the two is zero, except for a camera far away, for which both point the same way. */
    vec3 right = normalize(view.start_dx.xyz + view.forward_dx.xyz);
    vec3 up = normalize(view.start_dy.xyz + view.forward_dy.xyz), back = -normalize(view.forward.xyz);
    set(12, vec3(dot(mean.xyz, right), dot(mean.xyz, up), dot(mean.xyz, back)));
    features[15] = 1.0 / (1.0 + max(view_depth(mean.w), 0.0));
#if LSF_LOBE
    vec4 factor = texelFetch(specular_factor_texture, pixel, 0);
    features[16] = factor.a;
    features[17] = luminance(factor.rgb);
#endif
}

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, padded_size)))
        return;
    ivec2 pixel = min(ivec2(at), textureSize(mean_texture, 0) - 1);
    float scale = light_scale(totals[LSF_DENOISE_SUM_SCALE * LSF_DENOISE_SUMS]);
    vec4 mean = texelFetch(mean_texture, pixel, 0);
    for (int i = 0; i < features.length(); i++)
        features[i] = 0.0;
    if (mean.w != 0.0) {
        for (int part = 0; part <= LSF_LOBE; part++)
            set_light(pixel, part, scale);
        set_surface(pixel, mean);
    }
    uint index = at.y * padded_size.x + at.x;
    for (int i = 0; i < LSF_DENOISE_INPUT_GROUPS; i++) {
        int first = i * LSF_DENOISE_GROUP;
        maps[uint(i) * padded_size.x * padded_size.y + index] =
            uvec4(packHalf2x16(vec2(features[first], features[first + 1])),
                  packHalf2x16(vec2(features[first + 2], features[first + 3])),
                  packHalf2x16(vec2(features[first + 4], features[first + 5])),
                  packHalf2x16(vec2(features[first + 6], features[first + 7])));
    }
}
