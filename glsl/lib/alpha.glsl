/* Alpha masks and blending by stochastic transparency: a surface with alphaMode BLEND and alpha a is present with
 * probability a, drawn anew in each iteration, so that the mean over the iterations is the blend. Layers over the
 * same point are drawn independently: two of alpha a and b let (1 - a) (1 - b) through. Switch LSF_BLEND. */
#ifndef LSF_LIB_ALPHA
#define LSF_LIB_ALPHA

#include "shared/scene_data.h"

/* Surfaces may be present by chance, so that each layer of them needs a key. */
#if LSF_BLEND || LSF_STRAIGHT || defined(LSF_SEEN_THROUGH)
#define LSF_LAYERS 1
#include "lib/chance.glsl"
#endif

/* Key that tells one layer of an instance from others over the same point: the last vertex of its triangle, and
 * the side that is seen where a surface folds at that vertex. */
uint layer_key(uint instance, uint vertex, bool front)
{
#if LSF_LAYERS
    return hash(uvec3(instance, vertex, front)).x;
#else
    return 0u;
#endif
}

/* Whether a surface of this alpha is absent. `cutoff`: of lsf_material_data; `key`: of layer and position. */
bool alpha_cuts_out(float cutoff, float alpha, uvec3 key)
{
#if LSF_BLEND
    if (cutoff == LSF_ALPHA_BLENDED)
        cutoff = chance_even_number(key);
#endif
    return alpha < cutoff;
}

#endif
