/* Light that cones gather at visible points from voxels and from the environment. */
#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/pixel_tile.glsl"
#include "lib/sky.glsl"
#include "lib/sparse.glsl"
#include "lib/voxel_cone.glsl"
#include "lib/voxel_sky_lamp.glsl"

layout(location = 0) out vec4 irradiance_out; /* alpha: ambient visibility, of green light */
#if LSF_SPECULAR
layout(location = 1) out vec4 specular_out;
#endif

/* Light of a diffuse cone, weighted against directions drawn by the environment's radiance. `chance`: density of the
 * directions of all cones. */
vec3 arriving(cone_light light, vec3 direction, float chance)
{
    vec3 radiance = light.radiance * grid.unit.x;
#if LSF_ENVIRONMENT
    radiance += light.transmittance * sky_left(environment_radiance(direction), chance);
#endif
    return radiance;
}

/* Adds what a visible point reflects of a diffuse cone's light of that irradiance; `cosine`: of its direction. */
void reflect_light(surface s, vec3 to_viewer, vec3 direction, float cosine, vec3 irradiance)
{
    float reflected = 1.0;
#if LSF_SPECULAR
    vec3 h = normalize(to_viewer + direction);
    reflected -= surface_dielectric_fresnel(s, clamp(dot(to_viewer, h), 0.0, 1.0));
    float nv = max(dot(s.normal, to_viewer), LSF_COSINE_MIN), passes = coat_passes(s, to_viewer, direction);
    reflected *= sheen_leaves(s, nv, cosine) * passes;
#if LSF_SHEEN
    if (s.sheen.rgb != vec3(0.0))
        specular_out.rgb += passes * sheen_reflects(s, lift_to_horizon(to_viewer, s.normal), direction) * irradiance;
#endif
#endif
    irradiance_out.rgb += reflected * irradiance;
}

#if LSF_VOXEL_MIRRORS
layout(location = 1) uniform int most_mirrors; /* that a ray of the specular lobe goes on from */
#endif

#if LSF_SPECULAR && LSF_SEALED
/* Density of rays that find light which no other strategy finds: their weight is 1. */
#define ONLY_WAY 1e30

/* Light along a direction drawn from the lobe of a visible point with density `pdf`: from voxels, weighted against
 * points drawn on emitters, and from the environment, weighted against directions drawn by its radiance. What voxels
 * mirror of emitters is found in no other way. */
vec3 lobe_finds(vec3 point, vec3 normal, vec3 direction, float pdf)
{
    vec3 sum = vec3(0.0), through = vec3(1.0), sky = vec3(0.0);
    float density = pdf;
#if LSF_ENVIRONMENT
    sky = sky_left(environment_radiance(direction), pdf);
#endif
    cone_way way = cone_follow(point, normal, direction);
#if LSF_VOXEL_MIRRORS
    for (int i = 0; i < most_mirrors && way.met; i++) {
        int side;
        surface s = voxel_surface_at(way.cell, direction, side);
        if (!voxel_mirrors(s, pdf))
            break;
        vec3 shown = voxel_emission_at(way.cell, side) - voxel_emission_drawn(way.cell, side);
        shown += cone_end_at(point, direction, way.cell, density).emission;
#if LSF_VOXEL_LAMPS
        shown += voxel_shows_lamp(s, way.cell, side, point, direction, pdf);
#endif
#if VOXEL_SKY_LAMPS
        float sky_lamps = sky_lamp_share(s, direction, pdf);
        if (sky_lamps > 0.0)
            shown += sky_lamps * sky_lamp_mirrored(s, way.cell, side, point, direction, pdf);
#endif
        sum += through * (way.radiance + way.left * shown);
        through *= way.left;
        point = vec3(way.cell) + voxel_point_unpack(texelFetch(voxel_point, way.cell, 0).r);
        uint order = floatBitsToUint(cone_gather.x) + uint(i);
        if (!brdf_follow(s, hash_unit(hash(uvec3(gl_FragCoord.xy, order))), direction, through, pdf))
            return grid.unit.x * sum;
        density = ONLY_WAY;
        sky = environment_radiance(direction);
#if VOXEL_SKY_LAMPS
        sky = mix(sky, sky_left(sky, pdf), sky_lamps);
#endif
        way = cone_follow(point, s.geometric_normal, direction);
    }
#endif
    vec3 end = sky;
    if (way.met) {
        cone_end met = cone_end_at(point, direction, way.cell, density);
        end = grid.unit.x * (met.emission + cone_reflected(met.rest, point, direction, way.cell, pdf));
    }
    return grid.unit.x * (sum + through * way.radiance) + through * way.left * end;
}

brdf_sampler lobe_sampler(surface s, vec3 to_viewer)
{
    brdf_sampler p = brdf_sampler_of(s, to_viewer, true);
    p.specular = 1.0;
    return p;
}

/* What the specular lobe reflects of light from a direction, times the cosine. */
vec3 lobe_reflects(surface s, vec3 to_viewer, vec3 direction, float cosine)
{
    float leaves = 1.0;
#if LSF_SHEEN
    /* The sheen's own reflection is gathered with diffuse light. */
    leaves = sheen_leaves(s, max(dot(s.normal, to_viewer), LSF_COSINE_MIN), cosine);
    s.sheen = vec4(0.0);
#endif
    return brdf_evaluate(s, to_viewer, direction, 0.0).specular * (leaves * cosine);
}

/* Light of the specular lobe by a ray drawn from it. */
vec3 lobe_light(surface s, vec3 point, vec3 to_viewer)
{
    vec3 number = hash_unit(hash(uvec3(gl_FragCoord.xy, 1u)));
    vec2 u = fract(cone_gather.xw + number.xy);
    brdf_sampler p = lobe_sampler(s, to_viewer);
    vec3 direction = brdf_draw(p, vec3(u, fract(cone_gather.x + number.z)));
    float cosine = dot(s.normal, direction);
    if (cosine <= 0.0 || dot(s.geometric_normal, direction) <= 0.0)
        return vec3(0.0);
    float pdf = brdf_pdf(p, direction);
    vec3 radiance = lobe_finds(point, s.geometric_normal, direction, pdf);
    return lobe_reflects(s, to_viewer, direction, cosine) * radiance / pdf;
}
#elif LSF_SPECULAR
layout(binding = 3) uniform sampler2D albedo_texture; /* albedo of the specular lobe */
layout(location = 0) uniform float lobe_spread; /* ratio of the specular cone's diameter per unit length to alpha */

/* A right angle: the lobes of rougher surfaces are not round any more. */
#define CONE_WIDEST 2.0

/* Light of the specular lobe by a cone along the mirror direction. */
vec3 lobe_light(surface s, vec3 point, vec3 to_viewer)
{
    vec3 view_direction = lift_to_horizon(to_viewer, s.normal);
    vec3 mirrored = reflect(-view_direction, s.normal);
    if (dot(mirrored, s.geometric_normal) <= 0.0)
        return vec3(0.0);
    float spread = min(lobe_spread * lsf_alpha_from_roughness(s.roughness), CONE_WIDEST);
    cone_light light = cone_trace(point, s.geometric_normal, mirrored, 0.0, spread);
    vec2 coordinates = vec2(dot(s.normal, view_direction), s.roughness);
    vec2 albedo = textureLod(albedo_texture, coordinates, 0.0).rg;
    vec3 reflected = surface_specular_f0(s) * albedo.x + surface_specular_f90(s) * albedo.y;
    vec3 radiance = light.radiance * grid.unit.x;
#if LSF_ENVIRONMENT
    radiance += light.transmittance * environment_radiance(mirrored);
#endif
    float nv = dot(s.normal, view_direction);
    return reflected * sheen_leaves(s, nv, nv) * coat_passes(s, to_viewer, mirrored) * radiance;
}
#endif

/* Pixels of a tile have the rotations 0 to 15 of 16. Tiles differ at random in rotation and ring: where only few
 * directions are shared, no edge repeats. */
vec2 pixel_shift()
{
    return vec2(tile_order() / 16.0, 0.0) + tile_number(0u).xy;
}

#if LSF_VOXEL_DRAW
/* Numbers of the point's i-th draw. Each draw of a tile has its own part of the list; the second number goes on by the
 * golden ratio. Iterations move both as they move cones. */
vec2 draw_number(int i)
{
    vec2 steps = vec2(1.0 / (16.0 * float(cone_draws)), 0.6180339887);
    return fract(tile_number(1u).xy + (tile_order() + 16.0 * float(i)) * steps + cone_gather.xw);
}
#endif

#if LSF_EMITTERS
/* Number of the point's i-th point on emitters. Those of a tile lie in the 16 cells of a square of 4 x 4; iterations
 * move them as they move cones. */
vec2 emitter_number(int i)
{
    uint order = uint(tile_order());
    vec2 cell = vec2(order & 3u, order >> 2) / 4.0;
    return fract(cell + tile_number(2u).xy + cone_gather.xw + float(i) * vec2(0.7548776662, 0.5698402910));
}

/* Adds light of points drawn on emitters, weighted against cones and the ray of the specular lobe, which find it by
 * chance. */
void add_emitters(surface s, vec3 point, vec3 to_viewer)
{
    int count = int(emitters.y);
    for (int i = 0; i < count; i++) {
        emitter_view e;
        if (!cone_emitter(emitter_number(i), point, s.geometric_normal, s.normal, e))
            continue;
        float cosine = dot(s.normal, e.direction), density = emitters.y * e.density;
        float share = emitter_share(density, e.chance * cosine / LSF_PI);
        reflect_light(s, to_viewer, e.direction, cosine, cosine / density * share * e.radiance);
#if LSF_SPECULAR
        float pdf = brdf_pdf(lobe_sampler(s, to_viewer), e.direction);
        specular_out.rgb += lobe_reflects(s, to_viewer, e.direction, cosine) * e.radiance *
                            (emitter_share(density, e.chance * pdf) / density);
#endif
    }
}
#endif

void main()
{
    irradiance_out = vec4(0.0);
#if LSF_SPECULAR
    specular_out = vec4(0.0);
#endif
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, pixel, 0).r;
    if (depth == 0.0)
        return;
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, pixel, 0), s);
#endif
    vec2 ndc = position_ndc(pixel);
    vec3 point = voxel_from_position(position_from_depth(ndc, depth));
    vec3 to_viewer = surface_view(s, -normalize(view_ray_direction(ndc)));
    vec3 tangent, bitangent;
    orthonormal_basis(s.normal, tangent, bitangent);
    vec2 shift = pixel_shift();
    int count = int(cone_gather.z);
    float share = 1.0 / cone_gather.z;
    for (int i = 0; i < count; i++) {
        vec3 local = cone_direction(i, shift);
        vec3 direction = local.x * tangent + local.y * bitangent + local.z * s.normal;
        if (dot(direction, s.geometric_normal) <= 0.0)
            continue;
        float chance = cone_gather.z * local.z / LSF_PI;
        cone_light light = cone_trace(point, s.geometric_normal, direction, chance, cone_set[i].w);
        reflect_light(s, to_viewer, direction, local.z, share * LSF_PI * arriving(light, direction, chance));
        irradiance_out.a += share * light.transmittance.g;
    }
#if LSF_VOXEL_DRAW
    for (int i = 0; i < cone_draws; i++) {
        voxel_drawn drawn;
        bool faces = voxel_draw(draw_number(i), point, drawn);
        float cosine = dot(s.normal, drawn.direction);
        if (!faces || cosine <= 0.0 || dot(drawn.direction, s.geometric_normal) <= 0.0)
            continue;
        vec3 light = cone_draw(drawn, point, s.geometric_normal, cosine, cone_gather.z);
        reflect_light(s, to_viewer, drawn.direction, cosine, cosine * grid.unit.x * light);
    }
#endif
#if LSF_EMITTERS
    add_emitters(s, point, to_viewer);
#endif
#if LSF_SPECULAR
    specular_out.rgb += lobe_light(s, point, to_viewer);
#endif
}
