#include "net_rig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/half.h"
#include "math/sampling.h"

/* --- files --- */

typedef struct writer {
    char *bytes;
    size_t length;
    uint32_t seed, drawn;
} writer;

static void put(writer *w, const void *bytes, size_t count)
{
    w->bytes = realloc(w->bytes, w->length + count);
    memcpy(w->bytes + w->length, bytes, count);
    w->length += count;
}

static void put_u32(writer *w, uint32_t value)
{
    put(w, &value, sizeof value);
}

/* Uniform between -range and range. */
static float draw(writer *w, float range)
{
    return range * (2.0f * lsf_random_float(w->seed, w->drawn++) - 1.0f);
}

static void put_layer(writer *w, const char *name, uint32_t out, uint32_t in, uint32_t side,
                      float gain)
{
    uint8_t length = (uint8_t)strlen(name);
    float range = gain * sqrtf(3.0f / (float)(in * (side == 3 ? 9 : 1)));
    put(w, &length, 1);
    put(w, name, length);
    put_u32(w, out);
    put_u32(w, in);
    put_u32(w, side);
    put_u32(w, side);
    for (uint32_t i = 0; i < out * in * side * side; i++) {
        uint16_t half = lsf_float_to_half(draw(w, range));
        put(w, &half, sizeof half);
    }
    for (uint32_t i = 0; i < out; i++) {
        float bias = draw(w, 0.3f * gain);
        put(w, &bias, sizeof bias);
    }
}

/* Numbers of features that fit no group of 4, 8 or 16. */
static uint32_t encoded(uint32_t stage)
{
    static const uint32_t counts[] = {9, 13, 18, 5};
    return counts[(stage - 1) % 4];
}

static uint32_t doubled(uint32_t stage)
{
    return 11 + stage;
}

static uint32_t decoded(uint32_t stage)
{
    return 6 + 3 * stage;
}

char *net_rig_bytes(uint32_t stages, float leak, float gain, float out, uint32_t seed,
                    size_t *length)
{
    writer w = {.seed = seed};
    char name[16];
    uint32_t before = LSF_NET_INPUTS;
    put(&w, "LSFD", 4);
    put_u32(&w, 1);
    put_u32(&w, 4 * stages - 1);
    put(&w, &leak, sizeof leak);
    for (uint32_t s = 1; s <= stages; s++) {
        lsf_print(name, sizeof name, "enc%ua", s);
        put_layer(&w, name, encoded(s), before, 3, gain);
        lsf_print(name, sizeof name, "enc%ub", s);
        before = encoded(s);
        put_layer(&w, name, before, 2 * before, 3, gain);
    }
    for (uint32_t s = stages - 1; s > 0; s--) {
        lsf_print(name, sizeof name, "dec%ua", s);
        put_layer(&w, name, doubled(s), before, 2, gain);
        lsf_print(name, sizeof name, "dec%ub", s);
        before = decoded(s);
        put_layer(&w, name, before, doubled(s) + encoded(s), 3, gain);
    }
    put_layer(&w, "out", LSF_NET_OUTPUTS, before, 3, gain * out);
    *length = w.length;
    return w.bytes;
}

lsf_net *net_rig_make(uint32_t stages, float leak, float gain, float out, uint32_t seed)
{
    size_t length;
    lsf_error error = {0};
    char *bytes = net_rig_bytes(stages, leak, gain, out, seed, &length);
    lsf_net *net = lsf_net_read(bytes, length, "made", &error);
    free(bytes);
    return net;
}

void net_rig_write(const char *path, uint32_t stages, float leak, float gain, float out,
                   uint32_t seed)
{
    size_t length;
    lsf_error error = {0};
    char *bytes = net_rig_bytes(stages, leak, gain, out, seed, &length);
    lsf_file_write(path, bytes, length, &error);
    free(bytes);
}

/* --- what it makes of a picture --- */

typedef struct map {
    uint32_t features, width, height;
    float *values;
} map;

static map map_of(uint32_t features, uint32_t width, uint32_t height)
{
    return (map){features, width, height, calloc((size_t)features * width * height, sizeof(float))};
}

static float value_at(const map *m, uint32_t feature, int x, int y)
{
    bool inside = x >= 0 && y >= 0 && x < (int)m->width && y < (int)m->height;
    return inside ? m->values[((size_t)feature * m->height + (size_t)y) * m->width + (size_t)x]
                  : 0.0f;
}

static float rectified(float value, float leak)
{
    return value > 0.0f ? value : leak * value;
}

/* Of two maps, the second after the first; the second may be NULL. */
static map convolve(const lsf_net_layer *layer, const map *a, const map *b, float leak)
{
    map to = map_of(layer->out, a->width, a->height);
    float *target = to.values;
    for (uint32_t o = 0; o < layer->out; o++)
        for (int y = 0; y < (int)a->height; y++)
            for (int x = 0; x < (int)a->width; x++) {
                double sum = (double)layer->bias[o];
                const float *weight = layer->weights + (size_t)o * layer->in * 9;
                for (uint32_t i = 0; i < a->features + (b ? b->features : 0); i++)
                    for (int k = 0; k < 9; k++, weight++) {
                        int at_x = x + k % 3 - 1, at_y = y + k / 3 - 1;
                        float value = i < a->features ? value_at(a, i, at_x, at_y)
                                                      : value_at(b, i - a->features, at_x, at_y);
                        sum += (double)*weight * (double)value;
                    }
                *target++ = rectified((float)sum, leak);
            }
    return to;
}

static map pooled(const map *from)
{
    map to = map_of(from->features, from->width / 2, from->height / 2);
    float *target = to.values;
    for (uint32_t i = 0; i < from->features; i++)
        for (int y = 0; y < (int)to.height; y++)
            for (int x = 0; x < (int)to.width; x++) {
                float a = value_at(from, i, 2 * x, 2 * y), b = value_at(from, i, 2 * x + 1, 2 * y);
                float c = value_at(from, i, 2 * x, 2 * y + 1);
                *target++ = fmaxf(fmaxf(a, b), fmaxf(c, value_at(from, i, 2 * x + 1, 2 * y + 1)));
            }
    return to;
}

static map doubled_map(const lsf_net_layer *layer, const map *from)
{
    map to = map_of(layer->out, from->width * 2, from->height * 2);
    for (uint32_t o = 0; o < layer->out; o++)
        for (uint32_t y = 0; y < to.height; y++)
            for (uint32_t x = 0; x < to.width; x++) {
                double sum = (double)layer->bias[o];
                for (uint32_t i = 0; i < layer->in; i++)
                    sum += (double)value_at(from, i, (int)x / 2, (int)y / 2) *
                           (double)
                               layer->weights[((size_t)i * layer->out + o) * 4 + y % 2 * 2 + x % 2];
                to.values[((size_t)o * to.height + y) * to.width + x] = (float)sum;
            }
    return to;
}

size_t net_rig_state_size(const lsf_net *net, uint32_t width, uint32_t height)
{
    size_t size = 0;
    for (uint32_t s = 1; s <= net->stages; s++)
        size +=
            (size_t)lsf_net_encode(net, s, true)->out * (width >> (s - 1)) * (height >> (s - 1));
    return size;
}

/* Takes the place of `m`. */
static void follow(map *m, map next)
{
    free(m->values);
    *m = next;
}

void net_rig_run(const lsf_net *net, uint32_t width, uint32_t height, const float *input,
                 float *output, float *state)
{
    map skips[LSF_NET_STAGES_MAX + 1], at = map_of(LSF_NET_INPUTS, width, height);
    memcpy(at.values, input, sizeof(float) * LSF_NET_INPUTS * width * height);
    for (uint32_t s = 1; s <= net->stages; s++) {
        if (s > 1)
            at = pooled(&skips[s - 1]);
        follow(&at, convolve(lsf_net_encode(net, s, false), &at, NULL, net->leak));
        map kept = at;
        kept.values = state;
        follow(&at, convolve(lsf_net_encode(net, s, true), &at, state ? &kept : NULL, net->leak));
        skips[s] = at;
        size_t size = (size_t)at.features * at.width * at.height;
        if (state) {
            memcpy(state, at.values, size * sizeof *state);
            state += size;
        }
    }
    for (uint32_t s = net->stages - 1; s > 0; s--) {
        map up = doubled_map(lsf_net_decode(net, s, false), &at);
        follow(&at, convolve(lsf_net_decode(net, s, true), &up, &skips[s], net->leak));
        free(up.values);
        free(skips[s].values);
    }
    follow(&at, convolve(lsf_net_out(net), &at, NULL, 1.0f));
    memcpy(output, at.values, sizeof(float) * LSF_NET_OUTPUTS * width * height);
    free(at.values);
}
