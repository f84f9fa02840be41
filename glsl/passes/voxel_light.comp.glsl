/* Light that voxels send out. Switches LSF_EMIT: their emission, which replaces the previous value, else the
 * following is added; LSF_REFLECT: the light of the current light that the side facing it reflects, or, with
 * LSF_SHADOW_SKY, that of a batch of directions of the environment; LSF_VOXEL_LAMPS: smooth metals keep a lamp. */
#include "lib/hash.glsl"
#include "lib/luminance.glsl"
#include "lib/voxel_lamp.glsl"
#include "lib/voxel_reflect.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/voxel_sides.glsl"
#include "shared/brdf.h"
#if LSF_REFLECT
#include "lib/shadow.glsl"
#if !LSF_SHADOW_SKY
#include "lib/light.glsl"
#include "shared/light.h"
#endif
#endif

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
/* The shadow map uses the unit of points here. Points use that of specular_params, and these that of radiance, which is an
 * image in this pass. */
layout(binding = LSF_UNIT_VOXEL_SPECULAR_PARAMS) uniform usampler3D point_texture;
#if LSF_VOXEL_SPECULAR_PARAMS && (LSF_REFLECT || LSF_VOXEL_LAMPS)
layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform usampler3D specular_params_texture;
#endif
#if LSF_REFLECT && LSF_TRANSMISSION
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D transmission_texture;
#endif
#if LSF_EMIT && LSF_EMISSION
layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D emission_texture;
#endif

/* Points in voxels are stored to 2^-10 of a voxel, and the receiver is lifted off its surface by as much. */
#define LIFT (1.0 / 1024.0)

#if LSF_SHADOW_SKY
layout(location = 0) uniform int sky_map_count;
/* Number of cosine-distributed rays that find the environment from a voxel. */
layout(location = LSF_LOCATION_SKY_CHANCE) uniform float sky_rays;
#endif

#if LSF_VOXEL_LAMPS
layout(binding = 1, rgba32ui) uniform uimage3D lamp_image; /* voxel_lamp_pack, of each side */
layout(location = 0) uniform uint lamp_seed;               /* another one for each light of each iteration */

/* Adds a lamp to those of a side; of all it keeps one by weighted reservoir sampling (Chao 1982), each with the
 * probability of its luminance. `radiance`: what the side reflects of the lamp as a diffuse surface; `irradiance`: of
 * the side, the cosine included. */
void keep_lamp(ivec3 cell, int side, vec3 to_lamp, float nearness, vec3 irradiance, vec3 radiance)
{
    ivec3 texel = slice_texel(cell, side);
#if LSF_EMIT
    voxel_lamp kept = voxel_lamp_unpack(uvec4(0u));
#else
    voxel_lamp kept = voxel_lamp_unpack(imageLoad(lamp_image, texel));
#endif
    float before = luminance(kept.spread), added = luminance(radiance), all = before + added;
    float number = hash_unit(hash(uvec3(cell) ^ hash(uvec3(lamp_seed, side, 0u)))).x;
    if (number * all < added) {
        kept.to_lamp = to_lamp;
        kept.nearness = nearness;
        kept.irradiance = irradiance * (all / added);
    } else {
        kept.irradiance *= all / max(before, 1e-30);
    }
    kept.spread += radiance;
    imageStore(lamp_image, texel, voxel_lamp_pack(kept));
}
#endif

uint specular_params_at(ivec3 cell)
{
#if LSF_VOXEL_SPECULAR_PARAMS && (LSF_REFLECT || LSF_VOXEL_LAMPS)
    return texelFetch(specular_params_texture, cell, 0).r;
#else
    return 0u;
#endif
}

#if LSF_REFLECT
reflector material_at(ivec3 cell)
{
    float transmission = 0.0;
#if LSF_TRANSMISSION
    transmission = voxel_transmission(texelFetch(transmission_texture, cell, 0).r);
#endif
    return voxel_material_unpack(texelFetch(albedo_texture, cell, 0).r, specular_params_at(cell), transmission);
}

/* Distance from a point of the voxel, at the offset `inside` from its lower corner, to its border [voxels]. */
float way_out(vec3 inside, vec3 direction)
{
    vec3 ways = abs((vec3(greaterThan(direction, vec3(0.0))) - inside) / (abs(direction) + 1e-6));
    return min(ways.x, min(ways.y, ways.z));
}

/* Adds the radiance of the side that faces the light, and returns it. `irradiance`: on a plane that faces the light;
 * becomes that of the side, in the grid's unit. `inside`: the surface's point, as an offset from the voxel's lower
 * corner; `reach`: no more than the distance to the light. */
vec3 reflect_light(reflector material, vec3 inside, vec3 position, vec3 n, vec3 shading, vec3 to_light,
                   float reach, inout vec3 irradiance, inout vec3 front, inout vec3 back)
{
    bool faces = dot(n, to_light) > 0.0;
    vec3 side = faces ? n : -n;
    float cosine = max(dot(faces ? shading : -shading, to_light), 0.0);
#if LSF_SHADOW_SKY
    float density = sky_maps[shadow_sky_map].to_sky.w;
    if (density > 0.0)
        irradiance *= density / (density + sky_rays * cosine / LSF_PI);
#endif
    /* The back of a wall that is thinner than a voxel stands for the wall's other face, which would shadow it: that
     * face has the light that enters the voxel. A lamp may be in the voxel, and must not be passed. */
    float way = faces ? 0.0 : min(way_out(inside, to_light) * grid.origin.w, 0.5 * reach);
    vec3 lifted = position + LIFT * grid.origin.w * side + way * to_light;
    float visibility = shadow_visibility(lifted, side);
#if LSF_SHADOW_TINT
    irradiance *= shadow_tint(lifted, side, vec3(1.0));
#endif
    irradiance *= visibility * cosine * grid.unit.y;
    vec3 radiance = reflectance(material, cosine) * irradiance / LSF_PI;
    front += faces ? radiance : vec3(0.0);
    back += faces ? vec3(0.0) : radiance;
    return radiance;
}

/* Radiance of both sides. */
void reflected(ivec3 cell, vec3 n, vec3 shading, inout vec3 front, inout vec3 back)
{
    uint point = texelFetch(point_texture, cell, 0).r;
    vec3 inside = voxel_point_unpack(point);
    vec3 position = voxel_to_position(vec3(cell) + inside);
#if LSF_EMISSION
    if (voxel_unlit(point))
        return;
#endif
    reflector material = material_at(cell);
#if LSF_SHADOW_SKY
    for (shadow_sky_map = 0; shadow_sky_map < sky_map_count; shadow_sky_map++) {
        vec3 irradiance = sky_maps[shadow_sky_map].irradiance.rgb;
        if (sky_maps[shadow_sky_map].error.y > 0.0)
            reflect_light(material, inside, position, n, shading, sky_maps[shadow_sky_map].to_sky.xyz, 1.0,
                          irradiance, front, back);
    }
#else
    vec3 irradiance;
    float distance2;
    vec3 to_light = light_direction(position, irradiance, distance2);
    vec3 radiance =
        reflect_light(material, inside, position, n, shading, to_light, sqrt(distance2), irradiance, front, back);
#if LSF_VOXEL_LAMPS
    if (radiance != vec3(0.0) && voxel_is_smooth_metal(specular_params_at(cell))) {
        bool far = light.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL;
        float nearness = far ? 0.0 : 1.0 / max(distance2 * grid.size.w * grid.size.w, 1e-20);
        keep_lamp(cell, dot(n, to_light) > 0.0 ? 0 : 1, to_light, nearness, irradiance, radiance);
    }
#endif
#endif
}
#endif

void put(ivec3 cell, int slice, float share, vec3 radiance)
{
    ivec3 texel = slice_texel(cell, slice);
#if LSF_EMIT
    vec4 sum = vec4(share * radiance, share);
#else
    vec4 sum = imageLoad(radiance_image, texel) + vec4(share * radiance, 0.0);
#endif
    imageStore(radiance_image, texel, min(sum, RADIANCE_MAX));
}

/* Stores the radiance of a side; returns the slices written, a bit each. */
uint put_side(ivec3 cell, vec3 n, bool front, vec3 radiance)
{
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_AXES
    uint slices = 0u;
    for (int axis = 0; axis < 3; axis++) {
        int slice = lobe_slice(axis, n[axis], front);
#if !LSF_EMIT
        if (n[axis] == 0.0)
            continue; /* emission has written nothing there */
#endif
        put(cell, slice, n[axis] * n[axis], radiance);
        slices |= n[axis] == 0.0 ? 0u : 1u << slice;
    }
    return slices;
#else
    int slice = front ? 0 : 1;
    if (slice < LSF_VOXEL_SIDES)
        put(cell, slice, 1.0, radiance);
    return slice < LSF_VOXEL_SIDES ? 1u << slice : 0u;
#endif
}

uint light_voxel(ivec3 cell)
{
    uint normal = texelFetch(normal_texture, cell, 0).r;
    vec3 n = voxel_normal_unpack(normal);
    vec3 front = vec3(0.0), back = vec3(0.0);
#if LSF_EMIT && LSF_VOXEL_LAMPS
    for (int side = 0; side < 2 && voxel_is_smooth_metal(specular_params_at(cell)); side++)
        imageStore(lamp_image, slice_texel(cell, side), uvec4(0u));
#endif
#if LSF_EMIT && LSF_EMISSION
    front = voxel_emission_unpack(texelFetch(emission_texture, cell, 0).r);
    if (voxel_emits_both(texelFetch(point_texture, cell, 0).r))
        back = front;
#endif
#if LSF_REFLECT
    vec3 shading = voxel_normal_unpack(voxel_shading_bits(cell, normal));
    reflected(cell, n, shading, front, back);
#endif
#if LSF_EMIT
    return put_side(cell, n, true, front) | put_side(cell, n, false, back);
#else
    if (front != vec3(0.0))
        put_side(cell, n, true, front);
    if (back != vec3(0.0))
        put_side(cell, n, false, back);
    return 0u;
#endif
}

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    uint slices = 0u;
    for (int n = voxel_brick_lane(); n < voxels; n += VOXEL_BRICK_LANES)
        slices |= light_voxel(voxel_brick_cell(brick, n));
#if LSF_EMIT
    atomicOr(bricks[at].sides, slices);
#endif
}
