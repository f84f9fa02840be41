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
    vec2 most;  /* the largest of these squares */
};

sky_found sky_found_nothing()
{
    return sky_found(vec2(0.0), vec2(0.0), vec2(0.0));
}

sky_found sky_found_both(sky_found a, sky_found b)
{
    return sky_found(a.lit + b.lit, a.whole + b.whole, max(a.most, b.most));
}

/* The share to use, for either lobe, from directions that are independent of those that use it: their regression,
 * with one more direction added that is as bright as the largest of them: none of it arrives for the diffuse
 * lobe, and for the specular lobe, which few directions reach, the share that arrives of diffuse light. */
vec2 sky_control_share(sky_found found)
{
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    vec2 whole = found.whole + found.most;
    float diffuse = whole.x > 0.0 ? found.lit.x / whole.x : 0.0;
    return vec2(diffuse, whole.y > 0.0 ? (found.lit.y + diffuse * found.most.y) / whole.y : diffuse);
#else
    return vec2(1.0);
#endif
}

#endif
