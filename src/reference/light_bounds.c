#include "reference/light_bounds.h"

#include "shared/light.h"

static float clamp_cosine(float x)
{
    return fminf(fmaxf(x, -1.0f), 1.0f);
}

/* The narrowest cone that contains two others. */
static void unite_cones(const lsf_light_bounds *a, const lsf_light_bounds *b, lsf_light_bounds *out)
{
    if (b->cos_spread < a->cos_spread) {
        const lsf_light_bounds *wider = b;
        b = a;
        a = wider;
    }
    lsf_float3 axis = lsf_f3_load(a->axis), other = lsf_f3_load(b->axis);
    /* The axis of a two-sided emitter has no sign. */
    if (a->two_sided && b->two_sided && lsf_f3_dot(axis, other) < 0.0f)
        other = lsf_f3_scale(other, -1.0f);
    float spread = acosf(clamp_cosine(a->cos_spread));
    float between = acosf(clamp_cosine(lsf_f3_dot(axis, other)));
    float reach = between + acosf(clamp_cosine(b->cos_spread));
    if (reach > spread) {
        float united = 0.5f * (spread + reach);
        lsf_float3 across = lsf_f3_mad(other, axis, -lsf_f3_dot(axis, other));
        across = lsf_f3_normalize_or(across, lsf_basis_about(axis).t);
        float angle = united - spread;
        axis = lsf_f3_mad(lsf_f3_scale(axis, cosf(angle)), across, sinf(angle));
        axis = lsf_f3_normalize(axis);
        spread = united + LSF_LIGHT_ROUNDING;
    }
    lsf_f3_store(out->axis, axis);
    out->cos_spread = spread < LSF_PI ? cosf(spread) : -1.0f;
}

lsf_light_bounds lsf_light_bounds_union(const lsf_light_bounds *a, const lsf_light_bounds *b)
{
    lsf_light_bounds out = {
        .cos_emission = fminf(a->cos_emission, b->cos_emission),
        .intensity = a->intensity + b->intensity,
        .range = fmaxf(a->range, b->range),
        .two_sided = a->two_sided || b->two_sided,
    };
    for (int i = 0; i < 3; i++) {
        out.low[i] = fminf(a->low[i], b->low[i]);
        out.high[i] = fmaxf(a->high[i], b->high[i]);
    }
    unite_cones(a, b, &out);
    return out;
}

/* Equation 1 of Conty Estevez and Kulla: the solid angle of directions in the cone and, weighted
 * by their cosine, beyond it. In place of their surface area stands the squared diagonal,
 * because lights may be points on a line. */
float lsf_light_bounds_cost(const lsf_light_bounds *b)
{
    float cosine = clamp_cosine(b->cos_spread), spread = acosf(cosine), sine = sinf(spread);
    float end = fminf(spread + acosf(clamp_cosine(b->cos_emission)), LSF_PI);
    float directions =
        2.0f * LSF_PI * (1.0f - cosine) +
        0.5f * LSF_PI *
            (2.0f * end * sine - cosf(spread - 2.0f * end) - 2.0f * spread * sine + cosine);
    lsf_float3 diagonal = lsf_f3_sub(lsf_f3_load(b->high), lsf_f3_load(b->low));
    return b->intensity * fmaxf(directions, 0.0f) * lsf_f3_dot(diagonal, diagonal);
}
