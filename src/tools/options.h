/* The command's options: one table, from which parsing, --help, the man page, the shell
 * completions and docs/command.md are made. */
#ifndef LSF_TOOLS_OPTIONS_H
#define LSF_TOOLS_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "base/base.h"
#include <lightsheaf/lightsheaf.h>

typedef enum lsf_command_bit {
    LSF_COMMAND_RENDER = 1 << 0,
    LSF_COMMAND_REFERENCE = 1 << 1,
    LSF_COMMAND_COMPARE = 1 << 2,
    LSF_COMMAND_INFO = 1 << 3,
    LSF_COMMAND_PLAN = 1 << 4,
    LSF_COMMAND_HELP = 1 << 5,
    LSF_COMMAND_BENCH = 1 << 6,
    LSF_COMMAND_MEASURE = 1 << 7,
    LSF_COMMAND_SANDBOX = 1 << 8,
    LSF_COMMAND_VIEW = 1 << 9,
} lsf_command_bit;

typedef struct lsf_command {
    lsf_command_bit bit;
    const char *name;
    const char *operands; /* "[SCENE]" */
    uint32_t operands_min, operands_max;
    const char *summary; /* one line */
    const char *text;    /* a paragraph */
} lsf_command;

/* NULL past the end. */
const lsf_command *lsf_command_at(size_t index);
const lsf_command *lsf_command_find(lsf_command_bit bit);

/* How an option's text becomes a value, and what is stored at its offset in lsf_settings. */
typedef enum lsf_value_type {
    LSF_VALUE_FLAG,        /* bool; takes no argument */
    LSF_VALUE_COUNT,       /* uint32_t in minimum..maximum */
    LSF_VALUE_SEED,        /* uint64_t */
    LSF_VALUE_DOUBLE,      /* double in minimum..maximum */
    LSF_VALUE_FLOAT,       /* float in minimum..maximum */
    LSF_VALUE_VECTOR,      /* lsf_vector_setting, each in minimum..maximum */
    LSF_VALUE_FRAMES,      /* lsf_frames_setting, each in minimum..maximum */
    LSF_VALUE_RESOLUTION,  /* uint32_t[2], each in minimum..maximum */
    LSF_VALUE_TEXT,        /* const char *, not empty */
    LSF_VALUE_TEXTS,       /* lsf_list_setting of texts, not empty */
    LSF_VALUE_JSON,        /* const char *, a path that is not a picture's or a scene's */
    LSF_VALUE_CHOICE,      /* int: minimum + index in `choices` */
    LSF_VALUE_TECHNIQUE,   /* const char *, registered */
    LSF_VALUE_TECHNIQUES,  /* lsf_list_setting of registered names */
    LSF_VALUE_AOVS,        /* uint32_t, lsf_aov bits */
    LSF_VALUE_DEFINE,      /* lsf_list_setting of "pass.key=value", the key known */
    LSF_VALUE_SWEEP,       /* the same of "pass.key=value,value" */
    LSF_VALUE_ENVIRONMENT, /* lsf_environment_setting */
    LSF_VALUE_EXPOSURE,    /* lsf_exposure_setting */
    LSF_VALUE_BACKGROUND,  /* lsf_background_setting */
    LSF_VALUE_PRESET,      /* int: which of the choices, or LSF_PRESET_FILE */
    LSF_VALUE_THRESHOLD,   /* lsf_list_setting of "metric=x" */
    LSF_VALUE_LIGHT,       /* lsf_lights_setting */
} lsf_value_type;

typedef struct lsf_command_option {
    const char *name;     /* long name without dashes */
    char letter;          /* 0: none */
    const char *argument; /* what --help calls its value; NULL for flags */
    unsigned commands;    /* lsf_command_bit of the commands that take it */
    const char *group;    /* heading in --help; rows of a group follow each other */
    lsf_value_type type;
    size_t offset; /* in lsf_settings */
    double minimum, maximum;
    const char *choices; /* "auto|egl|osmesa"; words of a list, or metrics, just as well */
    const char *initial; /* the default as one would type it; NULL: none */
    const char *help;    /* effect, unit */
} lsf_command_option;

/* NULL past the end. */
const lsf_command_option *lsf_command_option_at(size_t index);

/* Its choices with that between two of them. */
void lsf_command_option_add_choices(lsf_string *text, const lsf_command_option *option,
                                    const char *separator);

/* What an option accepts, in words, for messages: "a whole number in 1..65535". */
char *lsf_command_option_range(const lsf_command_option *option); /* malloc'ed */

/* --- values --- */

typedef struct lsf_vector_setting {
    bool given;
    float value[3];
} lsf_vector_setting;

typedef struct lsf_frames_setting {
    bool given;
    uint32_t first, last;
} lsf_frames_setting;

typedef struct lsf_list_setting {
    const char **items; /* point into argv */
    uint32_t count;
    uint64_t capacity;
} lsf_list_setting;

typedef struct lsf_environment_setting {
    const char *path;           /* NULL: none, or uniform */
    lsf_vector_setting uniform; /* radiance */
} lsf_environment_setting;

typedef struct lsf_exposure_setting {
    bool automatic;
    float ev;
} lsf_exposure_setting;

typedef struct lsf_background_setting {
    lsf_background kind;
    float radiance[3];
} lsf_background_setting;

typedef struct lsf_lights_setting {
    lsf_placed_light *items;
    uint32_t count;
    uint64_t capacity;
} lsf_lights_setting;

typedef struct lsf_settings {
    const lsf_command *command;
    lsf_list_setting operands;

    bool help, version, list_options, list_techniques, quiet, verbose;
    const char *json_path; /* "-": standard output; NULL: none */

    const char *output; /* NULL: not given */
    int format;         /* lsf_image_format */
    lsf_exposure_setting exposure;
    int tonemap; /* lsf_tone_curve */
    bool halves;

    const char *technique;
    uint32_t resolution[2];
    uint32_t samples;  /* 0: not given */
    double time_limit; /* seconds; infinity: none */
    uint32_t bounces;
    bool raw;
    bool temporal;
    uint64_t seed;
    uint32_t aovs;
    lsf_list_setting defines;
    lsf_background_setting background;

    const char *camera;
    lsf_vector_setting camera_position, camera_target; /* scene units */
    float fov_y;                                       /* degrees; NAN: the camera's own */
    double time;                                       /* seconds */

    lsf_frames_setting frames;
    double fps;
    uint32_t turntable; /* frames of a turn; 0: none */
    bool resume;

    lsf_environment_setting environment;
    float environment_rotation, environment_strength;
    int default_light; /* lsf_default_light */
    bool diffuse_only, show_back_faces, lenient;
    double memory_limit;         /* GiB */
    const char *scene, *variant; /* NULL: not given */
    lsf_list_setting animations, edits;
    lsf_lights_setting lights;

    int backend; /* lsf_backend */
    const char *shader_dir;
    bool gl_debug;

    const char *new_shader; /* NULL: not given */
    const char *sandbox;    /* shader that a plan is wanted of; NULL: none */
    uint32_t frame;
    lsf_list_setting channels, uniforms;
    uint32_t mouse[2]; /* pixels from the lower left corner; 0,0: not given */
    double watchdog;   /* seconds */
    bool list_names;

    const char *mask, *difference;
    float difference_gain;
    double epsilon; /* NAN: relative to the reference's mean */
    bool flip;
    bool dot, prices;
    lsf_list_setting thresholds;

    lsf_list_setting techniques, sweeps;
    uint32_t seeds;                                            /* 0: not given */
    uint32_t reference_samples;                                /* of each half; 0: not given */
    const char *csv_path, *html_path, *picture_folder, *cache; /* NULL: not given */

    int measure_preset;                /* which of quick and full, or LSF_PRESET_FILE */
    int clock;                         /* 0: what suits the device, 1: the processor's */
    double budget_ms, error;           /* NAN: not asked for */
    const char *preset, *saved_preset; /* NULL: not given */

    char *preset_text;                                    /* values point into it */
    const char *record, *replay, *frame_times, *coverage; /* NULL: not given */
    double budget;                                        /* milliseconds; 0: by the device */
    bool full_screen, list_keys;

    const char *view_file;  /* NULL: not given */
    const char *view_scene; /* that it names; NULL: none */
    char *view_text;        /* values point into it */

    lsf_string typed;  /* the options that shape a picture, as one would type them */
    lsf_string shared; /* those of them that render takes */
    uint64_t given[2]; /* bit i of word i / 64: row i of the table was on the command line
                        * or in a preset */
} lsf_settings;

/* Defaults, then the command line; argv[0] is the command's name. `settings` needs no
 * initialisation and is to be finished either way. LSF_ERROR_USAGE names option, value and range.
 */
bool lsf_settings_parse(lsf_settings *settings, lsf_command_bit command, int argc, char **argv,
                        lsf_error *error);
void lsf_settings_finish(lsf_settings *settings);

/* Keeps in mind that the option was given, with that value, for what is said of the picture. */
void lsf_settings_note(lsf_settings *settings, const lsf_command_option *option, const char *value);

/* Whether the option of that long name was on the command line. */
bool lsf_settings_given(const lsf_settings *settings, const char *name);

/* Whether JSON goes to standard output, where text would go else. */
bool lsf_settings_print_json(const lsf_settings *settings);

/* What the library's calls take; the results borrow from `settings`. */
lsf_render_params lsf_settings_render_params(const lsf_settings *settings);
lsf_scene_params lsf_settings_scene_params(const lsf_settings *settings);
lsf_context_params lsf_settings_context_params(const lsf_settings *settings);

#endif
