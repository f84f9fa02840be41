/* Builds a scene in code, a red square under a lamp, and renders it to the file that is named. */
#include <lightsheaf/lightsheaf.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static lsf_error error;

/* Ends the program where something could not be added, made or done. */
static void check(int good)
{
    if (good)
        return;
    fprintf(stderr, "%s\n", error.message);
    exit((int)error.code);
}

static lsf_scene *build(void)
{
    static const float positions[] = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    lsf_scene *scene = lsf_scene_create(NULL, &error);
    check(scene != NULL);

    lsf_material_desc red = {LSF_MATERIAL_DESC_DEFAULTS};
    red.base_color[1] = red.base_color[2] = 0.1f;
    red.metallic = 0.0f;
    lsf_mesh_part part = {LSF_MESH_PART_DEFAULTS};
    part.material = lsf_scene_add_material(scene, "red", &red, NULL, 0, &error);
    part.vertex_count = 4;
    part.positions = positions;
    part.index_count = 6;
    part.indices = indices;
    lsf_node_desc square = {LSF_NODE_DESC_DEFAULTS};
    square.mesh = lsf_scene_add_mesh(scene, "square", &part, 1, &error);
    check(lsf_scene_add_node(scene, &square, &error) != LSF_NONE);

    lsf_light_desc light = {LSF_LIGHT_POINT, {8, 8, 8}, INFINITY, 0, 0};
    lsf_node_desc lamp = {LSF_NODE_DESC_DEFAULTS};
    lamp.matrix[13] = 1.5; /* that high above the square */
    lamp.light = lsf_scene_add_light(scene, "lamp", &light, &error);
    check(lsf_scene_add_node(scene, &lamp, &error) != LSF_NONE);
    check(lsf_scene_commit(scene, &error));
    return scene;
}

int main(int argc, char **argv)
{
    lsf_scene *scene = build();
    lsf_context *context = lsf_context_create(NULL, &error);
    check(context != NULL);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = params.height = 32;
    params.samples = 1;
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    check(renderer && lsf_renderer_run(renderer, &error));
    lsf_image *image = lsf_renderer_read(renderer, &error);
    check(image && lsf_image_save(image, argc == 2 ? argv[1] : "built.exr", NULL, &error));
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
    return 0;
}
