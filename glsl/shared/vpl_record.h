/* A diffuse virtual point light of a cloud of many, storage buffer. Normalised space; 32 bytes. */
#ifndef LSF_SHARED_VPL_RECORD_H
#define LSF_SHARED_VPL_RECORD_H

#include "shared/shared.h"

/* A cloud is a buffer of a fixed number of records. Any of them may be dead, with intensity 0. */
struct lsf_vpl_record {
    vec3 position;
    uint normal;    /* unit geometric normal of the emitting side, by octahedral_encode */
    vec3 intensity; /* I along the normal [W/sr]; along another direction w it is I max(n.w, 0) */
    uint depth;     /* number of reflections of the light; 0: on an emissive surface */
};

#include "shared/shared_end.h"
#endif
