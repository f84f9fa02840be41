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
    {LSF_COMMAND_VIEW, "view", "[SCENE]...", 0, UINT32_MAX, "look at scenes in a window",
     "Shows SCENE in a window, in which the camera moves, techniques and their options are tried, "
     "and light is seen to change; without one, a page of the scenes that come with Lightsheaf. "
     "What is still becomes the picture that `render` makes. H shows keys and buttons."},
    {LSF_COMMAND_REFERENCE, "reference", "[SCENE]... -o OUT", 0, UINT32_MAX,
     "path-trace the same picture on the CPU, as ground truth",
     "Path-traces SCENE on the CPU: what a technique's picture is measured against. It takes the "
     "options of `render`; those that steer OpenGL or a technique have no effect here."},
    {LSF_COMMAND_COMPARE, "compare", "TEST REFERENCE [REFERENCE_B]", 2, 3,
     "measure a picture's error against a reference",
     "Prints the error of TEST against REFERENCE: RMSE, relMSE, bias per channel, SSIM and PSNR. "
     "With two independent halves of the reference, its own noise is taken out of the squared "
     "errors. A pixel that is not finite is a failure."},
    {LSF_COMMAND_INFO, "info", "SCENE...", 1, UINT32_MAX,
     "say what a scene holds and what it requires",
     "Prints what the file holds, what was ignored or repaired, and what the scene requires of a "
     "renderer. Of a picture it prints format, size, channels and texts, which tell how Lightsheaf "
     "made it. It needs no OpenGL."},
    {LSF_COMMAND_PLAN, "plan", "[SCENE]...", 0, UINT32_MAX,
     "say what a rendering would run, and why",
     "Prints the frame plan: the passes in order, each resource with its bytes, each shader's "
     "switches, and why each is there or was left out. It needs no OpenGL."},
    {LSF_COMMAND_BENCH, "bench", "rays|bidirectional|cone|voxel_path [SCENE]", 1, 2,
     "measure the speed of ray-bundles, or of a frame",
     "`rays` prints how many rays a second a ray-bundle answers, built and searched, beside the "
     "closest hits that Embree finds on the very same rays and cores, and the share of rays on "
     "which they agree. `bidirectional` prints what a frame of 21 VPLs and 21 ray-bundles takes, "
     "in the rows of Table 1 of Tokuyoshi and Ogaki 2012, on a scene that is tessellated to about "
     "as many triangles as theirs. `cone` prints what a frame of cone tracing takes whose voxels "
     "are made anew. `voxel_path` prints what the procedures of voxel path tracing "
     "take in the two frames that its talk of 2018 reports."},
    {LSF_COMMAND_MEASURE, "measure", "[SCENE]", 0, 1, "measure what a millisecond buys on a scene",
     "Renders SCENE by each technique, option and number of samples that is asked for, from "
     "several "
     "seeds, and prints what a frame takes and how far it is from the path-traced reference: time, "
     "memory, RMSE, relMSE, bias and SSIM, what of the error is noise and what stays."},
    {LSF_COMMAND_SANDBOX, "sandbox", "SHADER [SCENE] [-o OUT]", 0, 2,
     "run a shader of one's own against the engine",
     "Runs SHADER, a fragment shader as Shadertoy has them or with a main of its own, or a compute "
     "shader (.comp), in a window, where it is read again whenever it is saved, or writes what it "
     "draws to OUT. It may name what the engine knows of SCENE: what "
     "each pixel sees, lights and their shadow maps, voxels, ray-bundles, the picture of a "
     "technique; what it names is computed, and nothing else. docs/sandbox.md has the names."},
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
     "where the picture goes, its format by the ending: .exr (32-bit float, linear radiance, with "
     "the layers of --aov), .hdr (RGBE), .png (tone-mapped, 8-bit sRGB); - is standard output; %s "
     "in it is the scene's name without folder and ending, which tells the pictures of several "
     "scenes apart"},
    {"format", 0, "FORMAT", PICTURES, "Output", LSF_VALUE_CHOICE, AT(format), LSF_IMAGE_FORMAT_EXR,
     0, "exr|hdr|png", NULL,
     "the format, whatever the ending of OUT; standard output is exr without it"},
    {"exposure", 0, "EV|auto", PICTURES | LSF_COMMAND_VIEW, "Output", LSF_VALUE_EXPOSURE,
     AT(exposure), -100, 100, NULL, "0",
     "radiance is multiplied by 2^EV before tone mapping; auto brings the picture's log-average "
     "luminance to middle grey, 0.18; float formats hold radiance as it is"},
    {"exposure", 0, "EV", LSF_COMMAND_COMPARE | LSF_COMMAND_MEASURE, "Output", LSF_VALUE_FLOAT,
     AT(exposure.ev), -100, 100, NULL, "0", "radiance is multiplied by 2^EV before tone mapping"},
    {"tonemap", 0, "CURVE", PICTURES | LSF_COMMAND_VIEW, "Output", LSF_VALUE_CHOICE, AT(tonemap),
     LSF_TONE_CURVE_NEUTRAL, 0, "neutral|none|aces|agx", "neutral",
     "from radiance to .png: neutral is Khronos PBR Neutral, which keeps base colours; none is "
     "sRGB, cut off at 1; aces and agx are like film"},
    {"tonemap", 0, "CURVE", LSF_COMMAND_COMPARE, "Output", LSF_VALUE_CHOICE, AT(tonemap),
     LSF_TONE_CURVE_NEUTRAL, 0, "neutral|none|aces|agx", "neutral",
     "from radiance to what SSIM, PSNR, FLIP and the difference show; none is right for .png, "
     "which is made for display already"},
    {"aov", 0, "LIST", PLANNING, "Output", LSF_VALUE_AOVS, AT(aovs), 0, 0,
     "albedo|normal|depth|emission|direct|indirect_diffuse|indirect_specular|motion|voxel_albedo|"
     "voxel_normal|voxel_radiance|all",
     NULL,
     "layers beside the picture in .exr, separated by commas; all is every one but those of "
     "voxels"},
    {"dot", 0, NULL, LSF_COMMAND_PLAN, "Output", LSF_VALUE_FLAG, AT(dot), 0, 0, NULL, NULL,
     "print the plan as a graph for Graphviz: passes in order, what they fill and read, its bytes, "
     "and the switches that are on"},
    {"prices", 0, NULL, LSF_COMMAND_PLAN | LSF_COMMAND_MEASURE, "Output", LSF_VALUE_FLAG,
     AT(prices), 0, 0, NULL, NULL,
     "say what each feature of the scene costs: bytes, passes, resources and switches that the "
     "plan "
     "has without it no more; measure, which takes its first technique, times a frame, too"},
    {"json", 0, "FILE", LOADING | LSF_COMMAND_COMPARE | MEASURING, "Output", LSF_VALUE_JSON,
     AT(json_path), 0, 0, NULL, NULL,
     "write as JSON what is found, decided and measured; - is standard output, where it takes the "
     "place of text"},
    {"halves", 0, NULL, LSF_COMMAND_REFERENCE, "Output", LSF_VALUE_FLAG, AT(halves), 0, 0, NULL,
     NULL,
     "take --samples twice, independently: out_a.exr and out_b.exr beside out.exr, which holds "
     "their mean"},
    {"csv", 0, "FILE", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_JSON, AT(csv_path), 0, 0, NULL,
     NULL, "write the table as CSV, a line for each point; - is standard output"},
    {"html", 0, "FILE", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_JSON, AT(html_path), 0, 0, NULL,
     NULL,
     "write a report for a browser: plots, pictures and tables in one file that needs no network; "
     "- "
     "is standard output"},
    {"pictures", 0, "DIR", LSF_COMMAND_MEASURE, "Output", LSF_VALUE_TEXT, AT(picture_folder), 0, 0,
     NULL, NULL, "keep a picture of each point and of the reference in that folder, .exr and .png"},

    {"preset", 0, "NAME|FILE", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_PRESET,
     AT(measure_preset), 0, 0, "quick|full", "quick",
     "what is measured unless other options say: techniques, options, samples, seeds, reference; "
     "or "
     "a file of --save-preset, whose settings alone are measured then"},
    {"technique", 't', "LIST", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_TECHNIQUES,
     AT(techniques), 0, 0, NULL, NULL, "techniques, separated by commas; see --list-techniques"},
    {"sweep", 0, "pass.key=A,B,...", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_SWEEP,
     AT(sweeps), 0, 0, NULL, NULL,
     "measure each value of an option of a pass, with each of the other options that are swept; "
     "repeatable; see --list-options"},
    {"resolution", 'r', "W,H", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_RESOLUTION,
     AT(resolution), 1, 16384, NULL, NULL,
     "width and height in pixels; without it, 1024x768 on a GPU and 256x192 in software"},
    {"samples", 's', "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(samples), 1,
     65536, NULL, NULL,
     "the most iterations of a frame; the powers of 2 below are measured as well"},
    {"seeds", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(seeds), 2, 32, NULL,
     NULL, "frames of each point, from different random numbers: they tell noise from bias"},
    {"reference-samples", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT,
     AT(reference_samples), 1, 1000000, NULL, NULL,
     "samples a pixel of each half of the reference; more than there are in the cache are added to "
     "them"},
    {"budget-ms", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(budget_ms), 1e-3,
     1e9, NULL, NULL,
     "look for the technique, options and samples of the least relMSE in a frame of X "
     "milliseconds, "
     "instead of measuring all of them"},
    {"error", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(error), 1e-12, 1e12,
     NULL, NULL, "look for those that are the soonest to a relMSE of X"},
    {"clock", 0, "CLOCK", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_CHOICE, AT(clock), 0, 0,
     "auto|processor", "auto",
     "what milliseconds are: auto takes the GPU's timestamps, or the wall clock where OpenGL is "
     "software; processor adds up what all cores work, which other programs disturb less"},
    {"save-preset", 0, "FILE", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_JSON, AT(saved_preset),
     0, 0, NULL, NULL,
     "write what was found with --budget-ms or --error as a preset, for render --preset"},
    {"resume", 0, NULL, LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FLAG, AT(resume), 0, 0, NULL,
     NULL, "go on from the points that the file of --json holds, where it is there already"},
    {"frames", 0, "A-B", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FRAMES, AT(frames), 0,
     999999999, NULL, NULL,
     "measure the frames from A to B of the animation, or of --turntable, too: their error, that "
     "of "
     "what changes from one to the next, and flicker where nothing moves"},
    {"fps", 0, "X", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "24", "frames a second, in the time of animations"},
    {"turntable", 0, "N", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_COUNT, AT(turntable), 1,
     1000000, NULL, NULL,
     "carry the camera around the scene's centre, about the vertical axis, once in N frames, of "
     "which the first 8 are measured without --frames"},
    {"temporal", 0, NULL, LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_FLAG, AT(temporal), 0, 0,
     NULL, NULL, "keep light from frame to frame in frames that follow each other"},
    {"cache", 0, "DIR|none", LSF_COMMAND_MEASURE, "Measurement", LSF_VALUE_TEXT, AT(cache), 0, 0,
     NULL, NULL,
     "where references are kept, by what the scene's files hold and how it is seen; without it, "
     "lightsheaf in XDG_CACHE_HOME or in ~/.cache"},

    {"preset", 0, "FILE", SHOWING | LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_TEXT, AT(preset), 0,
     0, NULL, NULL,
     "take options from a file, one a line as name=value, as measure --save-preset writes them; "
     "those on the command line count more; reference takes neither technique nor samples from it"},
    {"technique", 't', "NAME", SHOWING | LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_TECHNIQUE,
     AT(technique), 0, 0, NULL, "bidirectional", "how light is found; see --list-techniques"},
    {"resolution", 'r', "W,H", PLANNING, "Picture", LSF_VALUE_RESOLUTION, AT(resolution), 1, 65535,
     NULL, "1024,768", "width and height in pixels; 1024x768 will do too"},
    {"resolution", 'r', "W,H", LSF_COMMAND_BENCH, "Measurement", LSF_VALUE_RESOLUTION,
     AT(resolution), 1, 16384, NULL, NULL,
     "the screen in pixels; without it, rays takes 512x512, 1024x1024 and 1920x1080, "
     "bidirectional 1920x1088, or 480x270 where OpenGL is software, cone 512x512, and voxel_path "
     "1024x768 and "
     "1920x1080"},
    {"resolution", 'r', "W,H", LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_RESOLUTION, AT(resolution),
     1, 65535, NULL, "640,360",
     "width and height in pixels; 640x360 will do too; a window is 1024,576 without it"},
    {"samples", 's', "N", LSF_COMMAND_SANDBOX, "Picture", LSF_VALUE_COUNT, AT(samples), 1, 1000000,
     NULL, "1", "iterations of lsf_picture in each frame"},
    {"samples", 's', "N", LSF_COMMAND_BENCH, "Measurement", LSF_VALUE_COUNT, AT(samples), 1, 64,
     NULL, NULL,
     "directions of bundles whose median is taken, or frames whose mean is; without it, 7 "
     "directions, 32 frames on a GPU and 3 in software"},
    {"samples", 's', "N", SHOWING, "Picture", LSF_VALUE_COUNT, AT(samples), 1, 1000000000, NULL,
     NULL, "iterations; 64, or with --time-limit as many as fit"},
    {"time-limit", 0, "S", PLANNING, "Picture", LSF_VALUE_DOUBLE, AT(time_limit), 0.001, 1e9, NULL,
     NULL,
     "seconds after which rendering ends; an iteration that is not done is dropped, but for the "
     "first"},
    {"bounces", 'b', "N", SHOWING | LSF_COMMAND_MEASURE | LSF_COMMAND_SANDBOX, "Picture",
     LSF_VALUE_COUNT, AT(bounces), 0, LSF_BOUNCES_MAX, NULL, NULL,
     "indirect bounces of light; 0 is direct light only; without it 3, and 7 where materials "
     "transmit light, for each side of a wall of glass takes one"},
    {"raw", 0, NULL, SHOWING | LSF_COMMAND_MEASURE, "Picture", LSF_VALUE_FLAG, AT(raw), 0, 0, NULL,
     NULL,
     "the mean of the iterations alone: no filter, and all pixels take the same samples unless "
     "interleave.size says otherwise"},
    {"seed", 0, "N", STAGING, "Picture", LSF_VALUE_SEED, AT(seed), 0, 0, NULL, "0",
     "start of the random numbers: the same seed gives the same bits"},
    {"define", 'D', "pass.key=value", STAGING, "Picture", LSF_VALUE_DEFINE, AT(defines), 0, 0, NULL,
     NULL, "set an option of a pass; repeatable; see --list-options"},

    {"background", 0, "R,G,B|environment|transparent", SHOWING, "Picture", LSF_VALUE_BACKGROUND,
     AT(background), 0, 1e30, NULL, NULL,
     "what is seen where no surface is: a radiance; environment; or transparent, which gives .exr "
     "and .png the alpha of each pixel; without it, the environment, or grey before the default "
     "sky"},

    {"camera", 'c', "NAME|INDEX", STAGING, "Camera", LSF_VALUE_TEXT, AT(camera), 0, 0, NULL, NULL,
     "a camera of the scene, by name or by index from 0; without it, the first"},
    {"camera-position", 0, "X,Y,Z", STAGING, "Camera", LSF_VALUE_VECTOR, AT(camera_position), -1e30,
     1e30, NULL, NULL, "move the camera there, in scene units"},
    {"camera-target", 0, "X,Y,Z", STAGING, "Camera", LSF_VALUE_VECTOR, AT(camera_target), -1e30,
     1e30, NULL, NULL, "turn the camera to that point, in scene units"},
    {"fov-y", 0, "DEG", STAGING, "Camera", LSF_VALUE_FLOAT, AT(fov_y), 0.01, 179, NULL, NULL,
     "vertical field of view in degrees; without it, the camera's own"},
    {"time", 0, "S", STAGING, "Camera", LSF_VALUE_DOUBLE, AT(time), -1e9, 1e9, NULL, "0",
     "the moment at which animations are sampled, in seconds; with --frames, that of frame 0"},

    {"frame", 0, "N", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_COUNT, AT(frame), 0, 999999999,
     NULL, "0",
     "the frame whose picture is written; those before it run as well where buffers keep something "
     "of them"},
    {"frames", 0, "A-B", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_FRAMES, AT(frames), 0,
     999999999, NULL, NULL,
     "write the frames from A to B, each to a picture of its own: %d in OUT, or %04d for leading "
     "zeros, is its number"},
    {"fps", 0, "X", LSF_COMMAND_SANDBOX, "Sequence", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "60", "frames a second: frame N has the time N / X, from --time on"},
    {"frames", 0, "A-B", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_FRAMES, AT(frames), 0, 999999999,
     NULL, NULL,
     "render the frames from A to B, each to a picture of its own: %d in OUT, or %04d for leading "
     "zeros, is its number. A frame depends on its number and the seed alone, so that several "
     "machines can share a sequence; --time-limit is that of each frame"},
    {"fps", 0, "X", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_DOUBLE, AT(fps), 1e-6, 1e6, NULL,
     "24", "frames a second, in the time of animations"},
    {"turntable", 0, "N", LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_COUNT, AT(turntable), 1,
     1000000, NULL, NULL,
     "carry the camera around the scene's centre, about the vertical axis, once in N frames; "
     "without "
     "--frames, these"},
    {"resume", 0, NULL, LSF_COMMAND_RENDER, "Sequence", LSF_VALUE_FLAG, AT(resume), 0, 0, NULL,
     NULL, "leave out frames whose picture is there already"},
    {"temporal", 0, NULL, LSF_COMMAND_RENDER | LSF_COMMAND_PLAN, "Sequence", LSF_VALUE_FLAG,
     AT(temporal), 0, 0, NULL, NULL,
     "keep light from frame to frame, so that few samples a frame look like many; each frame then "
     "depends on those before it: one machine renders all, from the first to the last"},

    {"light", 0, "X,Y,Z,R,G,B", SHOWING, "Scene", LSF_VALUE_LIGHT, AT(lights), -1e30, 1e30, NULL,
     NULL,
     "put a point light there, in scene units, with that intensity in W/sr, beside whatever lights "
     "the scene; repeatable"},
    {"edit", 0, "KIND/WHICH/VALUE=NUMBERS", SHOWING, "Scene", LSF_VALUE_TEXTS, AT(edits), 0, 0,
     NULL, NULL,
     "change a node, a light or a material of the scene, by name or by index from 0, or its "
     "environment: light/0/intensity=3,3,2.5, material/wall/base_color=0.8,0.2,0.2, "
     "environment/rotation=90, environment/strength=2 or node/lamp/matrix= and 16 numbers; also "
     "type (point, spot or directional), range, inner_cone, outer_cone, and metallic, roughness, "
     "emission, ior, "
     "transmission, coat, coat_roughness; repeatable"},
    {"view", 0, "FILE", SHOWING, "Scene", LSF_VALUE_TEXT, AT(view_file), 0, 0, NULL, NULL,
     "take scene, camera and options from a view that `lightsheaf view` has saved; those on the "
     "command line count more"},
    {"environment", 'e', "FILE|R,G,B", SCENES, "Scene", LSF_VALUE_ENVIRONMENT, AT(environment), 0,
     1e30, NULL, NULL,
     "light from outside: a latitude-longitude .hdr or .exr, or a uniform radiance in W/(m^2 sr)"},
    {"environment-rotation", 0, "DEG", SCENES, "Scene", LSF_VALUE_FLOAT, AT(environment_rotation),
     -36000, 36000, NULL, "0",
     "turn the environment about the vertical axis, in degrees, anticlockwise seen from above"},
    {"environment-strength", 0, "X", SCENES, "Scene", LSF_VALUE_FLOAT, AT(environment_strength), 0,
     1e20, NULL, "1", "multiply the environment's radiance by X"},
    {"default-light", 0, "WHEN", SCENES, "Scene", LSF_VALUE_CHOICE, AT(default_light),
     LSF_DEFAULT_LIGHT_AUTO, 0, "auto|always|never", "auto",
     "when a soft sky and a key light are added: auto is where the file has no light, its emissive "
     "materials do not light it, and there is no --environment"},
    {"diffuse-only", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(diffuse_only), 0, 0, NULL, NULL,
     "read every material as a diffuse one of its base colour, without normal maps"},
    {"show-back-faces", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(show_back_faces), 0, 0, NULL,
     NULL,
     "let the camera see the backs of single-sided materials, which glTF hides; light meets both "
     "sides in any case"},
    {"lenient", 0, NULL, SCENES, "Scene", LSF_VALUE_FLAG, AT(lenient), 0, 0, NULL, NULL,
     "ignore, with a warning each, extensions that the file requires and that change the look "
     "alone"},
    {"memory-limit", 0, "GIB", SCENES, "Scene", LSF_VALUE_DOUBLE, AT(memory_limit), 0.001, 1e6,
     NULL, "8", "refuse a scene whose loading takes more memory than this at any moment, in GiB"},
    {"scene", 0, "NAME|INDEX", SCENES, "Scene", LSF_VALUE_TEXT, AT(scene), 0, 0, NULL, NULL,
     "which of the file's scenes, by name or by index from 0; without it, the one that the file "
     "names, else the first"},
    {"animation", 0, "NAME|INDEX|none", SCENES, "Scene", LSF_VALUE_TEXTS, AT(animations), 0, 0,
     NULL, NULL,
     "play this animation of the file alone, or none; repeatable; without it all play, and of "
     "those that move the same node the first"},
    {"variant", 0, "NAME|INDEX", SCENES, "Scene", LSF_VALUE_TEXT, AT(variant), 0, 0, NULL, NULL,
     "dress the scene in one of the file's variants of materials (KHR_materials_variants); "
     "without it, in the file's own materials"},

    {"new", 0, "FILE", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_TEXT, AT(new_shader), 0, 0, NULL,
     NULL, "write a commented shader to begin with, and end; .comp is a compute shader"},
    {"uniform", 'u', "NAME=X", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_TEXTS, AT(uniforms), 0, 0,
     NULL, NULL,
     "set a uniform that the shader declares, of vectors with commas between numbers; repeatable"},
    {"channel", 0, "[BUFFER:]N=SOURCE", LSF_COMMAND_SANDBOX | LSF_COMMAND_PLAN, "Shader",
     LSF_VALUE_TEXTS, AT(channels), 0, 0, NULL, NULL,
     "what iChannelN is, as @channel in the shader says it, and in place of that; a:0=noise is "
     "that of buffer a; repeatable"},
    {"mouse", 0, "X,Y", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_RESOLUTION, AT(mouse), 1, 65535,
     NULL, NULL, "hold the mouse button there, in pixels from the lower left corner"},
    {"watchdog", 0, "S", LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_DOUBLE, AT(watchdog), 0, 1e6,
     NULL, "30", "seconds that a frame may take before its shader counts as hung; 0 is no limit"},
    {"sandbox", 0, "SHADER", LSF_COMMAND_PLAN, "Shader", LSF_VALUE_TEXT, AT(sandbox), 0, 0, NULL,
     NULL, "print what `lightsheaf sandbox SHADER` computes instead; without SCENE, of no scene"},
    {"list-names", 0, NULL, LSF_COMMAND_SANDBOX, "Shader", LSF_VALUE_FLAG, AT(list_names), 0, 0,
     NULL, NULL, "print the names that a shader may use, and what they are"},

    {"mask", 0, "FILE", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_TEXT, AT(mask), 0, 0, NULL,
     NULL, "leave out the pixels whose first channel is above 0.5"},
    {"threshold", 0, "METRIC=X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_THRESHOLD,
     AT(thresholds), 0, 0, "rmse|rmse_relative|relmse|bias|ssim|psnr|flip|flip_hdr", NULL,
     "end with status 5 when METRIC is worse than X; repeatable"},
    {"flip", 0, NULL, LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_FLAG, AT(flip), 0, 0, NULL, NULL,
     "measure FLIP and HDR-FLIP, too, which takes longer than all the rest"},
    {"difference", 0, "OUT", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_TEXT, AT(difference), 0,
     0, NULL, NULL, "write the absolute difference as a picture"},
    {"difference-gain", 0, "X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_FLOAT,
     AT(difference_gain), 1e-6, 1e6, NULL, "4", "the difference is multiplied by this"},
    {"epsilon", 0, "X", LSF_COMMAND_COMPARE, "Comparison", LSF_VALUE_DOUBLE, AT(epsilon), 0, 1e30,
     NULL, NULL, "added to the squared reference in relMSE; without it, 0.01 of its squared mean"},

    {"resolution", 'r', "W,H", LSF_COMMAND_VIEW, "Window", LSF_VALUE_RESOLUTION, AT(resolution), 64,
     16384, NULL, NULL, "width and height of the window; without it 1280,800"},
    {"full-screen", 0, NULL, LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_FLAG,
     AT(full_screen), 0, 0, NULL, NULL, "fill the screen"},
    {"budget", 0, "MS", LSF_COMMAND_VIEW, "Window", LSF_VALUE_DOUBLE, AT(budget), 1, 10000, NULL,
     NULL,
     "milliseconds that a frame may take while things move: pictures are as large, and maps as "
     "fine, as it allows; without it 100 in software, 34 on a GPU"},
    {"record", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(record), 0, 0, NULL, NULL, "write down what is done with mouse and keys, frame by frame"},
    {"replay", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(replay), 0, 0, NULL, NULL, "do what such a file says, then end"},
    {"frame-times", 0, "FILE", LSF_COMMAND_VIEW, "Window", LSF_VALUE_TEXT, AT(frame_times), 0, 0,
     NULL, NULL,
     "write as CSV how long each frame was shown, what it showed, and what the frame budget made "
     "of the picture"},
    {"coverage", 0, "FILE", LSF_COMMAND_VIEW | LSF_COMMAND_SANDBOX, "Window", LSF_VALUE_TEXT,
     AT(coverage), 0, 0, NULL, NULL,
     "write which keys, menus and parts of panels were used, and which were there and not used"},
    {"list-keys", 0, NULL, LSF_COMMAND_VIEW, "General", LSF_VALUE_FLAG, AT(list_keys), 0, 0, NULL,
     NULL, "print keys and buttons"},

    {"backend", 0, "NAME", DRAWING, "Device", LSF_VALUE_CHOICE, AT(backend), LSF_BACKEND_AUTO, 0,
     "auto|egl|osmesa", "auto",
     "where OpenGL comes from: auto is EGL on a GPU, else EGL in software, else OSMesa"},
    {"shader-dir", 0, "DIR", DRAWING | LSF_COMMAND_VIEW, "Device", LSF_VALUE_TEXT, AT(shader_dir),
     0, 0, NULL, NULL, "read the shaders from DIR instead of the built-in copy"},
    {"gl-debug", 0, NULL, DRAWING, "Device", LSF_VALUE_FLAG, AT(gl_debug), 0, 0, NULL, NULL,
     "make a debug context, log its messages, and stop at the first OpenGL error"},

    {"list-techniques", 0, NULL, SHOWING | LSF_COMMAND_MEASURE | LSF_COMMAND_SANDBOX, "General",
     LSF_VALUE_FLAG, AT(list_techniques), 0, 0, NULL, NULL, "print the techniques"},
    {"list-options", 0, NULL, STAGING, "General", LSF_VALUE_FLAG, AT(list_options), 0, 0, NULL,
     NULL, "print the options of all passes, for -D"},
    {"quiet", 'q', NULL, ANY, "General", LSF_VALUE_FLAG, AT(quiet), 0, 0, NULL, NULL,
     "say nothing but errors"},
    {"verbose", 'v', NULL, ANY, "General", LSF_VALUE_FLAG, AT(verbose), 0, 0, NULL, NULL,
     "say more: what is done, and the messages of OpenGL"},
    {"help", 'h', NULL, ANY, "General", LSF_VALUE_FLAG, AT(help), 0, 0, NULL, NULL,
     "print this and end"},
    {"version", 'V', NULL, ANY, "General", LSF_VALUE_FLAG, AT(version), 0, 0, NULL, NULL,
     "print the version and end"},
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
