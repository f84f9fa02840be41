#include "window/gl_calls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

lsf_window_gl lsf_gl;

bool lsf_window_gl_load(void)
{
    bool all = true;
#define LSF_WINDOW_GL_LOAD(type, name)                                                             \
    lsf_gl.name = (type)glfwGetProcAddress("gl" #name);                                            \
    all = all && lsf_gl.name;
    LSF_WINDOW_GL_CALLS(LSF_WINDOW_GL_LOAD)
#undef LSF_WINDOW_GL_LOAD
    return all;
}
