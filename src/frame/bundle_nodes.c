#include "frame/bundle_nodes.h"

#include "shared/bundle_data.h"
#include "shared/scene_data.h"

void lsf_bundle_nodes_bind(const lsf_bundle_nodes *nodes)
{
    glBindBufferRange(GL_UNIFORM_BUFFER, LSF_BINDING_BUNDLE, nodes->projections, nodes->offset,
                      sizeof(struct lsf_bundle_data));
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_BUNDLE_NODES, LSF_RAY_BUNDLE_ARRAYS,
                      nodes->arrays);
}
