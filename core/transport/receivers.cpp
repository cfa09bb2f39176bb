#include "core/transport/receivers.h"

namespace lueur {

Receivers receivers_of(const LightSamples& samples, const std::vector<std::uint8_t>& buried) {
    Receivers receivers{samples.of_vertex, samples.vertex, {}};
    for (const std::uint32_t v : receivers.vertex) receivers.buried.push_back(buried[v]);
    return receivers;
}

void add_receivers(std::uint32_t vertices, const std::vector<std::uint8_t>& buried, Receivers& receivers) {
    for (auto v = static_cast<std::uint32_t>(receivers.of_vertex.size()); v < vertices; ++v) {
        receivers.of_vertex.push_back(receivers.count());
        receivers.vertex.push_back(v);
        receivers.buried.push_back(buried[v]);
    }
}

} // namespace lueur
