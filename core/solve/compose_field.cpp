// The solution in channels -> XYZ at the vertices of the fine mesh.
#include <cmath>
#include <numbers>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/scene/spectral_content.h"
#include "core/solve/best_vectors.h"
#include "core/solve/error_estimate.h"
#include "core/solve/restriction.h"
#include "core/solve/solution_state.h"
#include "core/solve/traced_field.h"
#include "core/spectrum/colour_difference.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;

// XYZ of (weight_k * value_k): of all channels the weights of X, then of Y and of Z, those of other wavelengths 0.
struct ChannelWeights {
    std::size_t stride = 0;
    std::vector<float> weight;

    glm::vec3 operator()(const float* channels) const { return sums(weight.data(), channels, stride); }

private:
    LUEUR_BEST_VECTORS static glm::vec3 sums(const float* weight, const float* channels, std::size_t stride) {
        Lanes x{}, y{}, z{};
        for (std::size_t c = 0; c < stride; c += register_channels) {
            const Lanes value = *reinterpret_cast<const Lanes*>(channels + c);
            x += *reinterpret_cast<const Lanes*>(weight + c) * value;
            y += *reinterpret_cast<const Lanes*>(weight + stride + c) * value;
            z += *reinterpret_cast<const Lanes*>(weight + 2 * stride + c) * value;
        }
        glm::vec3 xyz(0);
        for (std::size_t c = 0; c < register_channels; ++c) xyz += glm::vec3(x[c], y[c], z[c]);
        return xyz;
    }
};

// first: where the wavelengths' channels begin in rows of `stride`.
ChannelWeights weights_of(const Wavelengths& wavelengths, std::size_t first, std::size_t stride, const double* factors,
                          double scale) {
    ChannelWeights weights{stride, std::vector<float>(3 * stride, 0.0f)};
    for (std::size_t k = 0; k < wavelengths.xyz_weight.size(); ++k)
        for (int axis = 0; axis < 3; ++axis)
            weights.weight[static_cast<std::size_t>(axis) * stride + first + k] =
                static_cast<float>(scale * (factors ? factors[k] : 1.0) * wavelengths.xyz_weight[k][axis]);
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
        const auto stride = static_cast<std::size_t>(ChannelField(0, s.channels()).stride);
        for (std::size_t m = 0; m < s.material_rho.size(); ++m) {
            OnMaterial on{
                weights_of(wavelengths, first, stride, s.material_rho[m].data() + first, per_steradian), {}, false};
            const Material& material = s.scene->materials[m];
            if (material.texture && material.texture->image) {
                on.textured = any_texture = true;
                const auto texels = texel_channels(material, wavelengths);
                for (std::size_t t = 0; t < 3; ++t)
                    on.by_texel[t] = weights_of(wavelengths, first, stride, texels[t].data(), per_steradian);
            }
            materials.push_back(std::move(on));
        }
        const ChannelWeights seen = weights_of(wavelengths, first, stride, nullptr, per_steradian);
        for (const auto& exitance : s.luminaire_exitance) {
            std::vector<float> channels(exitance.begin(), exitance.end());
            channels.resize(stride, 0.0f);
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

LUEUR_BEST_VECTORS void add_shares(std::span<const DirectShare> row, const ChannelField& exitance, float* irradiance) {
    for (int c = 0; c < exitance.stride; c += int(register_channels)) {
        Lanes sum = *reinterpret_cast<const Lanes*>(irradiance + c);
        for (const DirectShare& share : row)
            sum += share.factor * *reinterpret_cast<const Lanes*>(exitance[share.emitter] + c);
        *reinterpret_cast<Lanes*>(irradiance + c) = sum;
    }
}

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
    // Rows of samples are read with weights; where all vertices are samples, the vertices are the rows.
    const bool sampled = s.direct->samples().count() > 0;
    ChannelField at_rows(sampled ? s.direct->row_count() : 0, s.channels());
    tbb::parallel_for(Range(0, s.direct->row_count(), 256), [&](const Range& range) {
        for (std::uint32_t r = range.begin(); r < range.end(); ++r)
            add_shares(s.direct->rows()[r], exitance, sampled ? at_rows[r] : irradiance[r]);
    });
    if (sampled) s.direct->read_rows(at_rows.values, static_cast<std::size_t>(at_rows.stride), irradiance.values);
}

std::shared_ptr<const Field> compose_field(const Solution::State& s) {
    auto field = std::make_shared<Field>();
    ChannelField irradiance = irradiance_channels(s, field->unshot);
    const ChannelWeights seen = weights_of(*s.wavelengths, 0, static_cast<std::size_t>(irradiance.stride), nullptr, 1);
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
