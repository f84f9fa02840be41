/* Bindings of the sandbox for the resources that a user shader names, besides the units and
 * bindings of the library's own files. */
#ifndef LSF_SHARED_SANDBOX_DATA_H
#define LSF_SHARED_SANDBOX_DATA_H

#include "shared/shared.h"

/* Texture units. */
#define LSF_UNIT_CHANNEL 32 /* 4 of them */
#define LSF_UNIT_PICTURE 36
#define LSF_UNIT_PICTURE_DIRECT 37
#define LSF_UNIT_PICTURE_DIFFUSE 38
#define LSF_UNIT_PICTURE_SPECULAR 39
#define LSF_UNIT_SEEN_EMISSION 40
#define LSF_UNIT_SEEN_MOTION 41
#define LSF_UNIT_REFLECTIVE_SURFACE 42
#define LSF_UNIT_REFLECTIVE_SPECULAR_PARAMS 43
#define LSF_UNIT_BUNDLE_HITS 44

/* Storage buffer of the scene's lights; in other passes that of the VPLs. */
#define LSF_BINDING_SANDBOX_LIGHTS 1

/* A light without its map; as in shared/light_data.h. */
struct lsf_sandbox_light_data {
    vec4 position;    /* xyz */
    vec4 direction;   /* xyz: unit, away from the light */
    vec4 intensity;   /* rgb: W/sr in normalised units; directional W/m^2 */
    vec4 attenuation; /* 1/range^2, spot scale, spot offset (light.h), type */
};

#include "shared/shared_end.h"
#endif
