/* Hits on surfaces that coincide: the search lists them, ray_bundle_ties.comp.glsl chooses. */
#ifndef LSF_PASSES_RAY_BUNDLE_TIES
#define LSF_PASSES_RAY_BUNDLE_TIES

layout(std430, binding = LSF_BINDING_TIES) LSF_BUNDLE_TIE_ACCESS buffer lsf_tie_block
{
    uint tie_count;
    uint ties[]; /* pixels: x | y << 16 */
};

/* Lanes without work walk through software GL's loops up to the cap: caps are low, and long lists
 * take several turns. */
#define LSF_STEPS 64u
#define LSF_TURNS 65535u

#endif
