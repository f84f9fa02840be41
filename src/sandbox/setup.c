/* From the names in a shader to the plan of what is computed for it. */
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sandbox/engine.h"
#include "shared/sandbox_data.h"

/* Of the picture's technique. */
#define PICTURE_NEEDS (LSF_NEED_PICTURE | LSF_NEED_DIRECT | LSF_NEED_DIFFUSE | LSF_NEED_SPECULAR)
/* What it has made anyway. */
#define SHARED_NEEDS (LSF_NEED_VIEW | LSF_NEED_GBUFFER | LSF_NEED_MOTION)

static bool needs(const lsf_sandbox_setup *setup, lsf_sandbox_need need)
{
    return setup->own & need;
}

static bool lit(const lsf_sandbox_setup *setup)
{
    return setup->setup.state.light_count > 0;
}

lsf_voxel_light_use lsf_sandbox_voxel_light(const lsf_sandbox_setup *setup)
{
    const lsf_pass_params *params = &setup->setup.pass_params;
    return (lsf_voxel_light_use){.sides = LSF_VOXEL_SIDES_AXES,
                                 .levels = LSF_VOXEL_LEVELS,
                                 .lights = lit(setup),
                                 .pcf = params->shadow_map.filter == LSF_SHADOW_FILTER_PCF};
}

lsf_voxel_grid lsf_sandbox_grid(const lsf_sandbox_setup *setup)
{
    const lsf_pass_params *params = &setup->setup.pass_params;
    bool light = needs(setup, LSF_NEED_RADIANCE);
    uint32_t radiance = light ? 8 * LSF_VOXEL_SIDES_AXES : 0;
    const lsf_voxel_grid_use use = {
        .voxels = LSF_VOXEL_RESOLUTION,
        .bytes = lsf_voxelize_bytes(setup->plan, params->voxel_grid.jitter) + radiance * 8 / 7 + 1,
        .sides = light ? LSF_VOXEL_SIDES_AXES : 1};
    return lsf_voxel_grid_fit(&params->voxel_grid, &setup->setup.state, &use);
}

lsf_ray_bundle_use lsf_sandbox_bundle(const lsf_sandbox_setup *setup)
{
    (void)setup;
    return (lsf_ray_bundle_use){.count = 1, .slots = 1, .whole_scene = true, .interleave = 1};
}

static void plan_gbuffer(lsf_sandbox_setup *setup)
{
    if (needs(setup, LSF_NEED_GBUFFER))
        lsf_gbuffer_plan(setup->plan);
    else
        lsf_plan_omit(setup->plan, "gbuffer", "the shader names nothing that pixels see%s",
                      setup->needs & LSF_NEED_GBUFFER ? " but what the picture's technique has"
                                                      : "");
}

static void plan_maps(lsf_sandbox_setup *setup)
{
    lsf_plan *plan = setup->plan;
    const lsf_pass_params *params = &setup->setup.pass_params;
    bool on_voxels = needs(setup, LSF_NEED_RADIANCE), sky = plan->sky_lights > 0;
    bool reflective = needs(setup, LSF_NEED_REFLECTIVE);
    if ((needs(setup, LSF_NEED_SHADOW) && !reflective) || (on_voxels && lit(setup)))
        lsf_shadow_map_plan(plan, &params->shadow_map, &setup->setup.state);
    else
        lsf_plan_omit(plan, "shadow_map", "the shader names no shadow");
    if (reflective)
        lsf_reflective_shadow_map_plan(
            plan, &params->reflective_shadow_map, &setup->setup.state,
            &(lsf_reflective_shadow_map_use){.sky = sky && plan->requirements.environment_map});
    else
        lsf_plan_omit(plan, "reflective_shadow_map", "the shader does not name it");
    if (on_voxels && sky)
        lsf_sky_map_plan(plan, 0);
}

static void plan_voxels(lsf_sandbox_setup *setup)
{
    lsf_plan *plan = setup->plan;
    const lsf_pass_params *params = &setup->setup.pass_params;
    if (!needs(setup, LSF_NEED_VOXELS)) {
        lsf_plan_omit(plan, "voxelize", "the shader names no voxels");
        return;
    }
    lsf_voxel_grid grid = lsf_sandbox_grid(setup);
    lsf_voxel_grid_remark(plan, &params->voxel_grid, &grid);
    if (needs(setup, LSF_NEED_RADIANCE) && lit(setup))
        lsf_shadow_map_plan_scene(plan, &params->shadow_map, &setup->setup.state,
                                  LSF_VOXEL_LIGHT_TEXELS * grid.resolution);
    if (needs(setup, LSF_NEED_RADIANCE) && plan->sky_lights > 0)
        lsf_sky_map_plan_scene(plan, LSF_VOXEL_LIGHT_SKY_TEXELS * grid.resolution);
    lsf_voxelize_plan(plan, &params->voxelize, &grid);
    if (!needs(setup, LSF_NEED_RADIANCE)) {
        lsf_plan_omit(plan, "voxel_light", "the shader names no light of voxels");
        return;
    }
    lsf_voxel_light_use use = lsf_sandbox_voxel_light(setup);
    lsf_voxel_light_plan(plan, &grid, &use);
    lsf_voxel_mip_plan(plan, use.sides);
}

static void plan_bundle(lsf_sandbox_setup *setup)
{
    lsf_ray_bundle_use use = lsf_sandbox_bundle(setup);
    if (needs(setup, LSF_NEED_BUNDLE))
        lsf_ray_bundle_plan(setup->plan, &setup->setup.pass_params.ray_bundle, &use);
    else
        lsf_plan_omit(setup->plan, "ray_bundle_build", "the shader names no ray-bundle");
}

/* Properties of the scene that shaders of the library depend on. */
static void plan_seen_switches(lsf_plan *plan, const lsf_plan *seen)
{
    const lsf_requirements *r = &seen->requirements;
    bool specular_params = lsf_gbuffer_specular_params(seen) != GL_NONE;
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", seen->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", seen->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", seen->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_SEEN_EMISSION", lsf_plan_find(seen, "gbuffer.emission") != NULL,
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_SEEN_MOTION", lsf_plan_find(seen, "gbuffer.motion") != NULL,
                        "motion is named");
}

static void plan_switches(lsf_sandbox_setup *setup)
{
    lsf_plan *plan = setup->plan;
    const lsf_plan *seen = setup->own & LSF_NEED_GBUFFER || !setup->picture ? plan : setup->picture;
    plan_seen_switches(plan, seen);
    lsf_scene_gpu_lobe_switches(plan, lsf_gbuffer_specular_params(seen) != GL_NONE);
    if (setup->own == 0)
        return;
    lsf_plan_switch_add(plan, "LSF_LIGHT_COUNT", (int)setup->setup.state.light_count,
                        "there are as many lights");
    lsf_light_switches(plan);
    bool pcf = setup->setup.pass_params.shadow_map.filter == LSF_SHADOW_FILTER_PCF;
    lsf_plan_switch_add(plan, "LSF_SHADOW_PCF", pcf && !needs(setup, LSF_NEED_REFLECTIVE) ? 4 : 0,
                        "shadow.filter");
    lsf_scene_gpu_environment_switches(plan, "an environment shines");
    if (needs(setup, LSF_NEED_BUNDLE))
        lsf_ray_bundle_reader_switches(plan);
}

/* Which pass uses which name, for readers of the plan. */
static void plan_names(lsf_plan *plan, const lsf_sandbox_text *text)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t i = 0; lsf_sandbox_row_at(i); i++) {
            const lsf_sandbox_location *location = &text->passes[p].locations[i];
            if (location->path && lsf_sandbox_row_at(i)->needs)
                lsf_plan_remark(plan, "%s:%u: %s", location->path, location->line,
                                lsf_sandbox_row_at(i)->name);
        }
}

static void plan_target(lsf_plan *plan, const lsf_sandbox_pass_text *pass, uint32_t index)
{
    char name[32];
    if (!pass->part.text)
        return;
    lsf_print(name, sizeof name, "sandbox.%s", lsf_sandbox_pass_name(index));
    lsf_plan_texture_add(plan, name, GL_RGBA32F, plan->width, plan->height,
                         "what the shader writes");
    lsf_print(name, sizeof name, "sandbox.%s_before", lsf_sandbox_pass_name(index));
    if (pass->feeds_back)
        lsf_plan_texture_add(plan, name, GL_RGBA32F, plan->width, plan->height,
                             "a channel reads what it was a frame before");
}

static void plan_shader(lsf_sandbox_setup *setup, const lsf_sandbox_text *text)
{
    lsf_plan *plan = setup->plan;
    uint32_t count = 0;
    if (setup->picture)
        lsf_plan_pass_add(plan, "picture",
                          "the whole plan of the %s technique: `lightsheaf plan -t %s` lists it",
                          setup->picture->technique, setup->picture->technique);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        count += text->passes[p].part.text != NULL;
    lsf_plan_pass_add(plan, LSF_SANDBOX_PASS, "the shader's own %u pass%s", count,
                      count == 1 ? "" : "es");
    if (setup->scene && setup->needs != 0)
        plan_switches(setup);
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        plan_target(plan, &text->passes[p], p);
    lsf_plan_texture_add(plan, "sandbox.black", GL_RGBA8, 1, 1, "channels that nothing is said of");
    if (text->keyboard)
        lsf_plan_texture_add(plan, "sandbox.keyboard", GL_R8, LSF_SANDBOX_KEYS, 3,
                             "a channel reads the keyboard");
    if (text->radiance)
        lsf_tonemap_plan(plan, true);
    plan_names(plan, text);
}

static bool check_scene(const lsf_sandbox_setup *setup, const lsf_sandbox_text *text,
                        lsf_error *error)
{
    if (setup->scene || text->needs == 0)
        return true;
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        for (uint32_t i = 0; lsf_sandbox_row_at(i); i++) {
            const lsf_sandbox_location *location = &text->passes[p].locations[i];
            if (location->path && lsf_sandbox_row_at(i)->needs)
                return lsf_error_set(error, LSF_ERROR_USAGE,
                                     "%s:%u: %s needs a scene: name one after the shader",
                                     location->path, location->line, lsf_sandbox_row_at(i)->name);
        }
    return lsf_error_set(
        error, LSF_ERROR_USAGE,
        "a file that the shader includes needs a scene: name one after the shader");
}

static bool check_triangles(const lsf_sandbox_setup *setup, lsf_error *error)
{
    bool named = needs(setup, LSF_NEED_VOXELS) || needs(setup, LSF_NEED_BUNDLE);
    return !named || setup->plan->requirements.triangles > 0 ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "the shader names voxels or a ray-bundle, and the scene has no triangles");
}

static bool check_light(const lsf_sandbox_setup *setup, const lsf_sandbox_text *text,
                        lsf_error *error)
{
    uint32_t lights = setup->setup.state.light_count;
    if (!needs(setup, LSF_NEED_SHADOW) || text->light < lights)
        return true;
    const lsf_sandbox_location *location = &text->light_location;
    if (location->path)
        return lsf_error_set(error, LSF_ERROR_USAGE, "%s:%u: @light %u: the scene has %u light%s",
                             location->path, location->line, text->light, lights,
                             lsf_plural(lights));
    return lsf_error_set(error, LSF_ERROR_USAGE,
                         "the shader names a light's map, and the scene has no point, spot or "
                         "directional light; --default-light always adds one");
}

static bool choose_options(lsf_sandbox_setup *setup, const lsf_sandbox_text *text,
                           const lsf_render_params *params, lsf_error *error)
{
    uint64_t count = text->define_count + params->option_count;
    setup->params = *params;
    setup->options = lsf_alloc(count + 1, sizeof *setup->options);
    if (!setup->options)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    for (uint64_t i = 0; i < text->define_count; i++)
        setup->options[i] = text->defines[i];
    for (uint32_t i = 0; i < params->option_count; i++)
        setup->options[text->define_count + i] = params->options[i];
    setup->params.options = setup->options;
    setup->params.option_count = (uint32_t)count;
    setup->params.rgb8 = setup->params.present = false;
    setup->params.aovs = 0;
    return true;
}

static bool begin_picture(lsf_sandbox_setup *setup, lsf_error *error)
{
    static const struct {
        lsf_sandbox_need need;
        uint32_t aov;
    } layers[] = {{LSF_NEED_DIRECT, LSF_AOV_DIRECT},
                  {LSF_NEED_DIFFUSE, LSF_AOV_INDIRECT_DIFFUSE},
                  {LSF_NEED_SPECULAR, LSF_AOV_INDIRECT_SPECULAR},
                  {LSF_NEED_MOTION, LSF_AOV_MOTION}};
    lsf_render_params *params = &setup->params;
    if (!(setup->needs & LSF_NEED_PICTURE))
        return true;
    for (size_t i = 0; i < LSF_COUNT(layers); i++)
        params->aovs |= setup->needs & layers[i].need ? layers[i].aov : 0;
    params->temporal = true;
    params->raw = false;
    setup->picture = lsf_plan_create(setup->scene, params, error);
    return setup->picture != NULL;
}

/* The scene's part of a plan takes the scene's resources: without use for them there is none. */
static bool begin_plan(lsf_sandbox_setup *setup, const lsf_sandbox_text *text, lsf_error *error)
{
    lsf_render_params params = setup->params;
    if (setup->own != 0) {
        params.technique = LSF_SANDBOX_PASS;
        params.temporal = false;
        params.raw = true;
        params.aovs = needs(setup, LSF_NEED_MOTION) ? LSF_AOV_MOTION : 0;
        if (!lsf_setup_begin(&setup->setup, setup->scene, &params, true, error))
            return false;
        setup->plan = setup->setup.plan;
    } else {
        setup->plan = lsf_alloc(1, sizeof *setup->plan);
        if (!setup->plan)
            return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
        setup->plan->width = setup->plan->seen_width = params.width;
        setup->plan->height = setup->plan->seen_height = params.height;
        setup->plan->pixel_side = 1;
        if (setup->picture) {
            setup->plan->requirements = setup->picture->requirements;
            setup->plan->transmission = setup->picture->transmission;
        }
    }
    setup->plan->technique = LSF_SANDBOX_PASS;
    setup->plan->samples = 1;
    return check_triangles(setup, error) && check_light(setup, text, error);
}

bool lsf_sandbox_setup_begin(lsf_sandbox_setup *setup, const lsf_scene *scene,
                             const lsf_sandbox_text *text, const lsf_render_params *params,
                             lsf_error *error)
{
    *setup = (lsf_sandbox_setup){.scene = scene, .needs = text->needs};
    setup->own = text->needs & ~(uint32_t)PICTURE_NEEDS;
    if ((text->needs & LSF_NEED_PICTURE) && !(text->needs & LSF_NEED_HITS))
        setup->own &= ~(uint32_t)SHARED_NEEDS;
    if (!check_scene(setup, text, error) || !choose_options(setup, text, params, error) ||
        !begin_picture(setup, error) || !begin_plan(setup, text, error))
        return false;
    if (setup->own != 0) {
        plan_gbuffer(setup);
        plan_maps(setup);
        plan_voxels(setup);
        plan_bundle(setup);
        if (needs(setup, LSF_NEED_LIGHTS))
            lsf_plan_buffer_add(setup->plan, "sandbox.lights",
                                sizeof(struct lsf_sandbox_light_data) *
                                    (setup->setup.state.light_count + 1),
                                "the scene's lights");
    }
    plan_shader(setup, text);
    return !setup->plan->failed ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
}

void lsf_sandbox_setup_finish(lsf_sandbox_setup *setup)
{
    if (setup->plan != setup->setup.plan)
        lsf_plan_destroy(setup->plan);
    if (setup->own != 0)
        lsf_setup_finish(&setup->setup);
    lsf_plan_destroy(setup->picture);
    free((void *)setup->options);
    *setup = (lsf_sandbox_setup){0};
}
