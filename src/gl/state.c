/* The state of an application's context, whose values on entry are unknown and which is returned
 * as GL makes a new one. The contract is in lightsheaf/context.h. */
#include "gl/context.h"

/* User clip planes that GL promises. */
#define CLIP_DISTANCES 8

static void reset_switches(void)
{
    static const GLenum off[] = {GL_BLEND,
                                 GL_COLOR_LOGIC_OP,
                                 GL_CULL_FACE,
                                 GL_DEPTH_CLAMP,
                                 GL_DEPTH_TEST,
                                 GL_FRAMEBUFFER_SRGB,
                                 GL_LINE_SMOOTH,
                                 GL_POLYGON_OFFSET_FILL,
                                 GL_POLYGON_OFFSET_LINE,
                                 GL_POLYGON_OFFSET_POINT,
                                 GL_POLYGON_SMOOTH,
                                 GL_PRIMITIVE_RESTART,
                                 GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                 GL_PROGRAM_POINT_SIZE,
                                 GL_RASTERIZER_DISCARD,
                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_SAMPLE_ALPHA_TO_ONE,
                                 GL_SAMPLE_COVERAGE,
                                 GL_SAMPLE_MASK,
                                 GL_SAMPLE_SHADING,
                                 GL_SCISSOR_TEST,
                                 GL_STENCIL_TEST,
                                 GL_TEXTURE_CUBE_MAP_SEAMLESS};
    for (size_t i = 0; i < LSF_COUNT(off); i++)
        glDisable(off[i]);
    for (GLenum plane = 0; plane < CLIP_DISTANCES; plane++)
        glDisable(GL_CLIP_DISTANCE0 + plane);
    glEnable(GL_DITHER);
    glEnable(GL_MULTISAMPLE);
}

static void reset_rasterisation(void)
{
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glCullFace(GL_BACK);
    glDepthRange(0.0, 1.0);
    glFrontFace(GL_CCW);
    glHint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_DONT_CARE);
    glPatchParameteri(GL_PATCH_VERTICES, 3);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0.0f, 0.0f);
    glPrimitiveRestartIndex(0);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
}

static void reset_fragments(void)
{
    glBlendColor(0.0f, 0.0f, 0.0f, 0.0f);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ZERO);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glLogicOp(GL_COPY);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    glStencilMask(~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

static void reset_pixels(void)
{
    static const GLenum zero[] = {
        GL_PACK_SWAP_BYTES,    GL_PACK_LSB_FIRST,    GL_PACK_ROW_LENGTH,     GL_PACK_IMAGE_HEIGHT,
        GL_PACK_SKIP_ROWS,     GL_PACK_SKIP_PIXELS,  GL_PACK_SKIP_IMAGES,    GL_UNPACK_SWAP_BYTES,
        GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES};
    for (size_t i = 0; i < LSF_COUNT(zero); i++)
        glPixelStorei(zero[i], 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

static void reset_bindings(const lsf_context *context)
{
    static const GLenum buffers[] = {
        GL_ARRAY_BUFFER,          GL_ATOMIC_COUNTER_BUFFER,    GL_COPY_READ_BUFFER,
        GL_COPY_WRITE_BUFFER,     GL_DISPATCH_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER,
        GL_PIXEL_PACK_BUFFER,     GL_PIXEL_UNPACK_BUFFER,      GL_QUERY_BUFFER,
        GL_SHADER_STORAGE_BUFFER, GL_TEXTURE_BUFFER,           GL_UNIFORM_BUFFER};
    const lsf_binding_counts *counts = &context->counts;
    glBindBuffersBase(GL_ATOMIC_COUNTER_BUFFER, 0, counts->atomic_counter_buffers, NULL);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, counts->shader_storage_buffers, NULL);
    glBindBuffersBase(GL_UNIFORM_BUFFER, 0, counts->uniform_buffers, NULL);
    for (size_t i = 0; i < LSF_COUNT(buffers); i++)
        glBindBuffer(buffers[i], 0);
    glBindTextures(0, counts->textures, NULL);
    glBindSamplers(0, counts->textures, NULL);
    glBindImageTextures(0, counts->images, NULL);
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glBindVertexArray(0);
    glUseProgram(0); /* first: while a program is in use, Mesa unbinds no pipeline */
    glBindProgramPipeline(0);
}

void lsf_state_count_bindings(lsf_context *context)
{
    lsf_binding_counts *counts = &context->counts;
    glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &counts->textures);
    glGetIntegerv(GL_MAX_IMAGE_UNITS, &counts->images);
    glGetIntegerv(GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS, &counts->atomic_counter_buffers);
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &counts->shader_storage_buffers);
    glGetIntegerv(GL_MAX_UNIFORM_BUFFER_BINDINGS, &counts->uniform_buffers);
}

void lsf_state_reset(const lsf_context *context)
{
    reset_switches();
    reset_rasterisation();
    reset_fragments();
    reset_pixels();
    reset_bindings(context);
}

void lsf_state_set_conventions(void)
{
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); /* reverse-Z keeps its precision */
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DITHER);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}
