/* Marches a cone through the pyramid of radiance. Switches: LSF_VOXEL_SIDES as in voxel_mip; LSF_SEALED: cones
 * end where their axis meets a voxel, and look at nothing behind it; of diffuse ones nothing else counts. */
#ifndef LSF_LIB_VOXEL_CONE
#define LSF_LIB_VOXEL_CONE

#include "lib/voxel.glsl"
#include "shared/cone.h"
#if LSF_SEALED
#include "lib/voxel_sight.glsl"
#endif

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

/* step: of its length, in texels; offset: of the start from the surface, in voxels; the farthest it
 * goes [voxels]; opacity: what texels' opacity is multiplied with. */
layout(location = LSF_LOCATION_CONE) uniform vec4 cone_march;
layout(location = LSF_LOCATION_CONE_STEPS) uniform int cone_steps; /* at most */

/* Directions about the normal (z) in the middle of their rings, and the cones' diameter by length. */
layout(location = LSF_LOCATION_CONE_SET) uniform vec4 cone_set[LSF_CONE_MAX];
/* Turn of the whole set; whether points differ (0 or 1); number of cones; their place in their rings, from 0 to 1. */
layout(location = LSF_LOCATION_CONE_TURN) uniform vec4 cone_gather;

/* What is left of a cone's light counts as nothing: half a step of a picture of 8 bits. */
#define CONE_OPAQUE 0.002

/* What a closed texel lets through, so that its logarithm is a number. */
#define CONE_CLEAR_MIN 1e-7

/* The i-th direction about z. `shift`: by how much the point differs from others in turn and place. */
vec3 cone_direction(int i, vec2 shift)
{
    shift = cone_gather.xw + cone_gather.y * shift;
    float radius2 = lsf_cone_radius2(float(i), fract(shift.y), cone_gather.z);
    float angle = 2.0 * LSF_PI * shift.x;
    vec2 circle = sqrt(radius2) * normalize(cone_set[i].xy);
    return vec3(mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * circle, sqrt(1.0 - radius2));
}

struct cone_light {
    vec3 radiance;      /* in the grid's unit */
    float transmittance; /* how much of the environment is seen */
};

#if LSF_VOXEL_SIDES > 1
vec4 cone_slice(vec2 place, float z, float slice, float level)
{
    return textureLod(radiance_texture, vec3(place, (z + slice) * (1.0 / float(LSF_VOXEL_SIDES))), level);
}
#endif

#if LSF_SEALED
/* A sample, half a step on, and interpolation about it reach 1.5 texels beyond where the step begins. */
#define CONE_REACH 1.5
#define VOXEL_NOT_MET 1e9

/* What one sees of a voxel. */
vec3 cone_meet(ivec3 cell, vec3 direction)
{
#if LSF_VOXEL_SIDES == 1
    vec4 seen = texelFetch(radiance_texture, cell, 0);
#else
    vec4 seen = vec4(0.0);
    for (int axis = 0; axis < 3; axis++) {
        int slice = 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
        seen += abs(direction[axis]) *
                texelFetch(radiance_texture, cell + ivec3(0, 0, slice * int(grid.size.z)), 0);
    }
#endif
    return seen.rgb / max(seen.a, 1e-6);
}
#endif

/* From a point of a surface with the unit `normal` [voxels]. `spread`: diameter by length. */
cone_light cone_trace(vec3 point, vec3 normal, vec3 direction, float spread)
{
    float offset = cone_march.y;
    vec3 start = point + offset * normal;
    vec3 size = grid.size.xyz;
    vec3 rate = abs(direction);
    /* Where it leaves the grid. */
    vec3 wall = mix(vec3(0.0), size, greaterThan(direction, vec3(0.0)));
    vec3 leave = (wall - start) / mix(direction, vec3(1e-20), equal(direction, vec3(0.0)));
    float end = min(min(leave.x, min(leave.y, leave.z)), cone_march.z);
    /* A plane's texels reach 1/2 |n|_1 above it, interpolation 1 |n|_1 more. */
    vec3 tilt = abs(normal);
    float flatness = 1.0 / (1.5 * (tilt.x + tilt.y + tilt.z));
    float rise = dot(normal, direction);
#if LSF_VOXEL_SIDES > 1
    vec3 slice = vec3(0.0, 2.0, 4.0) + mix(vec3(0.0), vec3(1.0), lessThan(direction, vec3(0.0)));
#endif
#if LSF_SEALED
    float met = VOXEL_NOT_MET; /* where the axis enters an occupied voxel */
    voxel_ray ray;
    if (voxel_ray_begin(start, direction, ray) && voxel_ray_trace(ray))
        met = ray.distance;
    end = min(end, met - CONE_REACH);
#endif
    cone_light light;
    light.radiance = vec3(0.0);
    light.transmittance = 1.0;
    float t = 0.0;
    for (int i = 0; i < cone_steps; i++) {
        if (t >= end || light.transmittance < CONE_OPAQUE)
            break;
        float width = spread * (offset + t);
        float texel = max(min(width, (offset + rise * t) * flatness), 0.125 * width);
#if LSF_SEALED
        texel = min(texel, max((met - t) / CONE_REACH, 1.0));
#endif
        float level = floor(log2(clamp(texel, 1.0, float(1 << (LSF_VOXEL_LEVELS - 1)))));
        texel = exp2(level);
        float dt = cone_march.x * texel;
        vec3 p = start + (t + 0.5 * dt) * direction;
#if LSF_VOXEL_SIDES == 1
        vec4 seen = textureLod(radiance_texture, p / size, level);
        float clear =
            exp2(cone_march.x * log2(max(1.0 - cone_march.w * seen.a, CONE_CLEAR_MIN)));
        vec3 color = seen.rgb / max(seen.a, 1e-6);
#else
        float z = clamp(p.z, 0.5 * texel, size.z - 0.5 * texel) / size.z;
        vec2 place = p.xy / size.xy;
        vec4 x = cone_slice(place, z, slice.x, level);
        vec4 y = cone_slice(place, z, slice.y, level);
        vec4 w = cone_slice(place, z, slice.z, level);
        vec3 opacity = vec3(x.a, y.a, w.a);
        vec3 clearness = max(1.0 - cone_march.w * opacity, vec3(CONE_CLEAR_MIN));
        float clear = exp2(cone_march.x * dot(rate, log2(clearness)));
        vec3 color = (rate.x * x.rgb + rate.y * y.rgb + rate.z * w.rgb) /
                     max(dot(rate, opacity), 1e-6);
#endif
        light.radiance += light.transmittance * (1.0 - clear) * color;
        light.transmittance *= clear;
        t += dt;
    }
#if LSF_SEALED
    if (met < cone_march.z && light.transmittance >= CONE_OPAQUE) {
        light.radiance += light.transmittance * cone_meet(ray.cell, direction);
        light.transmittance = 0.0;
    }
#endif
    if (light.transmittance < CONE_OPAQUE)
        light.transmittance = 0.0;
    return light;
}

/* What one of a set of cones sees that gather a hemisphere. Sealed, it is its axis: over all turns and elevations
 * axes lie as the cosine has them, so that what they meet is right in the mean. What is beside the axis is
 * met by others, and would be counted twice. */
cone_light cone_diffuse(vec3 point, vec3 normal, vec3 direction, float spread)
{
#if LSF_SEALED
    cone_light light = cone_light(vec3(0.0), 1.0);
    voxel_ray ray;
    ivec3 met;
    if (voxel_ray_begin(point + voxel_lift(normal), direction, ray) && voxel_leave_start(ray) &&
        voxel_ray_meet(ray, cone_march.z, true, met))
        light = cone_light(cone_meet(met, direction), 0.0);
    return light;
#else
    return cone_trace(point, normal, direction, spread);
#endif
}

#endif
