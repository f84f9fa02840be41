/* Alpha masks, and surfaces that are there by chance: what is blended with alpha a (alphaMode BLEND) is there with
 * probability a, anew in each iteration, so that the mean over iterations is the blend. Each layer decides for
 * itself at each place: two of alpha a and b let (1 - a) (1 - b) through. Switch LSF_BLEND. */
#ifndef LSF_LIB_ALPHA
#define LSF_LIB_ALPHA

#include "shared/scene_data.h"

#if LSF_BLEND || LSF_STRAIGHT
#include "lib/chance.glsl"
#endif

/* Tells a layer of an instance from others over the same place: by its triangle's last vertex, and by the side
 * that is seen where a surface folds at that vertex. */
uint layer_key(uint instance, uint vertex, bool front)
{
#if LSF_BLEND || LSF_STRAIGHT
    return hash(uvec3(instance, vertex, front)).x;
#else
    return 0u;
#endif
}

/* Whether a surface of this alpha is missing. `cutoff`: of lsf_material_data; `key`: of layer and place. */
bool alpha_cuts_out(float cutoff, float alpha, uvec3 key)
{
#if LSF_BLEND
    if (cutoff == LSF_ALPHA_BLENDED)
        cutoff = chance_even_number(key);
#endif
    return alpha < cutoff;
}

#endif
