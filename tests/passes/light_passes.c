#include "light_passes.h"

#include <math.h>

#include "math/sampling.h"
#include "shared/scene_data.h"

const light_case light_cases[LIGHT_CASES] = {
    {"point", LSF_LIGHT_POINT, {0.1f, 0.5f, 0.2f}, {0, -1, 0}, 0, 0},
    {"narrow spot", LSF_LIGHT_SPOT, {0.1f, 0.7f, 0.2f}, {-0.3f, -1, 0.2f}, 0.3f, 0.8f},
    {"wide spot", LSF_LIGHT_SPOT, {0.1f, 0.5f, 0.2f}, {-0.3f, -1, 0.2f}, 0.9f, 1.4f},
    {"hard spot", LSF_LIGHT_SPOT, {0.1f, 0.7f, 0.2f}, {-0.3f, -1, 0.2f}, 0.5f, 0.5f},
    {"sun", LSF_LIGHT_DIRECTIONAL, {0, 0, 0}, {0.4f, -1, 0.3f}, 0, 0},
};

lsf_scene *light_case_scene(const light_case *c)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.7f, 0.5f, 0.3f);
    if (c->type == LSF_LIGHT_DIRECTIONAL)
        build_floor(scene, -0.8f, 1.0f);
    else
        build_box(scene, lsf_f3(-1, -0.8f, -1), lsf_f3(1, 0.8f, 1), true);
    build_material(scene, 0.1f, 0.1f, 0.2f);
    build_box(scene, lsf_f3(-0.5f, -0.8f, -0.3f), lsf_f3(0.1f, -0.1f, 0.3f), false);
    if (c->type == LSF_LIGHT_POINT) {
        lsf_node *sphere = build_sphere(scene, 3, false);
        for (int axis = 0; axis < 3; axis++) {
            sphere->translation[axis] = (const double[]){0.3, 0.1, 0.6}[axis];
            sphere->scale[axis] = 0.25;
        }
    }
    build_quad(scene, lsf_f3(0.4f, -0.5f, -0.6f), lsf_f3(0.9f, -0.5f, -0.4f),
               lsf_f3(0.8f, 0.2f, 0.4f), lsf_f3(0.3f, 0.2f, 0.2f));
    lsf_light *light = build_light(scene, c->type, c->position, c->direction, 3.0f);
    light->inner_cone = c->inner;
    light->outer_cone = c->outer;
    finish_gl_scene(scene);
    return scene;
}

static void collect_triangles(light_passes *p)
{
    const lsf_scene *scene = p->scene;
    p->corners = calloc(scene->index_count + 1, sizeof *p->corners);
    assert_non_null(p->corners);
    uint32_t n = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const lsf_primitive *primitive = &scene->primitives[scene->instances[i].primitive];
        const float *m = p->state.instances[i].transform;
        for (uint64_t k = 0; k < primitive->index_count; k++) {
            const float *v =
                scene->vertices.position + 3 * scene->indices[primitive->first_index + k];
            p->corners[n++] = lsf_f3(m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3],
                                     m[4] * v[0] + m[5] * v[1] + m[6] * v[2] + m[7],
                                     m[8] * v[0] + m[9] * v[1] + m[10] * v[2] + m[11]);
        }
    }
    p->triangle_count = n / 3;
}

static void require(bool ok, const lsf_error *error)
{
    if (!ok)
        fail_msg("%s", error->message);
}

void light_passes_init(light_passes *p, const lsf_scene *scene, int32_t rsm_resolution, int32_t pdf,
                       int32_t vpl_count)
{
    const lsf_reflective_shadow_map_params rsm = {.resolution = rsm_resolution, .pdf = pdf};
    const lsf_vpl_params vpl = {.count = vpl_count, .shadow_resolution = 256};
    lsf_error error = {0};
    memset(p, 0, sizeof *p);
    shader_folder_create(&p->folder);
    p->context = gl_test_context(gl_test_backend(), p->folder.path);
    p->scene = scene;
    const lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    require(lsf_state_update(&p->state, scene, &view, &error), &error);
    p->plan = (lsf_plan){.technique = "test",
                         .requirements = scene->requirements,
                         .width = 16,
                         .height = 16,
                         .pixel_side = 1,
                         .seen_width = 16,
                         .seen_height = 16,
                         .samples = 1};
    lsf_scene_gpu_plan(&p->plan, scene);
    lsf_iteration_plan(&p->plan);
    lsf_reflective_shadow_map_plan(&p->plan, &rsm, &p->state,
                                   &(lsf_reflective_shadow_map_use){.few_vpls = true});
    lsf_vpl_plan(&p->plan, &vpl, &(lsf_vpl_use){.lights = true});
    require(
        lsf_scene_gpu_create(&p->scene_gpu, p->context, &p->plan, scene, &p->state, NULL, &error) &&
            lsf_iteration_create(&p->iteration, p->context, &p->plan, &p->scene_gpu, &p->state,
                                 NULL, 5, &error) &&
            lsf_reflective_shadow_map_create(&p->rsm, p->context, &p->plan, &error) &&
            lsf_vpl_create(&p->vpl, p->context, &p->plan, &vpl, &error),
        &error);
    assert_int_equal(lsf_context_get_info(p->context).gl_bytes, lsf_plan_bytes(&p->plan));
    collect_triangles(p);
}

void light_passes_finish(light_passes *p)
{
    gl_test_check(p->context);
    glDeleteBuffers(1, &p->probe_points);
    glDeleteBuffers(1, &p->probe_results);
    lsf_vpl_destroy(&p->vpl);
    lsf_reflective_shadow_map_destroy(&p->rsm);
    lsf_iteration_destroy(&p->iteration);
    lsf_scene_gpu_destroy(&p->scene_gpu);
    assert_int_equal(lsf_context_get_info(p->context).gl_bytes, 0);
    lsf_context_destroy(p->context);
    shader_folder_destroy(&p->folder);
    lsf_state_finish(&p->state);
    free(p->plan.passes);
    free(p->plan.resources);
    free(p->plan.omissions);
    free(p->corners);
}

void light_passes_run(light_passes *p, uint32_t iteration, uint32_t light)
{
    lsf_iteration_begin(&p->iteration, iteration);
    lsf_reflective_shadow_map_run(&p->rsm, &p->iteration, light, NULL);
    const lsf_reflective_shadow_map_outputs *out = &p->rsm.outputs;
    const lsf_vpl_inputs inputs = {.shadow = &out->shadow,
                                   .seen = &out->seen,
                                   .importance = out->importance,
                                   .sums = out->sums};
    lsf_vpl_draw(&p->vpl, &p->iteration, 0, p->vpl.count, 1.0f, &inputs);
    gl_test_check(p->context);
}

struct lsf_vpl_data *light_passes_vpls(light_passes *p)
{
    struct lsf_vpl_data *vpls = calloc(p->vpl.count, sizeof *vpls);
    assert_non_null(vpls);
    glGetNamedBufferSubData(p->vpl.outputs.vpls, 0, (GLsizeiptr)(p->vpl.count * sizeof *vpls),
                            vpls);
    return vpls;
}

lsf_float3 light_passes_point(const light_passes *p, lsf_float3 v)
{
    const double *center = p->state.center, scale = p->state.scale;
    return lsf_f3((float)(((double)v.x - center[0]) * scale),
                  (float)(((double)v.y - center[1]) * scale),
                  (float)(((double)v.z - center[2]) * scale));
}

void light_passes_probe(light_passes *p, const char *library, const char *switches,
                        const char *expression, const float (*points)[8], uint32_t count,
                        float *results)
{
    char *text = lsf_format("%s\n"
                            "#include \"%s\"\n"
                            "layout(local_size_x = 64) in;\n"
                            "layout(std430, binding = 6) readonly buffer probe_block { vec4 "
                            "probe_points[]; };\n"
                            "layout(std430, binding = 7) writeonly buffer result_block { float "
                            "probe_results[]; };\n"
                            "layout(location = 0) uniform uint probe_count;\n"
                            "void main() {\n"
                            "    uint i = gl_GlobalInvocationID.x;\n"
                            "    if (i >= probe_count) return;\n"
                            "    vec3 position = probe_points[2u * i].xyz;\n"
                            "    vec3 normal = probe_points[2u * i + 1u].xyz;\n"
                            "    probe_results[i] = %s;\n"
                            "}\n",
                            switches, library, expression);
    shader_folder_write(&p->folder, "probe.comp.glsl", text);
    free(text);
    lsf_program_desc desc = {.label = "probe", .files = {"probe.comp.glsl"}};
    lsf_error error = {0};
    GLuint program = lsf_program_get(p->context, &desc, &error);
    require(program != 0, &error);
    glDeleteBuffers(1, &p->probe_points);
    glDeleteBuffers(1, &p->probe_results);
    glCreateBuffers(1, &p->probe_points);
    glCreateBuffers(1, &p->probe_results);
    glNamedBufferStorage(p->probe_points, (GLsizeiptr)(count * sizeof *points), points, 0);
    glNamedBufferStorage(p->probe_results, (GLsizeiptr)(count * sizeof *results), NULL, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, p->probe_points);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, p->probe_results);
    glUseProgram(program);
    glUniform1ui(0, count);
    glDispatchCompute((count + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(p->probe_results, 0, (GLsizeiptr)(count * sizeof *results), results);
    gl_test_check(p->context);
}

/* T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997. */
static double meet(const lsf_float3 *t, lsf_float3 origin, lsf_float3 direction)
{
    const double a[3] = {(double)t[0].x, (double)t[0].y, (double)t[0].z};
    double e1[3], e2[3], s[3], pv[3], q[3];
    const float *corner[3] = {&t[0].x, &t[1].x, &t[2].x}, *o = &origin.x, *d = &direction.x;
    for (int i = 0; i < 3; i++) {
        e1[i] = (double)corner[1][i] - a[i];
        e2[i] = (double)corner[2][i] - a[i];
        s[i] = (double)o[i] - a[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        pv[i] = (double)d[j] * e2[k] - (double)d[k] * e2[j];
        q[i] = s[j] * e1[k] - s[k] * e1[j];
    }
    double det = 0.0, u = 0.0, v = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        det += e1[i] * pv[i];
        u += s[i] * pv[i];
        v += (double)d[i] * q[i];
        along += e2[i] * q[i];
    }
    if (det == 0.0)
        return INFINITY;
    u /= det;
    v /= det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? along / det : INFINITY;
}

double light_passes_trace(const light_passes *p, lsf_float3 origin, lsf_float3 direction,
                          double start, lsf_float3 *normal)
{
    double nearest = INFINITY;
    for (uint32_t i = 0; i < p->triangle_count; i++) {
        const lsf_float3 *t = p->corners + 3 * (size_t)i;
        double distance = meet(t, origin, direction);
        if (!(distance > start && distance < nearest))
            continue;
        nearest = distance;
        if (normal)
            *normal = lsf_f3_normalize_or(
                lsf_f3_cross(lsf_f3_sub(t[1], t[0]), lsf_f3_sub(t[2], t[0])), lsf_f3(0, 0, 0));
    }
    return nearest;
}

float light_passes_raster_error(const light_passes *p, lsf_float3 normal, double distance)
{
    const struct lsf_light_data *light = &p->rsm.outputs.light;
    float most = 0.0f;
    for (int face = 0; face < (int)light->map_origin.w; face++) {
        lsf_vec4 right = light->map_right[face], up = light->map_up[face],
                 window = light->map_window[face];
        float x = fabsf(lsf_f3_dot(normal, (lsf_float3){right.x, right.y, right.z})) * window.z;
        float y = fabsf(lsf_f3_dot(normal, (lsf_float3){up.x, up.y, up.z})) * window.w;
        most = fmaxf(most, x + y);
    }
    bool perspective = light->map_shape.y == 0.0f;
    return gl_test_raster_step() * 2.0f * light->map_shape.w * most *
           (perspective ? (float)distance : 1.0f);
}

void light_passes_random(uint64_t index, uint64_t dimension, float point[2])
{
    point[0] = lsf_random_float(2 * dimension + 100, index);
    point[1] = lsf_random_float(2 * dimension + 101, index);
}
