/* What a rendering was and took, as the JSON that --json asks for; docs/command.md has the schema.
 */
#ifndef LSF_TOOLS_SUMMARY_H
#define LSF_TOOLS_SUMMARY_H

#include "tools/json.h"
#include "tools/options.h"

typedef struct lsf_summary_seconds {
    const char *name;
    double value;
} lsf_summary_seconds;

typedef struct lsf_summary {
    const lsf_settings *settings;
    const lsf_scene *scene;
    const char *scene_path, *output;
    const char *const *half_paths; /* two, or NULL */
    const char *technique;         /* "path tracing" for the reference */
    uint32_t bounces;
    uint32_t samples;    /* taken */
    const char *weights; /* file of the denoiser's; NULL: the library's own, or no denoiser */
    bool interrupted;
    float exposure; /* EV; NAN: none, in a float format */
    const lsf_summary_seconds *seconds;
    uint32_t seconds_count;
    const lsf_context_info *device;  /* NULL: the reference */
    const lsf_renderer_stats *stats; /* NULL: the reference */
    uint64_t plan_bytes;
    uint64_t rays; /* the reference */
} lsf_summary;

/* The key "device"; `device` NULL: the reference. */
void lsf_summary_add_device(lsf_json *json, const lsf_context_info *device);

/* Those asked for, or those that the scene needs. */
uint32_t lsf_summary_bounces(const lsf_settings *settings, const lsf_scene *scene);

void lsf_summary_add(lsf_json *json, const lsf_summary *summary);

#endif
