/* Training data: what goes into the network, as a file has it (denoise.md). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/half.h"
#include "passes/denoise_parts.h"

#define RECORD_VERSION 1u
#define RECORD_CHANNELS (LSF_NET_INPUTS + 8u)

const char *lsf_denoise_record_path(void)
{
    const char *path = getenv("LIGHTSHEAF_DENOISER_RECORD");
    return path && *path ? path : NULL;
}

/* As denoise_light.glsl has it. */
static float read_scale(const lsf_denoise *pass)
{
    float sum[4];
    glGetNamedBufferSubData(pass->total, LSF_DENOISE_SUM_SCALE * LSF_DENOISE_SUMS * sizeof sum,
                            sizeof sum, sum);
    float mean = sum[1] > 0.0f ? sum[0] / sum[1] : 0.0f, scale = mean * mean;
    return scale < 1e30f && scale > 1e-30f ? scale : 0.0f;
}

/* The picture's part of the network's input. */
static bool read_inputs(const lsf_denoise *pass, const lsf_plan *plan, float *channels)
{
    size_t padded = (size_t)pass->width * pass->height;
    size_t bytes = padded * LSF_DENOISE_INPUT_GROUPS * LSF_DENOISE_GROUP * sizeof(uint16_t);
    uint16_t *maps = lsf_alloc(bytes, 1);
    if (!maps)
        return false;
    glGetNamedBufferSubData(pass->exchange, 0, (GLsizeiptr)bytes, maps);
    for (uint32_t c = 0; c < LSF_NET_INPUTS; c++)
        for (uint32_t y = 0; y < plan->height; y++)
            for (uint32_t x = 0; x < plan->width; x++) {
                size_t at = c / LSF_DENOISE_GROUP * padded + (size_t)y * pass->width + x;
                *channels++ =
                    lsf_half_to_float(maps[at * LSF_DENOISE_GROUP + c % LSF_DENOISE_GROUP]);
            }
    free(maps);
    return true;
}

/* Channels `first` to `last` of a texture, one after the other; of none -1. */
static bool read_texture(GLuint texture, const lsf_plan *plan, int first, int last, float *channels)
{
    size_t pixels = (size_t)plan->width * plan->height;
    float *texels = lsf_alloc(pixels, 4 * sizeof *texels);
    if (!texels)
        return false;
    if (texture)
        glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, (GLsizei)(pixels * 4 * sizeof *texels),
                          texels);
    for (int c = first; c <= last; c++)
        for (size_t i = 0; i < pixels; i++)
            *channels++ = texture ? texels[4 * i + (size_t)c] : -1.0f;
    free(texels);
    return true;
}

static bool write_record(const char *path, const lsf_plan *plan, float scale, const float *channels,
                         lsf_error *error)
{
    const uint32_t header[] = {RECORD_VERSION, plan->width, plan->height, RECORD_CHANNELS};
    size_t count = (size_t)RECORD_CHANNELS * plan->width * plan->height;
    FILE *file = fopen(path, "ab");
    bool good = file && fwrite("LSFR", 4, 1, file) == 1 &&
                fwrite(header, sizeof header, 1, file) == 1 &&
                fwrite(&scale, sizeof scale, 1, file) == 1 &&
                fwrite(channels, sizeof *channels, count, file) == count;
    good = file && fclose(file) == 0 && good;
    return good || lsf_error_set(error, LSF_ERROR_FILE,
                                 "LIGHTSHEAF_DENOISER_RECORD=%s: the file cannot be written", path);
}

bool lsf_denoise_record(const lsf_denoise *pass, const lsf_plan *plan,
                        const lsf_denoise_inputs *inputs, lsf_error *error)
{
    const char *path = lsf_denoise_record_path();
    if (!path)
        return true;
    size_t pixels = (size_t)plan->width * plan->height;
    float *channels = lsf_alloc(RECORD_CHANNELS * pixels, sizeof *channels);
    float *after = channels ? channels + LSF_NET_INPUTS * pixels : NULL;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    bool good = channels && read_inputs(pass, plan, channels) &&
                read_texture(inputs->factors[0], plan, 0, 2, after) &&
                read_texture(inputs->factors[1], plan, 0, 2, after + 3 * pixels) &&
                read_texture(inputs->light[0], plan, 3, 3, after + 6 * pixels) &&
                read_texture(inputs->light[1], plan, 3, 3, after + 7 * pixels);
    if (!good)
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a record of training data");
    good = good && write_record(path, plan, read_scale(pass), channels, error);
    free(channels);
    return good;
}
