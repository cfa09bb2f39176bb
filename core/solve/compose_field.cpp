// The solution in channels -> XYZ at the vertices of the fine mesh.
#include <cmath>
#include <numbers>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/scene/spectral_content.h"
#include "core/solve/error_estimate.h"
#include "core/solve/restriction.h"
#include "core/solve/solution_state.h"
#include "core/solve/traced_field.h"
#include "core/spectrum/colour_difference.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;

// XYZ of (weight_k * value_k): three numbers a channel, of some neighbouring channels.
struct ChannelWeights {
    std::size_t first = 0;
    std::vector<glm::vec3> weight;

    glm::vec3 operator()(const float* channels) const {
        glm::vec3 xyz(0);
        for (std::size_t k = 0; k < weight.size(); ++k) xyz += weight[k] * channels[first + k];
        return xyz;
    }
};

ChannelWeights weights_of(const Wavelengths& wavelengths, std::size_t first, const double* factors, double scale) {
    ChannelWeights weights{first, {}};
    for (std::size_t k = 0; k < wavelengths.xyz_weight.size(); ++k)
        weights.weight.emplace_back(scale * (factors ? factors[k] : 1.0) * wavelengths.xyz_weight[k]);
    return weights;
}

// What one set of wavelengths makes of irradiance in channels, on each material.
struct Shader {
    struct OnMaterial {
        ChannelWeights reflected;
        std::array<ChannelWeights, 3> by_texel;
        bool textured = false;
    };
    std::vector<OnMaterial> materials;
    std::vector<glm::vec3> emitted; // of each luminaire
    bool any_texture = false;

    Shader(const Solution::State& s, const Wavelengths& wavelengths, std::size_t first) {
        constexpr double per_steradian = 1 / std::numbers::pi;
        for (std::size_t m = 0; m < s.material_rho.size(); ++m) {
            OnMaterial on{weights_of(wavelengths, first, s.material_rho[m].data() + first, per_steradian), {}, false};
            const Material& material = s.scene->materials[m];
            if (material.texture && material.texture->image) {
                on.textured = any_texture = true;
                const auto texels = texel_channels(material, wavelengths);
                for (std::size_t t = 0; t < 3; ++t)
                    on.by_texel[t] = weights_of(wavelengths, first, texels[t].data(), per_steradian);
            }
            materials.push_back(std::move(on));
        }
        const ChannelWeights seen = weights_of(wavelengths, first, nullptr, per_steradian);
        for (const auto& exitance : s.luminaire_exitance) {
            const std::vector<float> channels(exitance.begin(), exitance.end());
            emitted.push_back(seen(channels.data()));
        }
    }

    void shade(const Solution::State& s, const ChannelField& irradiance, Shades& shades) const {
        const std::uint32_t count = irradiance.count;
        shades.reflected_xyz.assign(count, glm::vec3(0));
        shades.emitted_xyz.assign(count, glm::vec3(0));
        if (any_texture) shades.reflected_by_texel.assign(count, glm::mat3(0));
        tbb::parallel_for(Range(0, count, 512), [&](const Range& range) {
            for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                const MeshVertex& vertex = s.mesh.vertices[v];
                const OnMaterial& on = materials[s.material_of(vertex.surface)];
                shades.reflected_xyz[v] = on.reflected(irradiance[v]);
                if (on.textured)
                    for (int t = 0; t < 3; ++t)
                        shades.reflected_by_texel[v][t] = on.by_texel[static_cast<std::size_t>(t)](irradiance[v]);
                if (const auto luminaire = s.luminaire_of(vertex.surface, vertex.back))
                    shades.emitted_xyz[v] = emitted[*luminaire];
            }
        });
    }
};

// Irradiance of all vertices in channels: indirect light of the coarse ones, interpolated, and direct light.
ChannelField irradiance_channels(const Solution::State& s, std::vector<float>& unshot) {
    const Mesh& mesh = s.mesh;
    const std::uint32_t count = static_cast<std::uint32_t>(mesh.vertices.size());
    const int channels = s.channels();
    ChannelField h(count, channels);
    unshot.assign(count, 0);
    if (s.is_traced()) {
        tbb::parallel_for(Range(0, count, 256), [&](const Range& range) {
            for (std::uint32_t v = range.begin(); v < range.end(); ++v) s.traced->irradiance(v, h[v]);
        });
        fill_buried(mesh.elements, s.traced->buried, h);
        return h;
    }
    if (s.solving && s.solver() != SolverKind::reference) {
        const ChannelField& indirect = s.indirect();
        const std::vector<float> ambient = s.ambient();
        const std::vector<float> left = s.unshot_at_vertices();
        std::copy(left.begin(), left.end(), unshot.begin());
        const bool at_all_vertices = indirect.count == count;
        tbb::parallel_for(Range(0, indirect.count, 256), [&](const Range& range) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i)
                for (int k = 0; k < channels; ++k) h[i][k] = indirect[i][k] + (ambient.empty() ? 0 : ambient[k]);
        });
        if (!at_all_vertices) fill_buried(elements_of_level(mesh, indirect.count), s.buried, h);
        for (std::uint32_t v = indirect.count; v < count; ++v) { // parents come first
            const auto& p = mesh.vertices[v].parents;
            for (int k = 0; k < channels; ++k) h[v][k] = 0.5f * (h[p[0]][k] + h[p[1]][k]);
        }
        for (auto v = static_cast<std::uint32_t>(left.size()); v < count; ++v) {
            const auto& p = mesh.vertices[v].parents;
            unshot[v] = 0.5f * (unshot[p[0]] + unshot[p[1]]);
        }
    }
    Exitances shown = s.luminaire_exitance;
    for (std::size_t l = 0; l < shown.size(); ++l)
        if (!s.luminaire_is_lit(l)) shown[l].clear();
    read_direct(s, shown, h);
    fill_buried(mesh.elements, s.all_buried(), h);
    return h;
}

// White: what a perfect reflector shows of the light that arrives there.
std::vector<float> colour_differences(const Field& field) {
    std::vector<float> differences(field.irradiance_xyz.size(), 0);
    tbb::parallel_for(std::size_t(0), differences.size(), [&](std::size_t v) {
        const Xyz white = Xyz(field.irradiance_xyz[v]) / std::numbers::pi;
        if (!(white.x > 0 && white.y > 0 && white.z > 0)) return;
        const auto lab = [&](const Shades& shades) {
            return lab_from_xyz(glm::max(Xyz(shades.reflected_xyz[v]), Xyz(0)), white);
        };
        differences[v] = static_cast<float>(delta_e_2000(lab(field), lab(*field.trichromatic)));
    });
    return differences;
}

} // namespace

void read_direct(const Solution::State& s, const Exitances& of, ChannelField& irradiance) {
    ChannelField exitance(static_cast<std::uint32_t>(of.size()), s.channels());
    for (std::uint32_t l = 0; l < exitance.count; ++l) std::copy(of[l].begin(), of[l].end(), exitance[l]);
    ChannelField at_rows(s.direct->row_count(), s.channels());
    tbb::parallel_for(Range(0, at_rows.count, 256), [&](const Range& range) {
        for (std::uint32_t r = range.begin(); r < range.end(); ++r)
            for (const DirectShare& share : s.direct->rows()[r])
                for (int k = 0; k < at_rows.stride; ++k) at_rows[r][k] += share.factor * exitance[share.emitter][k];
    });
    s.direct->read_rows(at_rows.values, static_cast<std::size_t>(at_rows.stride), irradiance.values);
}

std::shared_ptr<const Field> compose_field(const Solution::State& s) {
    auto field = std::make_shared<Field>();
    ChannelField irradiance = irradiance_channels(s, field->unshot);
    const ChannelWeights seen = weights_of(*s.wavelengths, 0, nullptr, 1);
    field->irradiance_xyz.resize(irradiance.count);
    tbb::parallel_for(Range(0, irradiance.count, 512), [&](const Range& range) {
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) field->irradiance_xyz[v] = seen(irradiance[v]);
    });
    Shader(s, *s.wavelengths, 0).shade(s, irradiance, *field);
    if (s.trichromatic) {
        field->trichromatic.emplace();
        const auto first = static_cast<std::size_t>(s.wavelengths->size());
        Shader(s, *s.trichromatic, first).shade(s, irradiance, *field->trichromatic);
        field->colour_difference = colour_differences(*field);
    }
    if (irradiance.values.size() <= largest_channel_field) field->irradiance = std::move(irradiance);
    field->wavelengths = s.wavelengths;
    estimate_error(s, *field);
    return field;
}

std::vector<double> irradiance_at(const Solution::State& s, std::uint32_t element, float b1, float b2) {
    const int channels = s.channels();
    std::vector<double> h(channels, 0);
    const Located at_point = locate(s.mesh, element, b1, b2);
    if (s.is_traced()) {
        std::vector<float> row(static_cast<std::size_t>(channels));
        float sum = 0;
        for (int k = 0; k < 3; ++k)
            if (!s.traced->buried[at_point.vertices[k]]) sum += at_point.weights[k];
        for (int k = 0; k < 3; ++k) {
            if (s.traced->buried[at_point.vertices[k]] || sum <= 0) continue;
            s.traced->irradiance(at_point.vertices[k], row.data());
            for (std::size_t c = 0; c < h.size(); ++c) h[c] += double(at_point.weights[k] / sum) * double(row[c]);
        }
        return h;
    }
    if (s.solving && s.solver() != SolverKind::reference) {
        const bool at_all_vertices = s.indirect().count == s.mesh.vertices.size();
        const auto [corners, weights] = locate_on_level(s.mesh, s.indirect().count, element, b1, b2);
        const auto counts = [&](int k) { return at_all_vertices || !s.buried[corners[k]]; };
        float sum = 0;
        for (int k = 0; k < 3; ++k)
            if (counts(k)) sum += weights[k];
        const std::vector<float> ambient = s.ambient();
        for (int k = 0; k < 3; ++k) {
            if (!counts(k) || sum <= 0) continue;
            const float* row = s.indirect()[corners[k]];
            for (int c = 0; c < channels; ++c) h[c] += double(weights[k] / sum) * row[c];
        }
        for (std::size_t c = 0; c < ambient.size(); ++c) h[c] += ambient[c];
    }
    float sum = 0;
    for (int k = 0; k < 3; ++k)
        if (!s.direct->buried()[at_point.vertices[k]]) sum += at_point.weights[k];
    static thread_local std::vector<float> factors;
    factors.assign(s.direct->emitter_count(), 0.0f);
    for (int k = 0; k < 3; ++k)
        if (!s.direct->buried()[at_point.vertices[k]] && sum > 0)
            s.direct->add_factors(at_point.vertices[k], at_point.weights[k] / sum, factors);
    for (std::size_t l = 0; l < factors.size(); ++l) {
        if (factors[l] == 0 || !s.luminaire_is_lit(l)) continue;
        for (int c = 0; c < channels; ++c) h[c] += double(factors[l]) * s.luminaire_exitance[l][c];
    }
    return h;
}

void add_reflected_radiosity(const Solution::State& s, std::uint32_t element, float b1, float b2, double factor,
                             std::span<double> radiosity) {
    const std::vector<double> h = irradiance_at(s, element, b1, b2);
    const std::vector<double>& rho = s.material_rho[s.material_of(s.mesh.coarse_surface[element])];
    for (std::size_t c = 0; c < radiosity.size(); ++c) radiosity[c] += factor * rho[c] * h[c];
}

} // namespace lueur
