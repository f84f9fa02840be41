/* Numbers that decide by chance, anew in each iteration. */
#ifndef LSF_LIB_CHANCE
#define LSF_LIB_CHANCE

#include "lib/hash.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_CHANCE) uniform uvec2 chance; /* seed, iteration; lsf_iteration_set_chance */

/* 0 <= u < 1; the same for the same key. */
float chance_number(uvec3 key)
{
    return hash_unit(hash(key ^ hash(uvec3(chance, 0u)))).x;
}

#endif
