/* Reading a renderer's pictures and statistics. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "techniques/renderer_parts.h"

/* Names of an image's channels: those of the picture, then of each layer. */
static uint32_t name_channels(const lsf_setup *setup, char (*names)[LSF_CHANNEL_NAME_SIZE])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < setup->layer_count; i++)
        count += lsf_layer_channels(lsf_layer_of(setup->layer_aovs[i]), names + count);
    return count;
}

/* Textures are read back in strips of whole rows of about this size: OpenGL's sizes are signed
 * 32-bit numbers, and after a long rendering memory may be short. */
enum { STRIP_BYTES = 1 << 18 };

static uint32_t strip_rows(uint32_t width, uint32_t texel_bytes)
{
    uint32_t rows = STRIP_BYTES / (width * texel_bytes);
    return rows > 0 ? rows : 1;
}

/* Calls `take` with rows of R, G, B and alpha, bottom row first. */
static bool read_strips(GLuint texture, uint32_t width, uint32_t height,
                        void (*take)(const float *texels, uint32_t first_row, uint32_t rows,
                                     void *user),
                        void *user)
{
    uint32_t most = strip_rows(width, 16);
    float *texels = lsf_alloc((uint64_t)most * width, 16);
    for (uint32_t y = 0; texels && y < height; y += most) {
        uint32_t rows = height - y < most ? height - y : most;
        glGetTextureSubImage(texture, 0, 0, (GLint)y, 0, (GLsizei)width, (GLsizei)rows, 1, GL_RGBA,
                             GL_FLOAT, (GLsizei)(rows * width * 16), texels);
        take(texels, y, rows, user);
    }
    free(texels);
    return texels != NULL;
}

/* Destination of a layer: its first channel of the first pixel, rows from the top. */
typedef struct layer_target {
    char *first;
    size_t row_bytes, pixel_bytes;
    uint32_t width, height, channels;
} layer_target;

static void copy_layer(const float *texels, uint32_t first_row, uint32_t rows, void *user)
{
    const layer_target *target = user;
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t x = 0; x < target->width; x++) {
            size_t y = target->height - 1 - (first_row + row);
            memcpy(target->first + y * target->row_bytes + x * target->pixel_bytes,
                   texels + ((size_t)row * target->width + x) * 4,
                   target->channels * sizeof(float));
        }
}

static uint32_t channels_of(uint32_t aov)
{
    return (uint32_t)strlen(lsf_layer_of(aov)->channels);
}

lsf_image *lsf_renderer_read(lsf_renderer *renderer, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error))
        return NULL;
    const lsf_setup *setup = &renderer->setup;
    const lsf_plan *plan = setup->plan;
    char names[3 * LSF_LAYER_COUNT][LSF_CHANNEL_NAME_SIZE];
    const char *name_list[3 * LSF_LAYER_COUNT];
    uint32_t channel_count = name_channels(setup, names);
    for (uint32_t i = 0; i < channel_count; i++)
        name_list[i] = names[i];
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return NULL;
    lsf_image *image = lsf_image_create(plan->width, plan->height, channel_count, name_list, error);
    bool good = image != NULL;
    for (uint32_t i = 0, channel = 0; good && i < setup->layer_count; i++) {
        uint32_t channels = channels_of(setup->layer_aovs[i]);
        bool present = lsf_renderer_layer(&renderer->outputs, setup->layer_aovs[i]) != 0;
        size_t pixel_bytes = channel_count * sizeof(float);
        layer_target target = {.first = (char *)(image->pixels + channel),
                               .row_bytes = plan->width * pixel_bytes,
                               .pixel_bytes = pixel_bytes,
                               .width = plan->width,
                               .height = plan->height,
                               .channels = channels};
        GLuint mean = i == 0 ? lsf_renderer_picture(renderer) : renderer->accumulate.means[i];
        if (present && !read_strips(mean, plan->width, plan->height, copy_layer, &target))
            good =
                lsf_error_set(error, LSF_ERROR_RENDER, "no memory left to read the picture back");
        channel += channels;
    }
    if (!good || !lsf_context_check(renderer->context, error)) {
        lsf_image_destroy(image);
        return NULL;
    }
    return image;
}

/* The mean of the picture (0) or of a layer; 0 where there is none. Of a renderer that is entered
 * and has caught up. */
static GLuint find_mean(lsf_renderer *renderer, uint32_t aov, lsf_error *error)
{
    const lsf_setup *setup = &renderer->setup;
    for (uint32_t i = 0; i < setup->layer_count; i++)
        if (setup->layer_aovs[i] == aov && lsf_renderer_layer(&renderer->outputs, aov))
            return i == 0 ? lsf_renderer_picture(renderer) : renderer->accumulate.means[i];
    lsf_error_set(error, LSF_ERROR_USAGE,
                  "no such layer was asked for in lsf_render_params.aovs, or nothing was rendered");
    return 0;
}

bool lsf_renderer_read_into(lsf_renderer *renderer, uint32_t aov, float *pixels, size_t row_bytes,
                            lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(pixels, "pixels", error))
        return false;
    const lsf_plan *plan = renderer->setup.plan;
    const uint32_t channels = channels_of(aov);
    const size_t pixel_bytes = channels * sizeof(float);
    if (row_bytes < plan->width * pixel_bytes)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "row_bytes %zu: a row of this layer takes at least %zu bytes",
                             row_bytes, plan->width * pixel_bytes);
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return false;
    GLuint mean = find_mean(renderer, aov, error);
    layer_target target = {.first = (char *)pixels,
                           .row_bytes = row_bytes,
                           .pixel_bytes = pixel_bytes,
                           .width = plan->width,
                           .height = plan->height,
                           .channels = channels};
    if (mean && !read_strips(mean, plan->width, plan->height, copy_layer, &target))
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left to read the picture back");
    return mean && lsf_context_check(renderer->context, error);
}

bool lsf_renderer_read_rgb8(lsf_renderer *renderer, float exposure, lsf_tone_curve curve,
                            uint8_t *rgb, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(rgb, "rgb", error))
        return false;
    if (!renderer->setup.params.rgb8)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "8-bit output was not asked for; set rgb8 in lsf_render_params");
    const lsf_plan *plan = renderer->setup.plan;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return false;
    lsf_tonemap_run(&renderer->tonemap, lsf_renderer_picture(renderer), exposure, curve);
    uint32_t most = strip_rows(plan->width, 3);
    for (uint32_t y = 0; y < plan->height; y += most) {
        uint32_t rows = plan->height - y < most ? plan->height - y : most;
        glGetTextureSubImage(renderer->tonemap.display, 0, 0, (GLint)y, 0, (GLsizei)plan->width,
                             (GLsizei)rows, 1, GL_RGB, GL_UNSIGNED_BYTE,
                             (GLsizei)(rows * plan->width * 3),
                             rgb + (uint64_t)y * plan->width * 3);
    }
    return lsf_context_check(renderer->context, error);
}

uint32_t lsf_renderer_texture(lsf_renderer *renderer, uint32_t aov, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error))
        return 0;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return 0;
    return find_mean(renderer, aov, error);
}

bool lsf_renderer_present(lsf_renderer *renderer, uint32_t framebuffer, const int32_t viewport[4],
                          float exposure, lsf_tone_curve curve, lsf_error *error)
{
    if (!lsf_given(renderer, "renderer", error) || !lsf_given(viewport, "viewport", error))
        return false;
    if (!renderer->setup.params.present)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "presenting was not asked for; set present in lsf_render_params");
    if (viewport[2] < 1 || viewport[3] < 1)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "viewport %d,%d pixels: both must be at least 1", viewport[2],
                             viewport[3]);
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return false;
    if ((framebuffer && !glIsFramebuffer(framebuffer)) ||
        glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return lsf_error_set(
            error, LSF_ERROR_USAGE,
            "framebuffer %u is not there or not complete in the renderer's context", framebuffer);
    lsf_tonemap_present(&renderer->tonemap, lsf_renderer_picture(renderer), framebuffer, viewport,
                        exposure, curve);
    return lsf_context_check(renderer->context, error);
}

typedef struct pixel_tally {
    uint32_t width;
    double lost, kept;    /* luminance */
    uint64_t lost_pixels; /* number of pixels that are not finite */
} pixel_tally;

static void tally_rows(const float *texels, uint32_t first_row, uint32_t rows, void *user)
{
    (void)first_row;
    pixel_tally *tally = user;
    for (const float *t = texels; t < texels + (size_t)4 * tally->width * rows; t += 4) {
        tally->lost += (double)t[3];
        tally->kept += (double)lsf_f3_luminance(lsf_f3_load(t));
        tally->lost_pixels += !isfinite(t[0]) || !isfinite(t[1]) || !isfinite(t[2]);
    }
}

/* Scans the picture for the luminance that bounds took away, which alpha holds, and for pixels
 * that are not finite. */
static void look_at_pixels(const lsf_renderer *renderer, double *lost_share, uint64_t *lost_pixels)
{
    const lsf_plan *plan = renderer->setup.plan;
    pixel_tally tally = {.width = plan->width};
    read_strips(renderer->accumulate.means[0], plan->width, plan->height, tally_rows, &tally);
    bool lost = renderer->outputs.bounded && tally.lost > 0.0;
    *lost_share = lost ? tally.lost / (tally.lost + tally.kept) : 0.0;
    *lost_pixels = tally.lost_pixels;
}

/* The technique's passes, then the renderer's. */
static uint32_t list_passes(lsf_renderer *renderer,
                            lsf_pass_report reports[LSF_RENDERER_MAX_PASSES])
{
    uint32_t count = renderer->setup.technique->report(renderer->technique, reports);
    reports[count++] = (lsf_pass_report){.timer = renderer->accumulate.timer};
    if (renderer->light_mean.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->light_mean.timer};
    if (renderer->light_guide.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->light_guide.timer};
    if (renderer->temporal.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->temporal.timer};
    if (renderer->light_filter.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->light_filter.timer};
    if (renderer->denoise.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->denoise.timer};
    if (renderer->tonemap.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->tonemap.timer};
    return count;
}

uint32_t lsf_renderer_poll_times(lsf_renderer *renderer, const lsf_pass_time **times)
{
    if (!renderer || !times)
        return 0;
    lsf_pass_report reports[LSF_RENDERER_MAX_PASSES];
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, NULL);
    if (!entered)
        return 0;
    uint32_t count = list_passes(renderer, reports);
    for (uint32_t i = 0; i < count; i++) {
        lsf_pass_time *time = &renderer->pass_times[i];
        time->name = lsf_timer_name(reports[i].timer);
        time->runs = lsf_timer_poll(reports[i].timer, &time->milliseconds);
    }
    *times = renderer->pass_times;
    return count;
}

lsf_renderer_stats lsf_renderer_get_stats(lsf_renderer *renderer)
{
    if (!renderer)
        return (lsf_renderer_stats){0};
    lsf_pass_report reports[LSF_RENDERER_MAX_PASSES];
    lsf_error ignored = {0}; /* the error shows again when the picture is read */
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, &ignored);
    if (!entered)
        return (lsf_renderer_stats){0};
    lsf_renderer_catch_up(renderer, true, &ignored);
    uint32_t count = list_passes(renderer, reports);
    double iterations = renderer->iterations ? (double)renderer->iterations : 1.0;
    for (uint32_t i = 0; i < count; i++)
        renderer->pass_stats[i] = (lsf_pass_stats){
            .name = lsf_timer_name(reports[i].timer),
            .runs = lsf_timer_runs(reports[i].timer),
            .milliseconds = lsf_timer_milliseconds(reports[i].timer) / iterations,
            .count_count = reports[i].count_count,
            .count_names = reports[i].count_names,
            .counts = reports[i].counts,
        };
    double lost_share;
    uint64_t lost_pixels;
    look_at_pixels(renderer, &lost_share, &lost_pixels);
    return (lsf_renderer_stats){.samples = renderer->samples,
                                .compile_seconds = renderer->compile_seconds,
                                .upload_seconds = renderer->upload_seconds,
                                .render_seconds = renderer->render_seconds,
                                .lost_share = lost_share,
                                .lost_pixels = lost_pixels,
                                .pass_count = count,
                                .passes = renderer->pass_stats};
}
