/* Skins and morph targets. */
#ifndef LSF_IO_GLTF_DEFORM_HPP
#define LSF_IO_GLTF_DEFORM_HPP

#include "io/gltf_primitive.hpp"

namespace lsf
{

/* Gives nodes the weights of their meshes' morph targets. */
void weights_import(gltf_import &import);

/* The scene's skin for the file's. */
uint32_t skin_import(gltf_import &import, int skin);

/* Whether skins or morph targets deform a primitive. */
bool has_shape(const tinygltf::Primitive &primitive, bool skinned);

/* The index of the deformer of a primitive's vertices, as another of the scene's shapes. */
uint32_t shape_import(gltf_import &import, const tinygltf::Primitive &primitive, bool skinned,
                      bool flat, const vertex_arrays &arrays, const std::string &location);

/* Fails unless a skin has all joints that the vertices of a shape follow. */
void check_joints(const gltf_import &import, uint32_t shape, uint32_t skin,
                  const std::string &location);

} // namespace lsf

#endif
