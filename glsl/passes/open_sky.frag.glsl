/* Light of the environment that visible points would reflect to the eye without occlusion; see
 * src/passes/open_sky.md. Texels without a surface are not drawn (lsf_skip_background). Switches LSF_ENVIRONMENT_MAP,
 * LSF_SKY_CHANCE, LSF_SPECULAR_PATHS (LSF_LOBE_RAYS rays through voxels tell how much of it narrow lobes reflect),
 * LSF_SPECULAR_PARAMS, LSF_SPECULAR, LSF_TRANSMISSION and those of the libraries. */
#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/path_random.glsl"
#include "lib/sky.glsl"
#include "lib/sky_chance.glsl"
#include "lib/sky_control.glsl"
#include "lib/view.glsl"
#if LSF_SPECULAR_PATHS
#include "lib/branch.glsl"
#include "lib/luminance.glsl"
#include "lib/specular_share.glsl"
#include "lib/voxel_sight.glsl"
#endif
#include "shared/open_sky_data.h"

/* Pixels read different directions: software GL fetches texels for all lanes at once, storage buffers lane by lane. */
layout(binding = LSF_UNIT_OPEN_SKY) uniform samplerBuffer drawn_fetch;
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
layout(binding = 3) uniform sampler2DArray control_texture;
#endif
layout(location = 0) uniform ivec2 counts; /* samples of each kind, a power of two; the iteration's number */
layout(location = 1) uniform uint seed;
layout(location = 2) uniform bool told; /* there were earlier iterations */

layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif
#if LSF_SPECULAR_PATHS
layout(location = 2) out vec4 narrow_out;
layout(location = 3) out vec2 lobe_out; /* parts of the lobes of which rays leave the scene, and of which they may */
#if LSF_TRANSMISSION
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D voxel_transmission_bits;
#endif
#endif

surface s;
vec3 view_direction;
brdf_sampler p;
int count; /* samples of each kind */
vec3 irradiance = vec3(0.0), specular = vec3(0.0);
#if LSF_SPECULAR_PATHS
float twice;              /* lobe_widened_twice */
vec3 narrow = vec3(0.0); /* the part of specular light that rays have a share of */
#endif

/* Density of one of the directions that the host draws, by the radiance alone [1/sr]. */
float drawn_density(vec3 radiance)
{
    return sky_density(radiance) / sky_sampling.w;
}

/* `density`: of one direction drawn by the radiance [1/sr]; `weight`: the reciprocal of the density with which samples
 * of both kinds find the direction; `radiance` may already hold a part of it. */
void add(vec3 direction, vec3 radiance, float density, float weight)
{
    brdf_value f = brdf_evaluate(s, view_direction, direction, 0.0);
#if LSF_SKY_CHANCE
    share_sky(s, view_direction, direction, density * sky_sampling.w, f);
#endif
    vec3 arriving = radiance * (weight * dot(s.normal, direction));
    irradiance += f.diffuse * arriving;
    specular += f.specular * arriving;
#if LSF_SPECULAR_PATHS
    narrow += narrow_sky_share(twice, density) * f.specular * arriving;
#endif
}

bool above(vec3 direction)
{
    return dot(s.normal, direction) > 0.0 && dot(s.geometric_normal, direction) > 0.0;
}

void add_drawn(int index)
{
    lsf_open_sky_data drawn =
        lsf_open_sky_data(texelFetch(drawn_fetch, 2 * index), texelFetch(drawn_fetch, 2 * index + 1));
    vec3 direction = drawn.direction.xyz;
    float density = drawn.direction.w;
    if (!above(direction) || density <= 0.0)
        return;
    float both = density + brdf_pdf(p, direction);
    add(direction, drawn.radiance.rgb, density, density / (float(count) * both));
}

void add_reflected(vec3 u)
{
    vec3 direction;
#if LSF_TRANSMISSION
    vec3 through;
    if (brdf_pass(p, s, u, direction, through))
        return;
#endif
    direction = brdf_draw(p, u);
    if (!above(direction))
        return;
    vec3 radiance = environment_radiance(direction);
    float density = drawn_density(radiance);
    add(direction, radiance, density, 1.0 / (float(count) * (density + brdf_pdf(p, direction))));
}

#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
/* The largest share that the directions of a sequence suggest for either lobe. */
float share_before(ivec2 pixel, int sequence)
{
    vec4 sums = texelFetch(control_texture, ivec3(pixel, sequence), 0);
    float most = texelFetch(control_texture, ivec3(pixel, 2), 0)[sequence];
    if (sums.z + sums.w == 0.0)
        return 1.0; /* nothing is known yet */
    sky_found found = sky_found(sums.xy, sums.zw, most);
    return max(sky_control_diffuse(found), sky_control_specular(found));
}
#endif

/* Light that is not used need not be known well: the number of samples follows the share that directions before
 * this iteration suggest. */
int samples_of(ivec2 pixel)
{
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    if (told) {
        float wanted = float(counts.x) * max(share_before(pixel, 0), share_before(pixel, 1));
        return int(exp2(ceil(log2(clamp(wanted, 1.0, float(counts.x))))));
    }
#endif
    return counts.x;
}

#if LSF_SPECULAR_PATHS
#define LOBES_UNKNOWN vec2(0.0, 1.0)

/* Whether a ray from a visible point leaves the scene. `sure`: voxels miss no surface close to its start, and none lets
 * light through. */
bool leaves_scene(vec3 point, vec3 direction, out bool sure)
{
    voxel_ray ray;
    ivec3 cell;
    sure = voxel_starts_alone(point, s.geometric_normal, direction);
    if (!voxel_ray_begin(voxel_start(point, s.geometric_normal, direction), direction, ray) || !voxel_leave_start(ray) ||
        !voxel_ray_meet(ray, VOXEL_FAR, true, cell))
        return true;
#if LSF_TRANSMISSION
    surface met = s;
    transmission_unpack(texelFetch(voxel_transmission_bits, cell, 0).r, met);
    sure = sure && met.transmission == 0.0;
    return met.transmission > 0.0;
#else
    return false;
#endif
}

/* Of what the specular lobes of a visible point reflect, the part from where rays leave the scene, and the part from where
 * they may. */
vec2 ask_lobes(vec3 point, path_random_key key)
{
    vec2 leave = vec2(0.0);
    float whole = 0.0;
    brdf_sampler lobes = p;
    brdf_keep_lobes(lobes);
    for (int i = 0; i < LSF_LOBE_RAYS; i++) {
        vec3 direction = brdf_draw(lobes, path_random(key, uint(counts.y * LSF_LOBE_RAYS + i), 1u));
        if (!above(direction))
            continue;
        vec3 f = brdf_evaluate(s, view_direction, direction, 0.0).specular;
        float reflected = luminance(f) * dot(s.normal, direction) / brdf_pdf(lobes, direction);
        bool sure, leaves = leaves_scene(point, direction, sure);
        whole += reflected;
        leave += leaves ? reflected * vec2(sure, !sure) : vec2(0.0);
    }
    return whole > 0.0 ? leave / whole : LOBES_UNKNOWN;
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
#if LSF_SPECULAR_PATHS
    narrow_out = vec4(0.0);
    lobe_out = LOBES_UNKNOWN;
#endif
    s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, pixel, 0), s);
#endif
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    view_direction = surface_view(s, -normalize(view_ray_direction(ndc)));
    p = brdf_sampler_of(s, view_direction, true);
#if LSF_SPECULAR
    p.specular = 1.0 - LOBE_LEAST; /* directions drawn by the radiance serve the diffuse lobe well */
#endif
#if LSF_SPECULAR_PATHS
    twice = lobe_widened_twice(s, view_direction);
#endif
    path_random_key key;
    key.pixel = uint(pixel.x) | uint(pixel.y) << 16;
    key.seed = seed;
    key.texel = pixel;
    /* A part of a low-discrepancy sequence that begins at a multiple of its length. */
    count = samples_of(pixel);
    int parts = LSF_OPEN_SKY_DRAWN / count;
    int first = int(hash(uvec3(key.pixel, seed, counts.y)).x % uint(parts)) * count;
    for (int i = 0; i < count; i++) {
        add_drawn(first + i);
        add_reflected(path_random(key, uint(counts.y * counts.x + i), 0u));
    }
    irradiance_out.rgb = irradiance;
#if LSF_SPECULAR
    specular_out.rgb = specular;
#endif
#if LSF_SPECULAR_PATHS
    narrow_out.rgb = narrow;
    BRANCH(narrow_share(twice) > 0.0) {
        vec3 position = position_from_depth(ndc, texelFetch(depth_texture, pixel, 0).r);
        lobe_out = ask_lobes(voxel_from_position(position), key);
    }
#endif
}
