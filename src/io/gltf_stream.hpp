/* A stream of the scene's vertices while they are read. */
#ifndef LSF_IO_GLTF_STREAM_HPP
#define LSF_IO_GLTF_STREAM_HPP

#include "io/gltf_import.hpp"

#include <array>

namespace lsf
{

/* A stream of the scene that grows. */
class stream
{
  public:
    stream(float **array, uint64_t width, std::array<float, 4> otherwise, bool present)
        : array_(array), width_(width), otherwise_(otherwise), present_(present)
    {
    }
    /* Appends `count` vertices at `first`; the default where the file has none. */
    void append(uint64_t first, uint64_t count, const std::vector<float> &values);
    /* Appends copies of `count` vertices from `source` on. */
    void repeat(uint64_t first, uint64_t count, uint64_t source);

  private:
    float *grow(uint64_t first, uint64_t count);

    float **array_;
    uint64_t width_, capacity_ = 0;
    std::array<float, 4> otherwise_;
    bool present_;
};

} // namespace lsf

#endif
