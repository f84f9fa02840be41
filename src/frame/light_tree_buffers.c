#include "frame/light_tree_buffers.h"

void lsf_light_tree_bind(const lsf_light_tree_buffers *buffers)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_CLOUD, buffers->cloud);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE, buffers->tree);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_NODES, buffers->nodes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_LIGHT_TREE_AREAS, buffers->areas);
}
