/* Times of frames, and their pictures, for measuring the moving picture. */
#include "view/app.h"

#include "base/base.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- times of frames --- */

bool lsf_viewer_open_frame_log(lsf_viewer *viewer, lsf_error *error)
{
    const char *path = viewer->start->frame_times;
    if (!path)
        return true;
    viewer->frame_log = fopen(path, "w");
    if (!viewer->frame_log)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be written: %s", path,
                             strerror(errno));
    fprintf(viewer->frame_log, "frame,seconds,picture,width,height,coarse\n");
    return true;
}

void lsf_viewer_log_frame(lsf_viewer *viewer, double seconds)
{
    const lsf_viewer_picture *shown = lsf_viewer_shown(viewer);
    if (!viewer->frame_log)
        return;
    const char *what = !viewer->scene || shown->done == 0 ? "none"
                       : viewer->moving                   ? "moving"
                                                          : "still";
    fprintf(viewer->frame_log, "%" PRIu64 ",%.6f,%s,%u,%u,%u\n", viewer->input->frame - 1, seconds,
            what, shown->width, shown->height,
            viewer->moving ? lsf_budget_coarse(&viewer->budget) : 0);
}

bool lsf_viewer_close_frame_log(lsf_viewer *viewer, lsf_error *error)
{
    bool good = !viewer->frame_log || fclose(viewer->frame_log) == 0;
    viewer->frame_log = NULL;
    return good || lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be written: %s",
                                 viewer->start->frame_times, strerror(errno));
}

/* --- pictures of frames --- */

/* Of the pixel's centre, between the two of the smaller picture: its own size is taken to the
 * window's as OpenGL filters a texture. */
static float between(uint32_t pixel, uint32_t size, uint32_t of, uint32_t ends[2])
{
    float x = ((float)pixel + 0.5f) * (float)of / (float)size - 0.5f, low = floorf(x);
    ends[0] = low < 0.0f ? 0u : (uint32_t)low;
    ends[1] = low + 1.0f > (float)(of - 1) ? of - 1 : (uint32_t)(low + 1.0f);
    return x - low;
}

/* R, G and B as large as they are shown. NULL without memory, which `error` says. */
static lsf_image *enlarge(const lsf_image *from, uint32_t width, uint32_t height, lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    lsf_image *to = lsf_image_create(width, height, 3, names, error);
    for (uint32_t y = 0; to && y < height; y++) {
        uint32_t rows[2], columns[2];
        float v = between(y, height, from->height, rows);
        for (uint32_t x = 0; x < width; x++) {
            float u = between(x, width, from->width, columns);
            for (uint32_t c = 0; c < 3; c++) {
                float mixed[2];
                for (int row = 0; row < 2; row++) {
                    const float *line =
                        from->pixels + (size_t)rows[row] * from->width * from->channel_count;
                    float left = line[columns[0] * from->channel_count + c];
                    float right = line[columns[1] * from->channel_count + c];
                    mixed[row] = left + u * (right - left);
                }
                to->pixels[((size_t)y * width + x) * 3 + c] = mixed[0] + v * (mixed[1] - mixed[0]);
            }
        }
    }
    return to;
}

static bool save_shown(lsf_viewer *viewer, const char *path, lsf_error *error)
{
    const lsf_viewer_picture *shown = lsf_viewer_shown(viewer);
    lsf_image *image = lsf_renderer_read(shown->renderer, error);
    lsf_image *whole =
        image ? enlarge(image, (uint32_t)viewer->area.width, (uint32_t)viewer->area.height, error)
              : NULL;
    bool good = whole && lsf_image_save(whole, path, NULL, error);
    lsf_image_destroy(image);
    lsf_image_destroy(whole);
    return good;
}

bool lsf_viewer_take_snapshot(lsf_viewer *viewer, const char *name, lsf_error *error)
{
    double begun = lsf_now();
    if (!viewer->scene || lsf_viewer_shown(viewer)->done == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "snapshot %s: no picture is shown", name);
    char *picture = lsf_format("%s.exr", name), *path = lsf_format("%s.view", name);
    char *view = lsf_viewer_view_file(viewer);
    bool good = picture && path && view;
    if (!good)
        lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && save_shown(viewer, picture, error) &&
           lsf_file_write(path, view, strlen(view), error);
    free(picture);
    free(path);
    free(view);
    viewer->frame_begun += lsf_now() - begun; /* the frame's time is without it */
    return good;
}
