/* The exposure that suits a picture. */
#include "io/io.h"
#include "math/vector.h"
#include "shared/tonemap.h"

#include <math.h>

#define MIDDLE_GREY 0.18

typedef struct pixel_channels {
    int red, green, blue, alpha;
} pixel_channels;

/* Luminance of surfaces and the share of the pixel that they cover; both 0 where it is not finite,
 * and where it is black: no exposure changes that, so that an empty background has no part in the
 * choice. */
static void read_pixel(const lsf_image *image, const pixel_channels *channels, uint64_t pixel,
                       double *luminance, double *weight)
{
    const float *p = image->pixels + pixel * image->channel_count;
    float covered = channels->alpha < 0 ? 1.0f : p[channels->alpha];
    float shown = lsf_f3_luminance(lsf_f3(p[channels->red], p[channels->green], p[channels->blue]));
    bool counts = isfinite(shown) && shown > 0.0f && covered > 0.0f;
    *weight = counts ? (double)covered : 0.0;
    *luminance = counts ? (double)shown / (double)covered : 0.0;
}

float lsf_image_auto_exposure(const lsf_image *image)
{
    if (!image)
        return 0.0f;
    const pixel_channels channels = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                                     lsf_image_channel(image, "B"), lsf_image_channel(image, "A")};
    if (channels.red < 0 || channels.green < 0 || channels.blue < 0)
        return 0.0f;
    uint64_t pixels = (uint64_t)image->width * image->height;
    double sum = 0.0, weights = 0.0, logarithms = 0.0, luminance, weight;
    for (uint64_t i = 0; i < pixels; i++) {
        read_pixel(image, &channels, i, &luminance, &weight);
        sum += weight * luminance;
        weights += weight;
    }
    if (sum == 0.0)
        return 0.0f;
    double darkest = sum / weights / MIDDLE_GREY * (double)lsf_srgb_decode(1.0f / 255.0f);
    for (uint64_t i = 0; i < pixels; i++) {
        read_pixel(image, &channels, i, &luminance, &weight);
        if (weight > 0.0)
            logarithms += weight * log2(fmax(luminance, darkest));
    }
    return (float)(log2(MIDDLE_GREY) - logarithms / weights);
}
