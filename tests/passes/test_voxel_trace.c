/* Rays through occupancy filled by hand, against the exact intervals of all voxels on their way. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "math/sampling.h"
#include "shared/scene_data.h"
#include "shared/voxel_data.h"

enum { RAYS = 4096, LEVELS = 2 };

typedef struct grid {
    int size[3];
    uint8_t *voxels;
    uint32_t *words[LEVELS];
    int width[LEVELS][3]; /* of the textures */
    GLuint textures[LEVELS], buffer;
} grid;

typedef struct ray {
    float origin[4], direction[4];
} ray;

typedef struct hit {
    int32_t cell[3]; /* -1: none */
    float distance;
} hit;

static float random_number(uint32_t seed, uint32_t index, uint32_t dimension)
{
    return lsf_random_float(lsf_hash(seed, dimension), index);
}

/* --- occupancy as voxel_data.h lays it out */

static void set_bit(grid *g, int level, const int cell[3])
{
    const int *w = g->width[level];
    int x = 2 * (cell[0] >> 2) + ((cell[2] >> 1) & 1), y = cell[1] >> 2, z = cell[2] >> 2;
    int bit = (cell[0] & 3) | ((cell[1] & 3) << 2) | ((cell[2] & 1) << 4);
    g->words[level][(z * w[1] + y) * w[0] + x] |= 1u << bit;
}

static bool *voxel_at(const grid *g, const int cell[3])
{
    return (bool *)&g->voxels[(cell[2] * g->size[1] + cell[1]) * g->size[0] + cell[0]];
}

static void upload(grid *g)
{
    for (int level = 0; level < LEVELS; level++) {
        const int *w = g->width[level];
        glCreateTextures(GL_TEXTURE_3D, 1, &g->textures[level]);
        glTextureStorage3D(g->textures[level], 1, GL_R32UI, w[0], w[1], w[2]);
        glTextureSubImage3D(g->textures[level], 0, 0, 0, 0, w[0], w[1], w[2], GL_RED_INTEGER,
                            GL_UNSIGNED_INT, g->words[level]);
        glTextureParameteri(g->textures[level], GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(g->textures[level], GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glBindTextureUnit(LSF_UNIT_VOXEL_OCCUPANCY + (GLuint)level, g->textures[level]);
    }
    const struct lsf_voxel_grid_data data = {
        .origin = {0, 0, 0, 1},
        .size = {(float)g->size[0], (float)g->size[1], (float)g->size[2], 1},
        .unit = {1, 1}};
    glCreateBuffers(1, &g->buffer);
    glNamedBufferStorage(g->buffer, sizeof data, &data, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VOXEL, g->buffer);
}

/* A random part of the bricks, and in these of the voxels, is occupied. */
static grid fill(const int size[3], float bricks, float voxels, uint32_t seed)
{
    grid g = {0};
    for (int level = 0; level < LEVELS; level++)
        for (int axis = 0; axis < 3; axis++)
            g.width[level][axis] = size[axis] / (level ? 16 : 4) * (axis == 0 ? 2 : 1);
    memcpy(g.size, size, sizeof g.size);
    g.voxels = calloc((size_t)(size[0] * size[1] * size[2]), 1);
    for (int level = 0; level < LEVELS; level++)
        g.words[level] = calloc((size_t)(g.width[level][0] * g.width[level][1] * g.width[level][2]),
                                sizeof(uint32_t));
    uint32_t index = 0;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++) {
                const int cell[3] = {x, y, z}, brick[3] = {x >> 2, y >> 2, z >> 2};
                uint32_t name = (uint32_t)((brick[2] * size[1] + brick[1]) * size[0] + brick[0]);
                if (random_number(seed, name, 0) >= bricks ||
                    random_number(seed, index++, 1) >= voxels)
                    continue;
                *voxel_at(&g, cell) = true;
                set_bit(&g, 0, cell);
                set_bit(&g, 1, brick);
            }
    upload(&g);
    return g;
}

static void finish(grid *g)
{
    glDeleteTextures(LEVELS, g->textures);
    glDeleteBuffers(1, &g->buffer);
    free(g->voxels);
    for (int level = 0; level < LEVELS; level++)
        free(g->words[level]);
}

/* --- rays of every awkward kind */

static ray make_ray(const grid *g, uint32_t seed, uint32_t index)
{
    ray r = {0};
    uint32_t kind = index % 8;
    float length2 = 0.0f;
    for (uint32_t axis = 0; axis < 3; axis++) {
        float size = (float)g->size[axis];
        float u = random_number(seed, index, 2 + axis);
        /* Within, or up to half the grid's size outside. */
        r.origin[axis] = kind < 4 ? u * size : (2.0f * u - 0.5f) * size;
        if (kind == 1 || kind == 5) /* on planes between voxels */
            r.origin[axis] = floorf(r.origin[axis]);
        float d = 2.0f * random_number(seed, index, 5 + axis) - 1.0f;
        if (kind == 2 || kind == 6) /* along an axis, or across one */
            d = (index >> (3 + axis)) & 1 ? (d < 0.0f ? -1.0f : 1.0f) : 0.0f;
        if (kind == 3) /* almost so */
            d = (index >> (3 + axis)) & 1 ? d : 1e-9f * d;
        r.direction[axis] = d;
        length2 += d * d;
    }
    if (length2 == 0.0f)
        r.direction[0] = length2 = 1.0f;
    for (int axis = 0; axis < 3; axis++)
        r.direction[axis] /= sqrtf(length2);
    return r;
}

static void trace(lsf_context *context, const shader_folder *folder, const ray *rays, hit *hits)
{
    static const char text[] =
        "#include \"lib/voxel_trace.glsl\"\n"
        "layout(local_size_x = 64) in;\n"
        "layout(std430, binding = 6) readonly buffer ray_block { vec4 rays[]; };\n"
        "layout(std430, binding = 7) writeonly buffer hit_block { ivec4 hits[]; };\n"
        "void main() {\n"
        "    uint i = gl_GlobalInvocationID.x;\n"
        "    voxel_ray ray;\n"
        "    bool met = voxel_ray_begin(rays[2u * i].xyz, rays[2u * i + 1u].xyz, ray) &&\n"
        "               voxel_ray_trace(ray);\n"
        "    hits[i] = met ? ivec4(ray.cell, floatBitsToInt(ray.distance)) : ivec4(-1);\n"
        "}\n";
    shader_folder_write(folder, "rays.comp.glsl", text);
    lsf_program_desc desc = {.label = "rays", .files = {"rays.comp.glsl"}};
    lsf_error error = {0};
    GLuint program = lsf_program_get(context, &desc, &error), buffers[2];
    if (!program)
        fail_msg("%s", error.message);
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], RAYS * sizeof *rays, rays, 0);
    glNamedBufferStorage(buffers[1], RAYS * sizeof *hits, NULL, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, buffers[0]);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, buffers[1]);
    glUseProgram(program);
    glDispatchCompute(RAYS / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffers[1], 0, RAYS * sizeof *hits, hits);
    glDeleteBuffers(2, buffers);
    gl_test_check(context);
}

/* --- the truth */

/* Where the ray is within the voxel, grown by `margin` on all sides; false: nowhere. */
static bool interval(const ray *r, const int cell[3], double margin, double *enter, double *leave)
{
    *enter = 0.0;
    *leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double o = (double)r->origin[axis], d = (double)r->direction[axis];
        double low = cell[axis] - margin - o, high = cell[axis] + 1 + margin - o;
        if (fabs(d) < 1e-18) {
            if (low > 0.0 || high < 0.0)
                return false;
            continue;
        }
        *enter = fmax(*enter, fmin(low / d, high / d));
        *leave = fmin(*leave, fmax(low / d, high / d));
    }
    return *enter <= *leave;
}

/* Rounding moves a ray by no more. Places go to half a grid beyond it. [voxels] */
#define MARGIN 1e-4

static void check_ray(const grid *g, const ray *r, const hit *h)
{
    double reached = INFINITY, enter, leave;
    if (h->cell[0] >= 0) {
        assert_true(*voxel_at(g, h->cell));
        assert_true(interval(r, h->cell, MARGIN, &enter, &leave));
        /* Along a face that it grazes, a ray may be in a voxel at any time. */
        assert_true((double)h->distance >= enter - MARGIN && (double)h->distance <= leave + MARGIN);
        reached = leave;
    }
    /* No voxel that it surely crosses before. */
    for (int z = 0; z < g->size[2]; z++)
        for (int y = 0; y < g->size[1]; y++)
            for (int x = 0; x < g->size[0]; x++) {
                const int cell[3] = {x, y, z};
                if (!*voxel_at(g, cell) || !interval(r, cell, -MARGIN, &enter, &leave))
                    continue;
                if (h->cell[0] < 0)
                    fail_msg("no hit, but voxel %d %d %d is on the way", x, y, z);
                if (leave < (double)h->distance - MARGIN && leave < reached)
                    fail_msg("voxel %d %d %d at %g is skipped for one at %g", x, y, z, enter,
                             (double)h->distance);
            }
}

static void test_hits(void **state)
{
    (void)state;
    static const struct {
        int size[3];
        float bricks, voxels;
    } cases[] = {
        {{16, 16, 16}, 1.0f, 0.3f},   {{48, 16, 32}, 0.2f, 0.1f}, {{32, 64, 16}, 0.02f, 0.5f},
        {{48, 48, 48}, 0.02f, 0.05f}, {{16, 16, 16}, 0.0f, 0.0f},
    };
    shader_folder folder;
    shader_folder_create(&folder);
    lsf_context *context = gl_test_context(gl_test_backend(), folder.path);
    ray *rays = calloc(RAYS, sizeof *rays);
    hit *hits = calloc(RAYS, sizeof *hits);
    for (uint32_t c = 0; c < LSF_COUNT(cases); c++) {
        grid g = fill(cases[c].size, cases[c].bricks, cases[c].voxels, c);
        uint32_t met = 0;
        for (uint32_t i = 0; i < RAYS; i++)
            rays[i] = make_ray(&g, c, i);
        trace(context, &folder, rays, hits);
        for (uint32_t i = 0; i < RAYS; i++) {
            check_ray(&g, &rays[i], &hits[i]);
            met += hits[i].cell[0] >= 0;
        }
        if (cases[c].voxels > 0.0f)
            assert_in_range(met, RAYS / 64, RAYS);
        else
            assert_int_equal(met, 0);
        finish(&g);
    }
    free(rays);
    free(hits);
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hits)};
    return cmocka_run_group_tests_name("voxel_trace", tests, NULL, NULL);
}
