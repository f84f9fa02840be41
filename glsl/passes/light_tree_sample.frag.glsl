/* Light of a cloud of VPLs at visible points, sampled through the tree over it; see
 * src/passes/light_tree_sample.md. Switches LSF_LIGHT_TREE_SIGHT (visibility is tested: 1 in voxels, 2 against
 * triangles), LSF_VOXEL_PASSAGE (light continues through transmitting surfaces), LSF_SPECULAR_PARAMS and those of the
 * libraries. */
#include "lib/brdf_sample.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/specular_share.glsl"
#include "lib/sparse.glsl"
#include "passes/light_tree_sample_cut.glsl"
#include "passes/light_tree_sample_walk.glsl"
#if LSF_LIGHT_TREE_SIGHT
#include "lib/voxel.glsl"
#endif
#if LSF_LIGHT_TREE_SIGHT == 1
#include "lib/voxel_passage.glsl"
#elif LSF_LIGHT_TREE_SIGHT == 2
#define LSF_BINDING_TRIANGLES LSF_BINDING_LIGHT_TREE_TRIANGLES
#include "lib/triangle_sight.glsl"

layout(location = 5) uniform uint triangle_count;

/* Height of segments above both surfaces, so that neither occludes them: further vertices of paths lie on the
 * planes of voxels. */
#define SIGHT_LIFT (4.0 * VOXEL_PLANE)
#endif

layout(std430, binding = LSF_BINDING_LIGHT_TREE_COUNTS) buffer lsf_light_tree_count_block
{
    uint counts[]; /* low and high words of the counts LSF_LIGHT_TREE_SAMPLE_ */
};

layout(location = 1) uniform uvec2 iteration; /* iteration, seed */

layout(location = 0) out vec4 irradiance_out; /* alpha: luminance that a bound removed */
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out; /* the same */
#endif

void count(uint what, uint number)
{
    uint before = atomicAdd(counts[2u * what], number);
    if (before + number < before)
        atomicAdd(counts[2u * what + 1u], 1u);
}

/* Transmittance between the point and the receiver. */
vec3 seen(light_receiver r, light_point p)
{
#if LSF_LIGHT_TREE_SIGHT == 2
    float lift = SIGHT_LIFT * grid.origin.w;
    return vec3(!triangles_between(triangle_count, r.position + lift * r.s.geometric_normal,
                                   p.position + lift * p.normal));
#elif LSF_LIGHT_TREE_SIGHT
    vec3 from = voxel_from_position(r.position), to = voxel_from_position(p.position);
#if LSF_VOXEL_PASSAGE
    return voxel_seen(from, r.s.geometric_normal, to, p.normal);
#else
    return vec3(voxel_sees(from, r.s.geometric_normal, to, p.normal));
#endif
#else
    return vec3(1.0);
#endif
}

/* Share of the specular light that paths leave to samples. */
float lobe_left(light_receiver r)
{
#if LSF_SPECULAR_PATHS
    return 1.0 - specular_paths_share(r.s, r.view);
#else
    return 1.0;
#endif
}

/* Probability that a sample is for the specular lobe. */
float specular_chance(light_receiver r)
{
#if LSF_SPECULAR
    brdf_sampler p = brdf_sampler_of(r.s, r.view, true);
    float chance = p.specular;
#if LSF_COAT
    chance = mix(chance, 1.0, p.coat);
#endif
    return lobe_left(r) > 0.0 ? chance : 0.0;
#else
    return 0.0;
#endif
}

/* Adds the light from the point to the receiver, over its probability; w of both parts is the luminance that the
 * bound removes. */
void add_light(light_receiver r, light_point p, bool specular, float probability)
{
    vec3 to_point = p.position - r.position;
    float distance2 = max(dot(to_point, to_point), LSF_LIGHT_DISTANCE2_MIN);
    vec3 direction = to_point * inversesqrt(distance2);
    float leaves = -dot(p.normal, direction), arrives = dot(r.s.normal, direction);
    if (leaves <= 0.0 || arrives <= 0.0 || dot(r.s.geometric_normal, direction) <= 0.0)
        return;
    vec3 intensity = p.intensity * seen(r, p);
    if (intensity == vec3(0.0))
        return;
    float held2 = max(distance2, light_bound2(p.disc2));
    float kernel = light_kernel(p.disc2, leaves / held2);
    brdf_value f = brdf_evaluate(r.s, r.view, direction, kernel);
    float geometry = leaves * arrives / probability;
    if (p.record != LSF_LIGHT_TREE_NONE)
        geometry *= light_lobe(p.record, p.normal, -direction, kernel);
    float bounded = geometry / held2;
    float lost = held2 > distance2 ? max(geometry / distance2 - bounded, 0.0) : 0.0;
#if LSF_SPECULAR
    if (specular) {
        vec3 reflected = lobe_left(r) * f.specular * intensity;
        specular_out += vec4(bounded * reflected, lost * luminance(reflected));
        return;
    }
#endif
    vec3 reflected = f.diffuse * intensity;
    irradiance_out += vec4(bounded * reflected, lost * luminance(reflected));
}

void main()
{
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, texel, 0).r;
    uvec4 surface_texel = texelFetch(surface_texture, texel, 0);
    if (depth == 0.0 || surface_texel_unlit(surface_texel))
        return;
    surface s = surface_unpack(surface_texel);
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, texel, 0), s);
#endif
    vec2 ndc = position_ndc(texel);
    vec3 view = surface_view(s, -normalize(view_ray_direction(ndc)));
    light_receiver r = light_receiver_of(position_from_depth(ndc, depth), view, s);
    float chance = specular_chance(r);
    path_random_key key = path_random_key(uint(texel.x) | (uint(texel.y) << 16), iteration.y, texel);
    bvec2 lobes = bvec2(false);
    for (uint i = 0u; i < LSF_LIGHT_TREE_SAMPLES; i++) {
        vec3 u = path_random(key, iteration.x * LSF_LIGHT_TREE_SAMPLES + i, 0u);
        picks[i] = light_pick(int(u.z < chance), LSF_LIGHT_TREE_NONE, u.x, 0.0);
        lobes = bvec2(lobes.x || picks[i].lobe == 0, lobes.y || picks[i].lobe == 1);
    }
    uint dead = 0u, steps = light_cut(r, lobes);
    for (uint i = 0u; i < LSF_LIGHT_TREE_SAMPLES; i++) {
        uint index = iteration.x * LSF_LIGHT_TREE_SAMPLES + i;
        bool specular = picks[i].lobe == 1;
        float share = picks[i].weight / weight_sums[picks[i].lobe];
        light_walk_end end = light_walk(r, specular, picks[i].link, share, picks[i].u, key, index);
        steps += end.steps;
        if (end.link == LSF_LIGHT_TREE_NONE) {
            dead++;
            continue;
        }
        light_point p = light_point_at(end.link, vec4(path_random(key, index, 1u), path_random(key, index, 0u).y));
        add_light(r, p, specular,
                  end.probability * (specular ? chance : 1.0 - chance) * float(LSF_LIGHT_TREE_SAMPLES));
    }
    count(LSF_LIGHT_TREE_SAMPLE_ALL, LSF_LIGHT_TREE_SAMPLES);
    count(LSF_LIGHT_TREE_SAMPLE_STEPS, steps);
    if (dead > 0u)
        count(LSF_LIGHT_TREE_SAMPLE_DEAD, dead);
}
