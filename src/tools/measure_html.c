#include "tools/measure_html.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "report/report.h"
#include "tools/measure_json.h"

bool lsf_measure_begin_pictures(lsf_settings *settings, char **folder, lsf_error *error)
{
    const char *parent = getenv("TMPDIR");
    if (!settings->html_path || settings->picture_folder)
        return true;
    *folder = lsf_format("%s/lightsheaf-XXXXXX", parent && *parent ? parent : "/tmp");
    if (!*folder)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    if (!mkdtemp(*folder)) {
        lsf_error_set(error, LSF_ERROR_FILE,
                      "cannot create a folder for pictures, %s: %s; set TMPDIR, or give --pictures",
                      *folder, strerror(errno));
        free(*folder);
        *folder = NULL;
        return false;
    }
    settings->picture_folder = *folder;
    return true;
}

/* What an earlier measurement has kept elsewhere stays. */
static void remove_file(char **path, const char *folder)
{
    size_t length = strlen(folder);
    if (!*path || strncmp(*path, folder, length) != 0 || (*path)[length] != '/')
        return;
    unlink(*path);
    free(*path);
    *path = NULL;
}

void lsf_measure_end_pictures(lsf_measurement *measurement, char **folder)
{
    if (!*folder)
        return;
    lsf_measured_reference *reference = &measurement->reference;
    remove_file(&reference->picture, *folder);
    remove_file(&reference->preview, *folder);
    for (int i = 0; i < 2; i++)
        remove_file(&reference->halves[i], *folder);
    for (uint32_t i = 0; i < measurement->point_count; i++) {
        remove_file(&measurement->points[i].picture, *folder);
        remove_file(&measurement->points[i].preview, *folder);
    }
    rmdir(*folder);
    free(*folder);
    *folder = NULL;
}

/* Returns their number. Those of the front come first: there may not be room for all. Pictures of
 * points that were measured before may be gone. */
static uint32_t list_pictures(const lsf_measurement *m, lsf_report_picture *pictures)
{
    uint32_t count = 0;
    if (m->reference.picture)
        pictures[count++] = (lsf_report_picture){"reference", m->reference.picture};
    for (int front = 1; front >= 0; front--)
        for (uint32_t i = 0; i < m->point_count; i++) {
            const char *path = m->points[i].picture;
            if (m->points[i].front != (front == 1) || !path || access(path, R_OK) != 0)
                continue;
            pictures[count].path = path;
            snprintf(pictures[count++].id, sizeof pictures->id, "point-%u", i);
        }
    return count;
}

bool lsf_measure_write_html(const lsf_measurement *m, const lsf_context_info *device,
                            const lsf_prices *prices, const char *path, lsf_error *error)
{
    if (!path)
        return true;
    lsf_json json = {0};
    lsf_report_picture *pictures = lsf_alloc((uint64_t)m->point_count + 1, sizeof *pictures);
    lsf_measure_add_json(&json, m, device, prices);
    bool good =
        (pictures && !json.text.failed) || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good =
        good && lsf_report_write(path, json.text.text, pictures, list_pictures(m, pictures), error);
    free(json.text.text);
    free(pictures);
    return good;
}
