#include "denoiser/net.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/half.h"

#define FILE_VERSION 1

typedef struct reader {
    const unsigned char *at, *end;
    const char *name; /* of the file */
    lsf_error *error;
} reader;

static bool refuse(const reader *r, const char *what)
{
    return lsf_error_set(r->error, LSF_ERROR_FILE,
                         "%s: %s; export the weights anew (docs/denoiser.md)", r->name, what);
}

static bool take(reader *r, void *bytes, size_t count)
{
    if ((size_t)(r->end - r->at) < count)
        return refuse(r, "the file of weights is cut short");
    memcpy(bytes, r->at, count);
    r->at += count;
    return true;
}

static bool take_u32(reader *r, uint32_t *value)
{
    unsigned char b[4] = {0};
    if (!take(r, b, sizeof b))
        return false;
    *value = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    return true;
}

static bool take_float(reader *r, float *value)
{
    uint32_t bits = 0;
    if (!take_u32(r, &bits))
        return false;
    memcpy(value, &bits, sizeof bits);
    /* A feature map in half floats holds no more. */
    return (isfinite(*value) && fabsf(*value) <= LSF_HALF_MOST) ||
           refuse(r, "a weight is not a number, or too large");
}

static bool take_half(reader *r, float *value)
{
    unsigned char b[2] = {0};
    if (!take(r, b, sizeof b))
        return false;
    *value = lsf_half_to_float((uint16_t)(b[0] | b[1] << 8));
    return isfinite(*value) || refuse(r, "a weight is not a number, or too large");
}

/* What a layer has to be called, and how large it has to be: 0 where that is for the file to say.
 */
typedef struct expectation {
    char name[32];
    uint32_t in, out, side;
} expectation;

static const lsf_net_layer *layer_at(const lsf_net *net, uint32_t index)
{
    return &net->layers[index];
}

const lsf_net_layer *lsf_net_encode(const lsf_net *net, uint32_t stage, bool second)
{
    return layer_at(net, 2 * (stage - 1) + second);
}

const lsf_net_layer *lsf_net_decode(const lsf_net *net, uint32_t stage, bool second)
{
    return layer_at(net, 2 * net->stages + 2 * (net->stages - 1 - stage) + second);
}

const lsf_net_layer *lsf_net_out(const lsf_net *net)
{
    return layer_at(net, net->layer_count - 1);
}

uint32_t lsf_net_granularity(const lsf_net *net)
{
    return 1u << (net->stages - 1);
}

/* Of the layer at `index`, by those before it. */
static expectation expect(const lsf_net *net, uint32_t index)
{
    expectation e = {.side = 3};
    uint32_t stages = net->stages, encoders = 2 * stages;
    uint32_t before = index > 0 ? net->layers[index - 1].out : LSF_NET_INPUTS;
    bool second = index % 2;
    if (index < encoders) {
        lsf_print(e.name, sizeof e.name, "enc%u%c", index / 2 + 1, second ? 'b' : 'a');
        e.in = second ? 2 * before : before;
        e.out = second ? before : 0;
    } else if (index + 1 < net->layer_count) {
        uint32_t stage = stages - 1 - (index - encoders) / 2;
        lsf_print(e.name, sizeof e.name, "dec%u%c", stage, second ? 'b' : 'a');
        e.in = second ? before + lsf_net_encode(net, stage, true)->out : before;
        e.side = second ? 3 : 2;
    } else {
        lsf_print(e.name, sizeof e.name, "out");
        e.in = before;
        e.out = LSF_NET_OUTPUTS;
    }
    return e;
}

static bool take_name(reader *r, const expectation *expected, char *name, size_t size)
{
    unsigned char length = 0;
    if (!take(r, &length, 1))
        return false;
    if (length >= size)
        return refuse(r, "a layer's name is too long");
    if (!take(r, name, length))
        return false;
    name[length] = '\0';
    lsf_make_printable(name);
    return strcmp(name, expected->name) == 0 ||
           lsf_error_set(r->error, LSF_ERROR_FILE,
                         "%s: layer \"%s\" stands where \"%s\" has to; export the weights anew "
                         "(docs/denoiser.md)",
                         r->name, name, expected->name);
}

static bool take_size(reader *r, const expectation *e, lsf_net_layer *layer)
{
    uint32_t height = 0;
    if (!take_u32(r, &layer->out) || !take_u32(r, &layer->in) || !take_u32(r, &height) ||
        !take_u32(r, &layer->side))
        return false;
    bool good = layer->out > 0 && layer->out <= LSF_NET_FEATURES_MAX && layer->in == e->in &&
                (e->out == 0 || layer->out == e->out) && layer->side == e->side &&
                height == e->side;
    return good ||
           lsf_error_set(r->error, LSF_ERROR_FILE,
                         "%s: layer %s is %u x %u x %u x %u (out, in, height, width), and %s%u x "
                         "%u x %u x %u would fit; export the weights anew (docs/denoiser.md)",
                         r->name, layer->name, layer->out, layer->in, height, layer->side,
                         e->out ? "" : "up to ", e->out ? e->out : LSF_NET_FEATURES_MAX, e->in,
                         e->side, e->side);
}

static bool take_layer(reader *r, const lsf_net *net, uint32_t index)
{
    lsf_net_layer *layer = &net->layers[index];
    const expectation e = expect(net, index);
    if (!take_name(r, &e, layer->name, sizeof layer->name) || !take_size(r, &e, layer))
        return false;
    uint64_t count = (uint64_t)layer->out * layer->in * layer->side * layer->side;
    if (count * 2 + (uint64_t)layer->out * 4 > (uint64_t)(r->end - r->at))
        return refuse(r, "the file of weights is cut short");
    layer->weights = lsf_alloc(count, sizeof *layer->weights);
    layer->bias = lsf_alloc(layer->out, sizeof *layer->bias);
    if (!layer->weights || !layer->bias)
        return lsf_error_set(r->error, LSF_ERROR_FILE, "%s: out of memory", r->name);
    for (uint64_t i = 0; i < count; i++)
        if (!take_half(r, &layer->weights[i]))
            return false;
    for (uint32_t i = 0; i < layer->out; i++)
        if (!take_float(r, &layer->bias[i]))
            return false;
    return true;
}

/* Whether a weight of what a second layer of a stage made in the frame before is not 0. */
static bool is_recurrent(const lsf_net *net)
{
    for (uint32_t stage = 1; stage <= net->stages; stage++) {
        const lsf_net_layer *layer = lsf_net_encode(net, stage, true);
        for (uint32_t o = 0; o < layer->out; o++)
            for (uint32_t i = layer->out * 9; i < layer->in * 9; i++)
                if (layer->weights[(size_t)o * layer->in * 9 + i] != 0.0f)
                    return true;
    }
    return false;
}

static bool take_net(reader *r, lsf_net *net)
{
    char magic[4] = "";
    uint32_t version = 0;
    if (!take(r, magic, sizeof magic) || memcmp(magic, "LSFD", 4) != 0)
        return refuse(r, "this is no file of weights");
    if (!take_u32(r, &version) || !take_u32(r, &net->layer_count))
        return false;
    if (version != FILE_VERSION)
        return refuse(r, "the file of weights is of another version");
    net->stages = (net->layer_count + 1) / 4;
    if (net->layer_count % 4 != 3 || net->stages < 1 || net->stages > LSF_NET_STAGES_MAX)
        return refuse(r, "the number of layers is not 4 for each of up to 8 stages, less 1");
    if (!take_float(r, &net->leak))
        return false;
    net->layers = lsf_alloc(net->layer_count, sizeof *net->layers);
    if (!net->layers)
        return lsf_error_set(r->error, LSF_ERROR_FILE, "%s: out of memory", r->name);
    for (uint32_t i = 0; i < net->layer_count; i++)
        if (!take_layer(r, net, i))
            return false;
    net->recurrent = is_recurrent(net);
    return r->at == r->end || refuse(r, "bytes follow the last layer");
}

lsf_net *lsf_net_read(const void *bytes, size_t length, const char *name, lsf_error *error)
{
    lsf_net *net = lsf_alloc(1, sizeof *net);
    reader r = {bytes, (const unsigned char *)bytes + length, name, error};
    if (!net) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: out of memory", name);
        return NULL;
    }
    if (!take_net(&r, net)) {
        lsf_net_destroy(net);
        return NULL;
    }
    return net;
}

void lsf_net_destroy(lsf_net *net)
{
    for (uint32_t i = 0; net && net->layers && i < net->layer_count; i++) {
        free(net->layers[i].weights);
        free(net->layers[i].bias);
    }
    if (net)
        free(net->layers);
    free(net);
}
