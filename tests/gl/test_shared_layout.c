/* Structs that C and GLSL share lie in memory as the driver says they do: every member's offset in
 * std430 and std140 blocks, and the stride of an array. */
#include "shader_folder.h"

#include "shared/bundle_data.h"
#include "shared/emitter_data.h"
#include "shared/light_data.h"
#include "shared/light_tree_data.h"
#include "shared/scene_data.h"
#include "shared/sky_map_data.h"
#include "shared/view.h"
#include "shared/voxel_data.h"
#include "shared/vpl_data.h"

typedef struct member {
    const char *name;
    size_t offset;
} member;

typedef struct shared_struct {
    const char *header, *name;
    size_t size;
    member members[24];
} shared_struct;

#define MEMBER(type, name)                                                                         \
    {                                                                                              \
#name, offsetof(struct type, name)                                                         \
    }

static const shared_struct structs[] = {
    {"shared/view.h",
     "lsf_view_data",
     sizeof(struct lsf_view_data),
     {MEMBER(lsf_view_data, clip), MEMBER(lsf_view_data, previous_clip),
      MEMBER(lsf_view_data, previous_start), MEMBER(lsf_view_data, start),
      MEMBER(lsf_view_data, start_dx), MEMBER(lsf_view_data, start_dy),
      MEMBER(lsf_view_data, forward), MEMBER(lsf_view_data, forward_dx),
      MEMBER(lsf_view_data, forward_dy), MEMBER(lsf_view_data, size), MEMBER(lsf_view_data, jitter),
      MEMBER(lsf_view_data, depth)}},
    {"shared/scene_data.h",
     "lsf_instance_data",
     sizeof(struct lsf_instance_data),
     {MEMBER(lsf_instance_data, transform_0), MEMBER(lsf_instance_data, transform_1),
      MEMBER(lsf_instance_data, transform_2), MEMBER(lsf_instance_data, normal_0),
      MEMBER(lsf_instance_data, normal_1), MEMBER(lsf_instance_data, normal_2)}},
    {"shared/scene_data.h",
     "lsf_texture_slot_data",
     sizeof(struct lsf_texture_slot_data),
     {MEMBER(lsf_texture_slot_data, row_0), MEMBER(lsf_texture_slot_data, row_1)}},
    {"shared/scene_data.h",
     "lsf_material_data",
     sizeof(struct lsf_material_data),
     {MEMBER(lsf_material_data, base_color), MEMBER(lsf_material_data, emission),
      MEMBER(lsf_material_data, surface), MEMBER(lsf_material_data, anisotropy),
      MEMBER(lsf_material_data, flags), MEMBER(lsf_material_data, absorption),
      MEMBER(lsf_material_data, base_color_slot),
      MEMBER(lsf_material_data, metallic_roughness_slot), MEMBER(lsf_material_data, normal_slot),
      MEMBER(lsf_material_data, emissive_slot), MEMBER(lsf_material_data, anisotropy_slot),
      MEMBER(lsf_material_data, transmission_slot)}},
    {"shared/light_data.h",
     "lsf_light_data",
     sizeof(struct lsf_light_data),
     {MEMBER(lsf_light_data, position), MEMBER(lsf_light_data, direction),
      MEMBER(lsf_light_data, intensity), MEMBER(lsf_light_data, attenuation),
      MEMBER(lsf_light_data, map_origin), MEMBER(lsf_light_data, map_shape),
      MEMBER(lsf_light_data, map_offset), MEMBER(lsf_light_data, map_window),
      MEMBER(lsf_light_data, map_right), MEMBER(lsf_light_data, map_up),
      MEMBER(lsf_light_data, map_forward)}},
    {"shared/bundle_data.h",
     "lsf_bundle_data",
     sizeof(struct lsf_bundle_data),
     {MEMBER(lsf_bundle_data, right), MEMBER(lsf_bundle_data, up), MEMBER(lsf_bundle_data, forward),
      MEMBER(lsf_bundle_data, window), MEMBER(lsf_bundle_data, range),
      MEMBER(lsf_bundle_data, gap_starts), MEMBER(lsf_bundle_data, gap_lengths),
      MEMBER(lsf_bundle_data, side), MEMBER(lsf_bundle_data, row), MEMBER(lsf_bundle_data, sliced),
      MEMBER(lsf_bundle_data, first_link)}},
    {"shared/bundle_data.h",
     "lsf_bundle_status",
     sizeof(struct lsf_bundle_status),
     {MEMBER(lsf_bundle_status, draw_vertices), MEMBER(lsf_bundle_status, draw_instances),
      MEMBER(lsf_bundle_status, draw_first), MEMBER(lsf_bundle_status, draw_base),
      MEMBER(lsf_bundle_status, needed), MEMBER(lsf_bundle_status, iterations_done),
      MEMBER(lsf_bundle_status, drawn_low), MEMBER(lsf_bundle_status, drawn_high),
      MEMBER(lsf_bundle_status, new_nodes_low), MEMBER(lsf_bundle_status, new_nodes_high),
      MEMBER(lsf_bundle_status, new_chained_low), MEMBER(lsf_bundle_status, new_chained_high),
      MEMBER(lsf_bundle_status, nodes_low), MEMBER(lsf_bundle_status, nodes_high),
      MEMBER(lsf_bundle_status, chained_low), MEMBER(lsf_bundle_status, chained_high),
      MEMBER(lsf_bundle_status, first_needed)}},
    {"shared/bundle_data.h",
     "lsf_bundle_slot_data",
     sizeof(struct lsf_bundle_slot_data),
     {MEMBER(lsf_bundle_slot_data, data), MEMBER(lsf_bundle_slot_data, unused)}},
    {"shared/voxel_data.h",
     "lsf_voxel_grid_data",
     sizeof(struct lsf_voxel_grid_data),
     {MEMBER(lsf_voxel_grid_data, origin), MEMBER(lsf_voxel_grid_data, size),
      MEMBER(lsf_voxel_grid_data, unit), MEMBER(lsf_voxel_grid_data, id_bits),
      MEMBER(lsf_voxel_grid_data, unused)}},
    {"shared/voxel_data.h",
     "lsf_voxel_brick_data",
     sizeof(struct lsf_voxel_brick_data),
     {MEMBER(lsf_voxel_brick_data, cell), MEMBER(lsf_voxel_brick_data, low),
      MEMBER(lsf_voxel_brick_data, high), MEMBER(lsf_voxel_brick_data, sides)}},
    {"shared/emitter_data.h",
     "lsf_emitter_point_data",
     sizeof(struct lsf_emitter_point_data),
     {MEMBER(lsf_emitter_point_data, position), MEMBER(lsf_emitter_point_data, normal),
      MEMBER(lsf_emitter_point_data, radiance)}},
    {"shared/sky_map_data.h",
     "lsf_sky_map_data",
     sizeof(struct lsf_sky_map_data),
     {MEMBER(lsf_sky_map_data, right), MEMBER(lsf_sky_map_data, up),
      MEMBER(lsf_sky_map_data, towards), MEMBER(lsf_sky_map_data, to_sky),
      MEMBER(lsf_sky_map_data, irradiance), MEMBER(lsf_sky_map_data, texel),
      MEMBER(lsf_sky_map_data, error), MEMBER(lsf_sky_map_data, unused)}},
    {"shared/light_tree_data.h",
     "lsf_light_tree_data",
     sizeof(struct lsf_light_tree_data),
     {MEMBER(lsf_light_tree_data, live), MEMBER(lsf_light_tree_data, root),
      MEMBER(lsf_light_tree_data, low_x), MEMBER(lsf_light_tree_data, low_y),
      MEMBER(lsf_light_tree_data, low_z), MEMBER(lsf_light_tree_data, high_x),
      MEMBER(lsf_light_tree_data, high_y), MEMBER(lsf_light_tree_data, high_z)}},
    {"shared/light_tree_data.h",
     "lsf_light_tree_node",
     sizeof(struct lsf_light_tree_node),
     {MEMBER(lsf_light_tree_node, position), MEMBER(lsf_light_tree_node, similarity),
      MEMBER(lsf_light_tree_node, intensity), MEMBER(lsf_light_tree_node, normal),
      MEMBER(lsf_light_tree_node, low), MEMBER(lsf_light_tree_node, left),
      MEMBER(lsf_light_tree_node, high), MEMBER(lsf_light_tree_node, right),
      MEMBER(lsf_light_tree_node, variance), MEMBER(lsf_light_tree_node, count),
      MEMBER(lsf_light_tree_node, covariance), MEMBER(lsf_light_tree_node, usable)}},
    {"shared/vpl_data.h",
     "lsf_vpl_data",
     sizeof(struct lsf_vpl_data),
     {MEMBER(lsf_vpl_data, position), MEMBER(lsf_vpl_data, geometric_normal),
      MEMBER(lsf_vpl_data, normal), MEMBER(lsf_vpl_data, base_color),
      MEMBER(lsf_vpl_data, specular_params), MEMBER(lsf_vpl_data, to_light),
      MEMBER(lsf_vpl_data, intensity)}},
};

static GLuint block_program(lsf_context *context, const shader_folder *folder,
                            const shared_struct *shared)
{
    char *text = lsf_format("layout(local_size_x = 1) in;\n"
                            "#include \"%s\"\n"
                            "layout(std430, binding = 0) buffer storage_block { %s storage[]; };\n"
                            "layout(std140, binding = 0) uniform uniform_block { %s single; };\n"
                            "void main() { storage[1] = single; }\n",
                            shared->header, shared->name, shared->name);
    shader_folder_write(folder, "layout.comp.glsl", text);
    free(text);
    lsf_program_desc desc = {.label = shared->name, .files = {"layout.comp.glsl"}};
    lsf_error error = {0};
    GLuint program = lsf_program_get(context, &desc, &error);
    if (!program)
        fail_msg("%s", error.message);
    return program;
}

static size_t find_member(const shared_struct *shared, const char *name, size_t length)
{
    for (size_t i = 0; i < LSF_COUNT(shared->members) && shared->members[i].name; i++)
        if (strlen(shared->members[i].name) == length &&
            !strncmp(shared->members[i].name, name, length))
            return i;
    fail_msg("%s.%.*s is missing in this test's table", shared->name, (int)length, name);
    return 0;
}

/* `interface` GL_BUFFER_VARIABLE or GL_UNIFORM. A member that is an array or a struct is several
 * resources; its offset is their smallest. */
static void check_block(GLuint program, GLenum interface, const shared_struct *shared)
{
    size_t offsets[LSF_COUNT(shared->members)];
    memset(offsets, 0xff, sizeof offsets);
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLuint resource = 0; resource < (GLuint)count; resource++) {
        char name[128];
        glGetProgramResourceName(program, interface, resource, sizeof name, NULL, name);
        const char *start = strchr(name, '.');
        assert_non_null(start);
        size_t i = find_member(shared, start + 1, strcspn(start + 1, ".["));
        const GLenum property = GL_OFFSET;
        GLint offset = -1;
        glGetProgramResourceiv(program, interface, resource, 1, &property, 1, NULL, &offset);
        assert_true(offset >= 0);
        if ((size_t)offset < offsets[i])
            offsets[i] = (size_t)offset;
        if (interface == GL_BUFFER_VARIABLE) {
            const GLenum stride_property = GL_TOP_LEVEL_ARRAY_STRIDE;
            GLint stride = 0;
            glGetProgramResourceiv(program, interface, resource, 1, &stride_property, 1, NULL,
                                   &stride);
            assert_int_equal(stride, shared->size);
        }
    }
    for (size_t i = 0; i < LSF_COUNT(shared->members) && shared->members[i].name; i++)
        if (offsets[i] != shared->members[i].offset)
            fail_msg("%s.%s: %zu bytes from the start in C, %zu in GLSL", shared->name,
                     shared->members[i].name, shared->members[i].offset, offsets[i]);
}

static void test_layouts(void **state)
{
    shader_folder folder;
    shader_folder_create(&folder);
    lsf_context_params params = {LSF_CONTEXT_PARAMS_DEFAULTS};
    params.backend = *(const lsf_backend *)*state;
    params.fail_on_gl_error = true;
    params.shader_dir = folder.path;
    lsf_error error = {0};
    lsf_context *context = lsf_context_create(&params, &error);
    for (size_t i = 0; context && i < LSF_COUNT(structs); i++) {
        GLuint program = block_program(context, &folder, &structs[i]);
        check_block(program, GL_BUFFER_VARIABLE, &structs[i]);
        check_block(program, GL_UNIFORM, &structs[i]);
        gl_test_check(context);
    }
    bool missing = context == NULL;
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
    if (missing) {
        print_message("no context: %s\n", error.message);
        skip();
    }
}

int main(void)
{
    static lsf_backend backends[] = {LSF_BACKEND_EGL, LSF_BACKEND_OSMESA};
    const struct CMUnitTest tests[] = {
        {"egl", test_layouts, NULL, NULL, &backends[0]},
        {"osmesa", test_layouts, NULL, NULL, &backends[1]},
    };
    return cmocka_run_group_tests_name("shared layouts", tests, NULL, NULL);
}
