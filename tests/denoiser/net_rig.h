/* Small networks as files have them, and what they make of pictures, computed plainly. */
#ifndef LSF_TESTS_DENOISER_NET_RIG_H
#define LSF_TESTS_DENOISER_NET_RIG_H

#include "denoiser/net.h"

/* The bytes of a network with random weights, `gain` times as large as keep a map's range; of the
 * last layer `out` times as large again. The caller frees. */
char *net_rig_bytes(uint32_t stages, float leak, float gain, float out, uint32_t seed,
                    size_t *length);
lsf_net *net_rig_make(uint32_t stages, float leak, float gain, float out, uint32_t seed);
/* Writes the same to a file. */
void net_rig_write(const char *path, uint32_t stages, float leak, float gain, float out,
                   uint32_t seed);

/* What it makes of a picture whose size is a multiple of its granularity: maps of LSF_NET_INPUTS
 * and LSF_NET_OUTPUTS features, one after the other. `state`, if it is not NULL, holds
 * net_rig_state_size numbers, zeros before the first frame, and is brought to that of the next. */
void net_rig_run(const lsf_net *net, uint32_t width, uint32_t height, const float *input,
                 float *output, float *state);
size_t net_rig_state_size(const lsf_net *net, uint32_t width, uint32_t height);

#endif
