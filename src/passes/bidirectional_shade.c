#include "passes/bidirectional_shade.h"

#include <string.h>

#include "base/base.h"
#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

const lsf_option_row lsf_bidirectional_shade_options[LSF_BIDIRECTIONAL_SHADE_OPTION_COUNT] = {
    {"bidirectional.strategy", LSF_OPTION_ENUM, offsetof(lsf_bidirectional_shade_params, strategy),
     0, 0, "both|vpl|bundle", "",
     "samples light of punctual lights and emissive surfaces by VPLs and ray-bundles combined, or "
     "by one of them alone"},
    {"bidirectional.sequence", LSF_OPTION_ENUM, offsetof(lsf_bidirectional_shade_params, sequence),
     0, 0, "sobol|random", "",
     "random numbers of lights, VPLs and directions of bundles: low-discrepancy or plain random"},
    {"bidirectional.suppression", LSF_OPTION_ENUM,
     offsetof(lsf_bidirectional_shade_params, suppression), 0, 0, "roughness|clamp|none", "",
     "suppresses spikes on glossy surfaces; roughness: widens the lobe by the density of samples; "
     "clamp: cuts the lobe off"},
    {"bidirectional.kernel_samples", LSF_OPTION_FLOAT,
     offsetof(lsf_bidirectional_shade_params, kernel_samples), 0.01, 1e6, NULL, "samples",
     "samples over which suppression spreads a glossy lobe; fewer: sharper, with more spikes"},
    {"mis.beta", LSF_OPTION_FLOAT, offsetof(lsf_bidirectional_shade_params, mis_beta), 0.0, 100.0,
     NULL, "", "exponent of the power heuristic; 0: equal weights"},
    {"bidirectional.bound", LSF_OPTION_FLOAT, offsetof(lsf_bidirectional_shade_params, bound), 0.0,
     1e6, NULL, "disc radii",
     "smallest distance of VPLs from what they light where they alone end a path, relative to the "
     "disc of the area that a VPL represents; 0: exact, with spikes"},
};

static const char *const vpl_names[2] = {"bidirectional_shade_vpl", "bidirectional_shade_vpl_deep"};
static const char *const hit_names[2] = {"bidirectional_shade_hit", "bidirectional_shade_hit_deep"};

/* Conditions of textures, beside LSF_TEXTURE_SPECULAR. */
enum { DIRECT = 2, DEEP = 4 };

#define AT(member) offsetof(lsf_bidirectional_shade, member)

static const lsf_texture_row textures[] = {
    {"bidirectional_shade.irradiance", GL_RGBA32F, AT(outputs.light.irradiance), 0,
     "light for the diffuse lobe, without its albedo"},
    {"bidirectional_shade.specular", GL_RGBA32F, AT(outputs.light.specular), LSF_TEXTURE_SPECULAR,
     "light of the specular lobe"},
    {"bidirectional_shade.direct_irradiance", GL_RGBA32F, AT(outputs.direct.irradiance), DIRECT,
     "direct light is asked for apart"},
    {"bidirectional_shade.direct_specular", GL_RGBA32F, AT(outputs.direct.specular),
     DIRECT | LSF_TEXTURE_SPECULAR, "direct light is asked for apart"},
    {"bidirectional_shade.position", GL_RGBA32F, AT(outputs.position), DEEP, "vertices of paths"},
    {"bidirectional_shade.surface", GL_RGBA32UI, AT(outputs.surface), DEEP, "vertices of paths"},
    {"bidirectional_shade.throughput", GL_RGBA32UI, AT(throughput), DEEP,
     "what vertices hand on, as half floats"},
    {"bidirectional_shade.specular_params", GL_NONE, AT(outputs.specular_params), DEEP,
     "roughness of vertices"},
};

/* Uniforms of lib/ray_bundle.glsl. */
static const char *const bundle_switches[] = {"LSF_BUNDLE_SPECULAR_PARAMS", "LSF_BUNDLE_ANISOTROPY",
                                              "LSF_BUNDLE_EMISSION", "LSF_BUNDLE_GAPS"};

static void plan_switches(lsf_plan *plan, const lsf_bidirectional_shade_params *params,
                          const lsf_bidirectional_shade_use *use, bool of_vpl, bool deep)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_plan_switch_add(plan, "LSF_DEEP", deep, "vertices are hits of bundles");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_interleave_switch(plan, use->interleave);
    lsf_plan_switch_add(plan, "LSF_POOLED",
                        !deep && plan->filtered && use->interleave > 1 && r->specular,
                        "a filter pools the light of the pattern");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PATHS", use->lobes && !deep,
                        "paths gather narrow lobes");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_scene_gpu_lobe_switches(plan, specular_params);
    lsf_plan_switch_add(plan, "LSF_CLAMP_RADIANCE",
                        params->suppression == LSF_GLOSSY_SUPPRESSION_CLAMP,
                        "bidirectional.suppression is clamp");
    lsf_plan_switch_add(plan, "LSF_SHADOW_TINT",
                        of_vpl ? plan->straight : lsf_light_walls_needed(plan),
                        "light comes through materials that transmit");
    lsf_plan_switch_add(plan, "LSF_SHADOW_PCF", 0, "never: borders converge over iterations");
    lsf_plan_switch_add(plan, "LSF_SHADOW_HEMISPHERE", of_vpl, "the map is a VPL's");
    lsf_light_switches(plan);
    lsf_plan_switch_add(plan, "LSF_BUNDLE_IMPORTANCE", lsf_plan_find(plan, "bundle.pdf") != NULL,
                        "bundles are drawn by the environment's light");
    lsf_plan_switch_add(plan, "LSF_EMITTERS", use->vpl_emitter, "VPLs lie on emissive surfaces");
}

static void plan_vpl(lsf_plan *plan, const lsf_bidirectional_shade_params *params,
                     const lsf_bidirectional_shade_use *use, bool deep)
{
    lsf_plan_pass_add(plan, vpl_names[deep], "%s",
                      deep ? "VPLs light what bundles met" : "VPLs light visible points");
    lsf_plan_reads(plan, deep ? "view vpl" : "view points|gbuffer vpl");
    plan_switches(plan, params, use, true, deep);
    lsf_plan_switch_add(plan, "LSF_PUNCTUAL", use->vpl_light, "VPLs reflect punctual lights");
}

static void plan_hit(lsf_plan *plan, const lsf_bidirectional_shade_params *params,
                     const lsf_bidirectional_shade_use *use, bool deep)
{
    lsf_plan_pass_add(plan, hit_names[deep], "%s",
                      deep ? "what later segments of a path bring" : "what bundles bring");
    lsf_plan_reads(plan, deep ? "view ray_bundle" : "view points|gbuffer ray_bundle");
    if (use->hit_light)
        lsf_plan_reads(plan, "reflective_shadow_map");
    plan_switches(plan, params, use, false, deep);
    for (size_t i = 0; i < sizeof bundle_switches / sizeof bundle_switches[0]; i++)
        lsf_plan_switch_add(plan, bundle_switches[i],
                            lsf_plan_switch_value(plan, "ray_bundle_search", bundle_switches[i]),
                            "as in ray_bundle_search");
    lsf_plan_switch_add(plan, "LSF_EMISSION_ADAPTIVE", lsf_light_emission_is_adaptive(plan),
                        "rsm.pdf is adaptive");
    lsf_plan_switch_add(plan, "LSF_PUNCTUAL", use->hit_light, "hits reflect punctual lights");
    lsf_scene_gpu_media_switch(plan);
    lsf_scene_gpu_environment_switches(plan, "an environment shines");
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", use->split_direct && !deep,
                        "direct light is asked for apart");
    lsf_plan_switch_add(plan, "LSF_CONTINUE", use->vertices > (deep ? 1u : 0u),
                        "paths go on from here");
}

void lsf_bidirectional_shade_plan(lsf_plan *plan, const lsf_bidirectional_shade_params *params,
                                  const lsf_bidirectional_shade_use *use)
{
    bool vpl = use->vpl_light || use->vpl_emitter;
    if (vpl)
        plan_vpl(plan, params, use, false);
    if (vpl && use->deep_vpl)
        plan_vpl(plan, params, use, true);
    if (use->segments > 0)
        plan_hit(plan, params, use, false);
    if (use->segments > 1)
        plan_hit(plan, params, use, true);
    uint32_t given = (use->split_direct ? DIRECT : 0) | (use->vertices > 0 ? DEEP : 0), size[2];
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), given, size[0], size[1]);
}

static bool create_hit(lsf_bidirectional_shade *pass, const lsf_plan *plan, bool deep,
                       lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/bidirectional_shade_hit.frag.glsl"};
    if (!lsf_plan_find_pass(plan, hit_names[deep]))
        return true;
    const lsf_bidirectional_shade_outputs *out = &pass->outputs;
    bool split = lsf_plan_switch_value(plan, hit_names[deep], "LSF_SPLIT_DIRECT");
    bool onward = lsf_plan_switch_value(plan, hit_names[deep], "LSF_CONTINUE");
    lsf_framebuffer_desc desc = {
        .label = hit_names[deep],
        .color_count = 8,
        .colors = {out->light.irradiance, out->light.specular, split ? out->direct.irradiance : 0,
                   split ? out->direct.specular : 0, onward ? out->position : 0,
                   onward ? out->surface : 0, onward ? pass->throughput : 0,
                   onward ? out->specular_params : 0},
        .layer = -1};
    for (uint32_t i = 0; i < 4; i++)
        pass->hit_floats[deep] += desc.colors[i] != 0;
    pass->hit_framebuffers[deep] = lsf_framebuffer_create(pass->context, &desc, error);
    pass->hit_programs[deep] = lsf_plan_program(plan, pass->context, hit_names[deep], files, error);
    return pass->hit_framebuffers[deep] && pass->hit_programs[deep];
}

bool lsf_bidirectional_shade_create(lsf_bidirectional_shade *pass, lsf_context *context,
                                    const lsf_plan *plan,
                                    const lsf_bidirectional_shade_params *params, lsf_error *error)
{
    static const char *const vpl_files[5] = {"lib/fullscreen.vert.glsl",
                                             "passes/bidirectional_shade_vpl.frag.glsl"};
    *pass = (lsf_bidirectional_shade){.context = context, .params = *params};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !create_hit(pass, plan, false, error) || !create_hit(pass, plan, true, error))
        return false;
    const lsf_bidirectional_shade_outputs *out = &pass->outputs;
    const GLuint sums[2][2] = {{out->light.irradiance, out->light.specular},
                               {out->direct.irradiance, out->direct.specular}};
    for (int direct = 0; direct < 2; direct++) {
        if (!sums[direct][0])
            continue;
        lsf_framebuffer_desc desc = {.label = vpl_names[0],
                                     .color_count = 2,
                                     .colors = {sums[direct][0], sums[direct][1]},
                                     .layer = -1};
        pass->vpl_framebuffers[direct] = lsf_framebuffer_create(context, &desc, error);
        if (!pass->vpl_framebuffers[direct])
            return false;
    }
    for (int deep = 0; deep < 2; deep++) {
        if (!lsf_plan_find_pass(plan, vpl_names[deep]))
            continue;
        pass->vpl_programs[deep] =
            lsf_plan_program(plan, context, vpl_names[deep], vpl_files, error);
        if (!pass->vpl_programs[deep])
            return false;
    }
    const char *first = lsf_plan_find_pass(plan, vpl_names[0]) ? vpl_names[0] : hit_names[0];
    pass->lobes = lsf_plan_switch_value(plan, first, "LSF_SPECULAR_PATHS");
    pass->vpl_timer = lsf_timer_create(context, "bidirectional_shade_vpl", error);
    pass->hit_timer =
        pass->vpl_timer ? lsf_timer_create(context, "bidirectional_shade_hit", error) : NULL;
    return pass->hit_timer != NULL;
}

void lsf_bidirectional_shade_clear(lsf_bidirectional_shade *pass)
{
    const lsf_bidirectional_shade_outputs *out = &pass->outputs;
    const GLuint sums[] = {out->light.irradiance, out->light.specular, out->direct.irradiance,
                           out->direct.specular};
    for (size_t i = 0; i < LSF_COUNT(sums); i++)
        if (sums[i])
            glClearTexImage(sums[i], 0, GL_RGBA, GL_FLOAT, NULL);
}

static void bind_vertices(const lsf_bidirectional_shade *pass,
                          const lsf_bidirectional_shade_inputs *inputs,
                          const lsf_bidirectional_sample *sample, bool deep)
{
    lsf_bind_texture(0, deep ? pass->outputs.position : inputs->seen->depth);
    lsf_bind_texture(1, deep ? pass->outputs.surface : inputs->seen->surface);
    lsf_bind_texture(2, deep ? pass->outputs.specular_params : inputs->seen->specular_params);
    lsf_bind_texture(LSF_UNIT_POSITION_PIXELS, inputs->seen->pixels);
    if (deep) {
        lsf_bind_texture(3, pass->throughput);
        glUniform3fv(LSF_LOCATION_ARRIVAL, 1, sample->arrival);
    }
    lsf_shadow_bind(inputs->shadow);
    lsf_bind_texture(LSF_UNIT_BUNDLE_PDF, inputs->bundle_pdf);
}

static void set_sample(const lsf_bidirectional_shade *pass, const lsf_bidirectional_sample *sample,
                       bool deep)
{
    float kernel = 0.0f, before = 0.0f;
    if (sample->iterations > 0.0f)
        kernel = pass->params.kernel_samples / sample->iterations;
    if (deep)
        before = kernel / (sample->path_count * sample->arrival_pdf);
    glUniform4f(LSF_LOCATION_STRATEGY, sample->vpl_count, sample->bundle_count,
                pass->params.mis_beta, sample->weight);
    if (pass->lobes && !deep)
        glUniform1f(LSF_LOCATION_SPECULAR_SHARE, pass->lobe_kernel);
    glUniform4f(LSF_LOCATION_SUPPRESSION, kernel, sample->bound, before, sample->light_probability);
}

/* Balance heuristic between the bundle and directions drawn by the environment's radiance. */
static void set_sky(const lsf_bidirectional_shade *pass, const lsf_bidirectional_sample *sample)
{
    float share[2], kernel[2] = {0.0f, 0.0f};
    for (int side = 0; side < 2; side++) {
        float density = sample->bundle_pdf + sample->sky_pdf[side];
        share[side] = sample->bundle_pdf / density;
        if (sample->iterations > 0.0f)
            kernel[side] =
                pass->params.kernel_samples / (sample->iterations * sample->path_count * density);
    }
    glUniform4f(LSF_LOCATION_SKY_CHANCE, share[0], share[1], kernel[0], kernel[1]);
}

void lsf_bidirectional_shade_vpl(lsf_bidirectional_shade *pass, const lsf_iteration *iteration,
                                 const lsf_bidirectional_shade_inputs *inputs,
                                 const lsf_bidirectional_sample *sample, bool deep, uint32_t vpl,
                                 const lsf_region *region)
{
    bool direct = sample->emitter && !deep && pass->outputs.direct.irradiance;
    lsf_timer_begin(pass->vpl_timer);
    lsf_begin_fullscreen(pass->vpl_framebuffers[direct], iteration->grid.width,
                         iteration->grid.height, pass->vpl_programs[deep]);
    lsf_blend_add(pass->outputs.light.specular ? 2 : 1);
    bind_vertices(pass, inputs, sample, deep);
    set_sample(pass, sample, deep);
    lsf_bind_texture(LSF_UNIT_VPL, inputs->vpls);
    glUniform1ui(LSF_LOCATION_VPL, vpl);
    lsf_region_set(region);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->vpl_timer);
}

void lsf_bidirectional_shade_hit(lsf_bidirectional_shade *pass, const lsf_iteration *iteration,
                                 const lsf_bidirectional_shade_inputs *inputs,
                                 const lsf_bidirectional_sample *sample, bool deep, bool emission,
                                 bool light, const lsf_region *region)
{
    lsf_timer_begin(pass->hit_timer);
    /* Each fragment reads a vertex and then replaces it: its own texel alone, so that a barrier
     * between draws is all it takes (OpenGL 4.5, section 9.3.1). */
    glTextureBarrier();
    lsf_begin_fullscreen(pass->hit_framebuffers[deep], iteration->grid.width,
                         iteration->grid.height, pass->hit_programs[deep]);
    lsf_blend_add(pass->hit_floats[deep]);
    bind_vertices(pass, inputs, sample, deep);
    set_sample(pass, sample, deep);
    lsf_bundle_nodes_bind(&inputs->nodes);
    lsf_bind_texture(4, inputs->hits);
    lsf_bind_texture(LSF_UNIT_EMISSION, inputs->importance);
    lsf_scene_gpu_bind_environment(iteration->scene);
    if (iteration->plan->requirements.environment)
        set_sky(pass, sample);
    glUniform4f(LSF_LOCATION_ADDED, emission, light, sample->path_count, sample->emitter_weight);
    lsf_region_set(region);
    lsf_draw_fullscreen(pass->context);
    glTextureBarrier();
    lsf_timer_end(pass->hit_timer);
}

void lsf_bidirectional_shade_destroy(lsf_bidirectional_shade *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    for (int i = 0; i < 2; i++) {
        lsf_framebuffer_destroy(pass->context, &pass->vpl_framebuffers[i]);
        lsf_framebuffer_destroy(pass->context, &pass->hit_framebuffers[i]);
    }
    lsf_timer_destroy(pass->vpl_timer);
    lsf_timer_destroy(pass->hit_timer);
    memset(pass, 0, sizeof *pass);
}
