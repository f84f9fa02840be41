/* How much of the environment's light without shadows a pixel counts on; see src/passes/open_sky.md. Switch
 * LSF_SKY_CONTROL, lsf_sky_control. */
#ifndef LSF_LIB_SKY_CONTROL
#define LSF_LIB_SKY_CONTROL

#define LSF_SKY_CONTROL_SHARE 1

/* What directions have found of the light that they would bring without shadows, for the diffuse lobe (x) and the
 * specular one (y). */
struct sky_found {
    vec2 lit;   /* sums of the product of both */
    vec2 whole; /* ... of the squares of what there would be */
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

/* The share to count on, of either lobe, by directions that are independent of those that count on it: what these
 * have found, as if one more, that could have brought as much as any of them, had been dark. */
vec2 sky_control_share(sky_found found)
{
#if LSF_SKY_CONTROL == LSF_SKY_CONTROL_SHARE
    vec2 whole = found.whole + found.most;
    return vec2(whole.x > 0.0 ? found.lit.x / whole.x : 0.0, whole.y > 0.0 ? found.lit.y / whole.y : 0.0);
#else
    return vec2(1.0);
#endif
}

#endif
