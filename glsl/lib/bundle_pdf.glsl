/* Density [1/sr] of ray-bundles by direction: an axis is uniform, and is used both ways. */
#ifndef LSF_LIB_BUNDLE_PDF
#define LSF_LIB_BUNDLE_PDF

#include "shared/brdf.h"

float bundle_pdf(vec3 direction)
{
    return 0.5 / LSF_PI;
}

#endif
