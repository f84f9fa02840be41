/* A diffuse virtual point light of a cloud of many, storage buffer. Normalised space; 32 bytes. */
#ifndef LSF_SHARED_VPL_RECORD_H
#define LSF_SHARED_VPL_RECORD_H

#include "shared/shared.h"

/* A cloud is a buffer of as many as it has room for. Any of them may be dead, and is no light: its
 * intensity is 0. */
struct lsf_vpl_record {
    vec3 position;
    uint normal;    /* unit geometric normal of the side that shines, as octahedral_encode has it */
    vec3 intensity; /* I along the normal [W/sr]; along another direction w it is I max(n.w, 0) */
    uint depth;     /* times that the light was reflected; 0: on a surface that emits */
};

#include "shared/shared_end.h"
#endif
