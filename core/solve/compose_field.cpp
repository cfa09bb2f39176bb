// The solution in channels -> XYZ at the vertices of the fine mesh.
#include <numbers>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/restriction.h"
#include "core/solve/solution_state.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;

// XYZ of (weight_k * value_k) for one material: 3 numbers a channel.
using ChannelWeights = std::vector<glm::vec3>;

ChannelWeights irradiance_weights(const Solution::State& s) {
    ChannelWeights weights;
    for (const Xyz& w : s.wavelengths.xyz_weight) weights.emplace_back(w);
    return weights;
}

std::vector<ChannelWeights> reflected_weights(const Solution::State& s) {
    std::vector<ChannelWeights> all;
    for (const auto& rho : s.material_rho) {
        ChannelWeights weights;
        for (std::size_t k = 0; k < rho.size(); ++k)
            weights.emplace_back(s.wavelengths.xyz_weight[k] * rho[k] / std::numbers::pi);
        all.push_back(std::move(weights));
    }
    return all;
}

glm::vec3 weigh(const ChannelWeights& weights, const float* channels) {
    glm::vec3 xyz(0);
    for (std::size_t k = 0; k < weights.size(); ++k) xyz += weights[k] * channels[k];
    return xyz;
}

} // namespace

std::shared_ptr<const Field> compose_field(const Solution::State& s) {
    auto field = std::make_shared<Field>();
    const Mesh& mesh = s.mesh;
    const std::uint32_t count = static_cast<std::uint32_t>(mesh.vertices.size()), coarse = mesh.coarse_vertex_count;
    field->irradiance_xyz.assign(count, glm::vec3(0));
    field->reflected_xyz.assign(count, glm::vec3(0));
    field->emitted_xyz.assign(count, glm::vec3(0));
    field->unshot.assign(count, 0);
    const ChannelWeights irradiance = irradiance_weights(s);
    const std::vector<ChannelWeights> reflected = reflected_weights(s);

    if (s.solving) {
        const ChannelField& indirect = s.indirect();
        const std::vector<float> ambient = s.ambient();
        std::vector<float> unshot;
        if (s.scene->solve.solver == SolverKind::shooting) unshot = s.shooting.unshot_at_vertices();
        tbb::parallel_for(Range(0, coarse, 256), [&](const Range& range) {
            std::array<float, max_channels> h{};
            for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
                for (int k = 0; k < s.wavelengths.size(); ++k)
                    h[k] = indirect[i][k] + (ambient.empty() ? 0 : ambient[k]);
                field->irradiance_xyz[i] = weigh(irradiance, h.data());
                field->reflected_xyz[i] = weigh(reflected[s.material_of(mesh.vertices[i].surface)], h.data());
                if (!unshot.empty())
                    field->unshot[i] = unshot[i];
                else
                    field->unshot[i] = std::abs(weigh(irradiance, s.system.residual()[s.receivers.of_vertex[i]]).y);
            }
        });
        std::vector<glm::uvec3> coarse_elements;
        for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) coarse_elements.push_back(mesh.nodes[e].vertices);
        fill_buried(coarse_elements, s.buried, field->irradiance_xyz);
        fill_buried(coarse_elements, s.buried, field->reflected_xyz);
        for (std::uint32_t v = coarse; v < count; ++v) { // parents come first
            const auto& p = mesh.vertices[v].parents;
            field->irradiance_xyz[v] = 0.5f * (field->irradiance_xyz[p[0]] + field->irradiance_xyz[p[1]]);
            field->reflected_xyz[v] = 0.5f * (field->reflected_xyz[p[0]] + field->reflected_xyz[p[1]]);
            field->unshot[v] = 0.5f * (field->unshot[p[0]] + field->unshot[p[1]]);
        }
    }

    // Direct light: XYZ of each luminaire's exitance, as irradiance and as seen on each material.
    const std::size_t emitters = s.direct->emitter_count();
    std::vector<glm::vec3> emitter_xyz(emitters);
    std::vector<std::vector<glm::vec3>> emitter_on_material(s.material_rho.size(), std::vector<glm::vec3>(emitters));
    for (std::size_t l = 0; l < emitters; ++l) {
        if (!s.luminaire_is_lit(l)) continue;
        const std::vector<float> exitance(s.luminaire_exitance[l].begin(), s.luminaire_exitance[l].end());
        emitter_xyz[l] = weigh(irradiance, exitance.data());
        for (std::size_t m = 0; m < reflected.size(); ++m)
            emitter_on_material[m][l] = weigh(reflected[m], exitance.data());
    }
    tbb::parallel_for(Range(0, count, 512), [&](const Range& range) {
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
            const MeshVertex& vertex = mesh.vertices[v];
            const float* d = s.direct->at_vertex(v);
            const auto& on_material = emitter_on_material[s.material_of(vertex.surface)];
            for (std::size_t l = 0; l < emitters; ++l) {
                field->irradiance_xyz[v] += d[l] * emitter_xyz[l];
                field->reflected_xyz[v] += d[l] * on_material[l];
            }
            if (const auto* exitance = s.exitance_of(vertex.surface, vertex.back))
                field->emitted_xyz[v] = glm::vec3(xyz_from_channels(s.wavelengths, *exitance) / std::numbers::pi);
        }
    });
    const std::vector<std::uint8_t> buried = s.all_buried();
    fill_buried(mesh.elements, buried, field->irradiance_xyz);
    fill_buried(mesh.elements, buried, field->reflected_xyz);
    return field;
}

std::vector<double> irradiance_at(const Solution::State& s, std::uint32_t element, float b1, float b2) {
    const int channels = s.wavelengths.size();
    std::vector<double> h(channels, 0);
    const glm::uvec3 corners = s.mesh.nodes[element].vertices;
    const float coarse_weight[3] = {1 - b1 - b2, b1, b2};
    if (s.solving) {
        float sum = 0;
        for (int k = 0; k < 3; ++k)
            if (!s.buried[corners[k]]) sum += coarse_weight[k];
        const std::vector<float> ambient = s.ambient();
        for (int k = 0; k < 3; ++k) {
            if (s.buried[corners[k]] || sum <= 0) continue;
            const float* row = s.indirect()[corners[k]];
            for (int c = 0; c < channels; ++c) h[c] += double(coarse_weight[k] / sum) * row[c];
        }
        for (std::size_t c = 0; c < ambient.size(); ++c) h[c] += ambient[c];
    }
    const Located at_point = locate(s.mesh, element, b1, b2);
    float sum = 0;
    for (int k = 0; k < 3; ++k)
        if (!s.direct->buried()[at_point.vertices[k]]) sum += at_point.weights[k];
    for (std::size_t l = 0; l < s.direct->emitter_count(); ++l) {
        if (!s.luminaire_is_lit(l)) continue;
        double d = 0;
        for (int k = 0; k < 3; ++k)
            if (!s.direct->buried()[at_point.vertices[k]] && sum > 0)
                d += double(at_point.weights[k] / sum) * s.direct->at_vertex(at_point.vertices[k])[l];
        for (int c = 0; c < channels; ++c) h[c] += d * s.luminaire_exitance[l][c];
    }
    return h;
}

void add_reflected_radiosity(const Solution::State& s, std::uint32_t element, float b1, float b2, double factor,
                             std::span<double> radiosity) {
    const std::vector<double> h = irradiance_at(s, element, b1, b2);
    const std::vector<double>& rho = s.material_rho[s.material_of(s.mesh.coarse_surface[element])];
    for (std::size_t c = 0; c < h.size(); ++c) radiosity[c] += factor * rho[c] * h[c];
}

} // namespace lueur
