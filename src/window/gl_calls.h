/* The few functions of OpenGL that the window calls by itself. */
#ifndef LSF_WINDOW_GL_CALLS_H
#define LSF_WINDOW_GL_CALLS_H

#include <stdbool.h>

#include <GL/glcorearb.h>

#define LSF_WINDOW_GL_CALLS(X)                                                                     \
    X(PFNGLCREATETEXTURESPROC, CreateTextures)                                                     \
    X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                                                 \
    X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                                               \
    X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                                               \
    X(PFNGLCLEARTEXIMAGEPROC, ClearTexImage)                                                       \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                     \
    X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                                             \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)                                   \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                             \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                   \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                             \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                           \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)                                   \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                         \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                         \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                       \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                         \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                       \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                         \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                           \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                         \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                             \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                       \
    X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                                             \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                   \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                             \
    X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                                                   \
    X(PFNGLBINDSAMPLERPROC, BindSampler)                                                           \
    X(PFNGLUNIFORM1IPROC, Uniform1i)                                                               \
    X(PFNGLUNIFORM1FPROC, Uniform1f)                                                               \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                             \
    X(PFNGLVIEWPORTPROC, Viewport)                                                                 \
    X(PFNGLDISABLEPROC, Disable)                                                                   \
    X(PFNGLGETERRORPROC, GetError)

typedef struct lsf_window_gl {
#define LSF_WINDOW_GL_MEMBER(type, name) type name;
    LSF_WINDOW_GL_CALLS(LSF_WINDOW_GL_MEMBER)
#undef LSF_WINDOW_GL_MEMBER
} lsf_window_gl;

/* Functions of the context that is current: a process has one window. */
extern lsf_window_gl lsf_gl;

/* False where the context lacks one of them. */
bool lsf_window_gl_load(void);

#endif
