#include "reference/surface.h"

#include "scene/texture_sample.h"
#include "shared/brdf.h"

/* A hit's position in the vertex streams. */
typedef struct corner_weights {
    uint64_t vertices[3];
    float weights[3];
} corner_weights;

static corner_weights find_weights(const lsf_reference_geometry *geometry,
                                   const lsf_reference_hit *hit)
{
    corner_weights at = {.weights = {1.0f - hit->b1 - hit->b2, hit->b1, hit->b2}};
    lsf_reference_vertices(geometry, hit->instance, hit->triangle, at.vertices);
    return at;
}

static void interpolate(const float *stream, int components, const corner_weights *at, float *out)
{
    for (int c = 0; c < components; c++) {
        out[c] = 0.0f;
        for (int i = 0; i < 3; i++)
            out[c] += at->weights[i] * stream[components * at->vertices[i] + (unsigned)c];
    }
}

static lsf_texel sample_slot(const lsf_scene *scene, const lsf_texture_slot *slot,
                             const corner_weights *at)
{
    float uv[2] = {0.0f, 0.0f};
    const float *stream = slot->uv_set == 0 ? scene->vertices.uv0 : scene->vertices.uv1;
    if (stream != NULL)
        interpolate(stream, 2, at, uv);
    return lsf_texture_sample(scene, slot, uv);
}

static float saturate(float x)
{
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

/* Base colour and alpha: factor, texture and vertex colour. */
static lsf_texel base_color(const lsf_scene *scene, const lsf_material *material,
                            const corner_weights *at)
{
    const float *f = material->base_color;
    lsf_texel color = {f[0], f[1], f[2], f[3]};
    if (material->base_color_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(scene, &material->base_color_texture, at);
        color = (lsf_texel){color.r * t.r, color.g * t.g, color.b * t.b, color.a * t.a};
    }
    if (scene->vertices.color != NULL) {
        float c[4];
        interpolate(scene->vertices.color, 4, at, c);
        color = (lsf_texel){color.r * c[0], color.g * c[1], color.b * c[2], color.a * c[3]};
    }
    return color;
}

static const lsf_material *material_of(const lsf_reference_geometry *geometry,
                                       const lsf_reference_hit *hit)
{
    return &geometry->state->animated.materials[geometry->state->instances[hit->instance].material];
}

float lsf_reference_coverage(const lsf_reference_geometry *geometry, const lsf_reference_hit *hit)
{
    const lsf_material *material = material_of(geometry, hit);
    if (material->alpha_mode == LSF_ALPHA_OPAQUE)
        return 1.0f;
    corner_weights at = find_weights(geometry, hit);
    float alpha = base_color(geometry->scene, material, &at).a;
    if (material->alpha_mode == LSF_ALPHA_BLEND)
        return saturate(alpha);
    return alpha < material->alpha_cutoff ? 0.0f : 1.0f;
}

bool lsf_reference_material_emits(const lsf_material *material)
{
    return material->unlit || material->emission[0] > 0.0f || material->emission[1] > 0.0f ||
           material->emission[2] > 0.0f;
}

lsf_float3 lsf_reference_emission(const lsf_reference_geometry *geometry,
                                  const lsf_reference_hit *hit, bool front)
{
    const lsf_material *material = material_of(geometry, hit);
    bool emits = material->unlit || front || material->double_sided;
    if (!emits || !lsf_reference_material_emits(material))
        return lsf_f3(0.0f, 0.0f, 0.0f);
    corner_weights at = find_weights(geometry, hit);
    if (material->unlit) {
        lsf_texel color = base_color(geometry->scene, material, &at);
        return lsf_f3(color.r, color.g, color.b);
    }
    lsf_float3 emission = lsf_f3_load(material->emission);
    if (material->emissive_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(geometry->scene, &material->emissive_texture, &at);
        emission = lsf_f3_mul(emission, lsf_f3(t.r, t.g, t.b));
    }
    return emission;
}

/* Double precision keeps a direction even for the product of the smallest edges. */
lsf_float3 lsf_reference_triangle_normal(const lsf_reference_geometry *geometry, uint32_t instance,
                                         const lsf_float3 corners[3], float *area)
{
    double ax = (double)corners[1].x - corners[0].x, bx = (double)corners[2].x - corners[0].x;
    double ay = (double)corners[1].y - corners[0].y, by = (double)corners[2].y - corners[0].y;
    double az = (double)corners[1].z - corners[0].z, bz = (double)corners[2].z - corners[0].z;
    double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    double length = sqrt(x * x + y * y + z * z);
    if (area != NULL)
        *area = (float)(0.5 * length);
    if (!(length > 0.0))
        return lsf_f3(0.0f, 0.0f, 0.0f);
    if (geometry->state->instances[instance].mirrored)
        length = -length;
    return lsf_f3((float)(x / length), (float)(y / length), (float)(z / length));
}

static lsf_float3 transform_vector(const float *rows, int stride, lsf_float3 v)
{
    return lsf_f3(rows[0] * v.x + rows[1] * v.y + rows[2] * v.z,
                  rows[stride] * v.x + rows[stride + 1] * v.y + rows[stride + 2] * v.z,
                  rows[2 * stride] * v.x + rows[2 * stride + 1] * v.y + rows[2 * stride + 2] * v.z);
}

/* `t` projected perpendicular to the unit vector `n`, of unit length. */
static lsf_float3 perpendicular_part(lsf_float3 t, lsf_float3 n)
{
    t = lsf_f3_mad(t, n, -lsf_f3_dot(t, n));
    return lsf_f3_normalize_or(t, lsf_basis_about(n).t);
}

/* The front's shading frame: the interpolated normal and the file's tangents, as
 * `bitangent = cross(normal, tangent) * w` in object space. A mirrored instance mirrors the
 * bitangent with everything else, which flips its sign once more. */
static lsf_basis vertex_frame(const lsf_reference_geometry *geometry,
                              const lsf_instance_state *instance, const corner_weights *at,
                              lsf_float3 front_normal)
{
    const lsf_vertices *vertices = &geometry->state->pose.vertices;
    float n[3];
    interpolate(vertices->normal, 3, at, n);
    lsf_float3 normal = lsf_f3_normalize_or(
        transform_vector(instance->normal_transform, 3, lsf_f3_load(n)), front_normal);
    if (vertices->tangent == NULL)
        return lsf_basis_about(normal);
    float t[4];
    interpolate(vertices->tangent, 4, at, t);
    lsf_basis frame = {.n = normal};
    frame.t = perpendicular_part(transform_vector(instance->transform, 4, lsf_f3_load(t)), normal);
    float sign = (t[3] < 0.0f) != instance->mirrored ? -1.0f : 1.0f;
    frame.b = lsf_f3_scale(lsf_f3_cross(normal, frame.t), sign);
    return frame;
}

static lsf_basis map_normal(const lsf_scene *scene, const lsf_texture_slot *slot, float scale,
                            const corner_weights *at, lsf_basis frame)
{
    lsf_texel t = sample_slot(scene, slot, at);
    lsf_float3 local =
        lsf_f3((2.0f * t.r - 1.0f) * scale, (2.0f * t.g - 1.0f) * scale, 2.0f * t.b - 1.0f);
    lsf_float3 n = lsf_f3_normalize_or(lsf_basis_to_world(&frame, local), frame.n);
    float sign = lsf_f3_dot(lsf_f3_cross(frame.n, frame.t), frame.b) < 0.0f ? -1.0f : 1.0f;
    frame.n = n;
    frame.t = perpendicular_part(frame.t, n);
    frame.b = lsf_f3_scale(lsf_f3_cross(n, frame.t), sign);
    return frame;
}

/* KHR_materials_anisotropy: rotates frame.t to the direction of anisotropy and returns the
 * strength. */
static float orient_anisotropy(const lsf_scene *scene, const lsf_material *material,
                               const corner_weights *at, lsf_basis *frame)
{
    float strength = material->anisotropy_strength;
    float x = 1.0f, y = 0.0f;
    if (material->anisotropy_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(scene, &material->anisotropy_texture, at);
        x = 2.0f * t.r - 1.0f;
        y = 2.0f * t.g - 1.0f;
        strength *= t.b;
    }
    float c = cosf(material->anisotropy_rotation), s = sinf(material->anisotropy_rotation);
    lsf_float3 along = lsf_basis_to_world(frame, lsf_f3(c * x - s * y, s * x + c * y, 0.0f));
    frame->t = lsf_f3_normalize_or(along, frame->t);
    frame->b = lsf_f3_cross(frame->n, frame->t);
    return strength;
}

static void read_transmission(lsf_reference_surface *surface, const lsf_scene *scene,
                              const lsf_material *material, const corner_weights *at)
{
    float transmission = material->transmission;
    if (material->transmission_texture.texture != LSF_NONE)
        transmission *= sample_slot(scene, &material->transmission_texture, at).r;
    surface->transmission = saturate(transmission);
    surface->volume = material->volume && material->transmission > 0.0f;
    if (!surface->volume)
        return;
    float absorption[3];
    lsf_scene_absorption(scene, material, absorption);
    surface->absorption = lsf_f3_load(absorption);
    surface->eta = lsf_relative_ior(material->ior, surface->front);
    /* Without a change of index nothing is refracted, however rough the surface. */
    if (surface->eta == 1.0f)
        surface->alpha_t = surface->alpha_b = LSF_ALPHA_MIN;
}

/* KHR_materials_sheen. */
static void read_sheen(lsf_reference_surface *surface, const lsf_scene *scene,
                       const lsf_material *material, const corner_weights *at)
{
    lsf_float3 color = lsf_f3_load(material->sheen_color);
    float roughness = material->sheen_roughness;
    if (material->sheen_color_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(scene, &material->sheen_color_texture, at);
        color = lsf_f3_mul(color, lsf_f3(t.r, t.g, t.b));
    }
    if (material->sheen_roughness_texture.texture != LSF_NONE)
        roughness *= sample_slot(scene, &material->sheen_roughness_texture, at).a;
    surface->sheen_color = lsf_f3(saturate(color.x), saturate(color.y), saturate(color.z));
    surface->sheen_roughness = saturate(roughness);
}

/* KHR_materials_clearcoat, in the frame of the vertices, before any normal map. */
static void read_coat(lsf_reference_surface *surface, const lsf_scene *scene,
                      const lsf_material *material, const corner_weights *at)
{
    float roughness = material->coat_roughness;
    surface->coat = material->coat;
    surface->coat_normal = surface->frame.n;
    if (material->coat_texture.texture != LSF_NONE)
        surface->coat *= sample_slot(scene, &material->coat_texture, at).r;
    if (material->coat_roughness_texture.texture != LSF_NONE)
        roughness *= sample_slot(scene, &material->coat_roughness_texture, at).g;
    if (material->coat_normal_texture.texture != LSF_NONE)
        surface->coat_normal = map_normal(scene, &material->coat_normal_texture,
                                          material->coat_normal_scale, at, surface->frame)
                                   .n;
    surface->coat_alpha = lsf_alpha_from_roughness(saturate(roughness));
}

/* KHR_materials_specular. */
static void read_specular(lsf_reference_surface *surface, const lsf_scene *scene,
                          const lsf_material *material, const corner_weights *at)
{
    float f0 = lsf_f0_from_ior(material->ior), weight = material->specular;
    lsf_float3 tint = lsf_f3_load(material->specular_color);
    if (material->specular_texture.texture != LSF_NONE)
        weight *= sample_slot(scene, &material->specular_texture, at).a;
    if (material->specular_color_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(scene, &material->specular_color_texture, at);
        tint = lsf_f3_mul(tint, lsf_f3(t.r, t.g, t.b));
    }
    surface->f90_dielectric = weight;
    surface->f0_dielectric = lsf_f3_scale(
        lsf_f3(saturate(f0 * tint.x), saturate(f0 * tint.y), saturate(f0 * tint.z)), weight);
}

static void read_lobes(lsf_reference_surface *surface, const lsf_scene *scene,
                       const lsf_material *material, const corner_weights *at)
{
    float metallic = material->metallic, roughness = material->roughness;
    if (material->metallic_roughness_texture.texture != LSF_NONE) {
        lsf_texel t = sample_slot(scene, &material->metallic_roughness_texture, at);
        roughness *= t.g;
        metallic *= t.b;
    }
    surface->metallic = saturate(metallic);
    read_specular(surface, scene, material, at);
    surface->alpha_b = lsf_alpha_from_roughness(saturate(roughness));
    surface->alpha_t = surface->alpha_b;
    read_transmission(surface, scene, material, at);
    if (material->anisotropy_strength > 0.0f) {
        float strength = orient_anisotropy(scene, material, at, &surface->frame);
        surface->alpha_t = lsf_alpha_along_tangent(surface->alpha_b, saturate(strength));
    }
}

/* Double precision keeps the point within half a unit in the last place of the triangle's plane. */
static lsf_float3 position_within(const lsf_float3 corners[3], const lsf_reference_hit *hit)
{
    double b1 = hit->b1, b2 = hit->b2, b0 = 1.0 - b1 - b2;
    return lsf_f3((float)(b0 * corners[0].x + b1 * corners[1].x + b2 * corners[2].x),
                  (float)(b0 * corners[0].y + b1 * corners[1].y + b2 * corners[2].y),
                  (float)(b0 * corners[0].z + b1 * corners[1].z + b2 * corners[2].z));
}

lsf_float3 lsf_reference_hit_position(const lsf_reference_geometry *geometry,
                                      const lsf_reference_hit *hit)
{
    lsf_float3 corners[3];
    lsf_reference_corners(geometry, hit->instance, hit->triangle, corners);
    return position_within(corners, hit);
}

void lsf_reference_surface_init(lsf_reference_surface *surface,
                                const lsf_reference_geometry *geometry,
                                const lsf_reference_hit *hit, lsf_float3 direction)
{
    const lsf_scene *scene = geometry->scene;
    const lsf_instance_state *instance = &geometry->state->instances[hit->instance];
    const lsf_material *material = &geometry->state->animated.materials[instance->material];
    lsf_float3 corners[3];
    lsf_reference_corners(geometry, hit->instance, hit->triangle, corners);
    corner_weights at = find_weights(geometry, hit);
    lsf_float3 normal = lsf_reference_triangle_normal(geometry, hit->instance, corners, NULL);
    bool front = lsf_f3_dot(normal, direction) <= 0.0f;

    *surface = (lsf_reference_surface){
        .position = position_within(corners, hit),
        .geometric_normal = front ? normal : lsf_f3_scale(normal, -1.0f),
        .ray_offset = lsf_reference_ray_offset(corners),
        .view = lsf_f3_scale(direction, -1.0f),
        .emission = lsf_reference_emission(geometry, hit, front),
        .reflects = !material->unlit,
        .specular = !scene->diffuse_only && !material->unlit,
        .alpha_t = 1.0f,
        .alpha_b = 1.0f,
        .eta = 1.0f,
        .front = front,
    };
    lsf_texel color = base_color(scene, material, &at);
    surface->base_color = lsf_f3(color.r, color.g, color.b);
    surface->frame = vertex_frame(geometry, instance, &at, normal);
    if (surface->specular) {
        read_sheen(surface, scene, material, &at);
        read_coat(surface, scene, material, &at);
        if (material->normal_texture.texture != LSF_NONE)
            surface->frame = map_normal(scene, &material->normal_texture, material->normal_scale,
                                        &at, surface->frame);
        read_lobes(surface, scene, material, &at);
    }
    if (!front) {
        surface->coat_normal = lsf_f3_scale(surface->coat_normal, -1.0f);
        surface->frame.n = lsf_f3_scale(surface->frame.n, -1.0f);
        surface->frame.b = lsf_f3_scale(surface->frame.b, -1.0f);
    }
}
