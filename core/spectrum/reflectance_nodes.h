// A reflectance given each 5 nm from 380 to 780 nm, and its colour under a light as a weighted sum of those values.
#pragma once

#include <array>

#include "core/spectrum/observer.h"

namespace lueur {

inline constexpr int node_count = 81;
constexpr double node_nm(int node) {
    return 380 + 5 * node;
}

// One weight a node: sum_k weight[k] * reflectance[k] is the integral of light * reflectance * (xbar, ybar, zbar),
// exact for a reflectance that is linear between the nodes and constant outside them, whatever lines the light has.
// Without Km.
using NodeWeights = std::array<Xyz, node_count>;
NodeWeights node_weights(const Spectrum& light);

} // namespace lueur
