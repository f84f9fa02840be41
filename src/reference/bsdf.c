#include "reference/bsdf.h"

#include "math/sampling.h"
#include "shared/brdf.h"

static lsf_float3 specular_f0(const lsf_reference_surface *s)
{
    lsf_float3 dielectric = lsf_f3(s->f0_dielectric, s->f0_dielectric, s->f0_dielectric);
    return lsf_f3_mad(lsf_f3_scale(dielectric, 1.0f - s->metallic), s->base_color, s->metallic);
}

static lsf_float3 fresnel(lsf_float3 f0, float vh)
{
    return lsf_f3(lsf_fresnel_schlick(f0.x, vh), lsf_fresnel_schlick(f0.y, vh),
                  lsf_fresnel_schlick(f0.z, vh));
}

/* By the share of the light that each lobe would reflect if the surface were smooth. */
static float choose_specular_probability(const lsf_reference_surface *s, float nv)
{
    float diffuse = lsf_f3_luminance(s->base_color) * (1.0f - s->metallic);
    if (!s->specular)
        return diffuse > 0.0f ? 0.0f : -1.0f;
    diffuse *= 1.0f - lsf_fresnel_schlick(s->f0_dielectric, nv);
    float specular = lsf_f3_luminance(fresnel(specular_f0(s), nv));
    if (!(diffuse > 0.0f))
        return 1.0f;
    /* Both lobes stay likely enough for either to carry what the other cannot. */
    return fminf(fmaxf(specular / (specular + diffuse), 0.1f), 0.9f);
}

/* An interpolated or mapped normal may look away from a viewer who sees the surface. The view is
 * then lifted to the horizon for all purposes: with the true one, the half vector could meet the
 * normal in directions that reflect nothing, and the value would have no bound. */
void lsf_reference_bsdf_init(lsf_reference_bsdf *bsdf, const lsf_reference_surface *surface)
{
    lsf_float3 view = lsf_basis_to_local(&surface->frame, surface->view);
    view.z = fmaxf(view.z, LSF_COSINE_MIN);
    bsdf->surface = surface;
    bsdf->view = lsf_f3_normalize(view);
    bsdf->specular_probability =
        surface->reflects ? choose_specular_probability(surface, bsdf->view.z) : -1.0f;
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

static float pdf(const lsf_reference_bsdf *bsdf, lsf_float3 light, lsf_float3 half)
{
    const lsf_reference_surface *s = bsdf->surface;
    float p = bsdf->specular_probability;
    float result = (1.0f - p) * light.z / LSF_PI;
    if (p > 0.0f)
        result += p * lsf_pdf_ggx_reflection(bsdf->view, half, s->alpha_t, s->alpha_b);
    return result;
}

lsf_reference_reflection lsf_reference_bsdf_evaluate(const lsf_reference_bsdf *bsdf,
                                                     lsf_float3 light)
{
    lsf_reference_reflection result = {.pdf = 0.0f};
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 l = lsf_basis_to_local(&s->frame, light);
    if (bsdf->specular_probability < 0.0f || l.z <= 0.0f ||
        lsf_f3_dot(s->geometric_normal, light) <= 0.0f)
        return result;
    lsf_float3 sum = lsf_f3_add(bsdf->view, l);
    lsf_float3 half = lsf_f3_normalize_or(sum, lsf_f3(0.0f, 0.0f, 1.0f));
    /* v.h = |v + l| / 2, which keeps its sign at grazing angles as the product would not. */
    float vh = fminf(0.5f * lsf_f3_length(sum), 1.0f);
    float nl = fminf(l.z, 1.0f);
    result.pdf = pdf(bsdf, l, half);
    float diffuse = (1.0f - s->metallic) * nl / LSF_PI;
    if (s->specular) {
        diffuse *= 1.0f - lsf_fresnel_schlick(s->f0_dielectric, vh);
        float specular = ggx(s, bsdf->view, fminf(bsdf->view.z, 1.0f), l, nl, half) * nl;
        result.specular = lsf_f3_scale(fresnel(specular_f0(s), vh), specular);
    }
    result.diffuse = lsf_f3_scale(s->base_color, diffuse);
    return result;
}

lsf_float3 lsf_reference_bsdf_sample(const lsf_reference_bsdf *bsdf, float lobe, const float u[2])
{
    const lsf_reference_surface *s = bsdf->surface;
    lsf_float3 light;
    if (lobe < bsdf->specular_probability) {
        lsf_float3 half =
            lsf_sample_ggx_visible_normal(bsdf->view, s->alpha_t, s->alpha_b, u[0], u[1]);
        float vh = lsf_f3_dot(bsdf->view, half);
        light = lsf_f3_sub(lsf_f3_scale(half, 2.0f * vh), bsdf->view);
    } else {
        light = lsf_sample_cosine_hemisphere(u[0], u[1]);
    }
    return lsf_f3_normalize(lsf_basis_to_world(&s->frame, light));
}
