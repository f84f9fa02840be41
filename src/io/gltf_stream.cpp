#include "io/gltf_stream.hpp"

#include <algorithm>
#include <new>

namespace lsf
{

float *stream::grow(uint64_t first, uint64_t count)
{
    void *grown = *array_;
    if (!lsf_grow(&grown, &capacity_, (first + count) * width_, sizeof(float)))
        throw std::bad_alloc();
    *array_ = static_cast<float *>(grown);
    return *array_ + first * width_;
}

void stream::repeat(uint64_t first, uint64_t count, uint64_t source)
{
    if (!present_)
        return;
    float *out = grow(first, count);
    std::copy_n(*array_ + source * width_, count * width_, out);
}

void stream::append(uint64_t first, uint64_t count, const std::vector<float> &values)
{
    if (!present_)
        return;
    float *out = grow(first, count);
    if (!values.empty())
        std::copy_n(values.data(), count * width_, out);
    else
        for (uint64_t i = 0; i < count; i++)
            std::copy_n(otherwise_.data(), width_, out + i * width_);
}

} // namespace lsf
