#include "passes/light_tree_sample.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

/* Uniforms of light_tree_sample. */
#define LOCATION_DISC 0
#define LOCATION_ITERATION 1
#define LOCATION_SPREAD 2
#define LOCATION_CUT 3
#define LOCATION_TRIANGLES 5

/* Tests of triangles for a point. */
#define TRIANGLES_MOST (1 << 19)

const lsf_option_row lsf_light_tree_sample_options[LSF_LIGHT_TREE_SAMPLE_OPTION_COUNT] = {
    {"light_tree.node", LSF_OPTION_ENUM, offsetof(lsf_light_tree_sample_params, node), 0, 0,
     "substitute|lightcut|vpl", "",
     "where a sample ends; substitute: at a node that represents many virtual point lights, if "
     "the sample is diffuse; lightcut: at one light, chosen by its possible contribution; vpl: at "
     "one light, chosen by its brightness alone"},
    {"light_tree.angle", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_sample_params, angle), 0.0, 1e6,
     NULL, "rad",
     "largest angle that the standard deviation of a node's lights may subtend at a point for the "
     "node to represent them; 0: any"},
    {"light_tree.cut", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_sample_params, cut), 0.0, 1e6,
     NULL, "rad",
     "samples begin at nodes of the tree whose lights' standard deviation subtends at most this "
     "angle at the point; smaller: slower, with fewer bright pixels; 0: all begin at the root"},
    {"light_tree.samples", LSF_OPTION_INT, offsetof(lsf_light_tree_sample_params, samples), 0,
     LSF_LIGHT_TREE_SAMPLE_MOST, NULL, "samples",
     "samples of the cloud per point and iteration; 0: 4, or fewer where a time limit leaves "
     "software OpenGL too little time for them"},
    {"light_tree.bound", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_sample_params, bound), 0.0, 1e6,
     NULL, "disc radii",
     "smallest distance of virtual point lights from what they light, relative to the disc of the "
     "area that one represents; 0: exact, with spikes"},
    {"light_tree.kernel_samples", LSF_OPTION_FLOAT,
     offsetof(lsf_light_tree_sample_params, kernel_samples), 0.0, 1e6, NULL, "samples",
     "virtual point lights over which a glossy lobe is spread; fewer: sharper, with more spikes; "
     "0: exact"},
    {"light_tree.lobe_alpha", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_sample_params, lobe_alpha),
     0.0, 1.0, NULL, "",
     "smallest squared roughness, in one iteration, of surfaces that cast specular light on "
     "others; it falls with the sixth root of the number of iterations; 0: exact, with spikes"},
    {"light_tree.sight", LSF_OPTION_ENUM, offsetof(lsf_light_tree_sample_params, sight), 0, 0,
     "voxels|exact|open", "",
     "what occludes samples; voxels: the voxels; for measurements, exact: each opaque triangle of "
     "a scene with few; open: nothing"},
};

const char *const lsf_light_tree_sample_count_names[LSF_LIGHT_TREE_SAMPLE_COUNTS] = {
    [LSF_LIGHT_TREE_SAMPLE_ALL] = "samples",
    [LSF_LIGHT_TREE_SAMPLE_DEAD] = "dead",
    [LSF_LIGHT_TREE_SAMPLE_STEPS] = "steps"};

#define AT(member) offsetof(lsf_light_tree_sample, light.member)

static const lsf_texture_row textures[] = {
    {"light_tree_sample.irradiance", GL_RGBA32F, AT(irradiance), 0,
     "light for the diffuse lobe, without its albedo"},
    {"light_tree_sample.specular", GL_RGBA32F, AT(specular), LSF_TEXTURE_SPECULAR,
     "light of the specular lobe"},
};

/* Whether all triangles may be tried for each sample: 16 in a turn of a loop, of which software GL
 * makes 65535 in all, some thousand of them for other ends. */
static bool triangles_are_few(const lsf_plan *plan, const lsf_light_tree_sample_params *params)
{
    return lsf_plan_find(plan, "scene.triangles") &&
           plan->requirements.triangles * (uint64_t)params->samples <= TRIANGLES_MOST;
}

/* As LSF_LIGHT_TREE_SIGHT says it. */
static int sight_of(const lsf_plan *plan, const lsf_light_tree_sample_params *params)
{
    if (params->sight == LSF_LIGHT_TREE_OPEN)
        return 0;
    return params->sight == LSF_LIGHT_TREE_EXACT && triangles_are_few(plan, params) ? 2 : 1;
}

static void plan_triangles(lsf_plan *plan, const lsf_light_tree_sample_params *params)
{
    lsf_scene_gpu_plan_triangles(plan);
    if (!triangles_are_few(plan, params))
        lsf_plan_remark(plan,
                        "light_tree.sight=exact tests at most %d triangles, shared among "
                        "light_tree.samples; the "
                        "scene has %llu: voxels are used instead",
                        TRIANGLES_MOST, (unsigned long long)plan->requirements.triangles);
    else if (plan->transmission || plan->requirements.masked)
        lsf_plan_remark(plan,
                        "light_tree.sight=exact: masked and transparent surfaces do not occlude");
}

void lsf_light_tree_sample_plan(lsf_plan *plan, const lsf_light_tree_sample_params *params,
                                bool covariance, bool lobes)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    uint32_t size[2];
    lsf_plan_pass_add(plan, "light_tree_sample", "%d sample%s of the cloud for each visible point",
                      params->samples, lsf_plural((uint64_t)params->samples));
    lsf_plan_reads(plan, "view points|gbuffer vpl_cloud light_tree");
    if (params->sight != LSF_LIGHT_TREE_OPEN)
        lsf_plan_reads(plan, "voxelize");
    if (params->sight == LSF_LIGHT_TREE_EXACT)
        plan_triangles(plan, params);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_SUBSTITUTE",
                        params->node == LSF_LIGHT_TREE_SUBSTITUTE, "light_tree.node is substitute");
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_SAMPLES", params->samples, "light_tree.samples");
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_SITES", params->node != LSF_LIGHT_TREE_VPL,
                        "light_tree.node is not vpl");
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_SIGHT", sight_of(plan, params),
                        "light_tree.sight is voxels: 1; exact: 2");
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_COVARIANCE", covariance, "light_tree.covariance");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    if (params->sight == LSF_LIGHT_TREE_VOXELS)
        lsf_voxel_passage_all_switches(plan);
    else
        lsf_scene_gpu_scatter_switches(plan);
    lsf_scene_gpu_lobe_switches(plan, specular_params);
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PATHS", lobes, "paths gather narrow lobes");
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, size[0], size[1]);
    lsf_plan_buffer_add(plan, "light_tree_sample.counts",
                        LSF_LIGHT_TREE_SAMPLE_COUNTS * 2 * sizeof(GLuint),
                        "what became of samples");
}

bool lsf_light_tree_sample_create(lsf_light_tree_sample *pass, lsf_context *context,
                                  const lsf_plan *plan, const lsf_light_tree_sample_params *params,
                                  lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/light_tree_sample.frag.glsl"};
    *pass = (lsf_light_tree_sample){
        .context = context,
        .params = *params,
        .sight = sight_of(plan, params),
        .lobes = lsf_plan_switch_value(plan, "light_tree_sample", "LSF_SPECULAR_PATHS")};
    const lsf_split_light *out = &pass->light;
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree_sample.counts", NULL, 0,
                                &pass->count_buffer, error) ||
        !lsf_light_tree_fetch_create(&pass->fetch, context, error))
        return false;
    glClearNamedBufferData(pass->count_buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    lsf_framebuffer_desc desc = {.label = "light_tree_sample",
                                 .color_count = out->specular ? 2 : 1,
                                 .colors = {out->irradiance, out->specular},
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "light_tree_sample", files, error);
    pass->timer = lsf_timer_create(context, "light_tree_sample", error);
    return pass->framebuffer && pass->program && pass->timer;
}

/* Areas of discs: the clouds of so many iterations count as one, each of whose VPLs stands for
 * as much less. What is spread over alpha is off by alpha^2, and the variance of n samples in a
 * lobe falls as 1 / (n alpha^2): their sum is least with alpha^2 as n^(-1/3) (A. Kaplanyan, C.
 * Dachsbacher 2013, "Path Space Regularization for Holistic and Robust Light Transport"). */
static void set_disc_scale(const lsf_light_tree_sample *pass, const lsf_iteration *iteration)
{
    float clouds = lsf_iteration_expected(iteration), bound = pass->params.bound;
    glUniform3f(LOCATION_DISC, bound * bound / clouds,
                pass->params.kernel_samples * LSF_PI / clouds,
                pass->params.lobe_alpha * powf(clouds, -1.0f / 6.0f));
}

/* Of variances to squared distances: 0 rad are any. */
static float square_or_any(float angle)
{
    return angle > 0.0f ? angle * angle : INFINITY;
}

static void bind_sight(const lsf_light_tree_sample *pass, const lsf_iteration *iteration,
                       const lsf_light_tree_sample_inputs *inputs)
{
    if (pass->sight == 1) {
        lsf_voxels_bind(inputs->voxels);
        lsf_voxel_passage_bind(iteration);
    }
    if (pass->sight != 2)
        return;
    lsf_voxels_bind_grid(inputs->voxels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_TRIANGLES,
                     iteration->scene->triangles);
    glUniform1ui(LOCATION_TRIANGLES, iteration->scene->triangle_count);
}

float lsf_light_tree_sample_lobe_kernel(const lsf_light_tree_sample *pass,
                                        const lsf_iteration *iteration)
{
    return 2.0f * LSF_PI * pass->params.kernel_samples /
           ((float)pass->params.samples * lsf_iteration_expected(iteration));
}

void lsf_light_tree_sample_run(lsf_light_tree_sample *pass, const lsf_iteration *iteration,
                               const lsf_light_tree_sample_inputs *inputs)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, grid->width, grid->layers * grid->height,
                         pass->program);
    lsf_surface_maps_bind(inputs->seen);
    lsf_light_tree_fetch_bind(&pass->fetch, inputs->tree);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_COUNTS, pass->count_buffer);
    bind_sight(pass, iteration, inputs);
    set_disc_scale(pass, iteration);
    if (pass->lobes)
        glUniform1f(LSF_LOCATION_SPECULAR_SHARE,
                    lsf_light_tree_sample_lobe_kernel(pass, iteration));
    glUniform1f(LOCATION_SPREAD, square_or_any(pass->params.angle));
    /* By luminance alone the root is as good as any cut. */
    glUniform1f(LOCATION_CUT, pass->params.node == LSF_LIGHT_TREE_VPL
                                  ? INFINITY
                                  : square_or_any(pass->params.cut));
    glUniform2ui(LOCATION_ITERATION, iteration->index,
                 lsf_iteration_seed(iteration, LSF_PURPOSE_LIGHT_TREE));
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

const uint64_t *lsf_light_tree_sample_counts(lsf_light_tree_sample *pass)
{
    GLuint words[2 * LSF_LIGHT_TREE_SAMPLE_COUNTS];
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(pass->count_buffer, 0, sizeof words, words);
    for (size_t i = 0; i < LSF_LIGHT_TREE_SAMPLE_COUNTS; i++)
        pass->counts[i] = words[2 * i] | (uint64_t)words[2 * i + 1] << 32;
    return pass->counts;
}

void lsf_light_tree_sample_destroy(lsf_light_tree_sample *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_light_tree_fetch_destroy(&pass->fetch);
    lsf_buffer_destroy(pass->context, &pass->count_buffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
