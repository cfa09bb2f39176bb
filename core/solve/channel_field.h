// A value a vertex and channel, padded so that a vertex's channels are whole vector registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/spectrum/wavelengths.h"

namespace lueur {

inline constexpr std::size_t register_channels = 8; // floats of the widest vectors in use

struct ChannelField {
    std::uint32_t count = 0; // vertices or elements
    int stride = 8;          // channels rounded up to a multiple of 8; the padding stays 0
    std::vector<float> values;

    ChannelField() = default;
    ChannelField(std::uint32_t n, int channels)
        : count(n)
        , stride((channels + 7) / 8 * 8)
        , values(std::size_t(n) * ((channels + 7) / 8 * 8), 0.0f) {}

    float* operator[](std::uint32_t i) { return values.data() + std::size_t(i) * stride; }
    const float* operator[](std::uint32_t i) const { return values.data() + std::size_t(i) * stride; }
};

} // namespace lueur
