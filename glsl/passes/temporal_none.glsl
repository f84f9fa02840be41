/* Where there is no luminance, or no difference, to tell. */
#ifndef LSF_PASSES_TEMPORAL_NONE
#define LSF_PASSES_TEMPORAL_NONE

#define NONE 1e36

#endif
