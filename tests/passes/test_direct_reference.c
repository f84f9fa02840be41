/* Direct light, albedo and normals by GL against the path tracer. */
#include <math.h>

#include "against_reference.h"

enum { SAMPLES = 64 };

static void check_scene(const char *name, const lsf_scene *scene, const lsf_render_params *params,
                        double limit)
{
    lsf_render_params direct = *params;
    direct.technique = "direct";
    direct.bounces = 0;
    against_reference pictures = against_reference_render(name, scene, &direct);
    against_reference_check(name, &pictures, "R", limit, 0.003, 0.02);
    against_reference_check(name, &pictures, "albedo.R", INFINITY, 0.003, 0.02);
    against_reference_check(name, &pictures, "normal.X", INFINITY, 0.003, 0.02);
    against_reference_destroy(&pictures);
}

/* `option`: of the shadow map; NULL for none. */
static void check_file(const char *name, const char *root_variable, const char *folder,
                       const char *option)
{
    char path[4096];
    lsf_error error = {0};
    const char *root = getenv(root_variable);
    snprintf(path, sizeof path, "%s/%s/%s.gltf", root ? root : "", folder, name);
    FILE *file = fopen(path, "r");
    if (!file)
        skip();
    fclose(file);
    lsf_scene_params scene_params = {LSF_SCENE_PARAMS_DEFAULTS};
    lsf_scene *scene = lsf_scene_load(path, &scene_params, &error);
    if (!scene)
        fail_msg("%s", error.message);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.width = params.height = 80;
    params.samples = SAMPLES;
    params.options = &option;
    params.option_count = option != NULL;
    check_scene(name, scene, &params, INFINITY);
    lsf_scene_destroy(scene);
}

static void cornell_point(void **unused)
{
    (void)unused;
    check_file("cornell_point", "LSF_SHARED", "scenes/cornell", NULL);
}

/* The sun shines on the outside of closed edges. */
static void cornell_sun(void **unused)
{
    (void)unused;
    check_file("cornell_sun", "LSF_SHARED", "scenes/cornell", NULL);
}

static void cornell_glossy(void **unused)
{
    (void)unused;
    check_file("cornell_glossy", "LSF_SOURCE_ROOT", "data/scenes", NULL);
}

/* --- scenes made by hand ------------------------------------------------------------------------
 */

/* Gives every quadrilateral texture coordinates and a tangent along u, every sphere smooth normals
 * and a tangent along its parallels. The second set is the first one turned. */
static void add_streams(lsf_scene *scene)
{
    static const float corners[6][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
    lsf_vertices *v = &scene->vertices;
    v->uv0 = calloc(v->count, 2 * sizeof(float));
    v->uv1 = calloc(v->count, 2 * sizeof(float));
    v->tangent = calloc(v->count, 4 * sizeof(float));
    assert_true(v->uv0 && v->uv1 && v->tangent);
    for (uint32_t p = 0; p < scene->primitive_count; p++) {
        const lsf_primitive *primitive = &scene->primitives[p];
        for (uint32_t i = 0; i < primitive->vertex_count; i++) {
            uint64_t at = primitive->first_vertex + i;
            lsf_float3 here = lsf_f3_load(v->position + 3 * at), along;
            if (primitive->vertex_count == 6) {
                const float *a = v->position + 3 * primitive->first_vertex;
                along = lsf_f3_sub(lsf_f3_load(a + 3), lsf_f3_load(a));
                v->uv0[2 * at] = corners[i][0];
                v->uv0[2 * at + 1] = corners[i][1];
            } else {
                along = lsf_f3(here.z, 0, -here.x);
                lsf_f3_store(v->normal + 3 * at, lsf_f3_normalize(here));
                v->uv0[2 * at] = 0.5f + 0.5f * here.x;
                v->uv0[2 * at + 1] = 0.5f - 0.5f * here.y;
            }
            v->uv1[2 * at] = v->uv0[2 * at + 1];
            v->uv1[2 * at + 1] = 1.0f - v->uv0[2 * at];
            lsf_f3_store(v->tangent + 4 * at, lsf_f3_normalize_or(along, lsf_f3(1, 0, 0)));
            v->tangent[4 * at + 3] = p % 2 ? -1.0f : 1.0f;
        }
    }
}

static void move(lsf_node *node, double x, double y, double z, double scale)
{
    node->translation[0] = x;
    node->translation[1] = y;
    node->translation[2] = z;
    node->scale[0] = node->scale[1] = node->scale[2] = scale;
}

static void put_ground(lsf_scene *scene)
{
    build_material(scene, 0.5f, 0.5f, 0.45f);
    build_floor(scene, -1.0f, 5.0f);
}

static void check_view(const char *name, lsf_scene *scene, const float position[3], double limit)
{
    static const float target[3] = {0, -0.2f, 0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.width = 96;
    params.height = 64;
    params.samples = SAMPLES;
    params.camera_position = position;
    params.camera_target = target;
    add_streams(scene);
    finish_gl_scene(scene);
    check_scene(name, scene, &params, limit);
    destroy_scene(scene);
}

/* Three spheres of each metallic 0 and 1, under a spot and a sun. */
static lsf_scene *sphere_scene(const float roughness[3])
{
    lsf_scene *scene = build_scene();
    put_ground(scene);
    for (int i = 0; i < 6; i++) {
        lsf_material *material = build_material(scene, 0.9f, 0.6f, 0.3f);
        material->roughness = roughness[i % 3];
        material->metallic = (float)(i / 3);
        material->ior = i == 1 ? 2.0f : 1.5f;
        move(build_sphere(scene, 3, false), 1.4 * (i % 3 - 1), i / 3 ? 0.7 : -0.4, i / 3 ? -1 : 0.5,
             0.6);
    }
    lsf_light *spot =
        build_light(scene, LSF_LIGHT_SPOT, lsf_f3(-2, 4, 3), lsf_f3(0.45f, -0.8f, -0.6f), 60.0f);
    spot->inner_cone = 0.2f;
    spot->outer_cone = 0.6f;
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.6f, -0.7f, -0.4f), 1.5f);
    return scene;
}

static void roughness_and_metallic(void **unused)
{
    (void)unused;
    static const float roughness[3] = {0.3f, 0.6f, 1.0f};
    check_view("spheres", sphere_scene(roughness), (const float[3]){0, 1.5f, 5}, INFINITY);
}

/* All but the highlights, a hundredth of a pixel wide. */
static void mirrors(void **unused)
{
    (void)unused;
    static const float roughness[3] = {0.0f, 0.03f, 0.0f};
    check_view("mirrors", sphere_scene(roughness), (const float[3]){0, 1.5f, 5}, 0.7);
}

static void orthographic(void **unused)
{
    (void)unused;
    static const float roughness[3] = {0.4f, 0.7f, 1.0f};
    lsf_scene *scene = sphere_scene(roughness);
    scene->cameras[0].orthographic = true;
    scene->cameras[0].x_magnification = 3.0f;
    scene->cameras[0].y_magnification = 2.0f;
    check_view("orthographic", scene, (const float[3]){1, 2.5f, 5}, INFINITY);
}

static void anisotropy(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    static const uint8_t directions[4 * 3] = {255, 128, 255, 128, 255, 128,
                                              0,   128, 200, 200, 30,  255};
    put_ground(scene);
    uint32_t texture = build_texture(scene, 2, 2, 3, directions, false);
    for (int i = 0; i < 4; i++) {
        lsf_material *material = build_material(scene, 0.9f, 0.8f, 0.5f);
        material->metallic = i == 3 ? 0.0f : 1.0f;
        material->roughness = 0.4f;
        material->anisotropy_strength = 0.8f;
        material->anisotropy_rotation = i == 0 ? 0.0f : 1.1f;
        if (i >= 2)
            material->anisotropy_texture.texture = texture;
        lsf_node *node = build_sphere(scene, 3, false);
        move(node, 1.3 * (i - 1.5), -0.3, 0, 0.6);
        if (i == 1)
            node->scale[0] = -0.6;
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-1, 3, 4), lsf_f3(0, -1, 0), 40.0f);
    check_view("anisotropy", scene, (const float[3]){0, 1.0f, 5}, INFINITY);
}

/* A bump in every quarter of the texture. */
static uint32_t build_bumps(lsf_scene *scene)
{
    enum { SIZE = 32 };
    uint8_t texels[SIZE * SIZE * 3];
    for (int i = 0; i < SIZE * SIZE; i++) {
        float x = (float)(i % SIZE % 16) / 7.5f - 1.0f, y = (float)(i / SIZE % 16) / 7.5f - 1.0f;
        float inside = fmaxf(1.0f - x * x - y * y, 0.0f);
        lsf_float3 n = lsf_f3_normalize(lsf_f3(0.8f * x * inside, -0.8f * y * inside, 0.6f));
        texels[3 * i] = (uint8_t)lrintf(127.5f * (n.x + 1.0f));
        texels[3 * i + 1] = (uint8_t)lrintf(127.5f * (n.y + 1.0f));
        texels[3 * i + 2] = (uint8_t)lrintf(127.5f * (n.z + 1.0f));
    }
    return build_texture(scene, SIZE, SIZE, 3, texels, false);
}

/* A metal, smooth and rough in turn along u. */
static uint32_t build_scratches(lsf_scene *scene)
{
    uint8_t texels[32 * 3];
    for (int i = 0; i < 32; i++) {
        texels[3 * i] = texels[3 * i + 2] = 255;
        texels[3 * i + 1] = i % 4 < 2 ? 80 : 255;
    }
    return build_texture(scene, 32, 1, 3, texels, false);
}

/* Few samples of bumps and of scratches much smaller than a pixel, on metal. The mean of their
 * normals would be a plane that reflects the sun elsewhere, and the mean of their roughness a lobe
 * that is neither narrow nor wide. */
static void small_details(void **unused)
{
    (void)unused;
    for (int rough = 0; rough < 2; rough++) {
        static const float position[3] = {0, 4, 0.5f}, target[3] = {0, -1, 0};
        lsf_scene *scene = build_scene();
        uint32_t map = rough ? build_scratches(scene) : build_bumps(scene);
        lsf_material *material = build_material(scene, 0.9f, 0.7f, 0.5f);
        material->metallic = 1.0f;
        material->roughness = rough ? 1.0f : 0.4f;
        lsf_texture_slot *slot =
            rough ? &material->metallic_roughness_texture : &material->normal_texture;
        slot->texture = map;
        slot->transform[0] = slot->transform[4] = 301.0f;
        build_floor(scene, -1.0f, 5.0f);
        build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0),
                    rough ? lsf_f3(0, -1, -0.1f) : lsf_f3(-1, -1, 0), 3.0f);
        add_streams(scene);
        finish_gl_scene(scene);
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.technique = "direct";
        params.bounces = 0;
        params.width = params.height = 64;
        params.samples = 16;
        params.camera_position = position;
        params.camera_target = target;
        const char *name = rough ? "small_scratches" : "small_bumps";
        against_reference pictures = against_reference_render(name, scene, &params);
        /* All pixels share their sample points, which fall into few phases of such a pattern. */
        against_reference_check(name, &pictures, "R", INFINITY, 0.1, 0.5);
        against_reference_destroy(&pictures);
        destroy_scene(scene);
    }
}

/* Quadrilaterals with either sign of the bitangent, plain, mirrored, seen from behind, and
 * anisotropic. */
static void normal_maps(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    put_ground(scene);
    uint32_t bumps = build_bumps(scene);
    for (int i = 0; i < 6; i++) {
        lsf_material *material = build_material(scene, 0.7f, 0.7f, 0.8f);
        material->roughness = 0.45f;
        material->metallic = i % 2 ? 1.0f : 0.0f;
        material->normal_texture.texture = bumps;
        material->normal_scale = i < 3 ? 1.0f : 0.6f;
        if (i == 5) {
            material->anisotropy_strength = 0.7f;
            material->anisotropy_rotation = 0.9f;
        }
        lsf_node *node = build_quad(scene, lsf_f3(-1, -1, 0), lsf_f3(1, -1, 0.3f),
                                    lsf_f3(1, 1, -0.3f), lsf_f3(-1, 1, 0));
        move(node, 1.5 * (i % 3 - 1), i < 3 ? -0.2 : 1.2, i < 3 ? 0.5 : -0.3, 0.65);
        if (i == 1 || i == 4)
            node->scale[0] = -0.65;
        if (i == 2) { /* half a turn about y */
            node->rotation[1] = 1.0;
            node->rotation[3] = 0.0;
        }
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-2, 3, 4), lsf_f3(0, -1, 0), 60.0f);
    check_view("normal_maps", scene, (const float[3]){0.3f, 1.2f, 5}, INFINITY);
}

/* Widens the image made last to 16 bits, with low bytes of its own. */
static void widen(lsf_scene *scene)
{
    lsf_texture_image *image = &scene->images[scene->image_count - 1];
    size_t count = (size_t)image->width * image->height * image->channels;
    uint16_t *wide = calloc(count, sizeof *wide);
    assert_non_null(wide);
    for (size_t i = 0; i < count; i++)
        wide[i] = (uint16_t)(((uint8_t *)image->texels)[i] << 8 | (37 * i & 255));
    free(image->texels);
    image->texels = wide;
    image->type = LSF_TEXEL_U16;
}

static uint32_t build_noise(lsf_scene *scene, uint32_t width, uint32_t height, uint32_t channels,
                            bool srgb)
{
    uint8_t texels[1024];
    for (uint32_t i = 0; i < width * height * channels; i++)
        texels[i] = (uint8_t)(40 + i * 7919u % 211);
    return build_texture(scene, width, height, channels, texels, srgb);
}

/* A texture of each kind on a tile of its own; two tiles are cut out and shade the floor. */
static void textures(void **unused)
{
    (void)unused;
    static const struct {
        uint32_t width, height, channels;
        bool srgb, wide;
        lsf_wrap wrap;
        uint32_t uv_set;
        bool transformed, nearest, masked, colored;
    } tiles[12] = {
        {.width = 5, .height = 3, .channels = 3, .srgb = true, .transformed = true},
        {.width = 4, .height = 4, .channels = 3, .srgb = true, .uv_set = 1},
        {.width = 1, .height = 1, .channels = 3, .srgb = true},
        {.width = 6, .height = 2, .channels = 3, .srgb = true, .wide = true},
        {.width = 7, .height = 5, .channels = 1, .srgb = true},
        {.width = 4, .height = 4, .channels = 2, .srgb = true, .masked = true},
        {.width = 3, .height = 3, .channels = 4, .masked = true, .uv_set = 1, .colored = true},
        {.width = 5,
         .height = 5,
         .channels = 1,
         .wide = true,
         .wrap = LSF_WRAP_MIRROR,
         .transformed = true},
        {.width = 5, .height = 4, .channels = 2, .wide = true},
        {.width = 3, .height = 4, .channels = 4, .wide = true, .srgb = true},
        {.width = 4,
         .height = 3,
         .channels = 3,
         .nearest = true,
         .wrap = LSF_WRAP_CLAMP,
         .transformed = true},
        {.width = 2, .height = 2, .channels = 3, .colored = true},
    };
    lsf_scene *scene = build_scene();
    put_ground(scene);
    for (int i = 0; i < 12; i++) {
        uint32_t texture =
            build_noise(scene, tiles[i].width, tiles[i].height, tiles[i].channels, tiles[i].srgb);
        if (tiles[i].wide)
            widen(scene);
        scene->textures[texture].nearest = tiles[i].nearest;
        scene->textures[texture].wrap_s = scene->textures[texture].wrap_t = tiles[i].wrap;
        lsf_material *material = build_material(scene, 0.9f, 0.9f, 0.9f);
        material->base_color_texture.texture = texture;
        material->base_color_texture.uv_set = tiles[i].uv_set;
        if (tiles[i].transformed)
            memcpy(material->base_color_texture.transform,
                   (const float[6]){1.3f, 0.6f, 0.2f, -0.5f, 1.7f, -0.4f}, 6 * sizeof(float));
        material->alpha_mode = tiles[i].masked ? LSF_ALPHA_MASK : LSF_ALPHA_OPAQUE;
        material->alpha_cutoff = 0.55f;
        if (i % 2)
            material->metallic_roughness_texture.texture = texture;
        lsf_node *node = build_quad(scene, lsf_f3(-1, -1, 0), lsf_f3(1, -1, 0), lsf_f3(1, 1, 0),
                                    lsf_f3(-1, 1, 0));
        move(node, 1.1 * (i % 4 - 1.5), 1.1 * (1.2 - i / 4), 0.2 * (i / 4), 0.5);
    }
    lsf_vertices *v = &scene->vertices;
    v->color = calloc(v->count, 4 * sizeof(float));
    assert_non_null(v->color);
    for (uint64_t i = 0; i < 4 * v->count; i++)
        v->color[i] = i < 24 || !tiles[i / 24 - 1].colored ? 1.0f : 1.0f - 0.1f * (float)(i % 7);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 3, 4), lsf_f3(0, -1, 0), 60.0f);
    check_view("textures", scene, (const float[3]){0.3f, 0.6f, 5}, INFINITY);
}

/* KHR_materials_specular: weight and tint, by factor and by texture, brighter than 1 too. */
static void specular(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    put_ground(scene);
    uint32_t weights = build_noise(scene, 3, 4, 4, false),
             tints = build_noise(scene, 4, 3, 3, true);
    for (int i = 0; i < 6; i++) {
        lsf_material *material = build_material(scene, 0.2f, 0.15f, 0.1f);
        material->roughness = i % 2 ? 0.35f : 0.7f;
        material->metallic = i == 4 ? 0.5f : 0.0f;
        material->specular = i == 0 ? 0.2f : 1.0f;
        if (i >= 1)
            memcpy(material->specular_color, (const float[3]){0.3f, 2.0f, 14.0f},
                   3 * sizeof(float));
        if (i == 2 || i == 5)
            material->specular_texture.texture = weights;
        if (i >= 3)
            material->specular_color_texture.texture = tints;
        move(build_sphere(scene, 3, false), 1.4 * (i % 3 - 1), i / 3 ? 0.7 : -0.4, i / 3 ? -1 : 0.5,
             0.6);
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-2, 3, 4), lsf_f3(0, -1, 0), 60.0f);
    check_view("specular", scene, (const float[3]){0, 1.5f, 5}, INFINITY);
}

/* KHR_materials_clearcoat: by factors and textures, over bent normals, and with bent ones of its
 * own. */
static void clear_coat(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    put_ground(scene);
    uint32_t noise = build_noise(scene, 3, 4, 3, false), bumps = build_bumps(scene);
    for (int i = 0; i < 6; i++) {
        lsf_material *material = build_material(scene, 0.4f, 0.15f, 0.1f);
        material->roughness = 0.8f;
        material->metallic = i == 4 ? 1.0f : 0.0f;
        material->coat = i == 1 ? 0.5f : 1.0f;
        material->coat_roughness = i == 0 ? 0.3f : 0.6f;
        if (i == 2)
            material->coat_texture.texture = noise;
        if (i == 2 || i == 5)
            material->coat_roughness_texture.texture = noise;
        if (i == 3)
            material->normal_texture.texture = bumps;
        if (i == 4)
            material->coat_normal_texture.texture = bumps;
        move(build_sphere(scene, 3, false), 1.4 * (i % 3 - 1), i / 3 ? 0.7 : -0.4, i / 3 ? -1 : 0.5,
             0.6);
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-2, 3, 4), lsf_f3(0, -1, 0), 60.0f);
    check_view("clear_coat", scene, (const float[3]){0, 1.5f, 5}, INFINITY);
}

/* KHR_materials_sheen: by factors and textures, over metal, and under a coat. */
static void sheen(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    put_ground(scene);
    uint32_t colors = build_noise(scene, 3, 4, 3, true),
             alphas = build_noise(scene, 3, 4, 4, false);
    for (int i = 0; i < 6; i++) {
        lsf_material *material = build_material(scene, 0.3f, 0.15f, 0.1f);
        material->roughness = 0.8f;
        material->metallic = i == 4 ? 1.0f : 0.0f;
        memcpy(material->sheen_color, (const float[3]){0.9f, 0.5f, 0.2f}, 3 * sizeof(float));
        material->sheen_roughness = i == 0 ? 0.3f : i == 1 ? 1.0f : 0.6f;
        if (i == 2)
            material->sheen_color_texture.texture = colors;
        if (i == 2 || i == 5)
            material->sheen_roughness_texture.texture = alphas;
        material->coat = i == 3 ? 1.0f : 0.0f;
        material->coat_roughness = 0.5f;
        move(build_sphere(scene, 3, false), 1.4 * (i % 3 - 1), i / 3 ? 0.7 : -0.4, i / 3 ? -1 : 0.5,
             0.6);
    }
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(-2, 3, 4), lsf_f3(0, -1, 0), 60.0f);
    check_view("sheen", scene, (const float[3]){0, 1.5f, 5}, INFINITY);
}

/* Alone, for to the path tracer it is a lamp. */
static void unlit(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, 0.9f, 0.8f, 0.7f);
    material->unlit = true;
    material->base_color_texture.texture = build_noise(scene, 3, 4, 4, true);
    lsf_node *node =
        build_quad(scene, lsf_f3(-2, -1, 0), lsf_f3(2, -1, 0), lsf_f3(2, 1, 0), lsf_f3(-2, 1, 0));
    scene->show_back_faces = true;
    node->rotation[1] = 1.0; /* seen from behind */
    node->rotation[3] = 0.0;
    check_view("unlit", scene, (const float[3]){0.3f, 0.6f, 5}, INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cornell_point),  cmocka_unit_test(cornell_sun),
        cmocka_unit_test(cornell_glossy), cmocka_unit_test(roughness_and_metallic),
        cmocka_unit_test(mirrors),        cmocka_unit_test(orthographic),
        cmocka_unit_test(anisotropy),     cmocka_unit_test(normal_maps),
        cmocka_unit_test(textures),       cmocka_unit_test(specular),
        cmocka_unit_test(clear_coat),     cmocka_unit_test(sheen),
        cmocka_unit_test(unlit),          cmocka_unit_test(small_details),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
