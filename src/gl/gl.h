/* The GL layer: a context's services for passes. Objects are created once, from a plan; direct
 * state access only. All names are labelled for RenderDoc and apitrace (KHR_debug). */
#ifndef LSF_GL_GL_H
#define LSF_GL_GL_H

#include <glad/gl.h>

#include <stdbool.h>
#include <stdint.h>

#include <lightsheaf/context.h>

/* --- entering a context --- */

/* A function of the public API that needs a context begins with
 *     LSF_LEAVE lsf_context *entered = lsf_context_enter(context, error);
 * and fails where that gives NULL. The context is current from there on; an application's own gets
 * the state that passes rely on, and GL's when the outermost such function ends. */
#define LSF_LEAVE __attribute__((cleanup(lsf_context_leave)))
lsf_context *lsf_context_enter(lsf_context *context, lsf_error *error);
void lsf_context_leave(lsf_context **entered); /* *entered NULL allowed */
/* Lets other threads use their contexts, between two pieces of a function's work; contexts in
 * software take turns. */
void lsf_context_pause(const lsf_context *context);

/* --- memory: every byte of GL storage goes through these and is counted --- */

typedef struct lsf_texture_desc {
    const char *label;
    GLenum target;                 /* GL_TEXTURE_2D, _2D_ARRAY, _CUBE_MAP, _3D */
    GLenum internal_format;        /* sized */
    uint32_t width, height, depth; /* depth: layers or slices, 1 for 2D, 6 for a cube map */
    uint32_t levels;
} lsf_texture_desc;

/* Bytes that the texture's texels take, all levels: what lsf_texture_create counts. */
uint64_t lsf_texture_bytes(const lsf_texture_desc *desc);
/* Immutable storage, nearest filtering, clamp to edge. 0 on failure: LSF_ERROR_RENDER names the
 * label, the size and the device's limit. */
GLuint lsf_texture_create(lsf_context *context, const lsf_texture_desc *desc, lsf_error *error);
void lsf_texture_destroy(lsf_context *context, GLuint *texture); /* *texture 0 allowed; set to 0 */

/* The largest storage block that a shader can read on every device (GL 4.5, table 23.64);
 * software GL has no larger ones. */
#define LSF_STORAGE_BLOCK_BYTES ((uint64_t)1 << 27)

/* Immutable storage; `data` NULL leaves it undefined; `flags` as for glNamedBufferStorage. */
GLuint lsf_buffer_create(lsf_context *context, const char *label, uint64_t bytes, const void *data,
                         GLbitfield flags, lsf_error *error);
void lsf_buffer_destroy(lsf_context *context, GLuint *buffer);

/* Sets `textures` to new names of buffer textures; glTextureBuffer gives each its buffer. In
 * software GL a context's first call draws: it changes the program, the framebuffer and texture
 * units. */
bool lsf_buffer_textures_create(lsf_context *context, GLsizei count, GLuint *textures,
                                lsf_error *error);

/* The bytes of a texel of this sized internal format; 0 when it is unknown. */
uint32_t lsf_format_bytes(GLenum internal_format);
const char *lsf_format_name(GLenum internal_format); /* "GL_RGBA16F" */

typedef struct lsf_framebuffer_desc {
    const char *label;
    uint32_t color_count;
    GLuint colors[8];       /* textures; entries that are 0 are left out, without a gap */
    GLuint depth;           /* texture, 0: none */
    int32_t layer;          /* -1: whole textures (layered rendering); else one layer of each */
    uint32_t width, height; /* size of a framebuffer without attachments, whose shaders write
                             * buffers; else 0 */
} lsf_framebuffer_desc;
GLuint lsf_framebuffer_create(lsf_context *context, const lsf_framebuffer_desc *desc,
                              lsf_error *error);
void lsf_framebuffer_destroy(lsf_context *context, GLuint *framebuffer);

/* For tests: the n-th texture, buffer, framebuffer, program or timer created from now on fails (1:
 * the next); 0 turns it off. A program from the cache does not count. */
void lsf_context_fail_allocation(lsf_context *context, uint64_t n);

/* Records an error of a pass that ran, where nothing can be returned: the next lsf_context_check
 * fails with it. Only the first one is kept. */
void lsf_context_fail(lsf_context *context, const lsf_error *error);

/* --- programs --- */

typedef struct lsf_define {
    const char *name;
    int value;
} lsf_define;

/* Files are named by path below glsl/: "passes/gbuffer.vert.glsl"; the stage follows from the
 * ending .vert.glsl .tesc.glsl .tese.glsl .geom.glsl .frag.glsl .comp.glsl. */
typedef struct lsf_program_desc {
    const char *label;
    const char *files[5]; /* NULL-terminated unless all five are used */
    const lsf_define *defines;
    uint32_t define_count;
} lsf_program_desc;

/* Compiles and links, or returns the program that an equal source (hashed after preprocessing of
 * includes and defines) already gave. Owned by the context. 0 on failure: LSF_ERROR_RENDER holds
 * the whole log, every line as path:line: message. Each source starts with #version 450 core and
 * the defines; `#include "lib/brdf.glsl"` is by path below glsl/, each file once, whatever #if
 * stands around it. #extension lines stand above the first include, as GLSL wants them before any
 * declaration. */
GLuint lsf_program_get(lsf_context *context, const lsf_program_desc *desc, lsf_error *error);

/* A part of a shader's text: one that a user wrote, or one that the library puts before or
 * behind it. */
typedef struct lsf_shader_part {
    const char *path;   /* name in messages; without a text, the file below glsl to read */
    const char *text;   /* NULL: that file's */
    const char *folder; /* for a user's text: the folder where its #include "..." begins; NULL:
                         * glsl */
    uint32_t line;      /* number of the text's first line */
} lsf_shader_part;

/* Compiles and links the parts, one after the other, as a fragment shader that is drawn by
 * lsf_draw_fullscreen, or as a compute shader. In a user's text, `#include
 * <lightsheaf/brdf.glsl>` names a file of glsl/lib or glsl/shared, #version is left out, and
 * #extension is moved to where GLSL wants it. The caller owns the program. 0 on failure:
 * LSF_ERROR_RENDER holds the log, every line as path:line: message, with the text's line below
 * it. */
GLuint lsf_program_build(lsf_context *context, const char *label, GLenum stage,
                         const lsf_define *defines, uint32_t define_count,
                         const lsf_shader_part *parts, uint32_t part_count, lsf_error *error);
void lsf_program_destroy(GLuint *program); /* *program 0 allowed */

/* A draw takes over no state from the pass before. A pass begins its draws with one of the two
 * functions that follow, which set all state that a draw depends on, and then changes what it
 * needs otherwise; nothing is put back. It binds its own textures (lsf_bind_texture), images and
 * buffers. Only buffers may stay bound from pass to pass within an iteration: the view, the grid
 * of voxels, and the light, VPL and bundle that is being worked on. */

/* To be called before draws of which every fragment counts, without tests, culling and blending:
 * a fragment replaces the framebuffer's texel, or the shader writes elsewhere. */
void lsf_begin_fullscreen(GLuint framebuffer, uint32_t width, uint32_t height, GLuint program);
/* Draws one triangle that covers the viewport with an empty vertex array. Pair with
 * "lib/fullscreen.vert.glsl". */
void lsf_draw_fullscreen(lsf_context *context);
/* The same with a DrawArraysIndirectCommand at the start of a buffer. */
void lsf_draw_fullscreen_indirect(lsf_context *context, GLuint buffer);
/* Draws triangles of `count` vertices that the vertex shader makes from gl_VertexID alone. */
void lsf_draw_vertices(lsf_context *context, uint32_t count);

/* To be called after lsf_begin_fullscreen, where the framebuffer holds the depth of surfaces:
 * texels without a surface are neither shaded nor written. The depth may be sampled. */
void lsf_skip_background(void);

/* To be called before surfaces are drawn: the nearest surface in a texel stays. Depth is
 * reversed: the greater, the nearer. The caller binds the framebuffer. */
void lsf_begin_surfaces(uint32_t width, uint32_t height, GLuint program);

/* Sets whether back faces are culled in the draws that follow. The winding of a mirrored
 * instance flips; shaders take that into account, so that the front face itself is not
 * redefined. */
void lsf_cull_back(bool culled, bool mirrored);

/* What the program writes is added to the first `attachments` attachments. */
void lsf_blend_add(uint32_t attachments);
/* Color that the program writes is added to the first attachment, and alpha replaces its alpha. */
void lsf_blend_add_color(void);
/* One attachment is multiplied by what the program writes. */
void lsf_blend_multiply(uint32_t attachment);

/* Binds a texture that is filtered as its own parameters say (lsf_texture_create), whatever
 * sampler its unit had. Textures of materials come with samplers, and are bound by
 * lsf_scene_gpu_bind_material alone. */
void lsf_bind_texture(GLuint unit, GLuint texture);

/* --- pass groups and time --- */

/* A named timer that also opens a KHR_debug group. On software GL it brackets with glFinish and a
 * wall clock; on a GPU it uses timestamp queries read back some frames later, never waiting. */
typedef struct lsf_timer lsf_timer;
lsf_timer *lsf_timer_create(lsf_context *context, const char *name, lsf_error *error);
void lsf_timer_destroy(lsf_timer *timer);
void lsf_timer_begin(lsf_timer *timer);
void lsf_timer_end(lsf_timer *timer);
uint64_t lsf_timer_runs(lsf_timer *timer);
/* Total over all finished runs; waits for pending ones. */
double lsf_timer_milliseconds(lsf_timer *timer);
/* The runs that have finished since the last call, and how long they took together. It never
 * waits. */
uint64_t lsf_timer_poll(lsf_timer *timer, double *milliseconds);
const char *lsf_timer_name(const lsf_timer *timer);

#endif
