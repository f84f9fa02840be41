/* The module lightsheaf-denoiser: the network on the CPU, by oneDNN. What is read beside a map is
 * not put behind it: a second convolution adds to what the first has made. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <dnnl.h>

#include "denoiser/chain.h"
#include "denoiser/module.h"

/* Maps begin at multiples of it: the width of the widest registers. */
#define ALIGNMENT 64

/* A convolution by itself: `sum` adds to what is there, `leak` below 1 rectifies. */
typedef struct convolution {
    dnnl_primitive_t primitive;
    dnnl_memory_t weights, bias; /* bias NULL: none */
} convolution;

typedef struct runner {
    uint32_t width, height;
    float leak;
    lsf_net_chain chain;
    dnnl_engine_t engine;
    dnnl_stream_t stream;
    dnnl_format_tag_t layout; /* of feature maps */
    void *shared, *states[2], *pooled;
    dnnl_memory_t maps[LSF_NET_MAPS_MAX]; /* where a step has its result */
    dnnl_memory_t kept[LSF_NET_MAPS_MAX]; /* ... had it in the frame before; NULL: is not kept */
    dnnl_memory_t pools[LSF_NET_MAPS_MAX];
    dnnl_memory_t plain_input, plain_output;
    dnnl_primitive_t read_input, write_output, pool[LSF_NET_MAPS_MAX];
    convolution alone[LSF_NET_MAPS_MAX]; /* without what is beside */
    convolution first[LSF_NET_MAPS_MAX], beside[LSF_NET_MAPS_MAX];
} runner;

static bool done(dnnl_status_t status)
{
    return status == dnnl_success;
}

/* --- memory --- */

static bool describe(dnnl_memory_desc_t *desc, uint32_t features, uint32_t height, uint32_t width,
                     dnnl_format_tag_t tag)
{
    const dnnl_dims_t size = {1, features, height, width};
    return done(dnnl_memory_desc_init_by_tag(desc, 4, size, dnnl_f32, tag));
}

static bool describe_map(const runner *r, uint32_t map, dnnl_memory_desc_t *desc)
{
    const lsf_net_map *m = &r->chain.maps[map];
    return describe(desc, m->features, m->height, m->width, r->layout);
}

/* The most common layouts; plain where the library wants another one on this CPU. */
static bool choose_layout(runner *r)
{
    static const dnnl_format_tag_t tags[] = {dnnl_nChw16c, dnnl_nChw8c, dnnl_nhwc};
    const dnnl_dims_t kernel = {32, 32, 3, 3}, strides = {1, 1}, padding = {1, 1};
    dnnl_memory_desc_t any, weights, desc;
    dnnl_convolution_desc_t probe;
    dnnl_primitive_desc_t primitive;
    r->layout = dnnl_nchw;
    if (!describe(&any, 32, 64, 64, dnnl_format_tag_any) ||
        !done(dnnl_memory_desc_init_by_tag(&weights, 4, kernel, dnnl_f32, dnnl_format_tag_any)) ||
        !done(dnnl_convolution_forward_desc_init(&probe, dnnl_forward_inference,
                                                 dnnl_convolution_direct, &any, &weights, NULL,
                                                 &any, strides, padding, padding)) ||
        !done(dnnl_primitive_desc_create(&primitive, &probe, NULL, r->engine, NULL)))
        return false;
    const dnnl_memory_desc_t *chosen =
        dnnl_primitive_desc_query_md(primitive, dnnl_query_dst_md, 0);
    for (size_t i = 0; i < LSF_COUNT(tags); i++)
        if (describe(&desc, 32, 64, 64, tags[i]) && dnnl_memory_desc_equal(chosen, &desc))
            r->layout = tags[i];
    return done(dnnl_primitive_desc_destroy(primitive));
}

static void *allocate(uint64_t bytes)
{
    uint64_t whole = (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    void *memory = aligned_alloc(ALIGNMENT, whole ? whole : ALIGNMENT);
    if (memory)
        memset(memory, 0, whole);
    return memory;
}

static bool make_maps(runner *r)
{
    lsf_net_chain *chain = &r->chain;
    dnnl_memory_desc_t desc;
    size_t pooled = 0;
    for (uint32_t i = 0; i <= chain->step_count; i++) {
        /* What goes in and comes out is brought into another layout: that is shared, too. */
        if (chain->maps[i].home == LSF_NET_OUTSIDE && i > 0)
            chain->maps[i].home = LSF_NET_SHARED;
        if (!describe_map(r, i, &desc))
            return false;
        chain->maps[i].bytes = dnnl_memory_desc_get_size(&desc);
    }
    lsf_net_chain_assign_offsets(chain, ALIGNMENT);
    for (uint32_t i = 0; i < chain->step_count; i++) {
        const lsf_net_map *source = &chain->maps[chain->steps[i].source];
        if (chain->steps[i].pooled && source->bytes / 2 > pooled)
            pooled = source->bytes / 2;
    }
    r->shared = allocate(chain->shared_bytes);
    r->pooled = allocate(pooled);
    for (int i = 0; i < 2; i++)
        r->states[i] = allocate(chain->state_bytes);
    if (!r->shared || !r->pooled || !r->states[0] || !r->states[1])
        return false;
    for (uint32_t i = 0; i <= chain->step_count; i++) {
        const lsf_net_map *map = &chain->maps[i];
        bool state = map->home == LSF_NET_STATE;
        char *base = i == 0 ? NULL : state ? r->states[1] : r->shared;
        void *memory = base ? base + map->offset : DNNL_MEMORY_ALLOCATE;
        if (!describe_map(r, i, &desc) ||
            !done(dnnl_memory_create(&r->maps[i], &desc, r->engine, memory)) ||
            (state && !done(dnnl_memory_create(&r->kept[i], &desc, r->engine,
                                               (char *)r->states[0] + map->offset))))
            return false;
    }
    return true;
}

/* --- primitives --- */

static bool reorder(const runner *r, dnnl_memory_t from, dnnl_memory_t to, dnnl_primitive_t *made)
{
    const dnnl_memory_desc_t *from_desc, *to_desc;
    dnnl_primitive_desc_t desc;
    if (!done(dnnl_memory_get_memory_desc(from, &from_desc)) ||
        !done(dnnl_memory_get_memory_desc(to, &to_desc)) ||
        !done(dnnl_reorder_primitive_desc_create(&desc, from_desc, r->engine, to_desc, r->engine,
                                                 NULL)))
        return false;
    bool good = done(dnnl_primitive_create(made, desc));
    return done(dnnl_primitive_desc_destroy(desc)) && good;
}

static bool run_reorder(const runner *r, dnnl_primitive_t primitive, dnnl_memory_t from,
                        dnnl_memory_t to)
{
    const dnnl_exec_arg_t arguments[] = {{DNNL_ARG_FROM, from}, {DNNL_ARG_TO, to}};
    return done(dnnl_primitive_execute(primitive, r->stream, 2, arguments));
}

/* Weights of features `first` to `first` + `count` of the source, in the layout that is wanted. */
static bool make_weights(const runner *r, const lsf_net_layer *layer, uint32_t first,
                         uint32_t count, const dnnl_memory_desc_t *wanted, dnnl_memory_t *made)
{
    const dnnl_dims_t size = {layer->out, count, layer->side, layer->side};
    size_t taps = (size_t)layer->side * layer->side;
    bool doubles = layer->side == 2;
    dnnl_memory_desc_t desc;
    dnnl_memory_t plain = NULL;
    dnnl_primitive_t primitive = NULL;
    float *weights = lsf_alloc((uint64_t)layer->out * count * taps, sizeof *weights);
    if (!weights)
        return false;
    for (uint32_t o = 0; o < layer->out && !doubles; o++)
        memcpy(weights + o * count * taps, layer->weights + (o * layer->in + first) * taps,
               count * taps * sizeof *weights);
    if (doubles)
        memcpy(weights, layer->weights, layer->out * count * taps * sizeof *weights);
    bool good = done(dnnl_memory_desc_init_by_tag(&desc, 4, size, dnnl_f32,
                                                  doubles ? dnnl_iohw : dnnl_oihw)) &&
                done(dnnl_memory_create(&plain, &desc, r->engine, weights)) &&
                done(dnnl_memory_create(made, wanted, r->engine, DNNL_MEMORY_ALLOCATE)) &&
                reorder(r, plain, *made, &primitive) && run_reorder(r, primitive, plain, *made) &&
                done(dnnl_stream_wait(r->stream));
    dnnl_primitive_destroy(primitive);
    dnnl_memory_destroy(plain);
    free(weights);
    return good;
}

static bool make_bias(const runner *r, const lsf_net_layer *layer, dnnl_memory_t *made)
{
    const dnnl_dims_t size = {layer->out};
    dnnl_memory_desc_t desc;
    void *values;
    if (!done(dnnl_memory_desc_init_by_tag(&desc, 1, size, dnnl_f32, dnnl_a)) ||
        !done(dnnl_memory_create(made, &desc, r->engine, DNNL_MEMORY_ALLOCATE)) ||
        !done(dnnl_memory_get_data_handle(*made, &values)))
        return false;
    memcpy(values, layer->bias, layer->out * sizeof *layer->bias);
    return true;
}

/* What is done to the result: `sum` adds it to what is there; a leak of 1 does nothing. */
static bool make_attributes(dnnl_primitive_attr_t *made, bool sum, float leak)
{
    dnnl_post_ops_t after;
    if (!done(dnnl_primitive_attr_create(made)) || !done(dnnl_post_ops_create(&after)))
        return false;
    bool good = (!sum || done(dnnl_post_ops_append_sum(after, 1.0f))) &&
                (leak >= 1.0f ||
                 done(dnnl_post_ops_append_eltwise(after, 1.0f, dnnl_eltwise_relu, leak, 0.0f))) &&
                done(dnnl_primitive_attr_set_post_ops(*made, after));
    return done(dnnl_post_ops_destroy(after)) && good;
}

static bool make_primitive_desc(const runner *r, const lsf_net_layer *layer,
                                const dnnl_memory_desc_t *source, const dnnl_memory_desc_t *target,
                                bool sum, dnnl_primitive_attr_t attributes,
                                dnnl_primitive_desc_t *made)
{
    const dnnl_dims_t size = {layer->out, source->dims[1], layer->side, layer->side};
    const dnnl_dims_t bias_size = {layer->out}, one = {1, 1}, two = {2, 2}, none = {0, 0};
    dnnl_memory_desc_t weights, bias;
    dnnl_convolution_desc_t plain;
    dnnl_deconvolution_desc_t doubling;
    if (!done(dnnl_memory_desc_init_by_tag(&weights, 4, size, dnnl_f32, dnnl_format_tag_any)) ||
        !done(dnnl_memory_desc_init_by_tag(&bias, 1, bias_size, dnnl_f32, dnnl_a)))
        return false;
    if (layer->side == 2)
        return done(dnnl_deconvolution_forward_desc_init(
                   &doubling, dnnl_forward_inference, dnnl_deconvolution_direct, source, &weights,
                   &bias, target, two, none, none)) &&
               done(dnnl_primitive_desc_create(made, &doubling, attributes, r->engine, NULL));
    return done(dnnl_convolution_forward_desc_init(&plain, dnnl_forward_inference,
                                                   dnnl_convolution_direct, source, &weights,
                                                   sum ? NULL : &bias, target, one, one, one)) &&
           done(dnnl_primitive_desc_create(made, &plain, attributes, r->engine, NULL));
}

/* Of `count` features of the layer's from `first` on, which `source` holds. */
static bool make_convolution(const runner *r, const lsf_net_layer *layer, dnnl_memory_t source,
                             dnnl_memory_t target, uint32_t first, bool sum, float leak,
                             convolution *made)
{
    const dnnl_memory_desc_t *from, *to, *weights;
    dnnl_primitive_attr_t attributes = NULL;
    dnnl_primitive_desc_t desc = NULL;
    bool good = done(dnnl_memory_get_memory_desc(source, &from)) &&
                done(dnnl_memory_get_memory_desc(target, &to)) &&
                make_attributes(&attributes, sum, leak) &&
                make_primitive_desc(r, layer, from, to, sum, attributes, &desc);
    if (good) {
        weights = dnnl_primitive_desc_query_md(desc, dnnl_query_weights_md, 0);
        good = done(dnnl_primitive_create(&made->primitive, desc)) &&
               make_weights(r, layer, first, (uint32_t)from->dims[1], weights, &made->weights) &&
               (sum || make_bias(r, layer, &made->bias));
    }
    dnnl_primitive_desc_destroy(desc);
    dnnl_primitive_attr_destroy(attributes);
    return good;
}

static bool make_pool(runner *r, uint32_t step)
{
    const lsf_net_map *source = &r->chain.maps[r->chain.steps[step].source];
    const dnnl_dims_t two = {2, 2}, none = {0, 0};
    const dnnl_memory_desc_t *from;
    dnnl_memory_desc_t to;
    dnnl_pooling_desc_t pooling;
    dnnl_primitive_desc_t desc;
    if (!done(dnnl_memory_get_memory_desc(r->maps[r->chain.steps[step].source], &from)) ||
        !describe(&to, source->features, source->height / 2, source->width / 2, r->layout) ||
        !done(dnnl_memory_create(&r->pools[step], &to, r->engine, r->pooled)) ||
        !done(dnnl_pooling_forward_desc_init(&pooling, dnnl_forward_inference, dnnl_pooling_max,
                                             from, &to, two, two, none, none)) ||
        !done(dnnl_primitive_desc_create(&desc, &pooling, NULL, r->engine, NULL)))
        return false;
    bool good = done(dnnl_primitive_create(&r->pool[step], desc));
    return done(dnnl_primitive_desc_destroy(desc)) && good;
}

static bool make_step(runner *r, uint32_t i)
{
    const lsf_net_step *step = &r->chain.steps[i];
    const lsf_net_layer *layer = step->layer;
    dnnl_memory_t target = r->maps[i + 1];
    float leak = step->last || layer->side == 2 ? 1.0f : r->leak;
    if (step->pooled && !make_pool(r, i))
        return false;
    dnnl_memory_t source = step->pooled ? r->pools[i] : r->maps[step->source];
    bool always_beside = step->beside && !step->kept;
    if (!always_beside && !make_convolution(r, layer, source, target, 0, false, leak, &r->alone[i]))
        return false;
    if (!step->beside)
        return true;
    dnnl_memory_t beside = step->kept ? r->kept[i + 1] : r->maps[step->beside];
    return make_convolution(r, layer, source, target, 0, false, 1.0f, &r->first[i]) &&
           make_convolution(r, layer, beside, target, layer->in - step->beside_features, true, leak,
                            &r->beside[i]);
}

/* Plain maps of the caller's, which are set when it runs. */
static bool make_ends(runner *r)
{
    uint32_t last = r->chain.step_count;
    dnnl_memory_desc_t input, output;
    return describe(&input, LSF_NET_INPUTS, r->height, r->width, dnnl_nchw) &&
           describe(&output, LSF_NET_OUTPUTS, r->height, r->width, dnnl_nchw) &&
           done(dnnl_memory_create(&r->plain_input, &input, r->engine, DNNL_MEMORY_NONE)) &&
           done(dnnl_memory_create(&r->plain_output, &output, r->engine, DNNL_MEMORY_NONE)) &&
           reorder(r, r->plain_input, r->maps[0], &r->read_input) &&
           reorder(r, r->maps[last], r->plain_output, &r->write_output);
}

/* --- the module's functions --- */

static void destroy_convolution(convolution *c)
{
    dnnl_primitive_destroy(c->primitive);
    dnnl_memory_destroy(c->weights);
    dnnl_memory_destroy(c->bias);
}

static void destroy(void *self)
{
    runner *r = self;
    if (!r)
        return;
    for (uint32_t i = 0; i < LSF_NET_MAPS_MAX; i++) {
        destroy_convolution(&r->alone[i]);
        destroy_convolution(&r->first[i]);
        destroy_convolution(&r->beside[i]);
        dnnl_primitive_destroy(r->pool[i]);
        dnnl_memory_destroy(r->maps[i]);
        dnnl_memory_destroy(r->kept[i]);
        dnnl_memory_destroy(r->pools[i]);
    }
    dnnl_primitive_destroy(r->read_input);
    dnnl_primitive_destroy(r->write_output);
    dnnl_memory_destroy(r->plain_input);
    dnnl_memory_destroy(r->plain_output);
    dnnl_stream_destroy(r->stream);
    dnnl_engine_destroy(r->engine);
    free(r->shared);
    free(r->pooled);
    free(r->states[0]);
    free(r->states[1]);
    free(r);
}

static void *create(const lsf_net *net, uint32_t width, uint32_t height, bool recurrent,
                    lsf_error *error)
{
    runner *r = lsf_alloc(1, sizeof *r);
    bool good = r != NULL;
    if (good) {
        r->width = width;
        r->height = height;
        r->leak = net->leak;
        lsf_net_chain_make(&r->chain, net, width, height, recurrent);
        good = done(dnnl_engine_create(&r->engine, dnnl_cpu, 0)) &&
               done(dnnl_stream_create(&r->stream, r->engine, dnnl_stream_default_flags)) &&
               choose_layout(r) && make_maps(r) && make_ends(r);
    }
    for (uint32_t i = 0; good && i < r->chain.step_count; i++)
        good = make_step(r, i);
    if (good)
        return r;
    lsf_error_set(error, LSF_ERROR_RENDER,
                  "oneDNN cannot run the network at %ux%u pixels: memory may be short; use a "
                  "smaller resolution, or denoise.processor=gl",
                  width, height);
    destroy(r);
    return NULL;
}

static bool convolve(const runner *r, const convolution *c, dnnl_memory_t source,
                     dnnl_memory_t target)
{
    const dnnl_exec_arg_t arguments[] = {{DNNL_ARG_SRC, source},
                                         {DNNL_ARG_DST, target},
                                         {DNNL_ARG_WEIGHTS, c->weights},
                                         {DNNL_ARG_BIAS, c->bias}};
    return done(dnnl_primitive_execute(c->primitive, r->stream, c->bias ? 4 : 3, arguments));
}

static bool run_step(const runner *r, uint32_t i, bool kept)
{
    const lsf_net_step *step = &r->chain.steps[i];
    dnnl_memory_t source = r->maps[step->source], target = r->maps[i + 1];
    if (step->pooled) {
        const dnnl_exec_arg_t arguments[] = {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, r->pools[i]}};
        if (!done(dnnl_primitive_execute(r->pool[i], r->stream, 2, arguments)))
            return false;
        source = r->pools[i];
    }
    if (!step->beside || (step->kept && !kept))
        return convolve(r, &r->alone[i], source, target);
    return convolve(r, &r->first[i], source, target) &&
           convolve(r, &r->beside[i], step->kept ? r->kept[i + 1] : r->maps[step->beside], target);
}

static bool run(void *self, const float *input, float *output, bool kept, lsf_error *error)
{
    runner *r = self;
    bool good = done(dnnl_memory_set_data_handle(r->plain_input, (void *)(uintptr_t)input)) &&
                done(dnnl_memory_set_data_handle(r->plain_output, output)) &&
                run_reorder(r, r->read_input, r->plain_input, r->maps[0]);
    for (uint32_t i = 0; good && i < r->chain.step_count; i++)
        good = run_step(r, i, kept);
    good = good && run_reorder(r, r->write_output, r->maps[r->chain.step_count], r->plain_output) &&
           done(dnnl_stream_wait(r->stream));
    return good || lsf_error_set(error, LSF_ERROR_RENDER, "oneDNN has failed to run the network");
}

static void keep(void *self)
{
    runner *r = self;
    for (uint32_t i = 0; i < LSF_NET_MAPS_MAX; i++) {
        void *old, *new;
        if (!r->kept[i])
            continue;
        dnnl_memory_get_data_handle(r->kept[i], &old);
        dnnl_memory_get_data_handle(r->maps[i], &new);
        dnnl_memory_set_data_handle(r->kept[i], new);
        dnnl_memory_set_data_handle(r->maps[i], old);
    }
}

__attribute__((visibility("default")))
const lsf_denoiser_module lsf_denoiser = {create, run, keep, destroy};
