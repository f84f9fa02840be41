#include "frame/light_tree_buffers.h"

#include "base/base.h"

void lsf_light_tree_bind(const lsf_light_tree_buffers *buffers)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_CLOUD, buffers->cloud);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE, buffers->tree);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_NODES, buffers->nodes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_AREAS, buffers->areas);
}

bool lsf_light_tree_fetch_create(lsf_light_tree_fetch *fetch, lsf_context *context,
                                 lsf_error *error)
{
    return lsf_buffer_textures_create(context, LSF_COUNT(fetch->textures), fetch->textures, error);
}

void lsf_light_tree_fetch_bind(const lsf_light_tree_fetch *fetch,
                               const lsf_light_tree_buffers *buffers)
{
    const GLenum formats[LSF_COUNT(fetch->textures)] = {GL_RGBA32UI, GL_RGBA32UI, GL_R32F};
    const GLuint names[LSF_COUNT(fetch->textures)] = {buffers->cloud, buffers->nodes,
                                                      buffers->areas};
    for (GLuint i = 0; i < LSF_COUNT(names); i++) {
        glTextureBuffer(fetch->textures[i], formats[i], names[i]);
        lsf_bind_texture(LSF_UNIT_LIGHT_TREE_CLOUD + i, fetch->textures[i]);
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE, buffers->tree);
}

void lsf_light_tree_fetch_destroy(lsf_light_tree_fetch *fetch)
{
    glDeleteTextures(LSF_COUNT(fetch->textures), fetch->textures);
}
