/* What shaders write into images and storage buffers is seen by later commands only after
 * glMemoryBarrier with the bit of the way by which they access it; and it waits for earlier ones,
 * draws to the same texture, too, only after the bit of images or storage buffers (OpenGL 4.5,
 * section 7.12.2). Software GL needs no barriers, so that a missing one shows only on a GPU. */
#include <ctype.h>
#include <string.h>

#include "base/base.h"
#include "gl_spy.h"
#include "plan/plan.h"
#include "spied_pictures.h"

enum { OBJECTS = 1 << 14, PROGRAMS = 4096, BITS = 32, STAGES = 5 };

typedef struct last_access {
    uint64_t when;  /* 0: never */
    GLuint program; /* 0: by drawing to it */
    char pass[64];
} last_access;

/* By object. */
typedef struct accesses {
    last_access written; /* by a shader */
    last_access any;     /* by a draw or dispatch */
} accesses;

static accesses buffers[OBJECTS], textures[OBJECTS];
static uint64_t now, barriers[BITS]; /* when each bit's last barrier was */
static char *sources[PROGRAMS][STAGES];
static int missing;

static PFNGLMEMORYBARRIERPROC memory_barrier;
static PFNGLATTACHSHADERPROC attach_shader;
static PFNGLDELETEBUFFERSPROC delete_buffers;
static PFNGLDELETETEXTURESPROC delete_textures;
static PFNGLNAMEDBUFFERSUBDATAPROC buffer_sub_data;
static PFNGLGETNAMEDBUFFERSUBDATAPROC get_buffer_sub_data;
static PFNGLCLEARNAMEDBUFFERDATAPROC clear_buffer;
static PFNGLCLEARNAMEDBUFFERSUBDATAPROC clear_buffer_sub;
static PFNGLCOPYNAMEDBUFFERSUBDATAPROC copy_buffer;
static PFNGLGETQUERYBUFFEROBJECTUI64VPROC get_query;
static PFNGLCLEARTEXIMAGEPROC clear_texture;
static PFNGLCOPYIMAGESUBDATAPROC copy_image;
static PFNGLGETTEXTUREIMAGEPROC get_image;
static PFNGLGETTEXTURESUBIMAGEPROC get_sub_image;
static PFNGLCLEARNAMEDFRAMEBUFFERFVPROC clear_floats;
static PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC clear_uints;

/* --- what shaders declare ------------------------------------------------------------------- */

static void spy_attach_shader(GLuint program, GLuint shader)
{
    GLint length = 0;
    int stage = 0;
    glGetShaderiv(shader, GL_SHADER_SOURCE_LENGTH, &length);
    assert_true(program < PROGRAMS && length > 0);
    while (stage < STAGES && sources[program][stage])
        stage++;
    assert_true(stage < STAGES);
    sources[program][stage] = malloc((size_t)length);
    glGetShaderSource(shader, length, NULL, sources[program][stage]);
    attach_shader(program, shader);
}

/* The next place where `word` stands as a whole word, or NULL. */
static const char *find_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        if ((at == text || !(isalnum((unsigned char)at[-1]) || at[-1] == '_')) &&
            !(isalnum((unsigned char)at[length]) || at[length] == '_'))
            return at;
    return NULL;
}

/* How variables may be used. */
enum { READS = 1, WRITES = 2, COHERENT = 4 };

static int qualifier(const char *word, size_t length)
{
    static const struct {
        const char *word;
        int access;
    } known[] = {
        {"readonly", READS}, {"writeonly", WRITES}, {"coherent", READS | WRITES | COHERENT}};
    for (size_t i = 0; i < LSF_COUNT(known); i++)
        if (strlen(known[i].word) == length && strncmp(known[i].word, word, length) == 0)
            return known[i].access;
    return 0;
}

/* What the declaration from `at` to `end` says, by itself or by a macro, of which the first
 * definition counts. */
static int declared_access(const char *source, const char *at, const char *end)
{
    while (at < end) {
        size_t length = strcspn(at, " (),\n");
        char define[128];
        snprintf(define, sizeof define, "#define %.*s ", (int)length, at);
        const char *macro = length > 0 ? strstr(source, define) : NULL;
        const char *word = macro ? macro + strlen(define) : at;
        int access = qualifier(word, macro ? strcspn(word, " \n") : length);
        if (access)
            return access;
        at += length + 1;
    }
    return READS | WRITES;
}

/* What the program's stages may do with the image or block. */
static int access_of(GLuint program, const gl_spy_use *use)
{
    int access = 0;
    char name[64];
    snprintf(name, sizeof name, "%s", use->declared);
    name[strcspn(name, "[")] = '\0';
    for (int stage = 0; stage < STAGES && sources[program][stage]; stage++) {
        const char *source = sources[program][stage];
        for (const char *at = find_word(source, name); at; at = find_word(at + 1, name)) {
            const char *start = at, *kind = use->role == GL_SPY_IMAGE ? "image" : "buffer";
            while (start > source && !strchr(";{}", start[-1]))
                start--;
            start = strstr(start, "layout(");
            const char *found = start && start < at ? strstr(start, kind) : NULL;
            if (found && found < at)
                access |= declared_access(source, start, at);
        }
    }
    if (access == 0)
        fail_msg("no stage declares %s", use->declared);
    return access;
}

/* --- who waits for whom --------------------------------------------------------------------- */

static accesses *object(GLenum kind, GLuint name)
{
    assert_true(name < OBJECTS);
    return kind == GL_TEXTURE ? &textures[name] : &buffers[name];
}

static void expect_since(const last_access *last, GLbitfield bit, GLenum kind, GLuint name,
                         const char *who)
{
    int index = 0;
    while (bit >> index != 1)
        index++;
    if (name == 0 || last->when <= barriers[index])
        return;
    char label[64];
    gl_spy_label(kind, name, label);
    print_message("%s follows %s on %s without the barrier 0x%x\n", who, last->pass, label, bit);
    missing++;
}

static void expect(GLbitfield bit, GLenum kind, GLuint name, const char *who)
{
    expect_since(&object(kind, name)->written, bit, kind, name, who);
}

static void record(last_access *last, GLuint program, const char *pass)
{
    last->when = now;
    last->program = program;
    snprintf(last->pass, sizeof last->pass, "%s", pass);
}

static void expect_bound(GLbitfield bit, GLenum binding, const char *who)
{
    GLint name = 0;
    glGetIntegerv(binding, &name);
    expect(bit, GL_BUFFER, (GLuint)name, who);
}

/* Calls `visit` for each texture that is attached. */
static void for_attachments(GLuint framebuffer, const char *who,
                            void (*visit)(GLuint texture, const char *who))
{
    for (GLenum i = 0; framebuffer && i < 9; i++) {
        GLenum point = i < 8 ? GL_COLOR_ATTACHMENT0 + i : GL_DEPTH_ATTACHMENT;
        GLint type = GL_NONE, name = 0;
        glGetNamedFramebufferAttachmentParameteriv(framebuffer, point,
                                                   GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
        if (type != GL_TEXTURE)
            continue;
        glGetNamedFramebufferAttachmentParameteriv(framebuffer, point,
                                                   GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
        visit((GLuint)name, who);
    }
}

static void expect_attached(GLuint texture, const char *who)
{
    expect(GL_FRAMEBUFFER_BARRIER_BIT, GL_TEXTURE, texture, who);
}

static void record_attached(GLuint texture, const char *who)
{
    record(&object(GL_TEXTURE, texture)->any, 0, who);
}

static void on_command(const gl_spy_command *command)
{
    static const GLbitfield bits[] = {
        [GL_SPY_TEXTURE] = GL_TEXTURE_FETCH_BARRIER_BIT,
        [GL_SPY_IMAGE] = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
        [GL_SPY_UNIFORMS] = GL_UNIFORM_BARRIER_BIT,
        [GL_SPY_STORAGE] = GL_SHADER_STORAGE_BARRIER_BIT,
        [GL_SPY_VERTICES] = GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT,
    };
    int access[GL_SPY_USES];
    for (size_t i = 0; i < command->use_count; i++) {
        const gl_spy_use *use = &command->uses[i];
        bool stored = use->role == GL_SPY_IMAGE || use->role == GL_SPY_STORAGE;
        access[i] = stored ? access_of(command->program, use) : READS;
        /* What is coherent takes part in atomic operations, which need no barriers between them. */
        if (access[i] & COHERENT)
            continue;
        if (access[i] & READS)
            expect(bits[use->role], use->kind, use->name, command->pass);
        /* Runs of one program that only write share their texels among them. */
        const last_access *any = &object(use->kind, use->name)->any;
        if ((access[i] & WRITES) && !(access[i] == WRITES && any->program == command->program))
            expect_since(any, bits[use->role], use->kind, use->name, command->pass);
    }
    if (command->indirect)
        expect_bound(GL_COMMAND_BARRIER_BIT,
                     command->draws ? GL_DRAW_INDIRECT_BUFFER_BINDING
                                    : GL_DISPATCH_INDIRECT_BUFFER_BINDING,
                     command->pass);
    if (command->indexed)
        expect_bound(GL_ELEMENT_ARRAY_BARRIER_BIT, GL_ELEMENT_ARRAY_BUFFER_BINDING, command->pass);
    GLint framebuffer = 0;
    if (command->draws)
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    for_attachments((GLuint)framebuffer, command->pass, expect_attached);
    now++;
    for_attachments((GLuint)framebuffer, command->pass, record_attached);
    for (size_t i = 0; i < command->use_count; i++) {
        accesses *o = object(command->uses[i].kind, command->uses[i].name);
        record(&o->any, command->program, command->pass);
        if (access[i] & WRITES)
            record(&o->written, command->program, command->pass);
    }
}

static void spy_memory_barrier(GLbitfield bits)
{
    for (int i = 0; i < BITS; i++)
        if (bits >> i & 1)
            barriers[i] = now;
    memory_barrier(bits);
}

/* --- objects, and what is done with them apart from drawing ---------------------------------- */

static void spy_delete_buffers(GLsizei count, const GLuint *names)
{
    for (GLsizei i = 0; i < count; i++)
        *object(GL_BUFFER, names[i]) = (accesses){0};
    delete_buffers(count, names);
}

static void spy_delete_textures(GLsizei count, const GLuint *names)
{
    for (GLsizei i = 0; i < count; i++)
        *object(GL_TEXTURE, names[i]) = (accesses){0};
    delete_textures(count, names);
}

static void spy_buffer_sub_data(GLuint buffer, GLintptr offset, GLsizeiptr bytes, const void *data)
{
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, buffer, "glNamedBufferSubData");
    buffer_sub_data(buffer, offset, bytes, data);
}

static void spy_get_buffer_sub_data(GLuint buffer, GLintptr offset, GLsizeiptr bytes, void *data)
{
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, buffer, "glGetNamedBufferSubData");
    get_buffer_sub_data(buffer, offset, bytes, data);
}

static void spy_clear_buffer(GLuint buffer, GLenum internal, GLenum format, GLenum type,
                             const void *data)
{
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, buffer, "glClearNamedBufferData");
    clear_buffer(buffer, internal, format, type, data);
}

static void spy_clear_buffer_sub(GLuint buffer, GLenum internal, GLintptr offset, GLsizeiptr bytes,
                                 GLenum format, GLenum type, const void *data)
{
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, buffer, "glClearNamedBufferSubData");
    clear_buffer_sub(buffer, internal, offset, bytes, format, type, data);
}

static void spy_copy_buffer(GLuint from, GLuint to, GLintptr from_offset, GLintptr to_offset,
                            GLsizeiptr bytes)
{
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, from, "glCopyNamedBufferSubData");
    expect(GL_BUFFER_UPDATE_BARRIER_BIT, GL_BUFFER, to, "glCopyNamedBufferSubData");
    copy_buffer(from, to, from_offset, to_offset, bytes);
}

static void spy_get_query(GLuint query, GLuint buffer, GLenum name, GLintptr offset)
{
    expect(GL_QUERY_BUFFER_BARRIER_BIT, GL_BUFFER, buffer, "glGetQueryBufferObjectui64v");
    get_query(query, buffer, name, offset);
}

static void spy_clear_texture(GLuint texture, GLint level, GLenum format, GLenum type,
                              const void *data)
{
    expect(GL_TEXTURE_UPDATE_BARRIER_BIT, GL_TEXTURE, texture, "glClearTexImage");
    clear_texture(texture, level, format, type, data);
}

static void spy_copy_image(GLuint from, GLenum from_target, GLint from_level, GLint from_x,
                           GLint from_y, GLint from_z, GLuint to, GLenum to_target, GLint to_level,
                           GLint to_x, GLint to_y, GLint to_z, GLsizei width, GLsizei height,
                           GLsizei depth)
{
    expect(GL_TEXTURE_UPDATE_BARRIER_BIT, GL_TEXTURE, from, "glCopyImageSubData");
    expect(GL_TEXTURE_UPDATE_BARRIER_BIT, GL_TEXTURE, to, "glCopyImageSubData");
    copy_image(from, from_target, from_level, from_x, from_y, from_z, to, to_target, to_level, to_x,
               to_y, to_z, width, height, depth);
}

static void spy_get_image(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei bytes,
                          void *pixels)
{
    expect(GL_TEXTURE_UPDATE_BARRIER_BIT, GL_TEXTURE, texture, "glGetTextureImage");
    get_image(texture, level, format, type, bytes, pixels);
}

static void spy_get_sub_image(GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                              GLsizei height, GLsizei depth, GLenum format, GLenum type,
                              GLsizei bytes, void *pixels)
{
    expect(GL_TEXTURE_UPDATE_BARRIER_BIT, GL_TEXTURE, texture, "glGetTextureSubImage");
    get_sub_image(texture, level, x, y, z, width, height, depth, format, type, bytes, pixels);
}

static void spy_clear_floats(GLuint framebuffer, GLenum kind, GLint at, const GLfloat *value)
{
    for_attachments(framebuffer, "glClearNamedFramebufferfv", expect_attached);
    clear_floats(framebuffer, kind, at, value);
}

static void spy_clear_uints(GLuint framebuffer, GLenum kind, GLint at, const GLuint *value)
{
    for_attachments(framebuffer, "glClearNamedFramebufferuiv", expect_attached);
    clear_uints(framebuffer, kind, at, value);
}

static void forget(void)
{
    memset(buffers, 0, sizeof buffers);
    memset(textures, 0, sizeof textures);
    for (int i = 0; i < PROGRAMS; i++)
        for (int stage = 0; stage < STAGES; stage++) {
            free(sources[i][stage]);
            sources[i][stage] = NULL;
        }
}

static void start(void)
{
    forget();
    gl_spy_start(on_command);
    GL_SPY(MemoryBarrier, memory_barrier, spy_memory_barrier);
    GL_SPY(AttachShader, attach_shader, spy_attach_shader);
    GL_SPY(DeleteBuffers, delete_buffers, spy_delete_buffers);
    GL_SPY(DeleteTextures, delete_textures, spy_delete_textures);
    GL_SPY(NamedBufferSubData, buffer_sub_data, spy_buffer_sub_data);
    GL_SPY(GetNamedBufferSubData, get_buffer_sub_data, spy_get_buffer_sub_data);
    GL_SPY(ClearNamedBufferData, clear_buffer, spy_clear_buffer);
    GL_SPY(ClearNamedBufferSubData, clear_buffer_sub, spy_clear_buffer_sub);
    GL_SPY(CopyNamedBufferSubData, copy_buffer, spy_copy_buffer);
    GL_SPY(GetQueryBufferObjectui64v, get_query, spy_get_query);
    GL_SPY(ClearTexImage, clear_texture, spy_clear_texture);
    GL_SPY(CopyImageSubData, copy_image, spy_copy_image);
    GL_SPY(GetTextureImage, get_image, spy_get_image);
    GL_SPY(GetTextureSubImage, get_sub_image, spy_get_sub_image);
    GL_SPY(ClearNamedFramebufferfv, clear_floats, spy_clear_floats);
    GL_SPY(ClearNamedFramebufferuiv, clear_uints, spy_clear_uints);
}

static void end(const lsf_renderer *renderer)
{
    print_message("%s\n", lsf_renderer_plan(renderer)->technique);
}

static void each_write_is_waited_for(void **state)
{
    (void)state;
    spy_on_pictures(start, end);
    forget();
    assert_int_equal(missing, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_write_is_waited_for)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
