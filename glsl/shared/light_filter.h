/* Constants of the light filter, for the shaders and for the host. */
#ifndef LSF_SHARED_LIGHT_FILTER_H
#define LSF_SHARED_LIGHT_FILTER_H

/* Side of the blocks over which lost light is summed [pixels]. */
#define LSF_LOST_BLOCK 8

#endif
