/* Control variate for the environment's light: the share of the unoccluded light that a pixel uses; see
 * src/passes/open_sky.md. Switch LSF_SKY_CONTROL, lsf_sky_control. */
#ifndef LSF_LIB_SKY_CONTROL
#define LSF_LIB_SKY_CONTROL

#define LSF_SKY_CONTROL_SHARE 1

/* Statistics of directions: light that arrived, against light that would arrive unoccluded, for the diffuse lobe
 * (x) and the specular one (y). */
struct sky_found {
    vec2 lit;   /* sums of the product of both */
    vec2 whole; /* sums of the squares of the unoccluded light */
    float most; /* the largest of these squares, diffuse */
};

sky_found sky_found_nothing()
{
    return sky_found(vec2(0.0), vec2(0.0), 0.0);
}

sky_found sky_found_both(sky_found a, sky_found b)
{
    return sky_found(a.lit + b.lit, a.whole + b.whole, max(a.most, b.most));
}

/* The share of diffuse light to use, from directions that are independent of those that use it: their regression,
 * with one more direction added that is as bright as the largest of them and of which nothing arrives. */
float sky_control_diffuse(sky_found found)
{
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    float whole = found.whole.x + found.most;
    return whole > 0.0 ? found.lit.x / whole : 0.0;
#else
    return 1.0;
#endif
}

/* The share of specular light, from all directions: few reach the lobe, so that half of them would say little.
 * Where none does, it is that of diffuse light. */
float sky_control_specular(sky_found found)
{
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    return found.whole.y > 0.0 ? found.lit.y / found.whole.y : sky_control_diffuse(found);
#else
    return 1.0;
#endif
}

#endif
