#include <lightsheaf/image.h>

#include <stdlib.h>
#include <string.h>

#include "base/base.h"

lsf_image *lsf_image_create(uint32_t width, uint32_t height, uint32_t channel_count,
                            const char *const *channel_names, lsf_error *error)
{
    if (channel_count > 0 && !lsf_given(channel_names, "channel_names", error))
        return NULL;
    lsf_image *image = lsf_alloc(1, sizeof *image);
    if (image) {
        image->width = width;
        image->height = height;
        image->channel_count = channel_count;
        image->channel_names = lsf_alloc(channel_count, LSF_CHANNEL_NAME_SIZE);
        uint64_t pixels = (uint64_t)width * height, values;
        if (!__builtin_mul_overflow(pixels, channel_count, &values))
            image->pixels = lsf_alloc(values, sizeof(float));
    }
    if (!image || !image->channel_names || !image->pixels) {
        lsf_image_destroy(image);
        lsf_error_set(error, LSF_ERROR_RENDER,
                      "not enough memory for an image of %u x %u pixels with %u channels; "
                      "make it smaller",
                      width, height, channel_count);
        return NULL;
    }
    for (uint32_t c = 0; c < channel_count; c++) {
        size_t length = strlen(channel_names[c]);
        if (length >= LSF_CHANNEL_NAME_SIZE) {
            lsf_error_set(error, LSF_ERROR_USAGE,
                          "channel name \"%.80s\" is longer than %d characters", channel_names[c],
                          LSF_CHANNEL_NAME_SIZE - 1);
            lsf_image_destroy(image);
            return NULL;
        }
        memcpy(image->channel_names[c], channel_names[c], length);
    }
    return image;
}

void lsf_image_destroy(lsf_image *image)
{
    if (!image)
        return;
    free(image->channel_names);
    free(image->pixels);
    free(image);
}

int lsf_image_channel(const lsf_image *image, const char *name)
{
    if (!image || !name)
        return -1;
    for (uint32_t c = 0; c < image->channel_count; c++)
        if (strcmp(image->channel_names[c], name) == 0)
            return (int)c;
    return -1;
}
