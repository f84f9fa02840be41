#include "light_tree_rig.h"

#include <math.h>

#include "base/base.h"
#include "math/sampling.h"
#include "math/vector.h"
#include "octahedral.h"

static lsf_vec3 vec3_of(lsf_float3 v)
{
    return (lsf_vec3){v.x, v.y, v.z};
}

float cloud_luminance(lsf_vec3 c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

bool cloud_shines(const struct lsf_vpl_record *r)
{
    float light = cloud_luminance(r->intensity);
    return light > 0.0f && isfinite(light) && isfinite(r->position.x) && isfinite(r->position.y) &&
           isfinite(r->position.z);
}

static lsf_float3 on_sphere(float u, float v)
{
    float z = 1.0f - 2.0f * u, r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    float angle = 6.28318531f * v;
    return lsf_f3(r * cosf(angle), r * sinf(angle), z);
}

/* Five of six on the room's sides. */
static void in_room(struct lsf_vpl_record *r, const float u[4])
{
    static const float half[3] = {0.8f, 0.5f, 0.6f};
    float side = floorf(u[0] * 7.2f);
    lsf_float3 normal, position;
    if (side >= 6.0f) {
        normal = on_sphere(u[1], u[2]);
        position = lsf_f3_add(lsf_f3(0.2f, -0.3f, 0.1f), lsf_f3_scale(normal, 0.15f));
    } else {
        int axis = (int)side / 2, sign = (int)side % 2 ? 1 : -1;
        float p[3], n[3] = {0, 0, 0};
        p[axis] = (float)sign * half[axis];
        p[(axis + 1) % 3] = (2.0f * u[1] - 1.0f) * half[(axis + 1) % 3];
        p[(axis + 2) % 3] = (2.0f * u[2] - 1.0f) * half[(axis + 2) % 3];
        n[axis] = (float)-sign;
        normal = lsf_f3_load(n);
        position = lsf_f3_load(p);
    }
    r->position = vec3_of(position);
    r->normal = octahedral_encode(normal);
}

static void make_record(struct lsf_vpl_record *r, cloud_kind kind, uint32_t i, const float u[4])
{
    const lsf_float3 tilted = lsf_f3_normalize(lsf_f3(0.3f, -0.6f, 0.4f));
    r->intensity = (lsf_vec3){0.5f + u[3], 0.7f, 1.5f - u[3]};
    in_room(r, u);
    if (kind == CLOUD_POINT) {
        r->position = (lsf_vec3){0.25f, -0.125f, 0.5f};
        r->normal = octahedral_encode(on_sphere(u[1], u[2]));
    } else if (kind == CLOUD_PLANE) {
        lsf_basis basis = lsf_basis_about(tilted);
        r->position = vec3_of(lsf_basis_to_world(&basis, lsf_f3(u[0] - 0.5f, 0.3f * u[1], 0.1f)));
        r->normal = octahedral_encode(tilted);
    } else if (kind == CLOUD_SAME) {
        r->position = (lsf_vec3){0.1f, 0.2f, 0.3f};
        r->normal = octahedral_encode(tilted);
    } else if (kind == CLOUD_BRIGHT && i == 7) {
        r->intensity = (lsf_vec3){1e6f, 1e6f, 1e6f};
    } else if (kind == CLOUD_DEAD || (kind == CLOUD_DAMAGED && i % 3 == 0)) {
        r->intensity = (lsf_vec3){0, 0, 0};
    } else if (kind == CLOUD_DAMAGED && i % 7 == 0) {
        r->position.y = NAN;
    } else if (kind == CLOUD_DAMAGED && i % 11 == 0) {
        r->intensity.x = INFINITY;
    }
}

struct lsf_vpl_record *cloud_make(cloud_kind kind, uint32_t count, uint32_t seed)
{
    struct lsf_vpl_record *records = calloc(count, sizeof *records);
    assert_non_null(records);
    for (uint32_t i = 0; i < count; i++) {
        float u[4];
        for (uint32_t k = 0; k < 4; k++)
            u[k] = lsf_random_float(seed, 4 * (uint64_t)i + k);
        make_record(&records[i], kind, i, u);
    }
    return records;
}

read_tree read_tree_of(const lsf_light_tree *tree)
{
    uint32_t n = tree->capacity;
    read_tree read = {.capacity = n,
                      .nodes = calloc(n, sizeof *read.nodes),
                      .areas = calloc(n, sizeof *read.areas)};
    assert_true(read.nodes && read.areas);
    const lsf_light_tree_buffers *from = &tree->outputs;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(from->tree, 0, sizeof read.data, &read.data);
    glGetNamedBufferSubData(from->nodes, 0, (GLsizeiptr)(n * sizeof *read.nodes), read.nodes);
    glGetNamedBufferSubData(from->areas, 0, (GLsizeiptr)(n * sizeof *read.areas), read.areas);
    return read;
}

void read_tree_free(read_tree *read)
{
    free(read->nodes);
    free(read->areas);
}
