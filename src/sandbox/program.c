/* The programs of a sandbox's passes: the text that is put before and behind a shader's own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sandbox/version.h"
#include "shared/sandbox_data.h"

#define MOST_PARTS 24

/* One line, so that it can stand for the last one of what it calls. */
static const char main_image[] =
    "layout(location = 0) out vec4 lsf_fragment; void main() { vec4 color = vec4(0.0, 0.0, 0.0, "
    "1.0); mainImage(color, gl_FragCoord.xy); lsf_fragment = color; }\n";

static int channel_of(const char *name)
{
    bool is = strncmp(name, "iChannel", 8) == 0 && name[8] >= '0' && name[8] <= '3' && !name[9];
    return is ? name[8] - '0' : -1;
}

/* Declares what the pass names and does not declare itself. */
static void add_declarations(lsf_string *text, const lsf_sandbox_pass_text *pass,
                             const lsf_sandbox_channel *channels)
{
    for (uint32_t i = 0; lsf_sandbox_row_at(i); i++) {
        const lsf_sandbox_row *row = lsf_sandbox_row_at(i);
        int channel = channel_of(row->name);
        if (pass->mentions[i] && row->kind == LSF_SANDBOX_OLDER)
            lsf_string_add(text, "#define %s\n", row->use);
        if (row->kind != LSF_SANDBOX_UNIFORM || !pass->mentions[i] || pass->declares[i])
            continue;
        if (strcmp(row->name, "iOutput") == 0)
            lsf_string_add(text, "layout(rgba32f, binding = 0) uniform %s;\n", row->use);
        else if (channel >= 0 && channels[channel].source == LSF_SOURCE_CUBE)
            lsf_string_add(text, "uniform samplerCube %s;\n", row->name);
        else
            lsf_string_add(text, "uniform %s;\n", row->use);
    }
}

/* Those of the engine's files that declare what the pass names. */
static uint32_t add_engine(lsf_shader_part *parts, uint32_t needs)
{
    uint32_t count = 0;
    for (uint32_t bit = 1; bit <= needs; bit <<= 1) {
        const char *file = lsf_sandbox_need_file((lsf_sandbox_need)bit);
        if ((needs & bit) && file)
            parts[count++] = (lsf_shader_part){.path = file};
    }
    return count;
}

static uint32_t last_line(const lsf_shader_part *part)
{
    uint32_t line = part->line;
    for (const char *at = part->text; at[0] && at[1]; at++)
        line += *at == '\n';
    return line;
}

static GLuint build(lsf_context *context, const lsf_sandbox_text *text, uint32_t index,
                    const lsf_sandbox_channel *channels, const lsf_plan *plan, lsf_error *error)
{
    const lsf_sandbox_pass_text *pass = &text->passes[index];
    const lsf_plan_pass *planned = lsf_plan_find_pass(plan, LSF_SANDBOX_PASS);
    lsf_define defines[LSF_PLAN_MAX_SWITCHES];
    lsf_shader_part parts[MOST_PARTS];
    lsf_string declarations = {0};
    uint32_t count = 1;
    for (uint32_t i = 0; i < planned->switch_count; i++)
        defines[i] = planned->switches[i].define;
    add_declarations(&declarations, pass, channels);
    parts[0] =
        (lsf_shader_part){.path = "sandbox", .text = declarations.text ? declarations.text : ""};
    count += add_engine(parts + count, pass->needs);
    if (text->common.text)
        parts[count++] = text->common;
    parts[count++] = pass->part;
    if (pass->main_image && !pass->main)
        parts[count++] = (lsf_shader_part){
            .path = pass->part.path, .text = main_image, .line = last_line(&pass->part)};
    GLuint program = 0;
    if (declarations.failed)
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for a shader");
    else
        program = lsf_program_build(context, pass->part.path,
                                    pass->compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, defines,
                                    planned->switch_count, parts, count, error);
    free(declarations.text);
    return program;
}

/* What glGetActiveUniform has to say of a uniform that is declared as in the table. */
static GLenum type_of(const char *use)
{
    static const struct {
        const char *word;
        GLenum type;
    } types[] = {
        {"vec3 ", GL_FLOAT_VEC3}, {"vec4 ", GL_FLOAT_VEC4}, {"float ", GL_FLOAT}, {"int ", GL_INT}};
    for (size_t i = 0; i < LSF_COUNT(types); i++)
        if (strncmp(use, types[i].word, strlen(types[i].word)) == 0)
            return types[i].type;
    return GL_NONE; /* samplers and images differ by what is bound */
}

static bool check_type(const lsf_sandbox_pass_text *pass, GLuint program, uint32_t row,
                       lsf_error *error)
{
    const lsf_sandbox_row *name = lsf_sandbox_row_at(row);
    const GLchar *const names[] = {name->name};
    GLenum wanted = type_of(name->use);
    GLuint index = GL_INVALID_INDEX;
    GLint type = 0;
    glGetUniformIndices(program, 1, names, &index);
    if (wanted == GL_NONE || index == GL_INVALID_INDEX)
        return true;
    glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_TYPE, &type);
    return (GLenum)type == wanted ||
           lsf_error_set(error, LSF_ERROR_RENDER, "%s:%u: declare uniform %s;",
                         pass->locations[row].path, pass->locations[row].line, name->use);
}

bool lsf_sandbox_pass_build(lsf_sandbox_pass *pass, lsf_context *context,
                            const lsf_sandbox_text *text, uint32_t index, const lsf_plan *plan,
                            lsf_error *error)
{
    const lsf_sandbox_pass_text *read = &text->passes[index];
    pass->program = build(context, text, index, pass->channels, plan, error);
    if (!pass->program)
        return false;
    for (uint32_t i = 0; lsf_sandbox_row_at(i); i++) {
        const lsf_sandbox_row *row = lsf_sandbox_row_at(i);
        pass->locations[i] = -1;
        if (row->kind != LSF_SANDBOX_UNIFORM || !read->mentions[i])
            continue;
        if (!check_type(read, pass->program, i, error))
            return false;
        pass->locations[i] = glGetUniformLocation(pass->program, row->name);
        int channel = channel_of(row->name);
        if (channel >= 0 && pass->locations[i] >= 0)
            glProgramUniform1i(pass->program, pass->locations[i], LSF_UNIT_CHANNEL + channel);
    }
    if (read->compute)
        glGetProgramiv(pass->program, GL_COMPUTE_WORK_GROUP_SIZE, pass->groups);
    return true;
}
