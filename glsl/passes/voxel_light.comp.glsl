/* Light that voxels send out. Switches LSF_EMIT: their emission, which replaces the previous value, else the
 * following is added; LSF_REFLECT: the light of the current light that the side facing it reflects, or, with
 * LSF_SHADOW_SKY, that of a batch of directions of the environment; LSF_VOXEL_LAMPS: smooth metals keep a lamp. */
#define VOXEL_BRICK_ACCESS restrict
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
layout(binding = 1, rgba32ui) uniform uimage3D lamp_image;        /* voxel_lamp_pack, of each side */
layout(location = LSF_LOCATION_LAMP_SEED) uniform uint lamp_seed; /* another one for each run */

voxel_lamp kept_front, kept_back; /* of the current voxel, if that is of smooth metal */

/* Adds a light to those of a side; of all it keeps one by weighted reservoir sampling (Chao 1982), each with the
 * probability of its luminance. `radiance`: what the side reflects of it as a diffuse surface; the others as in
 * voxel_lamp. `number` in [0, 1). */
void keep_lamp(inout voxel_lamp kept, vec3 to_lamp, float nearness, vec3 irradiance, vec3 radiance, float number)
{
    float before = luminance(kept.spread), added = luminance(radiance), sum = before + added;
    if (number * sum < added)
        kept = voxel_lamp(to_lamp, nearness, irradiance * (sum / added), kept.spread);
    else
        kept.irradiance *= sum / max(before, 1e-30);
    kept.spread += radiance;
}

voxel_lamp lamp_kept(ivec3 cell, int side)
{
#if LSF_EMIT
    return voxel_lamp_unpack(uvec4(0u));
#else
    return voxel_lamp_unpack(imageLoad(lamp_image, slice_texel(cell, side)));
#endif
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

/* The surface in a voxel; `inside`: its point, as an offset from the voxel's lower corner; `mirrors`: it is of smooth
 * metal, and keeps a lamp. */
struct voxel_target {
    ivec3 cell;
    vec3 inside, n, shading;
    reflector material;
    bool mirrors;
};

/* Adds the radiance of the side that faces the light, with `irradiance` on a plane that faces it; `reach`: no more
 * than the distance to the light; `nearness`: as in voxel_lamp; `number`: of the light in this run. */
void reflect_light(voxel_target t, vec3 to_light, float reach, float nearness, vec3 irradiance, int number,
                   inout vec3 front, inout vec3 back)
{
    bool faces = dot(t.n, to_light) > 0.0;
    vec3 side = faces ? t.n : -t.n;
    float cosine = max(dot(faces ? t.shading : -t.shading, to_light), 0.0);
#if LSF_SHADOW_SKY
    float density = sky_maps[shadow_sky_map].to_sky.w;
    if (density > 0.0)
        irradiance *= density / (density + sky_rays * cosine / LSF_PI);
#endif
    /* The back of a wall that is thinner than a voxel stands for the wall's other face, which would shadow it: that
     * face has the light that enters the voxel. A lamp may be in the voxel, and must not be passed. */
    float way = faces ? 0.0 : min(way_out(t.inside, to_light) * grid.origin.w, 0.5 * reach);
    vec3 lifted = voxel_to_position(vec3(t.cell) + t.inside) + LIFT * grid.origin.w * side + way * to_light;
    float visibility = shadow_visibility(lifted, side);
#if LSF_SHADOW_TINT
    irradiance *= shadow_tint(lifted, side, vec3(1.0));
#endif
    irradiance *= visibility * cosine * grid.unit.y;
    vec3 radiance = reflectance(t.material, cosine) * irradiance / LSF_PI;
    front += faces ? radiance : vec3(0.0);
    back += faces ? vec3(0.0) : radiance;
#if LSF_VOXEL_LAMPS
    float random = hash_unit(hash(uvec3(t.cell) ^ hash(uvec3(lamp_seed, number, 0u)))).x;
    if (t.mirrors && faces)
        keep_lamp(kept_front, to_light, nearness, irradiance, radiance, random);
    if (t.mirrors && !faces)
        keep_lamp(kept_back, to_light, nearness, irradiance, radiance, random);
#endif
}

/* Radiance of both sides. */
void reflected(voxel_target t, inout vec3 front, inout vec3 back)
{
#if LSF_SHADOW_SKY
    for (shadow_sky_map = 0; shadow_sky_map < sky_map_count; shadow_sky_map++)
        if (sky_maps[shadow_sky_map].error.y > 0.0)
            reflect_light(t, sky_maps[shadow_sky_map].to_sky.xyz, 1.0, VOXEL_LAMP_SKY,
                          sky_maps[shadow_sky_map].irradiance.rgb, shadow_sky_map, front, back);
#else
    vec3 irradiance;
    float distance2;
    vec3 to_light = light_direction(voxel_to_position(vec3(t.cell) + t.inside), irradiance, distance2);
    bool far = light.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL;
    float nearness = far ? 0.0 : 1.0 / max(distance2 * grid.size.w * grid.size.w, 1e-20);
    reflect_light(t, to_light, sqrt(distance2), nearness, irradiance, 0, front, back);
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
#if LSF_EMIT && LSF_EMISSION
    front = voxel_emission_unpack(texelFetch(emission_texture, cell, 0).r);
    if (voxel_emits_both(texelFetch(point_texture, cell, 0).r))
        back = front;
#endif
#if LSF_VOXEL_LAMPS
    bool mirrors = voxel_is_smooth_metal(specular_params_at(cell));
    kept_front = lamp_kept(cell, 0);
    kept_back = lamp_kept(cell, 1);
#else
    const bool mirrors = false;
#endif
#if LSF_REFLECT
    uint point = texelFetch(point_texture, cell, 0).r;
    voxel_target t = voxel_target(cell, voxel_point_unpack(point), n,
                                  voxel_normal_unpack(voxel_shading_bits(cell, normal)), material_at(cell), mirrors);
#if LSF_EMISSION
    if (!voxel_unlit(point))
#endif
        reflected(t, front, back);
#endif
#if LSF_VOXEL_LAMPS
    if (mirrors) {
        imageStore(lamp_image, slice_texel(cell, 0), voxel_lamp_pack(kept_front));
        imageStore(lamp_image, slice_texel(cell, 1), voxel_lamp_pack(kept_back));
    }
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
