/* Sample points along a pixel's side in an iteration. Switch LSF_PIXEL_SIDE; without it there is one. */
#ifndef LSF_LIB_PIXEL_SIDE
#define LSF_LIB_PIXEL_SIDE

#ifndef LSF_PIXEL_SIDE
#define LSF_PIXEL_SIDE 1
#endif

#endif
