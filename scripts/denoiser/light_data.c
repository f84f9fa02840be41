/* What the denoiser learns from: for each frame of a sequence the noisy light that light_filter
 * works on, what it makes of it, what guides it, and the light that many more iterations converge
 * to. README.md has the file's layout. It links the library's insides, as tests do. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "techniques/renderer_parts.h"
#include "tools/options.h"
#include "tools/sequence.h"

#define MAGIC "LSFT"
enum { VERSION = 2, VIEW_FLOATS = 16, NOISY_TEXTURES = 9, CLEAN_TEXTURES = 4 };

/* --- the pixel's sample point, which noisy and clean light of a frame have to share --- */

static struct {
    bool held;
    uint32_t seed, index;
} sample_point;

/* The linker puts these names to calls of lsf_sobol_2d_bits, and to the function itself. */
void __wrap_lsf_sobol_2d_bits(uint32_t index, uint32_t seed, uint32_t bits[2]);
void __real_lsf_sobol_2d_bits(uint32_t index, uint32_t seed, uint32_t bits[2]);

void __wrap_lsf_sobol_2d_bits(uint32_t index, uint32_t seed, uint32_t bits[2])
{
    bool pixel = sample_point.held && seed == sample_point.seed;
    __real_lsf_sobol_2d_bits(pixel ? sample_point.index : index, seed, bits);
}

/* --- a job --- */

typedef struct light_job {
    lsf_settings settings;
    lsf_sequence sequence;
    const char *output; /* what names of files begin with */
    uint32_t clean_iterations;
    lsf_scene *scene;
    lsf_context *context;
    FILE *out;
} light_job;

static bool load(light_job *job, lsf_error *error)
{
    const lsf_settings *settings = &job->settings;
    lsf_scene_params params = lsf_settings_scene_params(settings);
    if (settings->operands.count != 1)
        return lsf_error_set(error, LSF_ERROR_USAGE, "needs one scene");
    job->scene = lsf_scene_load(settings->operands.items[0], &params, error);
    bool good = job->scene != NULL;
    for (uint32_t i = 0; good && i < settings->edits.count; i++)
        good = lsf_scene_edit(job->scene, settings->edits.items[i], error);
    return good;
}

static void write_numbers(light_job *job, const void *numbers, size_t count)
{
    fwrite(numbers, 4, count, job->out);
}

/* RGBA32F, bottom row first; a texture that is not there is 0 with an alpha of -1. */
static bool write_texture(light_job *job, GLuint texture, lsf_error *error)
{
    size_t count = (size_t)job->settings.resolution[0] * job->settings.resolution[1] * 4;
    float *texels = lsf_alloc(count, sizeof *texels);
    if (!texels)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (size_t i = 0; !texture && i < count; i++)
        texels[i] = i % 4 == 3 ? -1.0f : 0.0f;
    if (texture)
        glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, (GLsizei)(count * sizeof *texels), texels);
    write_numbers(job, texels, count);
    free(texels);
    return true;
}

static void write_axis(float *out, lsf_vec4 axis, float sign)
{
    float length = sqrtf(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    out[0] = sign * axis.x / length;
    out[1] = sign * axis.y / length;
    out[2] = sign * axis.z / length;
}

/* The view's axes, to the right, up and backward, and what makes a view depth of a depth. */
static void write_view(light_job *job, const lsf_renderer *renderer)
{
    const struct lsf_view_data *view = &renderer->iteration.view;
    bool flat = renderer->setup.plan->orthographic;
    float numbers[VIEW_FLOATS] = {0};
    write_axis(numbers, flat ? view->start_dx : view->forward_dx, 1.0f);
    write_axis(numbers + 3, flat ? view->start_dy : view->forward_dy, 1.0f);
    write_axis(numbers + 6, view->forward, -1.0f);
    numbers[9] = view->depth.x;
    numbers[10] = view->depth.y;
    numbers[11] = view->depth.w;
    numbers[12] = flat;
    write_numbers(job, numbers, VIEW_FLOATS);
}

/* Noisy light of one frame, or clean light, as the renderer's iterations left it. */
static bool write_frame(light_job *job, lsf_renderer *renderer, bool noisy, lsf_error *error)
{
    const lsf_light_filter *filter = &renderer->light_filter;
    const lsf_light_mean *mean = &renderer->light_mean;
    LSF_LEAVE lsf_context *entered = lsf_renderer_enter(renderer, error);
    if (!entered || !lsf_renderer_catch_up(renderer, true, error))
        return false;
    if (!filter->timer)
        return lsf_error_set(error, LSF_ERROR_USAGE, "the plan has no light_filter");
    lsf_renderer_picture(renderer);
    const GLuint *filtered = filter->turns[(filter->params.steps - 1) % 2];
    const GLuint textures[NOISY_TEXTURES] = {
        filter->light[0], filter->light[1],     filtered[0],
        filtered[1],      mean->diffuse.factor, mean->specular.factor,
        mean->guide,      filter->picture,      renderer->accumulate.means[0]};
    if (noisy)
        write_view(job, renderer);
    for (int i = 0; i < (noisy ? NOISY_TEXTURES : CLEAN_TEXTURES); i++)
        if (!write_texture(job, textures[i], error))
            return false;
    return true;
}

/* All frames of the sequence, by one technique, `iterations` each. Clean light takes random numbers
 * that noisy light does not. */
static bool write_frames(light_job *job, const char *technique, uint32_t iterations, bool noisy,
                         lsf_error *error)
{
    const lsf_sequence *sequence = &job->sequence;
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    uint32_t own = params.samples, first_clean = (sequence->last + 1) * own;
    lsf_view camera, turned;
    params.samples = iterations;
    params.technique = technique;
    lsf_renderer *renderer = lsf_renderer_create(job->context, job->scene, &params, error);
    bool good = renderer && lsf_render_params_view(job->scene, &params, &camera, error);
    for (uint32_t number = sequence->first; good && number <= sequence->last; number++) {
        const lsf_view *view = lsf_sequence_view(sequence, job->scene, &camera, number, &turned);
        lsf_frame frame = lsf_sequence_frame(sequence, number, iterations, view);
        frame.cut = true;
        frame.first_sample = noisy ? number * own : first_clean + number * iterations;
        sample_point.held = true;
        sample_point.seed = lsf_hash(params.seed, LSF_PURPOSE_PIXEL);
        sample_point.index = number * own;
        good = lsf_renderer_begin_frame(renderer, &frame, error) &&
               lsf_renderer_run(renderer, error) && write_frame(job, renderer, noisy, error);
    }
    lsf_renderer_destroy(renderer);
    return good;
}

static bool write_file(light_job *job, const char *technique, bool noisy, lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    uint32_t iterations = noisy ? params.samples : job->clean_iterations;
    const uint32_t header[] = {VERSION,      noisy ? NOISY_TEXTURES : CLEAN_TEXTURES,
                               params.width, params.height,
                               iterations,   job->sequence.last - job->sequence.first + 1};
    char *path = lsf_format("%s_%s.light", job->output, noisy ? technique : "clean");
    job->out = path ? fopen(path, "wb") : NULL;
    bool good = job->out ||
                lsf_error_set(error, LSF_ERROR_USAGE, "%s_*.light: cannot be written", job->output);
    if (good) {
        fwrite(MAGIC, 1, 4, job->out);
        write_numbers(job, header, LSF_COUNT(header));
        good = write_frames(job, technique, iterations, noisy, error);
    }
    if (job->out && fclose(job->out) != 0 && good)
        good = lsf_error_set(error, LSF_ERROR_RENDER, "%s: could not be written", path);
    free(path);
    return good;
}

/* `techniques`: names with commas between them, of noisy light. */
static bool run(light_job *job, char *techniques, lsf_error *error)
{
    lsf_context_params context = lsf_settings_context_params(&job->settings);
    job->sequence = lsf_sequence_of(&job->settings);
    bool good = load(job, error) && (job->context = lsf_context_create(&context, error));
    if (good && job->clean_iterations > 0)
        good = write_file(job, job->settings.technique, false, error);
    char *rest = NULL;
    for (char *name = strtok_r(techniques, ",", &rest); good && name;
         name = strtok_r(NULL, ",", &rest))
        good = write_file(job, name, true, error);
    return good;
}

int main(int argc, char **argv)
{
    if (argc < 5) {
        fprintf(stderr, "usage: lightsheaf-light-data OUT TECHNIQUE[,TECHNIQUE]... "
                        "CLEAN_ITERATIONS SCENE [options of render]\n");
        return 2;
    }
    lsf_error error = {0};
    light_job job = {.output = argv[1], .clean_iterations = (uint32_t)strtoul(argv[3], NULL, 10)};
    bool good = lsf_settings_parse(&job.settings, LSF_COMMAND_RENDER, argc - 3, argv + 3, &error) &&
                run(&job, argv[2], &error);
    if (!good)
        fprintf(stderr, "lightsheaf-light-data: error: %s\n", error.message);
    lsf_context_destroy(job.context);
    lsf_scene_destroy(job.scene);
    lsf_settings_finish(&job.settings);
    return good ? 0 : 1;
}
