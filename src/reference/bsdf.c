#include "reference/bsdf.h"

#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/sheen.h"

/* Fresnel reflectance of a microfacet under the cosine vh. */
static lsf_float3 fresnel(const lsf_reference_surface *s, float vh)
{
    lsf_float3 f0 = lsf_f3_scale(s->f0_dielectric, 1.0f - s->metallic);
    f0 = lsf_f3_mad(f0, s->base_color, s->metallic);
    float f90 = 1.0f - (1.0f - s->f90_dielectric) * (1.0f - s->metallic);
    return lsf_f3(lsf_fresnel_interface_to(f0.x, f90, vh, s->eta),
                  lsf_fresnel_interface_to(f0.y, f90, vh, s->eta),
                  lsf_fresnel_interface_to(f0.z, f90, vh, s->eta));
}

/* Share that the dielectric passes on to the layers below, the same for all colours. */
static float below_dielectric(const lsf_reference_surface *s, float vh)
{
    float f0 = lsf_f3_max(s->f0_dielectric);
    return 1.0f - lsf_fresnel_interface_to(f0, s->f90_dielectric, vh, s->eta);
}

/* Share that is transmitted. */
static lsf_float3 transmittance(const lsf_reference_surface *s, float vh)
{
    float passes = below_dielectric(s, vh);
    return lsf_f3_scale(s->base_color, passes * s->transmission * (1.0f - s->metallic));
}

/* Probability that a microfacet that is drawn reflects instead of transmitting. */
static float reflected_share(const lsf_reference_surface *s, float vh)
{
    float transmitted = lsf_f3_luminance(transmittance(s, vh));
    if (!(transmitted > 0.0f))
        return 1.0f;
    float reflected = lsf_f3_luminance(fresnel(s, vh));
    return reflected / (reflected + transmitted);
}

/* Probabilities follow the share of light that each lobe would pass on if the surface were
 * smooth. */
static float choose_specular_probability(const lsf_reference_surface *s, float nv)
{
    float diffuse =
        lsf_f3_luminance(s->base_color) * (1.0f - s->metallic) * (1.0f - s->transmission);
    if (!s->specular)
        return diffuse > 0.0f ? 0.0f : -1.0f;
    float sheen = lsf_f3_luminance(s->sheen_color);
    if (!(diffuse * (1.0f - lsf_f3_max(s->f0_dielectric)) + sheen > 0.0f))
        return 1.0f;
    /* The sheen is broad and is sampled by the diffuse lobe. */
    diffuse = diffuse * below_dielectric(s, nv) +
              sheen * fminf(lsf_sheen_albedo(nv, s->sheen_roughness), 1.0f);
    float specular = lsf_f3_luminance(lsf_f3_add(fresnel(s, nv), transmittance(s, nv)));
    /* Both lobes keep a least probability, because neither can stand in for the other. */
    return fminf(fmaxf(specular / (specular + diffuse), 0.1f), 0.9f);
}

/* Probability by the share of light that it would reflect if it were smooth. */
static void init_coat(lsf_reference_bsdf *bsdf)
{
    const lsf_reference_surface *s = bsdf->surface;
    bsdf->coat_probability = 0.0f;
    if (s->coat == 0.0f || bsdf->specular_probability < 0.0f)
        return;
    bsdf->coat_frame = lsf_basis_about(s->coat_normal);
    lsf_float3 view = lsf_basis_to_local(&bsdf->coat_frame, s->view);
    view.z = fmaxf(view.z, LSF_COSINE_MIN);
    bsdf->coat_view = lsf_f3_normalize(view);
    float reflects = 1.0f - lsf_coat_passes(s->coat, bsdf->coat_view.z);
    float below = fmaxf(lsf_f3_luminance(s->base_color),
                        lsf_f3_luminance(fresnel(s, fminf(bsdf->view.z, 1.0f))));
    below *= 1.0f - reflects;
    bsdf->coat_probability = fminf(fmaxf(reflects / (reflects + below), 0.1f), 0.9f);
}

/* An interpolated or mapped normal may face away from a viewer who sees the surface. The view is
 * then lifted to the horizon for all purposes: with the true one, the half vector could meet the
 * normal in directions that reflect nothing, and the value would be unbounded. */
void lsf_reference_bsdf_init(lsf_reference_bsdf *bsdf, const lsf_reference_surface *surface)
{
    lsf_float3 view = lsf_basis_to_local(&surface->frame, surface->view);
    view.z = fmaxf(view.z, LSF_COSINE_MIN);
    bsdf->surface = surface;
    bsdf->view = lsf_f3_normalize(view);
    bsdf->specular_probability =
        surface->reflects ? choose_specular_probability(surface, bsdf->view.z) : -1.0f;
    init_coat(bsdf);
}

/* Factor by which a clear coat attenuates the layers below it. */
static float passes_coat(const lsf_reference_bsdf *bsdf, lsf_float3 light)
{
    const lsf_reference_surface *s = bsdf->surface;
    float nl = fabsf(lsf_f3_dot(bsdf->coat_frame.n, light));
    return lsf_coat_passes(s->coat, bsdf->coat_view.z) * lsf_coat_passes(s->coat, nl);
}

/* Adds the sheen to the value of the layers below it for light from the local direction l. */
static lsf_reference_reflection add_sheen(const lsf_reference_bsdf *bsdf, lsf_float3 l,
                                          lsf_reference_reflection below)
{
    const lsf_reference_surface *s = bsdf->surface;
    float color = lsf_f3_max(s->sheen_color), roughness = s->sheen_roughness;
    if (color == 0.0f)
        return below;
    float nv = fminf(bsdf->view.z, 1.0f), nl = fminf(fmaxf(fabsf(l.z), LSF_COSINE_MIN), 1.0f);
    float albedo_v = lsf_sheen_albedo(nv, roughness), albedo_l = lsf_sheen_albedo(nl, roughness);
    float leaves = lsf_sheen_leaves(color, albedo_v, albedo_l);
    below.diffuse = lsf_f3_scale(below.diffuse, leaves);
    below.specular = lsf_f3_scale(below.specular, leaves);
    if (l.z <= 0.0f)
        return below;
    lsf_float3 half = lsf_f3_normalize_or(lsf_f3_add(bsdf->view, l), lsf_f3(0.0f, 0.0f, 1.0f));
    float lobe = lsf_sheen_lobe(nv, nl, half.x * half.x + half.y * half.y, roughness) /
                 fmaxf(fmaxf(albedo_v, albedo_l), 1.0f);
    below.specular = lsf_f3_mad(below.specular, s->sheen_color, lobe * l.z);
    return below;
}

/* Adds the coat to the value of the layers below it for light from the direction `light`;
 * `reflects`: that is on the viewer's side. */
static lsf_reference_reflection add_coat(const lsf_reference_bsdf *bsdf, lsf_float3 light,
                                         bool reflects, lsf_reference_reflection below)
{
    const lsf_reference_surface *s = bsdf->surface;
    if (s->coat == 0.0f)
        return below;
    float passes = passes_coat(bsdf, light);
    below.diffuse = lsf_f3_scale(below.diffuse, passes);
    below.specular = lsf_f3_scale(below.specular, passes);
    below.pdf *= 1.0f - bsdf->coat_probability;
    lsf_float3 l = lsf_basis_to_local(&bsdf->coat_frame, light), v = bsdf->coat_view;
    if (!reflects || l.z <= 0.0f)
        return below;
    lsf_float3 sum = lsf_f3_add(v, l);
    lsf_float3 half = lsf_f3_normalize_or(sum, lsf_f3(0.0f, 0.0f, 1.0f));
    float vh = fminf(0.5f * lsf_f3_length(sum), 1.0f), nl = fminf(l.z, 1.0f);
    float lobe = s->coat * lsf_fresnel_schlick(LSF_COAT_F0, vh) * nl *
                 lsf_ggx_d(half.z, half.x * half.x + half.y * half.y, s->coat_alpha) *
                 lsf_ggx_v(nl, fminf(v.z, 1.0f), s->coat_alpha);
    below.specular = lsf_f3_add(below.specular, lsf_f3(lobe, lobe, lobe));
    below.pdf +=
        bsdf->coat_probability * lsf_pdf_ggx_reflection(v, half, s->coat_alpha, s->coat_alpha);
    return below;
}

static float ggx(const lsf_reference_surface *s, lsf_float3 view, float nv, lsf_float3 light,
                 float nl, lsf_float3 half)
{
    float nh = fmaxf(half.z, 0.0f);
    if (s->alpha_t != s->alpha_b)
        return lsf_ggx_d_anisotropic(nh, half.x, half.y, s->alpha_t, s->alpha_b) *
               lsf_ggx_v_anisotropic(nl, nv, light.x, light.y, view.x, view.y, s->alpha_t,
                                     s->alpha_b);
    return lsf_ggx_d(nh, half.x * half.x + half.y * half.y, s->alpha_b) *
           lsf_ggx_v(nl, nv, s->alpha_b);
}

/* A pair of directions on the same side, and the microfacet between them. */
typedef struct mirror {
    lsf_float3 half;
    float vh, nl;
    float lobe; /* D V nl */
    float pdf;  /* density of drawing the microfacet, per steradian of the direction */
} mirror;

static mirror mirror_between(const lsf_reference_bsdf *bsdf, lsf_float3 l)
{
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 sum = lsf_f3_add(bsdf->view, l);
    mirror m = {.half = lsf_f3_normalize_or(sum, lsf_f3(0.0f, 0.0f, 1.0f)),
                /* v.h = |v + l| / 2, which keeps its sign at grazing angles, unlike the product. */
                .vh = fminf(0.5f * lsf_f3_length(sum), 1.0f),
                .nl = fminf(l.z, 1.0f)};
    if (s->specular && bsdf->specular_probability > 0.0f) {
        m.lobe = ggx(s, bsdf->view, fminf(bsdf->view.z, 1.0f), l, m.nl, m.half) * m.nl;
        m.pdf = bsdf->specular_probability *
                lsf_pdf_ggx_reflection(bsdf->view, m.half, s->alpha_t, s->alpha_b);
    }
    return m;
}

static lsf_reference_reflection reflect(const lsf_reference_bsdf *bsdf, lsf_float3 l)
{
    const lsf_reference_surface *s = bsdf->surface;
    mirror m = mirror_between(bsdf, l);
    lsf_reference_reflection result = {.pdf = (1.0f - bsdf->specular_probability) * l.z / LSF_PI};
    float diffuse = (1.0f - s->metallic) * (1.0f - s->transmission) * m.nl / LSF_PI;
    if (s->specular) {
        result.pdf += m.pdf * reflected_share(s, m.vh);
        diffuse *= below_dielectric(s, m.vh);
        result.specular = lsf_f3_scale(fresnel(s, m.vh), m.lobe);
    }
    result.diffuse = lsf_f3_scale(s->base_color, diffuse);
    return result;
}

/* Transmission of a thin wall: the reflection, mirrored to the other side
 * (KHR_materials_transmission). */
static lsf_reference_reflection pass_wall(const lsf_reference_bsdf *bsdf, lsf_float3 l)
{
    const lsf_reference_surface *s = bsdf->surface;
    mirror m = mirror_between(bsdf, lsf_f3(l.x, l.y, -l.z));
    return (lsf_reference_reflection){.specular = lsf_f3_scale(transmittance(s, m.vh), m.lobe),
                                      .pdf = m.pdf * (1.0f - reflected_share(s, m.vh))};
}

/* Walter et al. 2007, equation 21, for radiance over the square of the index: T D_v(h) G1(l) J. */
static lsf_reference_reflection refract(const lsf_reference_bsdf *bsdf, lsf_float3 l)
{
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 half =
        lsf_f3_normalize_or(lsf_f3_mad(bsdf->view, l, s->eta), lsf_f3(0.0f, 0.0f, 1.0f));
    if (half.z < 0.0f)
        half = lsf_f3_scale(half, -1.0f);
    float vh = lsf_f3_dot(bsdf->view, half), lh = lsf_f3_dot(l, half);
    if (vh <= 0.0f || lh >= 0.0f)
        return (lsf_reference_reflection){.pdf = 0.0f};
    vh = fminf(vh, 1.0f);
    float drawn = lsf_pdf_ggx_visible_normal(bsdf->view, half, s->alpha_t, s->alpha_b) *
                  lsf_refraction_jacobian(vh, lh, s->eta);
    float unmasked = lsf_ggx_g1(-l.z, l.x, l.y, s->alpha_t, s->alpha_b);
    float share = 1.0f - reflected_share(s, vh);
    return (lsf_reference_reflection){.specular =
                                          lsf_f3_scale(transmittance(s, vh), drawn * unmasked),
                                      .pdf = bsdf->specular_probability * drawn * share};
}

bool lsf_reference_is_clear(const lsf_reference_surface *s)
{
    return s->transmission > 0.0f && !s->volume && fmaxf(s->alpha_t, s->alpha_b) <= LSF_ALPHA_MIN;
}

lsf_float3 lsf_reference_straight(const lsf_reference_surface *s)
{
    if (!lsf_reference_is_clear(s))
        return lsf_f3(0.0f, 0.0f, 0.0f);
    return transmittance(s, fminf(fmaxf(lsf_f3_dot(s->frame.n, s->view), LSF_COSINE_MIN), 1.0f));
}

lsf_reference_reflection lsf_reference_bsdf_evaluate(const lsf_reference_bsdf *bsdf,
                                                     lsf_float3 light)
{
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 l = lsf_basis_to_local(&s->frame, light);
    float side = lsf_f3_dot(s->geometric_normal, light);
    if (bsdf->specular_probability >= 0.0f && l.z > 0.0f && side > 0.0f)
        return add_coat(bsdf, light, true, add_sheen(bsdf, l, reflect(bsdf, l)));
    if (bsdf->specular_probability > 0.0f && s->transmission > 0.0f && l.z < 0.0f && side < 0.0f)
        return add_coat(bsdf, light, false,
                        add_sheen(bsdf, l, s->eta == 1.0f ? pass_wall(bsdf, l) : refract(bsdf, l)));
    return (lsf_reference_reflection){.pdf = 0.0f};
}

/* Draws a direction from a microfacet; `u` chooses between reflection and transmission. A rough
 * surface's microfacet may send light to the wrong side of the surface, where it would hit other
 * microfacets: such light is lost. */
static lsf_float3 leave_microfacet(const lsf_reference_bsdf *bsdf, lsf_float3 half, float u)
{
    const lsf_reference_surface *s = bsdf->surface;
    const lsf_float3 lost = {0.0f, 0.0f, 0.0f};
    float vh = lsf_f3_dot(bsdf->view, half);
    lsf_float3 mirrored = lsf_f3_sub(lsf_f3_scale(half, 2.0f * vh), bsdf->view);
    if (u < reflected_share(s, fminf(vh, 1.0f)))
        return mirrored.z > 0.0f ? mirrored : lost;
    if (s->eta == 1.0f)
        return mirrored.z > 0.0f ? lsf_f3(mirrored.x, mirrored.y, -mirrored.z) : lost;
    float beyond = lsf_refracted_cosine(vh, s->eta);
    lsf_float3 along = lsf_f3_scale(bsdf->view, -1.0f / s->eta);
    lsf_float3 refracted = lsf_f3_mad(along, half, vh / s->eta - beyond);
    return refracted.z < 0.0f ? refracted : lost;
}

lsf_float3 lsf_reference_bsdf_sample(const lsf_reference_bsdf *bsdf, float lobe, const float u[2])
{
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 light;
    if (lobe < bsdf->coat_probability) {
        lsf_float3 v = bsdf->coat_view;
        lsf_float3 half =
            lsf_sample_ggx_visible_normal(v, s->coat_alpha, s->coat_alpha, u[0], u[1]);
        light = lsf_f3_sub(lsf_f3_scale(half, 2.0f * lsf_f3_dot(v, half)), v);
        return lsf_f3_normalize_or(lsf_basis_to_world(&bsdf->coat_frame, light), light);
    }
    lobe = (lobe - bsdf->coat_probability) / (1.0f - bsdf->coat_probability);
    if (lobe < bsdf->specular_probability) {
        lsf_float3 half =
            lsf_sample_ggx_visible_normal(bsdf->view, s->alpha_t, s->alpha_b, u[0], u[1]);
        light = leave_microfacet(bsdf, half, lobe / bsdf->specular_probability);
    } else {
        light = lsf_sample_cosine_hemisphere(u[0], u[1]);
    }
    return lsf_f3_normalize_or(lsf_basis_to_world(&s->frame, light), light);
}
