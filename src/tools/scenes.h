/* The scenes that a command line names: files, standard input, or the one that comes with
 * Lightsheaf. */
#ifndef LSF_TOOLS_SCENES_H
#define LSF_TOOLS_SCENES_H

#include "tools/json.h"
#include "tools/options.h"

/* At least 1: where none is named, the one that comes with Lightsheaf. */
uint32_t lsf_tool_scene_count(const lsf_settings *settings);

/* Its path, "-" for standard input. malloc'ed; NULL: LSF_ERROR_USAGE. */
char *lsf_tool_scene_path(const lsf_settings *settings, uint32_t index, lsf_error *error);

/* Loads a scene of such a path; what it took is left in *seconds. NULL on failure. */
lsf_scene *lsf_tool_load_scene(const lsf_settings *settings, const char *path, double *seconds,
                               lsf_error *error);

/* What a command does with one of its scenes; adds one value to `json`, last of all. */
typedef bool lsf_tool_scene_function(void *user, uint32_t index, const char *path, lsf_json *json,
                                     lsf_error *error);

/* Does it with each scene, in order; what fails is reported, and the others go on. Then writes the
 * JSON where --json says: one value, or of several scenes an array, in which those that failed have
 * `scene` and `error`. The exit status: that of the first failure, or 0. */
int lsf_tool_for_each_scene(const lsf_settings *settings, lsf_tool_scene_function *run, void *user);

#endif
