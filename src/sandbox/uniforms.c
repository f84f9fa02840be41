/* Uniforms that a sandbox's shader declares itself. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "sandbox/sandbox.h"

typedef enum number_kind { FLOATS, INTS, UINTS } number_kind;

typedef struct own_uniform {
    GLuint program;
    GLint location;
    uint32_t components;
    number_kind kind;
} own_uniform;

static bool number_of(GLenum type, own_uniform *uniform)
{
    static const struct {
        GLenum type;
        number_kind kind;
        uint32_t components;
    } types[] = {{GL_FLOAT, FLOATS, 1},
                 {GL_FLOAT_VEC2, FLOATS, 2},
                 {GL_FLOAT_VEC3, FLOATS, 3},
                 {GL_FLOAT_VEC4, FLOATS, 4},
                 {GL_INT, INTS, 1},
                 {GL_INT_VEC2, INTS, 2},
                 {GL_INT_VEC3, INTS, 3},
                 {GL_INT_VEC4, INTS, 4},
                 {GL_BOOL, INTS, 1},
                 {GL_UNSIGNED_INT, UINTS, 1},
                 {GL_UNSIGNED_INT_VEC2, UINTS, 2},
                 {GL_UNSIGNED_INT_VEC3, UINTS, 3},
                 {GL_UNSIGNED_INT_VEC4, UINTS, 4}};
    for (size_t i = 0; i < LSF_COUNT(types); i++)
        if (types[i].type == type) {
            uniform->kind = types[i].kind;
            uniform->components = types[i].components;
            return true;
        }
    return false;
}

/* In the program of one pass; false where that has no such uniform, or not one of numbers. */
static bool find(const lsf_sandbox *sandbox, uint32_t pass, const char *name, own_uniform *uniform)
{
    GLuint program = sandbox->version.passes[pass].program, index = GL_INVALID_INDEX;
    const GLchar *const names[] = {name};
    GLint type = 0;
    if (!program)
        return false;
    glGetUniformIndices(program, 1, names, &index);
    if (index == GL_INVALID_INDEX)
        return false;
    glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_TYPE, &type);
    uniform->program = program;
    uniform->location = glGetUniformLocation(program, name);
    return uniform->location >= 0 && number_of((GLenum)type, uniform);
}

static bool find_first(const lsf_sandbox *sandbox, const char *name, own_uniform *uniform)
{
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (find(sandbox, p, name, uniform))
            return true;
    return false;
}

static void set(const own_uniform *u, const float value[4])
{
    GLint whole[4];
    for (int i = 0; i < 4; i++)
        whole[i] = (GLint)lroundf(fminf(fmaxf(value[i], -0x1p31f), 0x1.fffffep30f));
    const GLuint unsigned_[4] = {(GLuint)whole[0], (GLuint)whole[1], (GLuint)whole[2],
                                 (GLuint)whole[3]};
    switch (u->components) {
    case 1:
        u->kind == FLOATS ? glProgramUniform1fv(u->program, u->location, 1, value)
        : u->kind == INTS ? glProgramUniform1iv(u->program, u->location, 1, whole)
                          : glProgramUniform1uiv(u->program, u->location, 1, unsigned_);
        break;
    case 2:
        u->kind == FLOATS ? glProgramUniform2fv(u->program, u->location, 1, value)
        : u->kind == INTS ? glProgramUniform2iv(u->program, u->location, 1, whole)
                          : glProgramUniform2uiv(u->program, u->location, 1, unsigned_);
        break;
    case 3:
        u->kind == FLOATS ? glProgramUniform3fv(u->program, u->location, 1, value)
        : u->kind == INTS ? glProgramUniform3iv(u->program, u->location, 1, whole)
                          : glProgramUniform3uiv(u->program, u->location, 1, unsigned_);
        break;
    default:
        u->kind == FLOATS ? glProgramUniform4fv(u->program, u->location, 1, value)
        : u->kind == INTS ? glProgramUniform4iv(u->program, u->location, 1, whole)
                          : glProgramUniform4uiv(u->program, u->location, 1, unsigned_);
    }
}

static void get(const own_uniform *u, float value[4])
{
    GLint whole[4] = {0};
    if (u->kind == FLOATS) {
        glGetUniformfv(u->program, u->location, value);
        return;
    }
    glGetUniformiv(u->program, u->location, whole);
    for (int i = 0; i < 4; i++)
        value[i] = (float)whole[i];
}

static void apply(const lsf_sandbox *sandbox, const lsf_sandbox_value *value)
{
    own_uniform uniform;
    for (uint32_t p = 0; p < LSF_SANDBOX_PASSES; p++)
        if (find(sandbox, p, value->name, &uniform))
            set(&uniform, value->value);
}

void lsf_sandbox_apply_values(const lsf_sandbox *sandbox)
{
    for (uint64_t i = 0; i < sandbox->value_count; i++)
        apply(sandbox, &sandbox->values[i]);
}

static bool keep(lsf_sandbox *sandbox, const char *name, const float value[4], lsf_error *error)
{
    lsf_sandbox_value *kept = NULL;
    for (uint64_t i = 0; i < sandbox->value_count; i++)
        if (strcmp(sandbox->values[i].name, name) == 0)
            kept = &sandbox->values[i];
    if (!kept) {
        void *values = sandbox->values;
        char *copy = strdup(name);
        if (!copy || !lsf_grow(&values, &sandbox->value_capacity, sandbox->value_count + 1,
                               sizeof *sandbox->values)) {
            free(copy);
            return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        }
        sandbox->values = values;
        kept = &sandbox->values[sandbox->value_count++];
        kept->name = copy;
    }
    memcpy(kept->value, value, sizeof kept->value);
    apply(sandbox, kept);
    return true;
}

static bool none_of_that_name(const lsf_sandbox *sandbox, const char *name, lsf_error *error)
{
    const lsf_sandbox_text *text = &sandbox->version.text;
    lsf_string names = {0};
    for (uint64_t i = 0; i < text->uniform_count; i++)
        lsf_string_add(&names, "%s%s", i ? ", " : "", text->uniforms[i].name);
    lsf_error_set(error, LSF_ERROR_USAGE, "uniform %s: the shader has %s%s", name,
                  names.text ? "" : "none of its own", names.text ? names.text : "");
    free(names.text);
    return false;
}

bool lsf_sandbox_set_uniform(lsf_sandbox *sandbox, const char *name, const float value[4],
                             lsf_error *error)
{
    if (!lsf_given(sandbox, "sandbox", error) || !lsf_given(name, "name", error) ||
        !lsf_given(value, "value", error))
        return false;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, error);
    own_uniform uniform;
    if (!entered)
        return false;
    if (!find_first(sandbox, name, &uniform))
        return none_of_that_name(sandbox, name, error);
    return keep(sandbox, name, value, error);
}

bool lsf_sandbox_assign(lsf_sandbox *sandbox, const char *assignment, lsf_error *error)
{
    float value[4] = {0};
    size_t length = strcspn(assignment, "=");
    char *name = strndup(assignment, length);
    const char *at = assignment[length] ? assignment + length + 1 : "";
    uint32_t count = 0;
    own_uniform uniform;
    bool good = name || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    for (bool more = good; more && count < 4; at++) {
        char *end;
        value[count] = (float)lsf_read_number(at, &end);
        more = end != at && *end == ',';
        count += end != at && isfinite(value[count]);
        at = end;
        if (!more)
            break;
    }
    if (good && !find_first(sandbox, name, &uniform)) {
        /* It may have been left out of the program for want of use. */
        bool declared = false;
        for (uint64_t i = 0; i < sandbox->version.text.uniform_count; i++)
            declared |= strcmp(sandbox->version.text.uniforms[i].name, name) == 0;
        good = declared || none_of_that_name(sandbox, name, error);
        uniform.components = count;
    }
    if (good && (*at != '\0' || count != uniform.components || count == 0))
        good = lsf_error_set(error, LSF_ERROR_USAGE,
                             "uniform %s: expected %u number%s, such as "
                             "%s=0.5%s",
                             assignment, uniform.components, lsf_plural(uniform.components), name,
                             uniform.components > 1 ? ",0.5" : "");
    good = good && keep(sandbox, name, value, error);
    free(name);
    return good;
}

bool lsf_sandbox_get_uniform(const lsf_sandbox *sandbox, uint32_t index,
                             lsf_sandbox_uniform *uniform)
{
    if (!sandbox || !uniform)
        return false;
    const lsf_sandbox_text *text = &sandbox->version.text;
    LSF_LEAVE lsf_context *entered = lsf_context_enter(sandbox->context, NULL);
    for (uint64_t i = 0; entered && i < text->uniform_count; i++) {
        const lsf_sandbox_own *own = &text->uniforms[i];
        own_uniform found;
        if (!find_first(sandbox, own->name, &found) || index-- > 0)
            continue;
        *uniform = (lsf_sandbox_uniform){.name = own->name,
                                         .components = found.components,
                                         .integer = found.kind != FLOATS,
                                         .slider = own->slider,
                                         .minimum = own->minimum,
                                         .maximum = own->maximum};
        get(&found, uniform->value);
        return true;
    }
    return false;
}
