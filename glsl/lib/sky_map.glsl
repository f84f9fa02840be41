/* Maps of directions of the environment; see shared/sky_map_data.h. A texel holds the greatest key, that of the
 * plane nearest to the sky, and 0 where there is none. */
#ifndef LSF_LIB_SKY_MAP
#define LSF_LIB_SKY_MAP

#include "lib/plane_key.glsl"
#include "shared/scene_data.h"
#include "shared/sky_map_data.h"

layout(std140, binding = LSF_BINDING_LIGHT) uniform lsf_sky_map_block
{
    lsf_sky_map_data sky_maps[LSF_SKY_MAPS_MAX];
};

/* Steps of depths from 0 to 1. One more step stands for all surfaces that are nearer to the sky than anything that
 * can be lit. */
#define SKY_MAP_STEPS 65533.0
/* Rounding error of a depth. */
#define SKY_MAP_DEPTH_ERROR (0.5 / SKY_MAP_STEPS)
/* The rounding error of a slope s is this times (1 + |s|)^2. */
#define SKY_MAP_SLOPE_ERROR (0.5 / PLANE_KEY_SLOPE_STEPS)

/* Position in texels, and depth. */
vec3 sky_map_project(int map, vec3 p)
{
    return vec3(dot(sky_maps[map].right.xyz, p) + sky_maps[map].right.w,
                dot(sky_maps[map].up.xyz, p) + sky_maps[map].up.w,
                dot(sky_maps[map].towards.xyz, p) + sky_maps[map].towards.w);
}

/* Clip-space position for the pipeline, which clamps depths outside 0 to 1. */
vec4 sky_map_clip(int map, vec3 projected)
{
    return vec4(projected.xy * (2.0 / sky_maps[map].texel.w) - 1.0, projected.z, 1.0);
}

/* `gradient`: change of depth per texel. */
uint sky_map_slopes(int map, vec2 gradient)
{
    return plane_key_slopes(gradient * (sky_maps[map].texel.z / sky_maps[map].texel.xy));
}

uint sky_map_key(float depth, uint slopes)
{
    if (depth > 1.0)
        return 0xffff0000u;
    int steps = 1 + int(max(depth, 0.0) * SKY_MAP_STEPS + 0.5);
    return uint(steps) << 16 | (depth < 0.0 ? 0u : slopes);
}

float sky_map_depth(uint key)
{
    return (float(int(plane_key_steps(key))) - 1.0) / SKY_MAP_STEPS;
}

#endif
