/* Continues light paths through the voxels, from the first vertex that vpl_cloud_light has found or from a point
 * on an emitter. A diffuse virtual point light of intensity I sends out the flux pi I, in directions of density
 * cos / pi, so that a path in such a direction carries pi I whichever it is. One with a lobe g sends it out in
 * directions of another density p: a path carries I g cos / p. Each vertex is a virtual point light
 * with the intensity that it reflects. The path continues from it with the probability that keeps its largest
 * channel as bright as before (Russian roulette), and ends there otherwise. At transmitting surfaces the path
 * passes with a probability of their transmittance. Switches LSF_EMISSION, LSF_SPECULAR, LSF_TRANSMISSION,
 * LSF_VOXEL_PASSAGE and those of the libraries. */
#include "lib/cosine.glsl"
#include "lib/hash.glsl"
#include "lib/voxel_reflect.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/vpl_cloud.glsl"
#include "lib/voxel_passage.glsl"

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D voxel_albedo;
#if LSF_VOXEL_SPECULAR_PARAMS
layout(binding = LSF_UNIT_VOXEL_SPECULAR_PARAMS) uniform usampler3D voxel_specular_params;
#endif
#if LSF_TRANSMISSION
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D voxel_transmission_bits;
#endif

layout(location = 2) uniform uint vertices; /* largest number of vertices of a path */
layout(location = 3) uniform float offset;  /* 0..1, shifts the assignment of paths to points on emitters */

float largest_of(vec3 v)
{
    return max(v.r, max(v.g, v.b));
}

/* The start of the path; paths from emitters follow those from lights. On average the same number of paths leaves
 * each point, and they share its light. */
lsf_vpl_record path_start(uint path, out uint vertex)
{
    bool of_light = path < cloud_shape.z;
    vertex = of_light ? 1u : 0u;
    if (of_light)
        return cloud[cloud_slot(path, 0u)];
    float points = float(cloud_shape.x), paths = float(cloud_shape.w);
    float position = (float(path - cloud_shape.z) + offset) / paths;
    lsf_vpl_record start = cloud[min(uint(position * points), cloud_shape.x - 1u)];
    start.intensity *= points / paths;
    return start;
}

reflector material_of(ivec3 cell)
{
    uint specular_params = 0u;
    float transmission = 0.0;
#if LSF_VOXEL_SPECULAR_PARAMS
    specular_params = texelFetch(voxel_specular_params, cell, 0).r;
#endif
#if LSF_TRANSMISSION
    transmission = voxel_transmission(texelFetch(voxel_transmission_bits, cell, 0).r);
#endif
    return voxel_material_unpack(texelFetch(voxel_albedo, cell, 0).r, specular_params, transmission);
}

/* The VPL of the voxel that the ray has hit, for light of this intensity. */
lsf_vpl_record reflect_from(ivec3 cell, voxel_ray ray, vec3 intensity, uint depth, inout float u)
{
    uint normal = texelFetch(voxel_normal, cell, 0).r, point = texelFetch(voxel_point, cell, 0).r;
    vec3 n = voxel_normal_unpack(normal), shading = voxel_normal_unpack(voxel_shading_bits(cell, normal));
    float meets = dot(n, ray.direction);
    float side = meets <= 0.0 ? 1.0 : -1.0;
    vec3 position = vec3(cell) + voxel_point_unpack(point);
    if (meets != 0.0) {
        vec3 there = ray.origin + ray.direction * (dot(n, position - ray.origin) / meets);
        position = clamp(there, vec3(cell), vec3(cell + 1));
    }
#if LSF_EMISSION
    if (voxel_unlit(point))
        intensity = vec3(0.0);
#endif
    return cloud_reflect(voxel_to_position(position), side * n, side * shading, ray.direction, material_of(cell), intensity,
                         depth, u);
}

/* Advances to the voxel that reflects the light; `left`: transmittance on the way. False: there is none. */
bool meet(inout voxel_ray ray, uint path, uint vertex, out ivec3 cell, out vec3 left)
{
    left = vec3(1.0);
#if LSF_VOXEL_PASSAGE
    voxel_passage passage = voxel_passage_begin();
    float weight = 1.0; /* reciprocal of the probability of passing */
    for (uint i = 0u; i < uint(VOXEL_PASSAGE_MOST); i++) {
        bool sheet;
        if (!voxel_ray_meet(ray, VOXEL_FAR, true, cell))
            return false;
        vec3 before = passage.left;
        left = weight * voxel_passed(passage);
        if (!voxel_pass(passage, ray, cell, sheet))
            return true;
        if (sheet)
            continue;
        float passes = straight_chance(passage.left / max(before, vec3(1e-6)));
        uvec3 key = uvec3(cloud_iteration.x * cloud_shape.y + path, vertex, i) ^ hash(cloud_iteration.yzz);
        if (hash_unit(hash(key)).x >= passes) {
            left /= 1.0 - passes;
            return true;
        }
        weight /= passes;
    }
    return false;
#else
    return voxel_ray_meet(ray, VOXEL_FAR, true, cell);
#endif
}

void main()
{
    uint path = gl_GlobalInvocationID.x, vertex;
    if (path >= cloud_shape.y)
        return;
    lsf_vpl_record v = path_start(path, vertex);
    for (; vertex < vertices && largest_of(v.intensity) > 0.0; vertex++) {
        vec3 u = cloud_random(path, vertex);
        vec3 n = octahedral_decode(v.normal), t, b;
        orthonormal_basis(n, t, b);
        vec3 local = cosine_direction(disc_draw(u.xy));
        vec3 direction = normalize(local.x * t + local.y * b + local.z * n);
#if LSF_SPECULAR
        if (vpl_has_lobe(v)) {
            float weight;
            direction = vpl_lobe_draw(n, vpl_lobe_unpack(v), u.xy, weight);
            if (weight <= 0.0)
                return;
            v.intensity *= weight;
        }
#endif
        voxel_ray ray;
        ivec3 cell;
        vec3 left;
        if (!voxel_ray_begin(voxel_start(voxel_from_position(v.position), n, direction), direction, ray) ||
            !voxel_leave_start(ray) || !meet(ray, path, vertex, cell, left))
            return;
        float carried = largest_of(v.intensity);
        v = reflect_from(cell, ray, v.intensity * left, (v.depth_and_lobe & LSF_VPL_DEPTH_MASK) + 1u, u.z);
        cloud[cloud_slot(path, vertex)] = v;
        float goes_on = min(largest_of(v.intensity) / carried, 1.0);
        if (u.z >= goes_on)
            return;
        v.intensity /= goes_on;
    }
}
