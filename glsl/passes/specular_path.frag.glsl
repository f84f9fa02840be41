/* Specular light of visible points by paths through voxels: what media transmit, refracted, and what narrow lobes reflect;
 * see src/passes/specular_path.md. Switches LSF_ABSORPTION (there are media), LSF_SPECULAR_PATHS (narrow lobes),
 * LSF_EMITTERS (points are drawn on emitters; only with LSF_SPECULAR_PATHS), LSF_SPLIT_DIRECT, LSF_ENVIRONMENT,
 * LSF_VOXEL_MIRRORS, LSF_INTERLEAVE, LSF_PATHS_BOUNCE (voxels are lit directly: paths go on from all) and those of the
 * libraries. */
#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/interleave.glsl"
#include "lib/path_random.glsl"
#include "lib/reflectance.glsl"
#include "lib/sky.glsl"
#include "lib/sparse.glsl"
#include "lib/specular_share.glsl"
#include "lib/straight.glsl"
#include "lib/voxel_sky_lamp.glsl"
#include "lib/voxel_vertex.glsl"

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D voxel_radiance; /* two slices along z, one for each side */
layout(location = 0) uniform ivec2 lengths;   /* most paths of a point, most segments of a path */
layout(location = 1) uniform uvec2 iteration; /* iteration, seed */

layout(location = 0) out vec4 specular_out; /* added */
#if LSF_SPLIT_DIRECT
layout(location = 1) out vec4 direct_specular_out; /* added: emission that lobes show, but for those of media */
#endif

/* Whether paths pass the surface, refracted. */
bool is_medium(surface s)
{
#if LSF_ABSORPTION
    return s.volume && s.transmission > 0.0;
#else
    return false;
#endif
}

/* Microfacet reflection: a direction of the specular lobe, in the sampler's frame, for the normal h. `gain`: f cos / p of
 * visible normals without the Fresnel term. */
vec3 mirrored_at(brdf_sampler p, vec3 h, out float gain)
{
    vec3 local = 2.0 * dot(p.view, h) * h - p.view;
    vec3 stretched = vec3(p.alpha_t, p.alpha, 1.0) * p.view;
    gain = local.z <= 0.0 ? 0.0
                          : 2.0 * local.z * (p.view.z + length(stretched)) *
                                lsf_ggx_v_anisotropic(local.z, p.view.z, local.x, local.y, p.view.x, p.view.y, p.alpha_t,
                                                      p.alpha);
    return local;
}

#if LSF_SPECULAR_PATHS
/* Draws by the specular lobes of a visible point. */
brdf_sampler lobe_sampler(path_vertex v)
{
    brdf_sampler p = brdf_sampler_of(v.s, v.view, true);
    brdf_keep_lobes(p);
    return p;
}

/* Draws a direction of these lobes with the density `pdf`. False: nothing is reflected from there. */
bool leave_by_lobe(path_vertex v, vec3 u, inout vec3 through, out vec3 direction, out float pdf)
{
    brdf_sampler p = lobe_sampler(v);
    direction = brdf_draw(p, u);
    pdf = brdf_pdf(p, direction);
    float cosine = dot(v.s.normal, direction);
    if (cosine <= 0.0 || dot(v.s.geometric_normal, direction) <= 0.0)
        return false;
    through *= brdf_evaluate(v.s, v.view, direction, 0.0).specular * (cosine / pdf);
    return true;
}
#endif

#if LSF_ABSORPTION
/* Draws whether a path passes the surface of v or is reflected by it, and how. Multiplies the weight into `through`.
 * `share`: the part of the lobe at a visible point that it has; other light gathers the rest as if the point were seen
 * from outside. `sky`: the part of the environment's light along the path that nothing else finds; directions of the
 * environment find what comes to such a lobe straight through media. False: the path ends. */
bool pass_or_reflect(path_vertex v, vec3 u, bool visible, float share, inout vec3 through, out vec3 direction, inout float sky)
{
    brdf_sampler p = brdf_sampler_of(v.s, v.view, false);
    vec3 h = brdf_visible_normal(p, disc_draw(u.xy));
    float vh = min(dot(p.view, h), 1.0), far_vh = v.s.eta < 1.0 ? lsf_refracted_cosine(vh, v.s.eta) : vh;
    vec3 f0 = surface_specular_f0(v.s);
    float f90 = surface_specular_f90(v.s);
    vec3 mirrored = f0 + (f90 - f0) * lsf_fresnel_schlick(0.0, far_vh);
    float mirrored_sky = 1.0;
    if (visible) {
        vec3 gathered = f0 + (f90 - f0) * lsf_fresnel_schlick(0.0, vh);
        vec3 found = max(mirrored - gathered, 0.0);
        mirrored = max(mirrored - (1.0 - share) * gathered, 0.0);
        mirrored_sky = largest(found) / max(largest(mirrored), 1e-6);
    }
    float enters = v.s.transmission * (1.0 - v.s.metallic) * (1.0 - brdf_interface(p, p.dielectric, vh));
    vec3 passes = v.s.base_color * enters;
    float chance = largest(mirrored) / max(largest(mirrored) + largest(passes), 1e-6), gain;
    bool reflected = u.z < chance;
    vec3 local;
    if (reflected) {
        local = mirrored_at(p, h, gain);
        through *= mirrored / chance * gain;
        sky = mirrored_sky;
    } else {
        local = brdf_transmitted(p, h, vh, gain);
        through *= passes * (gain / max(1.0 - chance, 1e-6));
    }
    direction = brdf_from_frame(p, local);
    through *= brdf_layers_pass(p, v.s, direction);
    bool above = dot(v.s.geometric_normal, direction) > 0.0;
    return through != vec3(0.0) && (local.z > 0.0) == reflected && above == reflected;
}
#endif

#if LSF_TRANSMISSION
/* The share of the light that a voxel of a transmitting material holds which its diffuse lobe reflects; paths follow the
 * specular one. At the mean cosine of diffuse light, 2/3. */
vec3 matte_share(surface s)
{
    vec3 diffuse, specular;
    reflectances(reflector(s.base_color, s.transmission, s.roughness, s.f0, s.metallic), 2.0 / 3.0, diffuse, specular);
    return diffuse / max(diffuse + specular, vec3(1e-6));
}
#endif

bool transmits(surface s)
{
#if LSF_TRANSMISSION
    return s.transmission > 0.0;
#else
    return false;
#endif
}

/* Voxels mirror the environment by the direction of it that they keep, too. */
#define SKY_LAMPS (LSF_SPECULAR_PATHS && VOXEL_SKY_LAMPS)

/* Radiance of the side of a voxel towards a path's previous vertex, but for its emission. `density`: that of all paths in
 * this direction [1/sr]; 0: it was not drawn by a BRDF. `mirrors`: the path goes on from the voxel as from a mirror;
 * `straight`: or straight through it. */
vec3 voxel_shows(path_vertex met, ivec3 cell, int side, path_vertex before, vec3 direction, float density, bool mirrors, bool straight)
{
#if LSF_VOXEL_MIRRORS
    if (mirrors) {
#if LSF_VOXEL_LAMPS
        return voxel_shows_lamp(met.s, cell, side, before.position, direction, density);
#else
        return vec3(0.0);
#endif
    }
#endif
    vec3 held = texelFetch(voxel_radiance, cell + ivec3(0, 0, side * int(grid.size.z)), 0).rgb;
    held = max(held - voxel_emission_at(cell, side), 0.0);
#if LSF_TRANSMISSION
    if (met.s.transmission > 0.0 && !straight)
        return matte_share(met.s) * held;
#endif
#if LSF_VOXEL_LAMPS
    held = voxel_reflects(held, met.s, cell, side, before.position, direction, density);
#endif
    return held;
}

#if LSF_EMITTERS
/* Light of points drawn on emitters that v reflects, weighted against segments from v that hit them. `lobe`: v reflects
 * by its specular lobes alone. */
vec3 emitters_at(path_vertex v, bool lobe, vec3 absorption, path_random_key key, uint index, int segment)
{
    vec3 sum = vec3(0.0);
    brdf_sampler p = lobe ? lobe_sampler(v) : brdf_sampler_of(v.s, v.view, false);
    uint count = uint(emitters.y);
    for (uint i = 0u; i < count; i++) {
        emitter_view e;
        float cosine;
        vec2 u = path_random(key, index * count + i, ~uint(segment)).xy;
        if (!emitter_seen_from(v.position, v.s.geometric_normal, v.s.normal, u, e, cosine))
            continue;
        float density = emitters.y * e.density;
        brdf_value f = brdf_evaluate(v.s, v.view, e.direction, 0.0);
        vec3 reflected = lobe ? f.specular : brdf_sum(v.s, f);
        vec3 left = left_after(absorption_along(v, e.direction, absorption), e.position - v.position);
        float share = emitter_share(density, e.chance * brdf_pdf(p, e.direction));
        vec3 radiance = segment == 0 ? e.radiance : e.resolved * e.radiance;
        sum += reflected * radiance * left * (cosine / density * share);
    }
    return sum;
}
#endif

/* Emission of a voxel that a segment from v has met, drawn with this density; 0: points on emitters are not drawn at
 * v. */
vec3 emission_met(path_vertex v, vec3 direction, float pdf, ivec3 cell, int side, path_vertex met)
{
    vec3 emission = voxel_emission_at(cell, side);
#if LSF_EMITTERS
    if (pdf > 0.0) {
        float drawn = emitter_density_met(v.position, direction, cell, met.position, met.s.geometric_normal,
                                          grid.unit.x * emission);
        emission *= emitter_share(pdf, emitters.y * drawn);
    }
#endif
    return grid.unit.x * emission;
}

/* What paths find: light, and emission that lobes of visible points show. */
struct path_finds {
    vec3 light, direct;
};

/* Number of paths of a visible point: all at media, else by the part that the lobes have of the light which the surface
 * reflects. */
uint paths_of(path_vertex v)
{
    if (is_medium(v.s))
        return uint(lengths.x);
    brdf_sampler p = brdf_sampler_of(v.s, v.view, true);
    float lobes = p.specular;
#if LSF_COAT
    lobes = mix(lobes, 1.0, p.coat);
#endif
    return uint(ceil(float(lengths.x) * lobes));
}

/* Adds what one of `paths` paths finds that begins at the visible point v: through the surface of a medium, that body, or
 * along the specular lobes, of which it has a share. */
void add_path(path_vertex v, seen_body body, float share, path_random_key key, uint index, uint paths, inout path_finds finds)
{
    vec3 sum = vec3(0.0), direct = vec3(0.0), through = vec3(1.0), absorption = vec3(0.0);
    bool medium = is_medium(v.s);
    if (!medium)
        through = vec3(share);
    bool mirrors = false; /* v is of smooth metal */
    bool spreads = false; /* v is opaque, and the path goes on from it by its whole BRDF */
    /* Density of the direction by the last vertex that spreads light [1/sr]; 0: there was none. Behind it light goes
     * straight through media, as voxels are lit. */
    float spread = 0.0;
    float sky_part = 1.0; /* part of the environment's light along the path that nothing else finds */
    float sky_lamps = 0.0; /* sky_lamp_share of v */
    for (int segment = 0; segment < lengths.y; segment++) {
        vec3 u = path_random(key, index, uint(segment)), direction = -v.view;
        float pdf = 0.0;
        bool lobe = segment == 0 && !medium;
#if LSF_EMITTERS
        if (mirrors || spreads || lobe) {
            vec3 lit = through * emitters_at(v, lobe, absorption, key, index, segment);
            if (lobe)
                direct += lit;
            else
                sum += lit;
        }
#endif
        if (mirrors || spreads) {
            if (!brdf_follow(v.s, u, direction, through, pdf))
                break;
            spread = spreads ? dot(v.s.normal, direction) / LSF_PI : 0.0;
            sky_part = 1.0;
        }
#if LSF_SPECULAR_PATHS
        else if (lobe) {
            if (!leave_by_lobe(v, u, through, direction, pdf))
                break;
            sky_part = 0.0;
        }
#endif
#if LSF_TRANSMISSION
        else if (spread > 0.0) {
            through *= straight_transmittance(v.s, v.view);
        }
#endif
#if LSF_ABSORPTION
        else if (!pass_or_reflect(v, u, segment == 0, share, through, direction, sky_part)) {
            break;
        }
        path_vertex far_side;
        if (segment == 0 && path_through_wall(v, direction, body, far_side)) {
            through *= left_after(absorption_along(v, direction, absorption), far_side.position - v.position);
            v = far_side;
            continue;
        }
#endif
        voxel_ray ray;
        bool inside;
        ivec3 cell = ivec3(0);
        int side = 0;
        bool meets = path_ray_begin(v, direction, ray, inside) && path_ray_meet(ray, inside, cell);
        path_vertex met = v;
        if (meets)
            met = vertex_at(cell, v.position, direction, side);
#if LSF_ABSORPTION
        path_find_exit(v, direction, meets, cell, side, met);
#endif
        if (!meets) {
#if LSF_ENVIRONMENT
            vec3 sky = environment_radiance(direction);
            if (spread > 0.0)
                sky = sky_left(sky, spread);
            else if (sky_lamps > 0.0)
                sky = mix(sky, sky_left(sky, pdf), sky_lamps);
            sum += through * sky_part * sky;
#endif
            break;
        }
        absorption = absorption_along(v, direction, absorption);
        through *= left_after(absorption, met.position - v.position);
#if LSF_VOXEL_MIRRORS
        mirrors = voxel_mirrors(met.s, pdf);
#if SKY_LAMPS
        sky_lamps = mirrors ? sky_lamp_share(met.s, direction, float(paths) * pdf) : 0.0;
#endif
#endif
        bool last = false, straight = false;
#if LSF_PATHS_BOUNCE
        spreads = !transmits(met.s) && !mirrors;
        last = segment == lengths.y - 1; /* no bounce is left for other light than emission */
        straight = spread > 0.0;
#endif
        vec3 emission = through * emission_met(v, direction, pdf, cell, side, met);
        if (lobe)
            direct += emission;
        else
            sum += emission;
        if (!last)
            sum += through * grid.unit.x * voxel_shows(met, cell, side, v, direction, float(paths) * pdf, mirrors, straight);
#if SKY_LAMPS
        if (!last && sky_lamps > 0.0)
            sum += through * (grid.unit.x * sky_lamps) *
                   sky_lamp_mirrored(met.s, cell, side, v.position, direction, float(paths) * pdf);
#endif
        if (met.s.unlit || (!transmits(met.s) && !mirrors && !spreads))
            break;
        v = met;
    }
    finds.light += sum;
    finds.direct += direct;
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
#if LSF_SPLIT_DIRECT
    direct_specular_out = vec4(0.0);
#endif
    if (depth == 0.0 || surface_texel_unlit(surface_texel))
        return;
    path_vertex v;
    v.s = surface_unpack(surface_texel);
    specular_params_unpack(texelFetch(specular_params_texture, texel, 0), v.s);
    ivec2 pixel = point_pixel(texel);
    vec2 ndc = sample_ndc(vec2(pixel) + 0.5);
    v.position = voxel_from_position(position_from_depth(ndc, depth));
    v.view = -normalize(view_ray_direction(ndc));
    float share = 0.0;
    seen_body body = seen_body_none();
#if LSF_SPECULAR_PATHS
    share = specular_paths_share(v.s, v.view);
#endif
#if LSF_ABSORPTION
    if (is_medium(v.s))
        body = seen_body_of(v, pixel, ndc);
#endif
    if (share == 0.0 && !is_medium(v.s))
        return;
    path_random_key key;
    key.pixel = uint(pixel.x) | (uint(pixel.y) << 16);
    key.seed = iteration.y;
    path_finds finds = path_finds(vec3(0.0), vec3(0.0));
    uint paths = paths_of(v);
    for (uint i = 0u; i < paths; i++)
        add_path(v, body, share, key, iteration.x * paths + i, paths, finds);
    float weight = 1.0 / float(paths);
    specular_out.rgb = weight * finds.light;
#if LSF_SPLIT_DIRECT
    direct_specular_out.rgb = weight * finds.direct;
#else
    specular_out.rgb += weight * finds.direct;
#endif
}
