/* Options of the tessellation that scene/tessellate.h does. */
#ifndef LSF_PLAN_TESSELLATION_H
#define LSF_PLAN_TESSELLATION_H

#include "plan/option.h"

typedef struct lsf_tessellation_params {
    int32_t factor; /* each triangle is split into its square; 1: as in the file */
    float shape;    /* 0: flat; 1: on the mean of the vertices' tangent planes */
} lsf_tessellation_params;

/* Three quarters: Boubekeur and Alexa 2008, section 2. */
#define LSF_TESSELLATION_PARAMS_DEFAULTS .factor = 1, .shape = 0.75f

#define LSF_TESSELLATION_OPTION_COUNT 2
extern const lsf_option_row lsf_tessellation_options[LSF_TESSELLATION_OPTION_COUNT];

#endif
