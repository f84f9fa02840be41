#include <string.h>

#include "base/base.h"
#include "techniques/technique.h"

static const lsf_technique *const techniques[] = {
    &lsf_technique_bidirectional, &lsf_technique_cone, &lsf_technique_direct,
    &lsf_technique_substitute_tree, &lsf_technique_voxel_path};

static const lsf_pass_params defaults = {LSF_PASS_PARAMS_DEFAULTS};

#define TABLE(pass, rows)                                                                          \
    {                                                                                              \
        lsf_##pass##_options, rows, &defaults.pass, offsetof(lsf_pass_params, pass)                \
    }

const lsf_option_table lsf_pass_option_tables[] = {
    TABLE(tessellation, LSF_TESSELLATION_OPTION_COUNT),
    TABLE(sky_light, LSF_SKY_LIGHT_OPTION_COUNT),
    TABLE(gbuffer, LSF_GBUFFER_OPTION_COUNT),
    TABLE(shadow_map, LSF_SHADOW_MAP_OPTION_COUNT),
    TABLE(reflective_shadow_map, LSF_REFLECTIVE_SHADOW_MAP_OPTION_COUNT),
    TABLE(vpl, LSF_VPL_OPTION_COUNT),
    TABLE(ray_bundle, LSF_RAY_BUNDLE_OPTION_COUNT),
    TABLE(sparse, LSF_SPARSE_OPTION_COUNT),
    TABLE(blur, LSF_BLUR_OPTION_COUNT),
    TABLE(bidirectional_shade, LSF_BIDIRECTIONAL_SHADE_OPTION_COUNT),
    TABLE(voxel_grid, LSF_VOXEL_GRID_OPTION_COUNT),
    TABLE(voxelize, LSF_VOXELIZE_OPTION_COUNT),
    TABLE(cone, LSF_CONE_OPTION_COUNT),
    TABLE(specular_path, LSF_SPECULAR_PATH_OPTION_COUNT),
    TABLE(voxel_path, LSF_VOXEL_PATH_OPTION_COUNT),
    TABLE(vpl_cloud, LSF_VPL_CLOUD_OPTION_COUNT),
    TABLE(light_tree, LSF_LIGHT_TREE_OPTION_COUNT),
    TABLE(light_tree_sample, LSF_LIGHT_TREE_SAMPLE_OPTION_COUNT),
    TABLE(light_filter, LSF_LIGHT_FILTER_OPTION_COUNT),
    TABLE(denoise, LSF_DENOISE_OPTION_COUNT),
    TABLE(temporal, LSF_TEMPORAL_OPTION_COUNT),
};
const uint32_t lsf_pass_option_table_count = LSF_COUNT(lsf_pass_option_tables);

const lsf_technique *lsf_technique_find(const char *name)
{
    for (size_t i = 0; i < LSF_COUNT(techniques); i++)
        if (strcmp(techniques[i]->name, name) == 0)
            return techniques[i];
    return NULL;
}

const char *lsf_technique_name(uint32_t index)
{
    return index < LSF_COUNT(techniques) ? techniques[index]->name : NULL;
}

const char *lsf_technique_help(uint32_t index)
{
    return index < LSF_COUNT(techniques) ? techniques[index]->help : NULL;
}

/* Option groups that every technique takes. */
static const char *const common_groups[] = {"tessellation", "environment", "gbuffer",
                                            "shadow",       "interleave",  "light_filter",
                                            "denoise",      "temporal",    NULL};

static bool has_group(const char *const *groups, const char *key)
{
    size_t length = strcspn(key, ".");
    for (; groups && *groups; groups++)
        if (strlen(*groups) == length && strncmp(*groups, key, length) == 0)
            return true;
    return false;
}

static bool is_option(const char *key)
{
    lsf_option option;
    for (uint32_t i = 0; lsf_option_list(i, &option); i++)
        if (strcmp(option.key, key) == 0)
            return true;
    return false;
}

bool lsf_technique_takes(const char *technique, const char *key)
{
    const lsf_technique *found = technique && key ? lsf_technique_find(technique) : NULL;
    return found && is_option(key) &&
           (has_group(common_groups, key) || has_group(found->groups, key));
}

bool lsf_option_list(uint32_t index, lsf_option *option)
{
    if (!option)
        return false;
    return lsf_option_at(lsf_pass_option_tables, lsf_pass_option_table_count, index, option);
}
