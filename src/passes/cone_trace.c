#include "passes/cone_trace.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

/* The specular lobe's albedo is tabulated at as many cosines and roughnesses, by as many samples.
 */
#define ALBEDO_SIDE 32u
#define ALBEDO_SAMPLES 128u

/* Uniforms of passes/cone_trace.frag.glsl. */
#define LOCATION_LOBE 0
#define LOCATION_MOST_MIRRORS 1

/* Diameter of the specular cone by its length, to alpha. Half the normals of a GGX surface that one
 * sees lie within atan(alpha) of its own, so that half the mirrored light comes from within 2 alpha
 * of the mirror's direction while alpha is small. A cone has half its solid angle within 1 /
 * sqrt(2) of its half aperture, which is sqrt(8) alpha then. */
#define LOBE_SPREAD (2.0f * 2.8284271f)

#define AT(member) offsetof(lsf_cone_trace, light.member)

static const lsf_texture_row textures[] = {
    {"cone_trace.irradiance", GL_RGBA32F, AT(irradiance), 0,
     "light for the diffuse lobe, without its albedo"},
    {"cone_trace.specular", GL_RGBA32F, AT(specular), LSF_TEXTURE_SPECULAR,
     "light of the specular lobe"},
};

/* What rays read of voxels that mirror, beside what passages read. */
static void plan_mirrors(lsf_plan *plan, bool mirrors, bool lamps)
{
    lsf_plan_switch_add(plan, "LSF_VOXEL_MIRRORS", mirrors,
                        "smooth metals mirror what is around them");
    lsf_voxel_lamps_switch(plan, lamps);
    if ((mirrors || lamps) && !lsf_voxel_passage(plan)) {
        lsf_voxel_specular_params_switch(plan);
        lsf_voxel_bend_switch(plan);
    }
}

void lsf_cone_trace_plan(lsf_plan *plan, const lsf_cone_params *params, bool mirrors, bool lamps)
{
    uint32_t size[2];
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_plan_pass_add(plan, "cone_trace", "%d diffuse cones of each visible point%s", params->count,
                      r->specular ? ", and a specular one" : "");
    lsf_plan_reads(plan, "view points|gbuffer voxelize voxel_bounce|voxel_light voxel_draw");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)lsf_cone_slices(params), "cone.sides");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic && params->sealed,
                        "rays of the lobe are drawn; cones are round");
    lsf_voxel_passage_all_switches(plan);
    plan_mirrors(plan, mirrors, lamps);
    lsf_cone_emission_switches(plan, params);
    lsf_scene_gpu_lobe_switches(plan, specular_params);
    lsf_plan_switch_add(plan, "LSF_SEALED", params->sealed, "cone.sealed");
    lsf_plan_switch_add(plan, "LSF_VOXEL_DRAW", lsf_cone_draws(params), "cone.draws");
    lsf_scene_gpu_environment_switches(plan, "an environment shines");
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, size[0], size[1]);
    if (!r->specular || params->sealed)
        return;
    lsf_plan_texture_add(plan, "cone_trace.lobe_albedo", GL_RG32F, ALBEDO_SIDE, ALBEDO_SIDE,
                         "what the specular lobe reflects, by view and roughness");
}

/* What the lobe of `alpha` reflects of a uniform environment: f0 albedo[0] + albedo[1] (Karis 2013,
 * "Real Shading in Unreal Engine 4"), by samples of the normals that one sees. */
static void lobe_albedo(float cosine, float alpha, float albedo[2])
{
    const lsf_float3 view = {sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine};
    double sums[2] = {0.0, 0.0};
    for (uint32_t i = 0; i < ALBEDO_SAMPLES; i++) {
        float u[2];
        lsf_sobol_2d(i, 0, u);
        lsf_float3 h = lsf_sample_ggx_visible_normal(view, alpha, alpha, u[0], u[1]);
        float vh = lsf_f3_dot(view, h);
        float nl = 2.0f * vh * h.z - view.z;
        if (nl <= 0.0f || vh <= 0.0f)
            continue;
        float d = lsf_ggx_d(h.z, h.x * h.x + h.y * h.y, alpha);
        double reflected = (double)(d * lsf_ggx_v(nl, cosine, alpha) * nl /
                                    lsf_pdf_ggx_reflection(view, h, alpha, alpha));
        double grazing = (double)lsf_fresnel_schlick(0.0f, fminf(vh, 1.0f));
        sums[0] += (1.0 - grazing) * reflected;
        sums[1] += grazing * reflected;
    }
    albedo[0] = (float)(sums[0] / ALBEDO_SAMPLES);
    albedo[1] = (float)(sums[1] / ALBEDO_SAMPLES);
}

static void fill_lobe_albedo(GLuint texture)
{
    float table[ALBEDO_SIDE][ALBEDO_SIDE][2];
    for (uint32_t y = 0; y < ALBEDO_SIDE; y++)
        for (uint32_t x = 0; x < ALBEDO_SIDE; x++)
            lobe_albedo(((float)x + 0.5f) / (float)ALBEDO_SIDE,
                        lsf_alpha_from_roughness(((float)y + 0.5f) / (float)ALBEDO_SIDE),
                        table[y][x]);
    glTextureSubImage2D(texture, 0, 0, 0, ALBEDO_SIDE, ALBEDO_SIDE, GL_RG, GL_FLOAT, table);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

bool lsf_cone_trace_create(lsf_cone_trace *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_cone_params *params, const lsf_voxel_grid *grid,
                           lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/cone_trace.frag.glsl"};
    *pass = (lsf_cone_trace){.context = context, .params = *params, .grid = *grid};
    pass->mirrors = lsf_plan_switch_value(plan, "cone_trace", "LSF_VOXEL_MIRRORS");
    const lsf_split_light *out = &pass->light;
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "cone_trace.lobe_albedo",
                                            &pass->lobe_albedo, error))
        return false;
    if (pass->lobe_albedo)
        fill_lobe_albedo(pass->lobe_albedo);
    lsf_framebuffer_desc desc = {.label = "cone_trace",
                                 .color_count = out->specular ? 2 : 1,
                                 .colors = {out->irradiance, out->specular},
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "cone_trace", files, error);
    pass->timer = lsf_timer_create(context, "cone_trace", error);
    return pass->framebuffer && pass->program && pass->timer;
}

void lsf_cone_trace_run(lsf_cone_trace *pass, const lsf_iteration *iteration,
                        const lsf_cone_trace_inputs *inputs)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, grid->width, grid->layers * grid->height,
                         pass->program);
    lsf_surface_maps_bind(inputs->seen);
    lsf_bind_texture(3, pass->lobe_albedo);
    lsf_voxels_bind(inputs->voxels);
    lsf_cone_bind(&pass->params, &pass->grid, iteration, inputs->radiance, inputs->draws);
    if (inputs->lamps)
        lsf_voxel_lamps_bind(iteration, &pass->grid, inputs->lamps, true);
    if (inputs->emitters)
        lsf_emitter_points_bind(inputs->emitters, pass->params.emitters);
    lsf_voxel_passage_bind(iteration);
    lsf_scene_gpu_bind_environment(iteration->scene);
    if (iteration->plan->requirements.environment)
        lsf_iteration_bind_sky(iteration);
    if (pass->lobe_albedo)
        glUniform1f(LOCATION_LOBE, LOBE_SPREAD);
    if (pass->mirrors)
        glUniform1i(LOCATION_MOST_MIRRORS, (GLint)iteration->plan->bounces - 1);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_cone_trace_destroy(lsf_cone_trace *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_texture_destroy(pass->context, &pass->lobe_albedo);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
