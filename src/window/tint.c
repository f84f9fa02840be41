/* Draws the values of a texture as colours in a canvas. */
#include "window/canvas.h"

#include "window/gl_calls.h"

#include <stddef.h>

static const char *const vertex_source =
    "#version 450 core\n"
    "void main()\n"
    "{\n"
    "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
    "    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);\n"
    "}\n";

static const char *const fragment_source =
    "#version 450 core\n"
    "layout(binding = 0) uniform sampler2D values;\n"
    "layout(location = 0) uniform int tint;\n"
    "layout(location = 1) uniform float scale;\n"
    "layout(location = 0) out vec4 shown;\n"
    "vec3 srgb(vec3 x)\n"
    "{\n"
    "    x = clamp(x, 0.0, 1.0);\n"
    "    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x,\n"
    "               lessThanEqual(x, vec3(0.0031308)));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec3 value = texelFetch(values, ivec2(gl_FragCoord.xy), 0).rgb;\n"
    "    vec3 color = srgb(scale * value);\n"
    "    if (tint == 1)\n"
    "        color = dot(value, value) > 0.0 ? 0.5 + 0.5 * scale * value : vec3(0.0);\n"
    "    if (tint == 2)\n"
    "        color = vec3(isinf(value.x) ? 0.0 : 1.0 / (1.0 + scale * value.x));\n"
    "    if (tint == 3)\n"
    "        color = 0.5 + 0.5 * vec3(clamp(scale * value.xy, -1.0, 1.0), 0.0);\n"
    "    shown = vec4(color, 1.0);\n"
    "}\n";

static GLuint program, vertex_array;

static GLuint compile(GLenum kind, const char *source)
{
    GLuint shader = lsf_gl.CreateShader(kind);
    lsf_gl.ShaderSource(shader, 1, &source, NULL);
    lsf_gl.CompileShader(shader);
    return shader;
}

static bool open_tints(void)
{
    GLint linked = 0;
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source);
    GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_source);
    program = lsf_gl.CreateProgram();
    lsf_gl.AttachShader(program, vertex);
    lsf_gl.AttachShader(program, fragment);
    lsf_gl.LinkProgram(program);
    lsf_gl.DeleteShader(vertex);
    lsf_gl.DeleteShader(fragment);
    lsf_gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    lsf_gl.CreateVertexArrays(1, &vertex_array);
    return linked != 0;
}

void lsf_canvas_close_tints(void)
{
    if (program)
        lsf_gl.DeleteProgram(program);
    if (vertex_array)
        lsf_gl.DeleteVertexArrays(1, &vertex_array);
    program = vertex_array = 0;
}

bool lsf_canvas_tint(lsf_canvas *canvas, uint32_t texture, lsf_tint tint, float scale)
{
    if (!program && !open_tints())
        return false;
    lsf_gl.BindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    lsf_gl.Viewport(0, 0, (GLsizei)canvas->width, (GLsizei)canvas->height);
    lsf_gl.Disable(GL_SCISSOR_TEST);
    lsf_gl.Disable(GL_BLEND);
    lsf_gl.Disable(GL_DEPTH_TEST);
    lsf_gl.Disable(GL_CULL_FACE);
    lsf_gl.BindTextureUnit(0, texture);
    lsf_gl.BindSampler(0, 0);
    lsf_gl.UseProgram(program);
    lsf_gl.BindVertexArray(vertex_array);
    lsf_gl.Uniform1i(0, (GLint)tint);
    lsf_gl.Uniform1f(1, scale);
    lsf_gl.DrawArrays(GL_TRIANGLES, 0, 3);
    lsf_gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    return true;
}
