#include "gl/context.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

#define FILES_MAX LSF_COUNT(((lsf_program_desc *)0)->files)

static GLenum stage_of(const char *path)
{
    static const struct {
        const char *ending;
        GLenum stage;
    } stages[] = {
        {".vert.glsl", GL_VERTEX_SHADER},          {".tesc.glsl", GL_TESS_CONTROL_SHADER},
        {".tese.glsl", GL_TESS_EVALUATION_SHADER}, {".geom.glsl", GL_GEOMETRY_SHADER},
        {".frag.glsl", GL_FRAGMENT_SHADER},        {".comp.glsl", GL_COMPUTE_SHADER},
    };
    size_t length = strlen(path);
    for (size_t i = 0; i < LSF_COUNT(stages); i++) {
        size_t ending = strlen(stages[i].ending);
        if (length > ending && !strcmp(path + length - ending, stages[i].ending))
            return stages[i].stage;
    }
    return 0;
}

/* The stages of a program that is being made. */
typedef struct build {
    const lsf_program_desc *desc;
    uint32_t count;
    GLenum stages[FILES_MAX];
    lsf_shader_source sources[FILES_MAX];
    GLuint shaders[FILES_MAX];
    bool foreign; /* the text is a user's, who can mend its errors and knows of no program */
} build;

static bool read_sources(const lsf_context *context, build *b, lsf_error *error)
{
    const lsf_program_desc *desc = b->desc;
    for (uint32_t i = 0; i < FILES_MAX && desc->files[i]; i++) {
        b->stages[i] = stage_of(desc->files[i]);
        if (!b->stages[i])
            return lsf_error_set(error, LSF_ERROR_RENDER,
                                 "%s: the name must end in .vert.glsl, .tesc.glsl, .tese.glsl, "
                                 ".geom.glsl, .frag.glsl or .comp.glsl",
                                 desc->files[i]);
        if (!lsf_shader_source_build(context->shader_dir, desc->files[i], desc->defines,
                                     desc->define_count, &b->sources[i], error))
            return false;
        b->count++;
    }
    return b->count > 0 || lsf_error_set(error, LSF_ERROR_RENDER, "program %s names no shader",
                                         desc->label ? desc->label : "without a label");
}

static uint64_t hash_sources(const build *b)
{
    uint64_t key = 0;
    for (uint32_t i = 0; i < b->count; i++)
        key = XXH3_64bits_withSeed(b->sources[i].text.text, b->sources[i].text.length,
                                   key ^ b->stages[i]);
    return key;
}

/* The message holds as much of the log as fits; a longer log goes to the logger, line by line. */
static bool report(const build *b, const char *what, const lsf_string *log, lsf_error *error)
{
    const char *label = b->desc->label ? b->desc->label : "without a label";
    const char *text = log->text ? log->text : "the driver gives no reason";
    size_t length = strlen(text);
    while (length && text[length - 1] == '\n')
        length--;
    const size_t limit = LSF_ERROR_MESSAGE_SIZE - 256;
    if (length > limit) {
        for (const char *line = text; *line;) {
            size_t line_length = strcspn(line, "\n");
            lsf_log(LSF_LOG_ERROR, "%.*s", (int)line_length, line);
            line += line_length + (line[line_length] == '\n');
        }
    }
    int shown = (int)(length > limit ? limit : length);
    const char *rest = length > limit ? "\n... (the whole text is in the log)" : "";
    if (b->foreign && strcmp(what, "compile") == 0)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%.*s%s", shown, text, rest);
    return lsf_error_set(error, LSF_ERROR_RENDER, "%s%.128s did not %s:\n%.*s%s",
                         b->foreign ? "" : "program ", label, what, shown, text, rest);
}

static char *shader_log(GLuint shader)
{
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    char *log = lsf_alloc((uint64_t)(length > 0 ? length : 0) + 1, 1);
    if (log && length > 0)
        glGetShaderInfoLog(shader, length, NULL, log);
    return log;
}

static char *program_log(GLuint program)
{
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    char *log = lsf_alloc((uint64_t)(length > 0 ? length : 0) + 1, 1);
    if (log && length > 0)
        glGetProgramInfoLog(program, length, NULL, log);
    return log;
}

/* All stages are handed over before the first result is asked for: a driver that compiles on
 * threads works on them at once. All their errors are shown together. */
static bool compile(build *b, lsf_error *error)
{
    for (uint32_t i = 0; i < b->count; i++) {
        const GLchar *text = b->sources[i].text.text;
        const GLint length = (GLint)b->sources[i].text.length;
        b->shaders[i] = glCreateShader(b->stages[i]);
        glShaderSource(b->shaders[i], 1, &text, &length);
        glCompileShader(b->shaders[i]);
        lsf_debug_label(GL_SHADER, b->shaders[i],
                        b->desc->files[i] ? b->desc->files[i] : b->desc->label);
    }
    lsf_string mapped = {0};
    bool compiled = true;
    for (uint32_t i = 0; i < b->count; i++) {
        GLint status = GL_FALSE;
        glGetShaderiv(b->shaders[i], GL_COMPILE_STATUS, &status);
        compiled = compiled && status;
        char *log = shader_log(b->shaders[i]);
        if (log)
            lsf_shader_source_map_log(&b->sources[i], log, &mapped);
        free(log);
    }
    if (!compiled)
        report(b, "compile", &mapped, error);
    else if (mapped.length)
        lsf_log(LSF_LOG_DEBUG, "program %s:\n%s", b->desc->label ? b->desc->label : "",
                mapped.text);
    free(mapped.text);
    return compiled;
}

/* Finds a line of the log by the place that it names, else by the name that it quotes. */
static void map_foreign_link_line(const lsf_shader_source *source, const char *line,
                                  lsf_string *mapped)
{
    lsf_string placed = {0};
    size_t length = strlen(line);
    lsf_shader_source_map_log(source, line, &placed);
    bool unplaced = placed.text && strncmp(placed.text, line, length) == 0;
    if (unplaced)
        lsf_shader_source_map_name(source, line, mapped);
    else if (placed.text)
        lsf_string_add_bytes(mapped, placed.text, placed.length);
    free(placed.text);
}

/* A linker's log names no stage in its places; NVIDIA's heads each part with "Fragment info". */
static void map_link_log(const build *b, const char *log, lsf_string *mapped)
{
    static const struct {
        const char *heading;
        GLenum stage;
    } headings[] = {
        {"Vertex info", GL_VERTEX_SHADER},
        {"Tessellation control info", GL_TESS_CONTROL_SHADER},
        {"Tessellation evaluation info", GL_TESS_EVALUATION_SHADER},
        {"Geometry info", GL_GEOMETRY_SHADER},
        {"Fragment info", GL_FRAGMENT_SHADER},
        {"Compute info", GL_COMPUTE_SHADER},
    };
    static const lsf_shader_source unknown = {0}; /* maps nothing */
    const lsf_shader_source *source = b->count == 1 ? &b->sources[0] : &unknown;
    for (const char *line = log; *line;) {
        size_t length = strcspn(line, "\n");
        for (size_t h = 0; h < LSF_COUNT(headings); h++) {
            if (strncmp(line, headings[h].heading, strlen(headings[h].heading)))
                continue;
            for (uint32_t i = 0; i < b->count; i++)
                if (b->stages[i] == headings[h].stage)
                    source = &b->sources[i];
        }
        char *text = strndup(line, length);
        if (text && b->foreign)
            map_foreign_link_line(&b->sources[b->count - 1], text, mapped);
        else if (text)
            lsf_shader_source_map_log(source, text, mapped);
        free(text);
        line += length + (line[length] == '\n');
    }
}

static GLuint link_stages(const build *b, lsf_error *error)
{
    GLuint program = glCreateProgram();
    for (uint32_t i = 0; i < b->count; i++)
        glAttachShader(program, b->shaders[i]);
    glLinkProgram(program);
    for (uint32_t i = 0; i < b->count; i++)
        glDetachShader(program, b->shaders[i]);
    GLint status = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &status);
    if (!status) {
        char *log = program_log(program);
        lsf_string mapped = {0};
        if (log)
            map_link_log(b, log, &mapped);
        report(b, "link", &mapped, error);
        free(mapped.text);
        free(log);
        glDeleteProgram(program);
        return 0;
    }
    lsf_debug_label(GL_PROGRAM, program, b->desc->label);
    return program;
}

static GLuint find_cached(const lsf_context *context, uint64_t key)
{
    for (uint64_t i = 0; i < context->program_count; i++)
        if (context->programs[i].key == key)
            return context->programs[i].program;
    return 0;
}

static bool cache(lsf_context *context, uint64_t key, GLuint program, lsf_error *error)
{
    void *programs = context->programs;
    if (!lsf_grow(&programs, &context->program_capacity, context->program_count + 1,
                  sizeof(lsf_cached_program)))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while making a program");
    context->programs = programs;
    context->programs[context->program_count++] = (lsf_cached_program){key, program};
    return true;
}

static GLuint make_program(lsf_context *context, build *b, uint64_t key, lsf_error *error)
{
    const char *label = b->desc->label ? b->desc->label : "without a label";
    char what[256];
    snprintf(what, sizeof what, "program %s", label);
    if (!lsf_memory_begin(context, what, error))
        return 0;
    double start = lsf_now();
    GLuint program = compile(b, error) ? link_stages(b, error) : 0;
    bool made = lsf_memory_end(context, GL_PROGRAM, program, 0, what, program ? error : NULL);
    if (program && (!made || (!b->foreign && !cache(context, key, program, error)))) {
        glDeleteProgram(program);
        return 0;
    }
    if (program)
        lsf_log(LSF_LOG_DEBUG, "%s: compiled in %.1f ms", what, (lsf_now() - start) * 1e3);
    return program;
}

static void finish(build *b)
{
    for (uint32_t i = 0; i < b->count; i++) {
        glDeleteShader(b->shaders[i]); /* 0 is ignored */
        lsf_shader_source_free(&b->sources[i]);
    }
}

GLuint lsf_program_get(lsf_context *context, const lsf_program_desc *desc, lsf_error *error)
{
    build b = {.desc = desc};
    GLuint program = 0;
    if (read_sources(context, &b, error)) {
        uint64_t key = hash_sources(&b);
        program = find_cached(context, key);
        if (!program)
            program = make_program(context, &b, key, error);
    }
    finish(&b);
    return program;
}

GLuint lsf_program_build(lsf_context *context, const char *label, GLenum stage,
                         const lsf_define *defines, uint32_t define_count,
                         const lsf_shader_part *parts, uint32_t part_count, lsf_error *error)
{
    bool drawn = stage == GL_FRAGMENT_SHADER;
    const lsf_program_desc desc = {.label = label, .files = {"lib/fullscreen.vert.glsl"}};
    build b = {.desc = &desc, .stages = {GL_VERTEX_SHADER}, .foreign = true};
    GLuint program = 0;
    if (drawn && !lsf_shader_source_build(context->shader_dir, desc.files[0], NULL, 0,
                                          &b.sources[b.count++], error))
        return 0;
    b.stages[b.count] = stage;
    if (lsf_shader_source_build_parts(context->shader_dir, defines, define_count, parts, part_count,
                                      &b.sources[b.count], error)) {
        b.count++;
        program = make_program(context, &b, 0, error);
    }
    finish(&b);
    return program;
}

void lsf_program_destroy(GLuint *program)
{
    glDeleteProgram(*program); /* 0 is ignored */
    *program = 0;
}
