#include "sandbox/names.h"

#include <string.h>

#include "base/base.h"

#define U LSF_SANDBOX_UNIFORM
#define E LSF_SANDBOX_ENGINE
#define O LSF_SANDBOX_OLDER
#define A LSF_SANDBOX_ANNOTATION
#define S LSF_SANDBOX_SOURCE

static const lsf_sandbox_row rows[] = {
    {U, "iResolution", "vec3 iResolution", 0, "width and height of the picture in pixels, and 1"},
    {U, "iTime", "float iTime", 0, "time of the frame in seconds"},
    {U, "iGlobalTime", "float iGlobalTime", 0, "iTime, as older shaders call it"},
    {U, "iTimeDelta", "float iTimeDelta", 0, "time since the frame before in seconds"},
    {U, "iFrame", "int iFrame", 0, "number of the frame, from 0"},
    {U, "iFrameRate", "float iFrameRate", 0, "frames per second"},
    {U, "iMouse", "vec4 iMouse", 0,
     "xy: where the button was held last, in pixels; zw: where it went down; z above 0 while it is "
     "held, w above 0 in the frame in which it went down"},
    {U, "iDate", "vec4 iDate", 0, "year, month from 0, day, and seconds of the day"},
    {U, "iSampleRate", "float iSampleRate", 0, "44100; there is no sound"},
    {U, "iChannelTime", "float iChannelTime[4]", 0, "iTime, for each channel"},
    {U, "iChannelResolution", "vec3 iChannelResolution[4]", 0,
     "width and height of each channel in texels, and 1"},
    {U, "iChannel0", "sampler2D iChannel0", 0, "source of @channel 0; a samplerCube for cube maps"},
    {U, "iChannel1", "sampler2D iChannel1", 0, "source of @channel 1"},
    {U, "iChannel2", "sampler2D iChannel2", 0, "source of @channel 2"},
    {U, "iChannel3", "sampler2D iChannel3", 0, "source of @channel 3"},
    {U, "iOutput", "image2D iOutput", 0, "picture that a compute shader writes, rgba32f"},

    {E, "lsf_camera_position", "vec3 lsf_camera_position(vec2 pixel)", LSF_NEED_VIEW,
     "start of the pixel's view ray, on the near plane"},
    {E, "lsf_camera_direction", "vec3 lsf_camera_direction(vec2 pixel)", LSF_NEED_VIEW,
     "unit direction of the pixel's view ray"},
    {E, "lsf_metres", "float lsf_metres(float length)", LSF_NEED_VIEW,
     "converts a length of normalised space to scene units, which are metres in glTF"},

    {E, "lsf_seen", "bool lsf_seen(vec2 pixel)", LSF_NEED_GBUFFER,
     "whether the pixel shows a surface"},
    {E, "lsf_depth", "float lsf_depth(vec2 pixel)", LSF_NEED_GBUFFER,
     "view depth of the pixel's surface; infinity if there is none"},
    {E, "lsf_position", "vec3 lsf_position(vec2 pixel)", LSF_NEED_GBUFFER,
     "point of the pixel's surface"},
    {E, "lsf_normal", "vec3 lsf_normal(vec2 pixel)", LSF_NEED_GBUFFER,
     "unit shading normal of the pixel's surface, towards the viewer"},
    {E, "lsf_albedo", "vec3 lsf_albedo(vec2 pixel)", LSF_NEED_GBUFFER,
     "base colour of the pixel's surface"},
    {E, "lsf_surface", "surface lsf_surface(vec2 pixel)", LSF_NEED_GBUFFER,
     "the pixel's surface, as `<lightsheaf/brdf.glsl>` defines it: geometric_normal, normal, "
     "base_color, metallic, roughness, f0"},
    {E, "lsf_emission", "vec3 lsf_emission(vec2 pixel)", LSF_NEED_GBUFFER,
     "emitted radiance of the pixel's surface"},
    {E, "lsf_motion", "vec2 lsf_motion(vec2 pixel)", LSF_NEED_GBUFFER | LSF_NEED_MOTION,
     "motion since the frame before, in pixels"},

    {E, "lsf_light_count", "int lsf_light_count()", LSF_NEED_LIGHTS,
     "number of point, spot and directional lights"},
    {E, "lsf_light", "vec3 lsf_light(int i, vec3 position, out vec3 direction)", LSF_NEED_LIGHTS,
     "irradiance by a light on a plane that faces it, without shadows; unit direction to the "
     "light"},
    {E, "lsf_visibility", "float lsf_visibility(vec3 position, vec3 normal)",
     LSF_NEED_LIGHTS | LSF_NEED_SHADOW,
     "1 if the light of @light reaches the surface, 0 in shadow"},
    {E, "lsf_reflective_size", "ivec3 lsf_reflective_size()",
     LSF_NEED_LIGHTS | LSF_NEED_SHADOW | LSF_NEED_REFLECTIVE,
     "texels and faces of the reflective shadow map of @light"},
    {E, "lsf_reflective", "bool lsf_reflective(ivec3 texel, out vec3 position, out surface s)",
     LSF_NEED_LIGHTS | LSF_NEED_SHADOW | LSF_NEED_REFLECTIVE,
     "surface that the light of @light reaches in a texel; false if there is none"},
    {E, "lsf_environment", "vec3 lsf_environment(vec3 direction)", LSF_NEED_ENVIRONMENT,
     "radiance of the environment; 0 if there is none"},

    {E, "lsf_voxel_size", "ivec3 lsf_voxel_size()", LSF_NEED_VOXELS, "voxels along x, y and z"},
    {E, "lsf_voxel_from", "vec3 lsf_voxel_from(vec3 position)", LSF_NEED_VOXELS,
     "converts normalised space to voxels: cell i contains i to i + 1"},
    {E, "lsf_voxel_to", "vec3 lsf_voxel_to(vec3 voxel)", LSF_NEED_VOXELS,
     "converts voxels to normalised space"},
    {E, "lsf_voxel_occupied", "bool lsf_voxel_occupied(ivec3 cell)", LSF_NEED_VOXELS,
     "whether a triangle touches the cell"},
    {E, "lsf_voxel_trace",
     "bool lsf_voxel_trace(vec3 position, vec3 direction, float end, out ivec3 cell, out float "
     "distance)",
     LSF_NEED_VOXELS, "first occupied cell on a ray within `end`; lengths are in normalised space"},
    {E, "lsf_voxel_leave", "vec3 lsf_voxel_leave(vec3 position, vec3 normal)", LSF_NEED_VOXELS,
     "moves a point of a surface out of the voxels that the surface itself occupies"},
    {E, "lsf_voxel_albedo", "vec3 lsf_voxel_albedo(ivec3 cell)", LSF_NEED_VOXELS,
     "base colour of an occupied cell"},
    {E, "lsf_voxel_normal", "vec3 lsf_voxel_normal(ivec3 cell)", LSF_NEED_VOXELS,
     "unit normal of the plane in an occupied cell"},
    {E, "lsf_voxel_radiance", "vec4 lsf_voxel_radiance(vec3 voxel, vec3 direction, float level)",
     LSF_NEED_VOXELS | LSF_NEED_RADIANCE,
     "radiance seen along `direction`, premultiplied by the opacity in a; filtered over 2^level "
     "voxels, level 0 to 4"},

    {E, "lsf_bundle_size", "int lsf_bundle_size()", LSF_NEED_BUNDLE,
     "texels along a side of the ray-bundle's map"},
    {E, "lsf_bundle_texel", "vec2 lsf_bundle_texel(vec3 position)", LSF_NEED_BUNDLE,
     "position of a point on the map, in texels"},
    {E, "lsf_bundle_count", "int lsf_bundle_count(ivec2 texel)", LSF_NEED_BUNDLE,
     "number of surfaces on the ray of a texel"},
    {E, "lsf_bundle_node", "uint lsf_bundle_node(ivec2 texel, int i)", LSF_NEED_BUNDLE,
     "the i-th of these surfaces, in no order"},
    {E, "lsf_bundle_depth", "float lsf_bundle_depth(uint node)", LSF_NEED_BUNDLE,
     "depth of a surface along the bundle: 0 to 1 over the whole scene"},
    {E, "lsf_bundle_surface",
     "surface lsf_bundle_surface(uint node, vec3 direction, out vec3 emission)", LSF_NEED_BUNDLE,
     "surface of a node, seen along the bundle or against it"},
    {E, "lsf_bundle_direction", "vec3 lsf_bundle_direction()", LSF_NEED_BUNDLE,
     "unit direction of the bundle"},
    {E, "lsf_bundle_hit", "bool lsf_bundle_hit(vec2 pixel, out float distance, out uint node)",
     LSF_NEED_BUNDLE | LSF_NEED_HITS | LSF_NEED_GBUFFER,
     "hit of the ray from the visible point, along the bundle or against it, on the side that the "
     "surface faces; false if the ray leaves the scene"},

    {E, "lsf_picture", "vec3 lsf_picture(vec2 pixel)", LSF_NEED_PICTURE,
     "radiance of the picture of --technique; while nothing changes, the mean of all frames so "
     "far"},
    {E, "lsf_direct", "vec3 lsf_direct(vec2 pixel)", LSF_NEED_PICTURE | LSF_NEED_DIRECT,
     "reflected direct light in lsf_picture"},
    {E, "lsf_indirect_diffuse", "vec3 lsf_indirect_diffuse(vec2 pixel)",
     LSF_NEED_PICTURE | LSF_NEED_DIFFUSE, "indirect light of the diffuse lobe in lsf_picture"},
    {E, "lsf_indirect_specular", "vec3 lsf_indirect_specular(vec2 pixel)",
     LSF_NEED_PICTURE | LSF_NEED_SPECULAR, "indirect light of the specular lobe in lsf_picture"},

    {O, "texture2D", "texture2D texture", 0, "texture, as older shaders write it"},
    {O, "textureCube", "textureCube texture", 0, "texture, as older shaders write it"},
    {O, "texture2DLod", "texture2DLod textureLod", 0, "textureLod, as older shaders write it"},
    {O, "texture2DLodEXT", "texture2DLodEXT textureLod", 0,
     "textureLod, as older shaders write it"},

    {A, "@channel", "// @channel N SOURCE [wrap=] [filter=] [flip=no]", 0,
     "source of iChannelN in this pass; wrap is repeat, clamp or mirror, filter nearest, linear "
     "or mipmap"},
    {A, "@slider", "uniform float x = 0.5; // @slider 0 1", 0,
     "your own uniform with its range; -u x=0.7 sets it, too"},
    {A, "@common", "// @common", 0, "the text below is put before each pass"},
    {A, "@buffer", "// @buffer a", 0, "the text below is the pass of buffer a, b, c or d"},
    {A, "@image", "// @image", 0, "the text below is the pass of the picture"},
    {A, "@output", "// @output radiance", 0,
     "the picture is radiance, and is tone-mapped; otherwise it has display values"},
    {A, "@jitter", "// @jitter", 0,
     "varies the sample points of pixels, the maps of lights and the voxels in each frame, so "
     "that a mean over frames shows no steps, texels or voxels; without it, all frames have the "
     "same"},
    {A, "@light", "// @light N", 0, "light of the shadow map, from 0"},
    {A, "@bundle", "// @bundle X Y Z", 0,
     "direction of the ray-bundle; the default is the camera's view direction"},
    {A, "@define", "// @define pass.key=value", 0, "option of a pass, as with -D"},

    {S, "a, b, c, d", "@channel 0 a", 0,
     "a buffer: from this frame, or from the frame before if its pass runs later"},
    {S, "previous", "@channel 0 previous", 0, "picture of the frame before"},
    {S, "keyboard", "@channel 0 keyboard", 0,
     "256 x 3 texels by key code: held, pressed in this frame, toggled"},
    {S, "noise", "@channel 0 noise", 0, "256 x 256 texels of random numbers in r, g, b and a"},
    {S, "FILE", "@channel 0 wood.png", 0,
     "a picture beside the shader: PNG, JPEG and WebP as code values, HDR and EXR as radiance"},
    {S, "cube FILE", "@channel 0 cube sky.hdr", 0,
     "a cube map of a latitude-longitude picture, or of six where FILE has %s: px nx py ny pz nz"},
};

const lsf_sandbox_row *lsf_sandbox_row_at(uint32_t index)
{
    return index < LSF_COUNT(rows) ? &rows[index] : NULL;
}

uint32_t lsf_sandbox_find_name(const char *name, size_t length)
{
    for (uint32_t i = 0; i < LSF_COUNT(rows); i++)
        if (rows[i].kind <= LSF_SANDBOX_OLDER && strlen(rows[i].name) == length &&
            memcmp(rows[i].name, name, length) == 0)
            return i;
    return LSF_NONE;
}

bool lsf_sandbox_list(uint32_t index, lsf_sandbox_name *name)
{
    static const char *const groups[] = {"uniform", "engine", "older", "annotation", "source"};
    if (index >= LSF_COUNT(rows) || !name)
        return false;
    const lsf_sandbox_row *row = &rows[index];
    const char *use = row->kind == LSF_SANDBOX_OLDER ? row->name : row->use;
    *name = (lsf_sandbox_name){groups[row->kind], row->name, use, row->help};
    return true;
}

/* What declares what each need gives; below, files of the library and the needs of who includes
 * them. */
static const struct {
    uint32_t needs;
    const char *file;
} files[] =
    {
        {LSF_NEED_VIEW, "sandbox/view.glsl"},
        {LSF_NEED_GBUFFER, "sandbox/gbuffer.glsl"},
        {LSF_NEED_LIGHTS, "sandbox/lights.glsl"},
        {LSF_NEED_SHADOW, "sandbox/shadow.glsl"},
        {LSF_NEED_REFLECTIVE, "sandbox/reflective.glsl"},
        {LSF_NEED_ENVIRONMENT, "sandbox/environment.glsl"},
        {LSF_NEED_VOXELS, "sandbox/voxels.glsl"},
        {LSF_NEED_RADIANCE, "sandbox/radiance.glsl"},
        {LSF_NEED_BUNDLE, "sandbox/bundle.glsl"},
        {LSF_NEED_HITS, "sandbox/hits.glsl"},
        {LSF_NEED_PICTURE, "sandbox/picture.glsl"},
},
  included[] = {
      {LSF_NEED_VIEW, "lib/view.glsl"},
      {LSF_NEED_GBUFFER, "lib/gbuffer_textures.glsl"},
      {LSF_NEED_LIGHTS | LSF_NEED_SHADOW, "lib/light.glsl"},
      {LSF_NEED_LIGHTS | LSF_NEED_SHADOW, "lib/light_projection.glsl"},
      {LSF_NEED_LIGHTS | LSF_NEED_SHADOW, "lib/shadow.glsl"},
      {LSF_NEED_ENVIRONMENT, "lib/environment.glsl"},
      {LSF_NEED_VOXELS, "lib/voxel.glsl"},
      {LSF_NEED_VOXELS, "lib/voxel_trace.glsl"},
      {LSF_NEED_BUNDLE, "lib/ray_bundle.glsl"},
};

const char *lsf_sandbox_need_file(lsf_sandbox_need need)
{
    for (size_t i = 0; i < LSF_COUNT(files); i++)
        if (files[i].needs == (uint32_t)need)
            return files[i].file;
    return NULL;
}

uint32_t lsf_sandbox_needs_of_file(const char *path)
{
    for (size_t i = 0; i < LSF_COUNT(included); i++)
        if (strcmp(included[i].file, path) == 0)
            return included[i].needs;
    return 0;
}
