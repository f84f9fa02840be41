/* Shaders to begin with, which a command writes. */
#include "tools/sandbox_new.h"

#include "base/base.h"

#include <string.h>
#include <unistd.h>

static const char fragment[] =
    "// A shader for `lightsheaf sandbox FILE [SCENE] -o picture.png`.\n"
    "//\n"
    "// mainImage is called for each pixel, as in Shadertoy: fragCoord is the pixel's place in\n"
    "// pixels from the lower left corner, fragColor what a display shows there, 0 to 1.\n"
    "// `lightsheaf sandbox --list-names` prints all that a shader may name; only what it names\n"
    "// is computed.\n"
    "\n"
    "// A uniform of one's own: -u speed=2 sets it.\n"
    "uniform float speed = 1.0; // @slider 0 4\n"
    "\n"
    "// What iChannel0 is: a picture beside the shader, noise, keyboard, previous, or a buffer.\n"
    "// @channel 0 noise filter=nearest\n"
    "\n"
    "void mainImage(out vec4 fragColor, in vec2 fragCoord)\n"
    "{\n"
    "    vec2 uv = fragCoord / iResolution.xy;\n"
    "    vec3 color = 0.5 + 0.5 * cos(speed * iTime + uv.xyx + vec3(0.0, 2.0, 4.0));\n"
    "    color *= 0.9 + 0.1 * texture(iChannel0, fragCoord / 256.0).r;\n"
    "\n"
    "    // With a scene: what the pixel sees, lit from above.\n"
    "    // if (lsf_seen(fragCoord))\n"
    "    //     color = lsf_albedo(fragCoord) * (0.6 + 0.4 * lsf_normal(fragCoord).y);\n"
    "\n"
    "    fragColor = vec4(color, 1.0);\n"
    "}\n";

static const char compute[] =
    "// A compute shader for `lightsheaf sandbox FILE [SCENE] -o picture.png`. It is run once for\n"
    "// each pixel, in groups, and writes what a display shows there to iOutput.\n"
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "\n"
    "void main()\n"
    "{\n"
    "    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);\n"
    "    if (any(greaterThanEqual(pixel, ivec2(iResolution.xy))))\n"
    "        return;\n"
    "    vec2 uv = (vec2(pixel) + 0.5) / iResolution.xy;\n"
    "    vec3 color = 0.5 + 0.5 * cos(iTime + uv.xyx + vec3(0.0, 2.0, 4.0));\n"
    "    imageStore(iOutput, pixel, vec4(color, 1.0));\n"
    "}\n";

bool lsf_sandbox_new(const char *path, lsf_error *error)
{
    size_t length = strlen(path);
    bool computes = length > 5 && strcmp(path + length - 5, ".comp") == 0;
    const char *text = computes ? compute : fragment;
    if (access(path, F_OK) == 0)
        return lsf_error_set(error, LSF_ERROR_FILE, "--new %s: the file is there already", path);
    return lsf_file_write(path, text, strlen(text), error);
}
