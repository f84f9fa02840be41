/* Light that comes to visible points through the surfaces of media, refracted; see src/passes/refraction.md. Switches
 * LSF_TRANSMISSION and LSF_ABSORPTION (always), LSF_ENVIRONMENT, LSF_VOXEL_MIRRORS, LSF_INTERLEAVE, LSF_PATHS_BOUNCE
 * (voxels are lit directly: paths go on from all) and those of the libraries. */
#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/interleave.glsl"
#include "lib/path_random.glsl"
#include "lib/reflectance.glsl"
#include "lib/sky.glsl"
#include "lib/sparse.glsl"
#include "lib/straight.glsl"
#include "lib/voxel_vertex.glsl"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D voxel_radiance; /* two slices along z, one for each side */
layout(location = 0) uniform ivec2 lengths;   /* paths of a point, most segments of a path */
layout(location = 1) uniform uvec2 iteration; /* iteration, seed */

layout(location = 0) out vec4 specular_out; /* added */

/* Draws whether a path passes the surface of v or is reflected by it, and how. Multiplies the weight into `through`.
 * False: the path ends. */
bool pass_or_reflect(path_vertex v, vec3 u, bool visible, inout vec3 through, out vec3 direction)
{
    brdf_sampler p = brdf_sampler_of(v.s, v.view, false);
    vec3 h = brdf_visible_normal(p, disc_draw(u.xy));
    float vh = min(dot(p.view, h), 1.0), far_vh = v.s.eta < 1.0 ? lsf_refracted_cosine(vh, v.s.eta) : vh;
    vec3 f0 = surface_specular_f0(v.s);
    float f90 = surface_specular_f90(v.s);
    vec3 mirrored = f0 + (f90 - f0) * lsf_fresnel_schlick(0.0, far_vh);
    /* The lobe of visible points is gathered with other light, as if they were seen from outside. */
    if (visible)
        mirrored = max(mirrored - f0 - (f90 - f0) * lsf_fresnel_schlick(0.0, vh), 0.0);
    float enters = v.s.transmission * (1.0 - v.s.metallic) * (1.0 - brdf_interface(p, p.dielectric, vh));
    vec3 passes = v.s.base_color * enters;
    float chance = largest(mirrored) / max(largest(mirrored) + largest(passes), 1e-6), gain;
    vec3 local;
    if (u.z < chance) {
        local = 2.0 * vh * h - p.view;
        gain = lsf_ggx_g1(local.z, local.x, local.y, p.alpha_t, p.alpha);
        through *= mirrored / chance * gain;
    } else {
        local = brdf_transmitted(p, h, vh, gain);
        through *= passes * (gain / max(1.0 - chance, 1e-6));
    }
    direction = brdf_from_frame(p, local);
    through *= brdf_layers_pass(p, v.s, direction);
    bool reflected = u.z < chance, above = dot(v.s.geometric_normal, direction) > 0.0;
    return through != vec3(0.0) && (local.z > 0.0) == reflected && above == reflected;
}

/* The share of the light that a voxel of a transmitting material holds which its diffuse lobe reflects; paths follow the
 * specular one. At the mean cosine of diffuse light, 2/3. */
vec3 matte_share(surface s)
{
    vec3 diffuse, specular;
    reflectances(reflector(s.base_color, s.transmission, s.roughness, s.f0, s.metallic), 2.0 / 3.0, diffuse, specular);
    return diffuse / max(diffuse + specular, vec3(1e-6));
}

/* Radiance of the side of a voxel towards a path's previous vertex. `mirrors`: the path goes on from it as from a mirror;
 * `straight`: or straight through it. */
vec3 voxel_shows(path_vertex met, ivec3 cell, int side, path_vertex before, vec3 direction, bool mirrors, bool straight)
{
#if LSF_VOXEL_MIRRORS
    if (mirrors) {
        vec3 shown = voxel_emission_at(cell, side);
#if LSF_VOXEL_LAMPS
        shown += voxel_shows_lamp(met.s, cell, side, before.position, direction, 0.0);
#endif
        return shown;
    }
#endif
    vec3 held = texelFetch(voxel_radiance, cell + ivec3(0, 0, side * int(grid.size.z)), 0).rgb;
    if (met.s.transmission > 0.0 && !straight) {
        vec3 emission = voxel_emission_at(cell, side);
        return emission + matte_share(met.s) * max(held - emission, 0.0);
    }
#if LSF_VOXEL_LAMPS
    held = voxel_reflects(held, met.s, cell, side, before.position, direction, 0.0);
#endif
    return held;
}

/* Light of a path that begins at the visible point v of a body of that thickness, and passes its surface. */
vec3 path_light(path_vertex v, float thickness, path_random_key key, uint index)
{
    vec3 sum = vec3(0.0), through = vec3(1.0), absorption = vec3(0.0);
    bool mirrors = false; /* v is of smooth metal */
    bool spreads = false; /* v is opaque, and the path goes on from it by its whole BRDF */
    /* Density of the direction by the last vertex that spreads light [1/sr]; 0: there was none. Behind it light goes
     * straight through media, as voxels are lit. */
    float spread = 0.0;
    for (int segment = 0; segment < lengths.y; segment++) {
        vec3 u = path_random(key, index, uint(segment)), direction = -v.view;
        float pdf;
        if (mirrors || spreads) {
            if (!brdf_follow(v.s, u, direction, through, pdf))
                break;
            spread = spreads ? dot(v.s.normal, direction) / LSF_PI : 0.0;
        } else if (spread > 0.0) {
            through *= straight_transmittance(v.s, v.view);
        } else if (!pass_or_reflect(v, u, segment == 0, through, direction)) {
            break;
        }
        path_vertex far_side;
        if (segment == 0 && path_through_wall(v, direction, thickness, far_side)) {
            through *= left_after(absorption_along(v, direction, absorption), far_side.position - v.position);
            v = far_side;
            continue;
        }
        voxel_ray ray;
        bool inside;
        ivec3 cell = ivec3(0);
        int side = 0;
        bool meets = path_ray_begin(v, direction, ray, inside) && path_ray_meet(ray, inside, cell);
        path_vertex met = v;
        if (meets)
            met = vertex_at(cell, v.position, direction, side);
        path_find_exit(v, direction, meets, cell, side, met);
        if (!meets) {
#if LSF_ENVIRONMENT
            vec3 sky = environment_radiance(direction);
            sum += through * (spread > 0.0 ? sky_left(sky, spread) : sky);
#endif
            break;
        }
        absorption = absorption_along(v, direction, absorption);
        through *= left_after(absorption, met.position - v.position);
#if LSF_VOXEL_MIRRORS
        mirrors = voxel_mirrors(met.s, 0.0);
#endif
#if LSF_PATHS_BOUNCE
        spreads = met.s.transmission == 0.0 && !mirrors;
        bool last = segment == lengths.y - 1; /* no bounce is left for other light than emission */
        sum += through * grid.unit.x * (last ? voxel_emission_at(cell, side)
                                             : voxel_shows(met, cell, side, v, direction, mirrors, spread > 0.0));
#else
        sum += through * grid.unit.x * voxel_shows(met, cell, side, v, direction, mirrors, false);
#endif
        if (met.s.unlit || (met.s.transmission == 0.0 && !mirrors && !spreads))
            break;
        v = met;
    }
    return sum;
}

/* The pixel of a point, whose order may be that of an interleaving pattern. */
ivec2 point_pixel(ivec2 point)
{
#if LSF_SPARSE
    return position_pixel(point);
#else
    return interleave_pixel(point, textureSize(depth_texture, 0));
#endif
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, texel, 0).r;
    uvec4 surface_texel = texelFetch(surface_texture, texel, 0);
    specular_out = vec4(0.0);
    if (depth == 0.0 || surface_texel_unlit(surface_texel))
        return;
    path_vertex v;
    v.s = surface_unpack(surface_texel);
    specular_params_unpack(texelFetch(specular_params_texture, texel, 0), v.s);
    if (!v.s.volume || v.s.transmission == 0.0)
        return;
    ivec2 pixel = point_pixel(texel);
    vec2 ndc = sample_ndc(vec2(pixel) + 0.5);
    v.position = voxel_from_position(position_from_depth(ndc, depth));
    v.view = -normalize(view_ray_direction(ndc));
    float thickness = seen_thickness(v, pixel, ndc);
    path_random_key key;
    key.pixel = uint(pixel.x) | (uint(pixel.y) << 16);
    key.seed = iteration.y;
    for (int i = 0; i < lengths.x; i++)
        specular_out.rgb += path_light(v, thickness, key, iteration.x * uint(lengths.x) + uint(i)) / float(lengths.x);
}
