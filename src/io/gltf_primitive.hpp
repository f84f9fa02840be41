/* One primitive of the file as plain vertex arrays and a triangle list. */
#ifndef LSF_IO_GLTF_PRIMITIVE_HPP
#define LSF_IO_GLTF_PRIMITIVE_HPP

#include "io/gltf_import.hpp"

namespace lsf
{

/* Which optional streams the scene keeps. */
struct stream_choice {
    bool tangent = false, uv0 = false, uv1 = false, color = false;
};

struct vertex_arrays {
    uint64_t count = 0;
    std::vector<float> position, normal, tangent, uv0, uv1, color; /* empty: not in the file */
    std::vector<uint32_t> sources; /* the file's vertex of each; empty: the same */

    uint32_t source(uint64_t vertex) const
    {
        return sources.empty() ? (uint32_t)vertex : sources[vertex];
    }

    /* Makes vertex i a copy of what was vertex from[i]. */
    void gather(const std::vector<uint32_t> &from);
    void append_copies(const uint32_t *from, uint64_t copies);
};

/* Index of the accessor that the attribute names, or -1. */
int find_attribute(const tinygltf::Primitive &primitive, const char *name);

bool mode_is_triangles(int mode);

/* Bytes that the scene stores for a vertex. */
uint64_t vertex_bytes(const stream_choice &streams);

/* Reads the attributes that `streams` asks for, checks their formats and counts. Takes memory for
 * the scene, and lends what is returned. */
vertex_arrays read_vertices(gltf_import &import, const tinygltf::Primitive &primitive,
                            const stream_choice &streams, const std::string &location,
                            memory_loan &loan);

/* Lists, strips and fans, indexed or not, as a triangle list. Takes and lends like
 * read_vertices. */
std::vector<uint32_t> read_triangles(gltf_import &import, const tinygltf::Primitive &primitive,
                                     uint64_t vertex_count, const std::string &location,
                                     memory_loan &loan);

} // namespace lsf

#endif
