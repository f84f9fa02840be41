#include "tools/options.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

#define RENDERING (LSF_COMMAND_RENDER | LSF_COMMAND_REFERENCE)
#define PLANNING (RENDERING | LSF_COMMAND_PLAN)
#define LOADING (PLANNING | LSF_COMMAND_INFO)
#define MEASURING (LSF_COMMAND_BENCH | LSF_COMMAND_MEASURE)
#define STAGING (PLANNING | MEASURING | LSF_COMMAND_SANDBOX | LSF_COMMAND_VIEW)
#define SCENES (LOADING | MEASURING | LSF_COMMAND_SANDBOX | LSF_COMMAND_VIEW)
#define DRAWING (RENDERING | MEASURING | LSF_COMMAND_SANDBOX)
#define PICTURES (RENDERING | LSF_COMMAND_SANDBOX)
#define SHOWING (PLANNING | LSF_COMMAND_VIEW)
#define ANY (SCENES | LSF_COMMAND_COMPARE | LSF_COMMAND_HELP)

static const lsf_command commands[] = {
    {LSF_COMMAND_RENDER, "render", "[SCENE]... -o OUT", 0, UINT32_MAX,
     "render a glTF scene with OpenGL",
     "Renders SCENE (.gltf or .glb, - for standard input; without one, the furnished interior that "
     "comes with Lightsheaf) into OUT by iterations that converge. It needs neither display nor "
     "GPU."},
    {LSF_COMMAND_VIEW, "view", "[SCENE]...", 0, UINT32_MAX, "view scenes in a window",
     "Shows SCENE in a window, in which you can move the camera, try techniques and their "
     "options, and edit the scene; without one, a page of the scenes that come with Lightsheaf. A "
     "still view becomes the picture that `render` makes. H shows keys and buttons."},
    {LSF_COMMAND_REFERENCE, "reference", "[SCENE]... -o OUT", 0, UINT32_MAX,
     "path-trace the same picture on the CPU, as ground truth",
     "Path-traces SCENE on the CPU, as the reference for a technique's picture. It takes the "
     "options of `render`; those for OpenGL or a technique have no effect here."},
    {LSF_COMMAND_COMPARE, "compare", "TEST REFERENCE [REFERENCE_B]", 2, 3,
     "measure a picture's error against a reference",
     "Prints the error of TEST against REFERENCE: RMSE, relMSE, bias per channel, SSIM and PSNR. "
     "With two independent halves of the reference, its own noise is removed from the squared "
     "errors. A pixel that is not finite is a failure."},
    {LSF_COMMAND_INFO, "info", "SCENE...", 1, UINT32_MAX,
     "print the contents of a scene and its requirements",
     "Prints the contents of the file, what was ignored or repaired, and what the scene requires "
     "of a renderer. For a picture, it prints format, size, channels and texts, which include the "
     "command that made it. It needs no OpenGL."},
    {LSF_COMMAND_PLAN, "plan", "[SCENE]...", 0, UINT32_MAX,
     "print what a rendering would run, and why",
     "Prints the frame plan: the passes in order, each resource with its bytes, each shader's "
     "switches, and why each exists or was left out. It needs no OpenGL."},
    {LSF_COMMAND_BENCH, "bench", "rays|bidirectional|cone|voxel_path [SCENE]", 1, 2,
     "measure the speed of ray-bundles, or of a frame",
     "`rays` prints how many rays per second a ray-bundle traces, built and searched, beside "
     "Embree's closest hits for the same rays on the same cores, and the share of rays on which "
     "they agree. `bidirectional` prints the times of a frame of 21 VPLs and 21 ray-bundles, in "
     "the rows of Table 1 of Tokuyoshi and Ogaki 2012, on a scene that is tessellated to about as "
     "many triangles as theirs. `cone` prints the times of a frame of cone tracing that rebuilds "
     "its voxels. `voxel_path` prints the times of voxel path tracing in the two frames of its "
     "talk of 2018."},
    {LSF_COMMAND_MEASURE, "measure", "[SCENE]", 0, 1, "measure time, memory and error on a scene",
     "Renders SCENE by each requested technique, option and number of samples, from several "
     "seeds, and prints time, memory, and the error against the path-traced reference: RMSE, "
     "relMSE, bias and SSIM, and how much of the error is noise."},
    {LSF_COMMAND_SANDBOX, "sandbox", "SHADER [SCENE] [-o OUT]", 0, 2,
     "run your own shader with the engine's data",
     "Runs SHADER, a fragment shader as in Shadertoy or with its own main, or a compute shader "
     "(.comp). It runs in a window and is reloaded whenever it is saved, or its picture is "
     "written to OUT. The shader can use the engine's data of SCENE: the surface in each pixel, "
     "lights and their shadow maps, voxels, ray-bundles, the picture of a technique; only what it "
     "names is computed. docs/sandbox.md has the names."},
    {LSF_COMMAND_HELP, "help", "[COMMAND]", 0, 1, "explain a command and its options",
     "Prints the options of COMMAND, or the list of commands."},
};

const lsf_command *lsf_command_at(size_t index)
{
    return index < LSF_COUNT(commands) ? &commands[index] : NULL;
}

const lsf_command *lsf_command_find(lsf_command_bit bit)
{
    for (size_t i = 0; i < LSF_COUNT(commands); i++)
        if (commands[i].bit == bit)
            return &commands[i];
    return NULL;
}

#define AT(member) offsetof(lsf_settings, member)

static const lsf_command_option options[] = {
    {"output", 'o', "OUT", PICTURES, "Output", LSF_VALUE_TEXT, AT(output), 0, 0, NULL, NULL,
     "file of the picture, with the format given by its ending: .exr (32-bit float, linear "
     "radiance, with the layers of --aov), .hdr (RGBE), .png (tone-mapped, 8-bit sRGB); - is "
     "standard output; %s is replaced by the scene's name without folder and ending, for several "
     "scenes"},
    {"format", 0, "FORMAT", PICTURES, "Output", LSF_VALUE_CHOICE, AT(format), LSF_IMAGE_FORMAT_EXR,
     0, "exr|hdr|png", NULL,
     "format of the picture, whatever the ending of OUT; the default for standard output is exr"},
    {"exposure", 0, "EV|auto", PICTURES | LSF_COMMAND_VIEW, "Output", LSF_VALUE_EXPOSURE,
     AT(exposure), -100, 100, NULL, "0",
     "multiply radiance by 2^EV before tone mapping; auto brings the picture's log-average "
     "luminance to middle grey, 0.18; float formats are not affected"},
    {"exposure", 0, "EV", LSF_COMMAND_COMPARE | LSF_COMMAND_MEASURE, "Output", LSF_VALUE_FLOAT,
     AT(exposure.ev), -100, 100, NULL, "0", "multiply radiance by 2^EV before tone mapping"},
    {"tonemap", 0, "CURVE", PICTURES | LSF_COMMAND_VIEW, "Output", LSF_VALUE_CHOICE, AT(tonemap),
     LSF_TONE_CURVE_NEUTRAL, 0, "neutral|none|aces|agx", "neutral",
     "tone curve of .png: neutral is Khronos PBR Neutral, which preserves base colours; none is "
     "sRGB, clamped at 1; aces and agx resemble film"},
    {"tonemap", 0, "CURVE", LSF_COMMAND_COMPARE, "Output", LSF_VALUE_CHOICE, AT(tonemap),
     LSF_TONE_CURVE_NEUTRAL, 0, "neutral|none|aces|agx", "neutral",
     "tone curve for SSIM, PSNR, FLIP and the difference; use none for .png, which is already "
     "made for display"},
    {"aov", 0, "LIST", PLANNING, "Output", LSF_VALUE_AOVS, AT(aovs), 0, 0,
     "albedo|normal|depth|emission|direct|indirect_diffuse|indirect_specular|motion|voxel_albedo|"
     "voxel_normal|voxel_radiance|all",
     NULL,
     "additional layers in .exr, separated by commas; all is every one except those of voxels"},
    {"dot", 0, NULL, LSF_COMMAND_PLAN, "Output", LSF_VALUE_FLAG, AT(dot), 0, 0, NULL, NULL,
     "print the plan as a graph for Graphviz: passes in order, the resources that they write and "
     "read, with bytes, and the switches that are on"},
    {"prices", 0, NULL, LSF_COMMAND_PLAN | LSF_COMMAND_MEASURE, "Output", LSF_VALUE_FLAG,
     AT(prices), 0, 0, NULL, NULL,
     "print the cost of each feature of the scene: the bytes, passes, resources and switches that "
     "the plan does not have without it; measure, which uses its first technique, also times a "
     "frame"},
    {"json", 0, "FILE", LOADING | LSF_COMMAND_COMPARE | MEASURING, "Output", LSF_VALUE_JSON,
     AT(json_path), 0, 0, NULL, NULL,
     "write all results as JSON; - is standard output, where it replaces the text"},
    {"halves", 0, NULL, LSF_COMMAND_REFERENCE, "Output", LSF_VALUE_FLAG, AT(halves), 0, 0, NULL,
     NULL,
     "take --samples twice, independently, and write out_a.exr and out_b.exr in addition to "
     "out.exr, their mean"},
    {"csv", 0, "FILE", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_JSON, AT(csv_path), 0, 0, NULL,
     NULL, "write the table as CSV, a line for each point; - is standard output"},
    {"html", 0, "FILE", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_JSON, AT(html_path), 0, 0, NULL,
     NULL,
     "write a report for a browser: plots, pictures and tables in one file that needs no "
     "network; - is standard output"},
    {"pictures", 0, "DIR", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_TEXT, AT(picture_folder), 0, 0,
     NULL, NULL,
     "write a picture of each point and of the reference to that folder, .exr and .png"},

    {"preset", 0, "NAME|FILE", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_PRESET,
     AT(measure_preset), 0, 0, "quick|full", "quick",
     "defaults of techniques, options, samples, seeds and reference; or a file of --save-preset, "
     "of which only the settings are measured"},
    {"technique", 't', "LIST", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_TECHNIQUES,
     AT(techniques), 0, 0, NULL, NULL, "techniques, separated by commas; see --list-techniques"},
    {"sweep", 0, "pass.key=A,B,...", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_SWEEP,
     AT(sweeps), 0, 0, NULL, NULL,
     "measure each value of a pass's option, combined with the values of the other swept options; "
     "repeatable; see --list-options"},
    {"resolution", 'r', "W,H", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_RESOLUTION,
     AT(resolution), 1, 16384, NULL, NULL,
     "width and height in pixels; the default is 1024x768 on a GPU and 256x192 in software"},
    {"samples", 's', "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(samples), 1,
     65536, NULL, NULL,
     "largest number of iterations of a frame; the powers of 2 below are measured as well"},
    {"seeds", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(seeds), 2, 32, NULL,
     NULL, "frames of each point, with different random numbers, to separate noise from bias"},
    {"reference-samples", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT,
     AT(reference_samples), 1, 1000000, NULL, NULL,
     "samples per pixel of each half of the reference; if the cache has fewer, the rest are added "
     "to it"},
    {"budget-ms", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(budget_ms), 1e-3,
     1e9, NULL, NULL,
     "search for the technique, options and samples of the lowest relMSE in a frame of X "
     "milliseconds, instead of measuring all of them"},
    {"error", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(error), 1e-12, 1e12,
     NULL, NULL, "search for those that reach a relMSE of X in the shortest time"},
    {"clock", 0, "CLOCK", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_CHOICE, AT(clock), 0, 0,
     "auto|processor", "auto",
     "clock for milliseconds: auto uses the GPU's timestamps, or the wall clock if OpenGL is "
     "software; processor adds up the time of all cores, on which other programs have less effect"},
    {"save-preset", 0, "FILE", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_JSON, AT(saved_preset),
     0, 0, NULL, NULL,
     "write the settings found with --budget-ms or --error as a preset, for render --preset"},
    {"resume", 0, NULL, LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FLAG, AT(resume), 0, 0, NULL,
     NULL, "keep the points that are already in the file of --json, and measure the others"},
    {"frames", 0, "A-B", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FRAMES, AT(frames), 0,
     999999999, NULL, NULL,
     "measure the frames from A to B of the animation, or of --turntable, too: their error, the "
     "error of changes between them, and flicker where nothing moves"},
    {"fps", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "24", "frames per second of animation time"},
    {"turntable", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(turntable), 1,
     1000000, NULL, NULL,
     "move the camera around the scene's centre, about the vertical axis, once in N frames; the "
     "first 8 are measured without --frames"},
    {"temporal", 0, NULL, LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FLAG, AT(temporal), 0, 0,
     NULL, NULL, "reuse light of earlier frames in consecutive frames"},
    {"cache", 0, "DIR|none", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_TEXT, AT(cache), 0, 0,
     NULL, NULL,
     "folder of cached references, whose keys cover the scene's files and the view; the default "
     "is lightsheaf in XDG_CACHE_HOME or in ~/.cache"},

    {"preset", 0, "FILE", SHOWING | LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_TEXT, AT(preset), 0,
     0, NULL, NULL,
     "read options from a file, one per line as name=value, as measure --save-preset writes them; "
     "the command line overrides them; reference ignores technique and samples in it"},
    {"technique", 't', "NAME", SHOWING | LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_TECHNIQUE,
     AT(technique), 0, 0, NULL, "bidirectional", "rendering technique; see --list-techniques"},
    {"resolution", 'r', "W,H", PLANNING, "Picture", LSF_VALUE_RESOLUTION, AT(resolution), 1, 65535,
     NULL, "1024,768", "width and height in pixels; also accepts 1024x768"},
    {"resolution", 'r', "W,H", LSF_COMMAND_BENCH, "Measurement", LSF_VALUE_RESOLUTION,
     AT(resolution), 1, 16384, NULL, NULL,
     "width and height of the screen in pixels; the default is 512x512, 1024x1024 and 1920x1080 "
     "for rays, 1920x1088 for bidirectional, or 480x270 if OpenGL is software, 512x512 for cone, "
     "and 1024x768 and 1920x1080 for voxel_path"},
    {"resolution", 'r', "W,H", LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_RESOLUTION, AT(resolution),
     1, 65535, NULL, "640,360",
     "width and height in pixels; also accepts 640x360; the default of a window is 1024,576"},
    {"samples", 's', "N", LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_COUNT, AT(samples), 1, 1000000,
     NULL, "1", "iterations of lsf_picture in each frame"},
    {"samples", 's', "N", LSF_COMMAND_BENCH, "Measurement", LSF_VALUE_COUNT, AT(samples), 1, 64,
     NULL, NULL,
     "directions of bundles for the median, or frames for the mean; the default is 7 directions, "
     "32 frames on a GPU and 3 in software"},
    {"samples", 's', "N", SHOWING, "Picture", LSF_VALUE_COUNT, AT(samples), 1, 1000000000, NULL,
     NULL, "iterations; the default is 64, or with --time-limit as many as fit"},
    {"time-limit", 0, "S", PLANNING, "Picture", LSF_VALUE_DOUBLE, AT(time_limit), 0.001, 1e9, NULL,
     NULL,
     "seconds of rendering, without those in which software OpenGL compiles shaders; the last "
     "iteration ends at most a quarter of its time late, or is dropped, except the first"},
    {"bounces", 'b', "N", SHOWING | LSF_COMMAND_MEASURE | LSF_COMMAND_SANDBOX, "Picture",
     LSF_VALUE_COUNT, AT(bounces), 0, LSF_BOUNCES_MAX, NULL, NULL,
     "indirect bounces of light; 0 is direct light only; the default is 3, and 7 if materials "
     "transmit light, because each side of a glass wall takes one"},
    {"raw", 0, NULL, SHOWING | LSF_COMMAND_MEASURE, "Picture", LSF_VALUE_FLAG, AT(raw), 0, 0, NULL,
     NULL,
     "write the mean of the iterations without a filter; all pixels take the same samples unless "
     "interleave.size is set"},
    {"seed", 0, "N", STAGING, "Picture", LSF_VALUE_SEED, AT(seed), 0, 0, NULL, "0",
     "seed of the random numbers: the same seed gives the same bits, except on some GPUs"},
    {"define", 'D', "pass.key=value", STAGING, "Picture", LSF_VALUE_DEFINE, AT(defines), 0, 0, NULL,
     NULL, "set an option of a pass; repeatable; see --list-options"},

    {"background", 0, "R,G,B|environment|transparent", SHOWING, "Picture", LSF_VALUE_BACKGROUND,
     AT(background), 0, 1e30, NULL, NULL,
     "background where no surface is: a radiance; environment; or transparent, which writes the "
     "alpha of each pixel to .exr and .png; the default is the environment, or grey before the "
     "default sky"},

    {"camera", 'c', "NAME|INDEX", STAGING, "Camera", LSF_VALUE_TEXT, AT(camera), 0, 0, NULL, NULL,
     "camera of the scene, by name or by index from 0; default, the last, is added to frame the "
     "scene; without this option the first is used"},
    {"camera-position", 0, "X,Y,Z", STAGING, "Camera", LSF_VALUE_VECTOR, AT(camera_position), -1e30,
     1e30, NULL, NULL, "move the camera there, in scene units"},
    {"camera-target", 0, "X,Y,Z", STAGING, "Camera", LSF_VALUE_VECTOR, AT(camera_target), -1e30,
     1e30, NULL, NULL, "point the camera there, in scene units"},
    {"fov-y", 0, "DEG", STAGING, "Camera", LSF_VALUE_FLOAT, AT(fov_y), 0.01, 179, NULL, NULL,
     "vertical field of view in degrees; the default is the camera's own"},
    {"time", 0, "S", STAGING, "Camera", LSF_VALUE_DOUBLE, AT(time), -1e9, 1e9, NULL, "0",
     "time at which animations are sampled, in seconds; with --frames, that of frame 0"},

    {"frame", 0, "N", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_COUNT, AT(frame), 0, 999999999,
     NULL, "0", "frame to write; earlier frames run as well if buffers read them"},
    {"frames", 0, "A-B", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_FRAMES, AT(frames), 0,
     999999999, NULL, NULL,
     "write the frames from A to B, each to its own file: %d in OUT, or %04d for leading zeros, "
     "is the frame's number"},
    {"fps", 0, "X", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "60", "frames per second: frame N has the time N / X after --time"},
    {"frames", 0, "A-B", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_FRAMES, AT(frames), 0, 999999999,
     NULL, NULL,
     "render the frames from A to B, each to its own file: %d in OUT, or %04d for leading zeros, "
     "is the frame's number. A frame depends only on its number and the seed, so several machines "
     "can share a sequence; --time-limit applies to each frame"},
    {"fps", 0, "X", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "24", "frames per second of animation time"},
    {"turntable", 0, "N", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_COUNT, AT(turntable), 1,
     1000000, NULL, NULL,
     "move the camera around the scene's centre, about the vertical axis, once in N frames; the "
     "default of --frames is these N"},
    {"resume", 0, NULL, LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_FLAG, AT(resume), 0, 0, NULL,
     NULL, "skip frames whose picture already exists"},
    {"temporal", 0, NULL, LSF_COMMAND_RENDER | LSF_COMMAND_PLAN, "Sequence", LSF_VALUE_FLAG,
     AT(temporal), 0, 0, NULL, NULL,
     "reuse light of earlier frames, so that few samples per frame look like many; each frame "
     "then depends on those before it, and one machine renders all of them in order"},

    {"light", 0, "X,Y,Z,R,G,B", SHOWING, "Scene", LSF_VALUE_LIGHT, AT(lights), -1e30, 1e30, NULL,
     NULL,
     "add a point light at that position, in scene units, with that intensity in W/sr; repeatable"},
    {"edit", 0, "KIND/WHICH/VALUE=NUMBERS", SHOWING, "Scene", LSF_VALUE_TEXTS, AT(edits), 0, 0,
     NULL, NULL,
     "change a node, a light or a material of the scene, by name or by index from 0, or its "
     "environment: light/0/intensity=3,3,2.5, material/wall/base_color=0.8,0.2,0.2, "
     "environment/rotation=90, environment/strength=2 or node/lamp/matrix= and 16 numbers; also "
     "type (point, spot or directional), range, inner_cone, outer_cone, and metallic, roughness, "
     "emission, ior, "
     "transmission, coat, coat_roughness; repeatable"},
    {"view", 0, "FILE", SHOWING, "Scene", LSF_VALUE_TEXT, AT(view_file), 0, 0, NULL, NULL,
     "read scene, camera and options from a view that `lightsheaf view` has saved; the command "
     "line overrides them"},
    {"environment", 'e', "FILE|R,G,B", SCENES, "Scene", LSF_VALUE_ENVIRONMENT, AT(environment), 0,
     1e30, NULL, NULL,
     "light from outside: a latitude-longitude .hdr or .exr, or a uniform radiance in W/(m^2 sr)"},
    {"environment-rotation", 0, "DEG", SCENES, "Scene", LSF_VALUE_FLOAT, AT(environment_rotation),
     -36000, 36000, NULL, "0",
     "rotate the environment about the vertical axis, in degrees, anticlockwise as seen from "
     "above"},
    {"environment-strength", 0, "X", SCENES, "Scene", LSF_VALUE_FLOAT, AT(environment_strength), 0,
     1e20, NULL, "1", "multiply the environment's radiance by X"},
    {"default-light", 0, "WHEN", SCENES, "Scene", LSF_VALUE_CHOICE, AT(default_light),
     LSF_DEFAULT_LIGHT_AUTO, 0, "auto|always|never", "auto",
     "whether to add a soft sky and a key light, and a lamp where these do not reach what the "
     "first camera shows; auto: if the file has no light, its emissive materials do not light it, "
     "and there is no --environment"},
    {"diffuse-only", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(diffuse_only), 0, 0, NULL, NULL,
     "treat every material as diffuse with its base colour, without normal maps"},
    {"show-back-faces", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(show_back_faces), 0, 0, NULL,
     NULL,
     "show the backs of single-sided materials to the camera, which glTF hides; light reaches "
     "both sides in any case"},
    {"lenient", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(lenient), 0, 0, NULL, NULL,
     "ignore required extensions that only change the look, leave out images whose files cannot be "
     "found, and take factors beyond 0 to 1 for the nearest of the two, with warnings"},
    {"memory-limit", 0, "GIB", SCENES, "Scene", LSF_VALUE_DOUBLE, AT(memory_limit), 0.001, 1e6,
     NULL, "8", "refuse a scene that needs more memory than this at any moment of loading, in GiB"},
    {"scene", 0, "NAME|INDEX", SCENES, "Scene", LSF_VALUE_TEXT, AT(scene), 0, 0, NULL, NULL,
     "scene of the file, by name or by index from 0; the default is the file's own choice, else "
     "the first"},
    {"animation", 0, "NAME|INDEX|none", SCENES, "Scene", LSF_VALUE_TEXTS, AT(animations), 0, 0,
     NULL, NULL,
     "play only this animation of the file, or none; repeatable; the default is all, and the "
     "first of those that move the same node"},
    {"variant", 0, "NAME|INDEX", SCENES, "Scene", LSF_VALUE_TEXT, AT(variant), 0, 0, NULL, NULL,
     "use this variant of the file's materials (KHR_materials_variants); the default is the "
     "file's own materials"},

    {"new", 0, "FILE", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_TEXT, AT(new_shader), 0, 0, NULL,
     NULL, "write a commented starting shader, and exit; .comp is a compute shader"},
    {"uniform", 'u', "NAME=X", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_TEXTS, AT(uniforms), 0, 0,
     NULL, NULL,
     "set a uniform of the shader, with commas between the numbers of a vector; repeatable"},
    {"channel", 0, "[BUFFER:]N=SOURCE", LSF_COMMAND_SANDBOX | LSF_COMMAND_PLAN, "Shader",
     LSF_VALUE_TEXTS, AT(channels), 0, 0, NULL, NULL,
     "source of iChannelN, instead of @channel in the shader; a:0=noise sets that of buffer a; "
     "repeatable"},
    {"mouse", 0, "X,Y", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_RESOLUTION, AT(mouse), 1, 65535,
     NULL, NULL, "hold the mouse button there, in pixels from the lower left corner"},
    {"watchdog", 0, "S", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_DOUBLE, AT(watchdog), 0, 1e6,
     NULL, "30", "seconds after which a frame without result counts as hung; 0 is no limit"},
    {"sandbox", 0, "SHADER", LSF_COMMAND_PLAN, "Shader", LSF_VALUE_TEXT, AT(sandbox), 0, 0, NULL,
     NULL, "print what `lightsheaf sandbox SHADER` computes instead; SCENE is optional then"},
    {"list-names", 0, NULL, LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_FLAG, AT(list_names), 0, 0,
     NULL, NULL, "print the names that a shader can use, with their meaning"},

    {"mask", 0, "FILE", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_TEXT, AT(mask), 0, 0, NULL,
     NULL, "exclude the pixels whose first channel is above 0.5"},
    {"threshold", 0, "METRIC=X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_THRESHOLD,
     AT(thresholds), 0, 0, "rmse|rmse_relative|relmse|bias|ssim|psnr|flip|flip_hdr", NULL,
     "exit with status 5 if METRIC is worse than X; repeatable"},
    {"flip", 0, NULL, LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_FLAG, AT(flip), 0, 0, NULL, NULL,
     "measure FLIP and HDR-FLIP as well, which takes longer than all other metrics"},
    {"difference", 0, "OUT", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_TEXT, AT(difference), 0,
     0, NULL, NULL, "write the absolute difference as a picture"},
    {"difference-gain", 0, "X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_FLOAT,
     AT(difference_gain), 1e-6, 1e6, NULL, "4", "factor of the difference"},
    {"epsilon", 0, "X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_DOUBLE, AT(epsilon), 0, 1e30,
     NULL, NULL,
     "term added to the squared reference in relMSE; the default is 0.01 of its squared mean"},

    {"resolution", 'r', "W,H", LSF_COMMAND_VIEW, "Window", LSF_VALUE_RESOLUTION, AT(resolution), 64,
     16384, NULL, NULL, "width and height of the window; the default is 1280,800"},
    {"full-screen", 0, NULL, LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_FLAG,
     AT(full_screen), 0, 0, NULL, NULL, "fill the screen"},
    {"budget", 0, "MS", LSF_COMMAND_VIEW, "Window", LSF_VALUE_DOUBLE, AT(budget), 1, 10000, NULL,
     NULL,
     "time of a frame in milliseconds while something moves, which decides the size of pictures "
     "and the fineness of maps; the default is 100 in software, 34 on a GPU"},
    {"record", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(record), 0, 0, NULL, NULL, "record mouse and keyboard, frame by frame"},
    {"replay", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(replay), 0, 0, NULL, NULL, "replay such a recording, then exit"},
    {"frame-times", 0, "FILE", LSF_COMMAND_VIEW, "Window", LSF_VALUE_TEXT, AT(frame_times), 0, 0,
     NULL, NULL,
     "write a CSV of how long each frame was shown, what it showed, and the size that the frame "
     "budget chose"},
    {"coverage", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(coverage), 0, 0, NULL, NULL,
     "write which keys, menus and parts of panels were used, and which were shown but not used"},
    {"list-keys", 0, NULL, LSF_COMMAND_VIEW, "General", LSF_VALUE_FLAG, AT(list_keys), 0, 0, NULL,
     NULL, "print keys and buttons"},

    {"backend", 0, "NAME", DRAWING, "Device", LSF_VALUE_CHOICE, AT(backend), LSF_BACKEND_AUTO, 0,
     "auto|egl|osmesa", "auto",
     "source of OpenGL; auto: EGL on a GPU, else EGL in software, else OSMesa"},
    {"shader-dir", 0, "DIR", DRAWING | LSF_COMMAND_VIEW, "Device", LSF_VALUE_TEXT, AT(shader_dir),
     0, 0, NULL, NULL, "read the shaders from DIR instead of the built-in copy"},
    {"gl-debug", 0, NULL, DRAWING, "Device", LSF_VALUE_FLAG, AT(gl_debug), 0, 0, NULL, NULL,
     "create a debug context, log its messages, and stop at the first OpenGL error"},

    {"list-techniques", 0, NULL, SHOWING | LSF_COMMAND_MEASURE | LSF_COMMAND_SANDBOX, "General",
     LSF_VALUE_FLAG, AT(list_techniques), 0, 0, NULL, NULL, "print the techniques"},
    {"list-options", 0, NULL, STAGING, "General", LSF_VALUE_FLAG, AT(list_options), 0, 0, NULL,
     NULL, "print the options of all passes, for -D"},
    {"quiet", 'q', NULL, ANY, "General", LSF_VALUE_FLAG, AT(quiet), 0, 0, NULL, NULL,
     "print only errors"},
    {"verbose", 'v', NULL, ANY, "General", LSF_VALUE_FLAG, AT(verbose), 0, 0, NULL, NULL,
     "print progress in detail, and the messages of OpenGL"},
    {"help", 'h', NULL, ANY, "General", LSF_VALUE_FLAG, AT(help), 0, 0, NULL, NULL,
     "print this help and exit"},
    {"version", 'V', NULL, ANY, "General", LSF_VALUE_FLAG, AT(version), 0, 0, NULL, NULL,
     "print the version and exit"},
};

const lsf_command_option *lsf_command_option_at(size_t index)
{
    return index < LSF_COUNT(options) ? &options[index] : NULL;
}

void lsf_command_option_add_choices(lsf_string *text, const lsf_command_option *option,
                                    const char *separator)
{
    for (const char *c = option->choices; *c; c++)
        lsf_string_add_bytes(text, *c == '|' ? separator : c, *c == '|' ? strlen(separator) : 1);
}

char *lsf_command_option_range(const lsf_command_option *option)
{
    double low = option->minimum, high = option->maximum;
    bool bounded = fabs(low) < 1e30 && fabs(high) < 1e30;
    switch (option->type) {
    case LSF_VALUE_FLAG:
        return lsf_format("no value");
    case LSF_VALUE_COUNT:
        return lsf_format("a whole number in %.0f..%.0f", low, high);
    case LSF_VALUE_SEED:
        return lsf_format("a whole number in 0..18446744073709551615");
    case LSF_VALUE_DOUBLE:
    case LSF_VALUE_FLOAT:
        return bounded ? lsf_format("a number in %.9g..%.9g", low, high)
                       : lsf_format("a number from %.9g", low);
    case LSF_VALUE_VECTOR:
        return lsf_format("three finite numbers separated by commas, such as 0,1.5,-2");
    case LSF_VALUE_FRAMES:
        return lsf_format("the first and the last frame, such as 0-47, from %.0f to %.0f", low,
                          high);
    case LSF_VALUE_RESOLUTION:
        return lsf_format("two whole numbers in %.0f..%.0f separated by a comma or x, such as "
                          "1024,768",
                          low, high);
    case LSF_VALUE_TEXT:
    case LSF_VALUE_TEXTS:
        return lsf_format("a text that is not empty");
    case LSF_VALUE_JSON:
        return lsf_format("a file such as report.json, or - for standard output");
    case LSF_VALUE_CHOICE:
        return lsf_format("one of %s", option->choices);
    case LSF_VALUE_PRESET:
        return lsf_format("one of %s, or a file", option->choices);
    case LSF_VALUE_TECHNIQUE:
        return lsf_format("one of the names that --list-techniques prints");
    case LSF_VALUE_TECHNIQUES:
        return lsf_format("names that --list-techniques prints, separated by commas");
    case LSF_VALUE_AOVS:
        return lsf_format("one or more of %s, separated by commas", option->choices);
    case LSF_VALUE_DEFINE:
        return lsf_format("pass.key=value with a key that --list-options prints");
    case LSF_VALUE_SWEEP:
        return lsf_format("pass.key=value,value,... with a key that --list-options prints");
    case LSF_VALUE_ENVIRONMENT:
        return lsf_format("a file, or three numbers from 0 separated by commas, such as "
                          "1,1,1");
    case LSF_VALUE_EXPOSURE:
        return lsf_format("auto or a number in %.9g..%.9g", low, high);
    case LSF_VALUE_BACKGROUND:
        return lsf_format("environment, transparent, or three numbers from 0 separated by commas, "
                          "such as 1,1,1");
    case LSF_VALUE_LIGHT:
        return lsf_format("six numbers separated by commas, such as 0,1.5,0,10,10,10");
    case LSF_VALUE_THRESHOLD:
        return lsf_format("METRIC=X, such as rmse=0.02, with one of %s", option->choices);
    }
    return NULL;
}
