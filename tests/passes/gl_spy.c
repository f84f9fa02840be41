#include "gl_spy.h"

enum { UNITS = 64, TEXTURES = 1 << 14 };

static GLuint textures[UNITS], images[UNITS];
static GLuint buffer_of_texture[TEXTURES]; /* of buffer textures */
static gl_spy_use uses[GL_SPY_USES];
static size_t use_count;
static void (*tell)(const gl_spy_command *command);

static PFNGLBINDTEXTUREUNITPROC bind_texture_unit;
static PFNGLBINDIMAGETEXTUREPROC bind_image;
static PFNGLTEXTUREBUFFERPROC texture_buffer;
static PFNGLDELETETEXTURESPROC delete_textures;
static PFNGLDISPATCHCOMPUTEPROC dispatch;
static PFNGLDISPATCHCOMPUTEINDIRECTPROC dispatch_indirect;
static PFNGLDRAWARRAYSPROC draw_arrays;
static PFNGLDRAWARRAYSINDIRECTPROC draw_arrays_indirect;
static PFNGLDRAWELEMENTSINDIRECTPROC draw_elements_indirect;
static PFNGLDRAWELEMENTSINSTANCEDBASEINSTANCEPROC draw_elements;

void gl_spy_label(GLenum kind, GLuint name, char label[static 64])
{
    label[0] = '\0';
    if (name)
        glGetObjectLabel(kind, name, 64, NULL, label);
}

static void add(gl_spy_role role, GLenum kind, GLuint name, GLuint program, GLenum interface,
                GLuint index)
{
    assert_true(use_count < GL_SPY_USES);
    gl_spy_use *use = &uses[use_count++];
    *use = (gl_spy_use){.role = role, .kind = kind, .name = name};
    if (role != GL_SPY_VERTICES)
        glGetProgramResourceName(program, interface, index, sizeof use->declared, NULL,
                                 use->declared);
}

static bool is_image(GLint type)
{
    return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

static bool is_sampler(GLint type)
{
    return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_RECT_SHADOW) ||
           (type >= GL_SAMPLER_1D_ARRAY && type <= GL_SAMPLER_CUBE_SHADOW) ||
           (type >= GL_INT_SAMPLER_1D && type <= GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
           (type >= GL_SAMPLER_CUBE_MAP_ARRAY && type <= GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY);
}

static void look_at_uniforms(GLuint program)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        static const GLenum asked[] = {GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE};
        GLint told[3], unit;
        glGetProgramResourceiv(program, GL_UNIFORM, (GLuint)i, 3, asked, 3, NULL, told);
        for (GLint k = 0; told[1] >= 0 && k < told[2]; k++) {
            if (!is_image(told[0]) && !is_sampler(told[0]))
                break;
            glGetUniformiv(program, told[1] + k, &unit);
            assert_true(unit < UNITS);
            bool image = is_image(told[0]);
            GLuint texture = (image ? images : textures)[unit], buffer = buffer_of_texture[texture];
            add(image ? GL_SPY_IMAGE : GL_SPY_TEXTURE, buffer ? GL_BUFFER : GL_TEXTURE,
                buffer ? buffer : texture, program, GL_UNIFORM, (GLuint)i);
        }
    }
}

static void look_at_blocks(GLuint program, gl_spy_role role, GLenum interface, GLenum binding)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        static const GLenum asked = GL_BUFFER_BINDING;
        GLint at, buffer;
        glGetProgramResourceiv(program, interface, (GLuint)i, 1, &asked, 1, NULL, &at);
        glGetIntegeri_v(binding, (GLuint)at, &buffer);
        add(role, GL_BUFFER, (GLuint)buffer, program, interface, (GLuint)i);
    }
}

static void look_at_vertices(void)
{
    for (GLuint i = 0; i < 16; i++) {
        GLint enabled = 0, buffer = 0;
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
        if (enabled)
            add(GL_SPY_VERTICES, GL_BUFFER, (GLuint)buffer, 0, GL_NONE, 0);
    }
}

static void look(bool draws, bool indirect, bool indexed)
{
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    GLuint program = (GLuint)current;
    use_count = 0;
    look_at_uniforms(program);
    look_at_blocks(program, GL_SPY_UNIFORMS, GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER_BINDING);
    look_at_blocks(program, GL_SPY_STORAGE, GL_SHADER_STORAGE_BLOCK,
                   GL_SHADER_STORAGE_BUFFER_BINDING);
    if (draws)
        look_at_vertices();
    gl_spy_command command = {program, "", draws, indirect, indexed, uses, use_count};
    gl_spy_label(GL_PROGRAM, program, command.pass);
    tell(&command);
}

static void spy_bind_texture_unit(GLuint unit, GLuint texture)
{
    textures[unit] = texture;
    bind_texture_unit(unit, texture);
}

static void spy_bind_image(GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer,
                           GLenum access, GLenum format)
{
    images[unit] = texture;
    bind_image(unit, texture, level, layered, layer, access, format);
}

static void spy_texture_buffer(GLuint texture, GLenum format, GLuint buffer)
{
    assert_true(texture < TEXTURES);
    buffer_of_texture[texture] = buffer;
    texture_buffer(texture, format, buffer);
}

static void spy_delete_textures(GLsizei count, const GLuint *names)
{
    for (GLsizei i = 0; i < count; i++)
        buffer_of_texture[names[i]] = 0;
    delete_textures(count, names);
}

static void spy_dispatch(GLuint x, GLuint y, GLuint z)
{
    look(false, false, false);
    dispatch(x, y, z);
}

static void spy_dispatch_indirect(GLintptr offset)
{
    look(false, true, false);
    dispatch_indirect(offset);
}

static void spy_draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    look(true, false, false);
    draw_arrays(mode, first, count);
}

static void spy_draw_arrays_indirect(GLenum mode, const void *indirect)
{
    look(true, true, false);
    draw_arrays_indirect(mode, indirect);
}

static void spy_draw_elements_indirect(GLenum mode, GLenum type, const void *indirect)
{
    look(true, true, true);
    draw_elements_indirect(mode, type, indirect);
}

static void spy_draw_elements(GLenum mode, GLsizei count, GLenum type, const void *indices,
                              GLsizei instances, GLuint base)
{
    look(true, false, true);
    draw_elements(mode, count, type, indices, instances, base);
}

void gl_spy_start(void (*on_command)(const gl_spy_command *command))
{
    tell = on_command;
    memset(buffer_of_texture, 0, sizeof buffer_of_texture);
    GL_SPY(TextureBuffer, texture_buffer, spy_texture_buffer);
    GL_SPY(DeleteTextures, delete_textures, spy_delete_textures);
    GL_SPY(BindTextureUnit, bind_texture_unit, spy_bind_texture_unit);
    GL_SPY(BindImageTexture, bind_image, spy_bind_image);
    GL_SPY(DispatchCompute, dispatch, spy_dispatch);
    GL_SPY(DispatchComputeIndirect, dispatch_indirect, spy_dispatch_indirect);
    GL_SPY(DrawArrays, draw_arrays, spy_draw_arrays);
    GL_SPY(DrawArraysIndirect, draw_arrays_indirect, spy_draw_arrays_indirect);
    GL_SPY(DrawElementsIndirect, draw_elements_indirect, spy_draw_elements_indirect);
    GL_SPY(DrawElementsInstancedBaseInstance, draw_elements, spy_draw_elements);
}
