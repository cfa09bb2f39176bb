#include "core/solve/traced_field.h"

#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

void TracedField::irradiance(std::uint32_t v, float* out) const {
    const double paths = double(passes_at(v)) * path_batches;
    for (int c = 0; c < channels; ++c)
        out[c] = paths > 0 ? static_cast<float>(sums[std::size_t(v) * std::size_t(channels) + std::size_t(c)] / paths)
                           : 0.0f;
}

double TracedField::standard_error(std::uint32_t v) const {
    const std::span<const double> sums_of_batches(batches.data() + std::size_t(v) * path_batches, path_batches);
    const std::uint32_t count = passes_at(v);
    return count > 0 ? standard_error_of_batches(sums_of_batches) / count : 0;
}

TracedField make_traced_field(const Solution::State& s) {
    TracedField field;
    field.lights = make_path_lights(s);
    field.origins = ray_origins(s.mesh, s.world->epsilon());
    field.buried = s.all_buried();
    field.channels = s.channels();
    field.sums.assign(s.mesh.vertices.size() * std::size_t(field.channels), 0.0);
    field.batches.assign(s.mesh.vertices.size() * path_batches, 0.0);
    return field;
}

bool trace_pass(const Solution::State& s, const std::atomic<bool>& cancel, TracedField& field) {
    std::atomic<bool> cut_short{false};
    const bool done =
        run_slice(field.cursor, static_cast<std::uint32_t>(s.mesh.vertices.size()), 1, cancel,
                  [&](std::uint32_t first, std::uint32_t last) {
                      for (std::uint32_t v = first; v < last; ++v) {
                          if (field.buried[v]) continue;
                          const std::span<double> sums(field.sums.data() + std::size_t(v) * std::size_t(field.channels),
                                                       std::size_t(field.channels));
                          const std::uint32_t seed = hash(s.scene->solve.seed, v);
                          for (std::uint32_t batch = 0; batch < path_batches; ++batch) {
                              if (cut_short.load(std::memory_order_relaxed)) return;
                              bool endless = false;
                              field.batches[std::size_t(v) * path_batches + batch] +=
                                  trace_path(s, field.lights, field.origins[v], s.mesh.vertices[v].normal, seed, batch,
                                             field.passes, sums, &endless);
                              if (endless) cut_short = true;
                          }
                      }
                  });
    field.cut_short = field.cut_short || cut_short;
    if (!done) return false;
    field.cursor = 0;
    ++field.passes;
    return true;
}

} // namespace lueur
