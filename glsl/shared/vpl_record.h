/* A virtual point light of a cloud of many, storage buffer. Normalised space; 32 bytes. */
#ifndef LSF_SHARED_VPL_RECORD_H
#define LSF_SHARED_VPL_RECORD_H

#include "shared/shared.h"

/* The low bits of `depth_and_lobe`. */
#define LSF_VPL_DEPTH_MASK 63u

/* A cloud is a buffer of a fixed number of records. Any of them may be dead, with intensity 0. */
struct lsf_vpl_record {
    vec3 position;
    uint normal;    /* unit geometric normal of the emitting side, by octahedral_encode */
    vec3 intensity; /* I [W/sr]; along a direction w it is I max(n.w, 0) times the lobe, which is 1
                     * for diffuse light; the flux is pi I for any lobe */
    uint depth_and_lobe; /* number of reflections of the light, at most 63; 0: on an emissive
                          * surface. The bits above: lib/vpl_lobe.glsl, all 0 for diffuse light */
};

#include "shared/shared_end.h"
#endif
