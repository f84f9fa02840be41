/* Weight of a history that has an error of its own. */
#ifndef LSF_PASSES_TEMPORAL_WEIGHT
#define LSF_PASSES_TEMPORAL_WEIGHT

/* Number of samples that a history of `samples` counts for, so that the blend with a frame of so many iterations has
 * the least squared error. `bias2`: square of the history's error beyond its noise; `noise`: variance of the frame. */
float history_weight(float samples, float iterations, float bias2, float noise)
{
    if (bias2 <= 0.0)
        return samples;
    return noise > 0.0 ? 1.0 / (1.0 / samples + bias2 / (iterations * noise)) : 0.0;
}

#endif
