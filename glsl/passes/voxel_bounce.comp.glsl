/* Light from other voxels and from the environment that voxels reflect, on each side of their surface. */
#include "lib/environment.glsl"
#include "lib/hash.glsl"
#include "lib/sky.glsl"
#include "lib/voxel_reflect.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/voxel_cone.glsl"
#include "lib/voxel_sides.glsl"

layout(binding = 1) uniform sampler3D base_texture;
layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D albedo_texture;
layout(binding = LSF_UNIT_VOXEL_NORMAL) uniform usampler3D normal_texture;
layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D point_texture;
#if LSF_VOXEL_SPECULAR_PARAMS
layout(binding = LSF_UNIT_VOXEL_SPECULAR_PARAMS) uniform usampler3D specular_params_texture;
#endif
#if LSF_TRANSMISSION
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D transmission_texture;
#endif
layout(location = 0) uniform bvec3 sum_of; /* terms of the output: its previous value, the base, the reflected
                                            * light */
layout(location = 1) uniform float sky_rays; /* number by which the environment's light is shared with its
                                              * directions, whatever the number of cones here */

/* Rotation of a voxel's cones and their position in the ring: a lattice over the voxels, so that neighbours together
 * find light from all directions. */
vec2 cell_shift(ivec3 cell)
{
    vec3 at = vec3(cell);
    return fract(vec2(dot(at, vec3(0.8191725, 0.6710436, 0.5497005)), dot(at, vec3(0.5698403, 0.7548777, 0.3819660))));
}

/* Mean radiance at a side, weighted by the cosine to its shading normal and by its reflectance. */
vec3 gather(reflector material, ivec3 cell, vec3 position, vec3 n, vec3 shading)
{
    vec3 tangent, bitangent;
    orthonormal_basis(shading, tangent, bitangent);
    vec3 sum = vec3(0.0);
    vec2 shift = cell_shift(cell);
    int count = int(cone_gather.z);
    for (int i = 0; i < count; i++) {
        vec3 local = cone_direction(i, shift);
        vec3 direction = local.x * tangent + local.y * bitangent + local.z * shading;
        if (dot(direction, n) <= 0.0)
            continue;
        float chance = cone_gather.z * local.z / LSF_PI;
        cone_light light = cone_trace(position, n, direction, chance, cone_set[i].w);
        vec3 seen = light.radiance;
#if LSF_ENVIRONMENT
        seen += light.transmittance * grid.unit.y *
                sky_left(environment_radiance(direction), sky_rays * local.z / LSF_PI);
#endif
        sum += reflectance(material, local.z) / cone_gather.z * seen;
    }
#if LSF_VOXEL_DRAW
    for (int i = 0; i < cone_draws; i++) {
        vec2 number = hash_unit(hash(uvec3(cell) ^ hash(uvec3(floatBitsToUint(cone_gather.x), i, 0)))).xy;
        voxel_drawn drawn;
        bool faces = voxel_draw(number, position, drawn);
        float cosine = dot(shading, drawn.direction);
        if (!faces || cosine <= 0.0 || dot(drawn.direction, n) <= 0.0)
            continue;
        sum += reflectance(material, cosine) * cosine / LSF_PI * cone_draw(drawn, position, n, cosine, cone_gather.z);
    }
#endif
#if LSF_EMITTERS
    int points = int(emitters.y);
    for (int i = 0; i < points; i++) {
        vec2 number = hash_unit(hash(uvec3(cell) ^ hash(uvec3(floatBitsToUint(cone_gather.x), i, 1)))).xy;
        emitter_view e;
        if (!cone_emitter(number, position, n, shading, e))
            continue;
        float cosine = dot(shading, e.direction), density = emitters.y * e.density;
        float share = emitter_share(density, e.chance * cosine / LSF_PI);
        sum += reflectance(material, cosine) * (cosine / LSF_PI * share / density) * (grid.unit.y * e.resolved * e.radiance);
    }
#endif
    return sum;
}

void write(ivec3 cell, int slice, float share, vec3 reflected)
{
    ivec3 texel = slice_texel(cell, slice);
    vec3 sum = share * reflected;
    if (sum_of.x)
        sum += imageLoad(radiance_image, texel).rgb;
    if (sum_of.y)
        sum += texelFetch(base_texture, texel, 0).rgb;
    imageStore(radiance_image, texel, vec4(min(sum, RADIANCE_MAX), share));
}

void light_side(ivec3 cell, bool back)
{
    uint normal = texelFetch(normal_texture, cell, 0).r;
    float sign = back ? -1.0 : 1.0;
    vec3 n = sign * voxel_normal_unpack(normal);
    vec3 shading = sign * voxel_normal_unpack(voxel_shading_bits(cell, normal));
    vec3 reflected = vec3(0.0);
    if (sum_of.z) {
        uint point = texelFetch(point_texture, cell, 0).r;
        uint specular_params = 0u;
        float transmission = 0.0;
#if LSF_VOXEL_SPECULAR_PARAMS
        specular_params = texelFetch(specular_params_texture, cell, 0).r;
#endif
#if LSF_TRANSMISSION
        transmission = voxel_transmission(texelFetch(transmission_texture, cell, 0).r);
#endif
        reflector material =
            voxel_material_unpack(texelFetch(albedo_texture, cell, 0).r, specular_params, transmission);
        if (!voxel_unlit(point))
            reflected = gather(material, cell, vec3(cell) + voxel_point_unpack(point), n, shading);
    }
#if LSF_VOXEL_SIDES != LSF_VOXEL_SIDES_AXES
    write(cell, back ? 1 : 0, 1.0, reflected);
#else
    for (int axis = 0; axis < 3; axis++)
        write(cell, lobe_slice(axis, sign * n[axis], !back), n[axis] * n[axis], reflected);
#endif
}

void main()
{
    const int faces = LSF_VOXEL_SIDES == 1 ? 1 : 2;
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    /* Fronts first: the backs of a room's walls, whose rays end soon, are then beside each other. */
    for (int n = voxel_brick_lane(); n < faces * voxels; n += VOXEL_BRICK_LANES)
        light_side(voxel_brick_cell(brick, n < voxels ? n : n - voxels), n >= voxels);
}
