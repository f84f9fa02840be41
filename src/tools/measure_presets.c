#include "tools/measure_presets.h"

#include <math.h>
#include <string.h>

#include "tools/preset.h"
#include "tools/value.h"

typedef struct measure_preset {
    const char *sweeps[8]; /* NULL ends them */
    uint32_t samples, seeds, reference_samples;
} measure_preset;

static const measure_preset presets[] = {
    {{"voxel.resolution=64,128"}, 8, 4, 256},
    {{"voxel.resolution=64,128,256", "vpl.count=1,16,64", "bundle.count=1,4", "cone.count=6,12",
      "voxel_path.max_samples=1,6"},
     64,
     8,
     1024},
};

/* Candidates of an answer. */
static const measure_preset searches[] = {
    {{"voxel.resolution=32,64,128", "vpl.count=1,32", "sparse.grid=1,2,4"}, 4096, 4, 256},
    {{"voxel.resolution=32,64,128,256", "vpl.count=1,16,64", "bundle.count=1,4",
      "sparse.grid=1,2,4", "interleave.size=0,1", "voxel_path.max_samples=1,6"},
     65536,
     8,
     1024},
};

static bool append(lsf_list_setting *list, const char *item, lsf_error *error)
{
    return lsf_list_append(list, item) || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

/* What --define holds fast is not swept. */
static bool is_held(const lsf_settings *settings, const char *sweep)
{
    size_t length = strcspn(sweep, "=") + 1;
    for (uint32_t i = 0; i < settings->defines.count; i++)
        if (strncmp(settings->defines.items[i], sweep, length) == 0)
            return true;
    return false;
}

/* A sweep counts when one of the techniques takes its option. */
static bool is_taken(const lsf_settings *settings, const char *sweep)
{
    char key[64];
    size_t length = strcspn(sweep, "=");
    memcpy(key, sweep, length);
    key[length] = '\0';
    for (uint32_t i = 0; i < settings->techniques.count; i++)
        if (lsf_technique_takes(settings->techniques.items[i], key))
            return true;
    return false;
}

bool lsf_measure_fill_in(lsf_settings *settings, lsf_error *error)
{
    bool answers = !isnan(settings->budget_ms) || !isnan(settings->error);
    bool of_file = settings->measure_preset == LSF_PRESET_FILE; /* and of nothing beside it */
    const measure_preset *preset =
        &(answers ? searches : presets)[of_file ? 0 : settings->measure_preset];
    bool good = true, all = settings->techniques.count == 0;
    for (uint32_t i = 0; good && all && lsf_technique_name(i); i++)
        good = append(&settings->techniques, lsf_technique_name(i), error);
    if (settings->sweeps.count == 0 && !of_file)
        for (size_t i = 0; good && i < LSF_COUNT(preset->sweeps) && preset->sweeps[i]; i++)
            if (is_taken(settings, preset->sweeps[i]) && !is_held(settings, preset->sweeps[i]))
                good = append(&settings->sweeps, preset->sweeps[i], error);
    if (!settings->samples)
        settings->samples = preset->samples;
    if (!settings->seeds)
        settings->seeds = preset->seeds;
    if (!settings->reference_samples)
        settings->reference_samples = preset->reference_samples;
    return good;
}
