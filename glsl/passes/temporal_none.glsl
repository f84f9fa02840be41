/* Value of a luminance, or of a difference, that is unknown. */
#ifndef LSF_PASSES_TEMPORAL_NONE
#define LSF_PASSES_TEMPORAL_NONE

#define NONE 1e36

#endif
