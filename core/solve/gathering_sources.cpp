#include "core/solve/gathering_sources.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

using State = Solution::State;

ChannelField rho_of_receivers(const State& s) {
    ChannelField rho(s.receivers.count(), s.channels());
    for (std::uint32_t i = 0; i < rho.count; ++i) {
        const auto& values = s.material_rho[s.material_of(s.mesh.vertices[s.receivers.vertex[i]].surface)];
        std::copy(values.begin(), values.end(), rho[i]);
    }
    return rho;
}

std::vector<float> receiver_areas(const State& s) {
    std::vector<float> area(s.receivers.count(), 0);
    for (std::uint32_t v = 0; v < s.receivers.of_vertex.size(); ++v)
        if (!s.buried[v]) area[s.receivers.of_vertex[v]] += s.indirect_area[v];
    return area;
}

std::uint32_t fine_vertices_of_rays(const State& s) {
    return s.passes.empty() ? static_cast<std::uint32_t>(s.mesh.vertices.size()) : s.passes.front().fine_vertices;
}

ChannelField reflected_direct(const State& s, const Exitances& exitance) {
    const std::uint32_t count = fine_vertices_of_rays(s);
    const int channels = s.channels();
    ChannelField b(static_cast<std::uint32_t>(s.mesh.vertices.size()) + 1, channels);
    read_direct(s, exitance, b);
    std::fill_n(b[count], channels, 0.0f);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 256),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                              const auto& rho = s.material_rho[s.material_of(s.mesh.vertices[v].surface)];
                              for (int c = 0; c < channels; ++c) b[v][c] *= static_cast<float>(rho[c]);
                          }
                      });
    return b;
}

SmoothedReceivers smoothed_receivers(const State& s) {
    return {s.receivers.of_vertex, s.receivers.vertex, s.smoothing};
}

LightBasesRoom room_for_bases(const State& s) {
    return {s.receivers.count(), s.channels(), s.luminaire_exitance.size()};
}

} // namespace lueur
