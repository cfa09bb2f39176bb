#include "core/solve/shooting.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/solve/least_absorbed.h"
#include "core/transport/polygon_form_factor.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;
constexpr std::uint32_t patches_a_task = 256;
constexpr std::uint32_t shadow_rays = 3; // a receiver and shot
constexpr float most_scaling = 4;        // of a shot that arrives short

} // namespace

Shooting::Shooting(const World& world, const Mesh& mesh, Scenery scenery, std::vector<ChannelField> direct,
                   std::vector<double> emitted_flux, ChannelField rho, std::vector<float> weight, std::uint32_t seed)
    : world_(&world)
    , mesh_(&mesh)
    , origins_(std::move(scenery.origins))
    , buried_(std::move(scenery.buried))
    , luminaire_closed_(std::move(scenery.luminaire_closed))
    , direct_(std::move(direct))
    , emitted_(std::move(emitted_flux))
    , luminaire_shot_(emitted_.size(), 0)
    , rho_(std::move(rho))
    , weight_(std::move(weight))
    , seed_(seed) {
    const int channels = static_cast<int>(weight_.size());
    const std::uint32_t patches = static_cast<std::uint32_t>(mesh.patches.size());
    h_ = ChannelField(mesh.coarse_vertex_count, channels);
    unshot_ = ChannelField(patches, channels);
    unshot_flux_.assign(patches, 0);
    emitted_total_ = std::accumulate(emitted_.begin(), emitted_.end(), 0.0);
    unshot_total_ = emitted_total_;

    lit_share_ = scenery.lit_share;
    patch_area_.assign(patches, 0);
    patch_closed_.assign(patches, 1);
    patch_lit_.assign(patches, 0);
    std::vector<float> least(patches, 1), most(patches, 0);
    patch_first_.assign(patches + 1, 0);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        patch_area_[mesh.coarse_patch[e]] += mesh.coarse_area[e];
        ++patch_first_[mesh.coarse_patch[e] + 1];
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t p = mesh.coarse_patch[e], v = mesh.nodes[e].vertices[k];
            if (!scenery.closed[v]) patch_closed_[p] = 0;
            patch_lit_[p] += mesh.coarse_area[e] / 3 * scenery.lit[v];
            least[p] = std::min(least[p], scenery.lit[v]), most[p] = std::max(most[p], scenery.lit[v]);
        }
    }
    for (std::uint32_t p = 0; p < patches; ++p) {
        if (patch_area_[p] > 0) patch_lit_[p] /= patch_area_[p];
        patch_lit_spread_.push_back(std::max(0.0f, most[p] - least[p]));
    }
    std::partial_sum(patch_first_.begin(), patch_first_.end(), patch_first_.begin());
    patch_elements_.resize(mesh.coarse_element_count);
    std::vector<std::uint32_t> next(patch_first_.begin(), patch_first_.end() - 1);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) patch_elements_[next[mesh.coarse_patch[e]]++] = e;

    mean_rho_channel_.assign(channels, 0);
    double weights = 0;
    for (std::uint32_t p = 0; p < patches; ++p) {
        total_area_ += patch_area_[p];
        for (int c = 0; c < channels; ++c) mean_rho_channel_[c] += double(rho_[p][c]) * patch_area_[p];
    }
    for (int c = 0; c < channels; ++c) {
        if (total_area_ > 0) mean_rho_channel_[c] /= total_area_;
        mean_rho_ += weight_[c] * mean_rho_channel_[c];
        weights += weight_[c];
    }
    if (weights > 0) mean_rho_ /= weights;
}

double Shooting::unshot_share() const {
    return emitted_total_ > 0 ? unshot_total_ / emitted_total_ : 0;
}

// What a patch's elements receive from values at the vertices: their mean, over area. Buried vertices do not count;
// sums go to `out`.
template <int Channels>
void Shooting::add_patch_mean(std::uint32_t patch, const float* values, int stride, float* out) const {
    const Mesh& mesh = *mesh_;
    for (std::uint32_t k = patch_first_[patch]; k < patch_first_[patch + 1]; ++k) {
        const std::uint32_t e = patch_elements_[k];
        const glm::uvec3 v = mesh.nodes[e].vertices;
        std::array<const float*, 3> rows{};
        int count = 0;
        for (int corner = 0; corner < 3; ++corner)
            if (!buried_[v[corner]]) rows[count++] = values + std::size_t(v[corner]) * stride;
        if (count == 0) continue;
        const float share = mesh.coarse_area[e] / (patch_area_[patch] * float(count));
        for (int corner = 0; corner < count; ++corner)
            for (int c = 0; c < Channels; ++c) out[c] += share * rows[corner][c];
    }
}

void Shooting::receive(const ChannelField& irradiance, float scale) {
    const int channels = static_cast<int>(weight_.size());
    tbb::parallel_for(Range(0, unshot_.count, 32), [&](const Range& range) {
        for (std::uint32_t p = range.begin(); p < range.end(); ++p) {
            float mean[max_channels] = {};
            int channel = 0;
            for (; irradiance.stride - channel >= 32; channel += 32)
                add_patch_mean<32>(p, irradiance.values.data() + channel, irradiance.stride, mean + channel);
            for (; channel < irradiance.stride; channel += 8)
                add_patch_mean<8>(p, irradiance.values.data() + channel, irradiance.stride, mean + channel);
            float flux = 0;
            for (int c = 0; c < channels; ++c) {
                unshot_[p][c] += scale * rho_[p][c] * mean[c];
                flux += weight_[c] * unshot_[p][c];
            }
            unshot_flux_[p] = flux * patch_area_[p];
        }
    });
}

double Shooting::arriving(const ChannelField& irradiance) const {
    ChannelField luminous(irradiance.count, 1);
    for (std::uint32_t i = 0; i < irradiance.count; ++i)
        for (std::size_t c = 0; c < weight_.size(); ++c) luminous[i][0] += weight_[c] * irradiance[i][c];
    double sum = 0;
    for (std::uint32_t p = 0; p < unshot_.count; ++p) {
        float mean = 0;
        add_patch_mean<1>(p, luminous.values.data(), luminous.stride, &mean);
        sum += double(patch_area_[p]) * mean;
    }
    return sum;
}

void Shooting::deliver(const std::vector<float>& form_factor, std::uint32_t shooter, const float* radiosity) {
    const int channels = static_cast<int>(weight_.size());
    const double received = tbb::parallel_deterministic_reduce(
        Range(0, unshot_.count, 4 * patches_a_task), 0.0,
        [&](const Range& range, double sum) {
            for (std::uint32_t p = range.begin(); p < range.end(); ++p) {
                float mean = 0;
                add_patch_mean<1>(p, form_factor.data(), 1, &mean);
                sum += double(patch_area_[p]) * mean;
            }
            return sum;
        },
        [](double a, double b) { return a + b; });
    const double area = patch_area_[shooter];
    float scale = 1;
    if (received > area || (patch_closed_[shooter] && received > 0))
        scale = std::min(most_scaling, static_cast<float>(area / received));
    double brightness = 0;
    for (int c = 0; c < channels; ++c) brightness += weight_[c] * radiosity[c];
    arrived_ += brightness * scale * received;
    const double lacking = patch_lit_[shooter] * area - scale * received,
                 open = 0.5 * patch_lit_spread_[shooter] * area;
    lost_ += brightness * std::copysign(std::max(0.0, std::abs(lacking) - open), lacking);
    ChannelField irradiance(mesh_->coarse_vertex_count, channels);
    tbb::parallel_for(Range(0, irradiance.count, patches_a_task), [&](const Range& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            const float f = form_factor[i] * scale;
            if (f <= 0) continue;
            for (int c = 0; c < channels; ++c) {
                irradiance[i][c] = f * radiosity[c];
                h_[i][c] += irradiance[i][c];
            }
        }
    });
    receive(irradiance, 1);
}

// F from each coarse vertex to a patch, times the share of its stratified points that the vertex sees.
std::vector<float> Shooting::form_factors_to(std::uint32_t patch) {
    const Mesh& mesh = *mesh_;
    const glm::uvec3 corner = mesh.patches[patch];
    const std::array<glm::vec3, 3> p{mesh.vertices[corner.x].position, mesh.vertices[corner.y].position,
                                     mesh.vertices[corner.z].position};
    const std::array<glm::dvec3, 3> polygon{p[0], p[1], p[2]};
    const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    const float epsilon = world_->epsilon();
    std::vector<float> form_factor(mesh.coarse_vertex_count, 0);
    std::atomic<std::uint64_t> rays{0};
    tbb::parallel_for(Range(0, mesh.coarse_vertex_count, 64), [&](const Range& range) {
        std::uint64_t cast = 0;
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            if (buried_[i]) continue;
            const glm::vec3 origin = origins_[i];
            if (glm::dot(origin - p[0], normal) <= epsilon) continue;
            const double f = polygon_form_factor(origin, mesh.vertices[i].normal, polygon);
            if (f <= 1e-9) continue;
            int seen = 0;
            for (std::uint32_t k = 0; k < shadow_rays; ++k) {
                const glm::vec2 b = triangle_point(r2_point(k, random_offset(seed_ + shots_, i)));
                const glm::vec3 target = p[0] + b.x * (p[1] - p[0]) + b.y * (p[2] - p[0]) + epsilon * normal;
                seen += !world_->occluded({origin, target - origin, 0, shadow_ray_end});
            }
            cast += shadow_rays;
            form_factor[i] = static_cast<float>(f) * float(seen) / float(shadow_rays);
        }
        rays.fetch_add(cast, std::memory_order_relaxed);
    });
    rays_ += rays.load();
    return form_factor;
}

bool Shooting::shoot() {
    if (emitted_total_ <= 0) return false;
    // Luminaires, the strongest first: their direct light is kept by the transport.
    std::size_t l = emitted_.size();
    for (std::size_t k = 0; k < emitted_.size(); ++k)
        if (!luminaire_shot_[k] && (l == emitted_.size() || emitted_[k] > emitted_[l])) l = k;
    if (l < emitted_.size()) {
        const double received = arriving(direct_[l]);
        float scale = 1;
        if (received > emitted_[l] || (luminaire_closed_[l] && received > 0))
            scale = std::min(most_scaling, static_cast<float>(emitted_[l] / received));
        receive(direct_[l], scale);
        arrived_ += double(scale) * received;
        luminaire_shot_[l] = 1;
        ++luminaires_shot_;
        last_shooter_ = no_index;
    } else {
        const auto largest = std::max_element(unshot_flux_.begin(), unshot_flux_.end());
        if (largest == unshot_flux_.end() || !(*largest > 0)) return false;
        const std::uint32_t j = static_cast<std::uint32_t>(largest - unshot_flux_.begin());
        const std::vector<float> form_factor = form_factors_to(j);
        std::vector<float> radiosity(unshot_[j], unshot_[j] + weight_.size());
        std::fill(unshot_[j], unshot_[j] + weight_.size(), 0.0f);
        deliver(form_factor, j, radiosity.data());
        last_shooter_ = j;
    }
    ++shots_;
    double unshot = 0;
    for (const float f : unshot_flux_) unshot += f;
    for (std::size_t k = 0; k < emitted_.size(); ++k)
        if (!luminaire_shot_[k]) unshot += emitted_[k];
    unshot_total_ = unshot;
    if (unshot_.count > 0 && luminaires_shot_ == emitted_.size() && (shots_ - luminaires_shot_) % unshot_.count == 0)
        missing_.push_back(missing_share());
    return true;
}

double Shooting::missing_share() const {
    if (!(emitted_total_ > 0)) return 0;
    if (luminaires_shot_ < emitted_.size()) return 1;
    const double absorbed = std::max(least_absorbed, 1 - mean_rho_ * lit_share_);
    const double missing = unshot_total_ / absorbed;
    return arrived_ > 0 ? std::min(1.0, missing / (missing + arrived_)) : 0;
}

double Shooting::lost_share() const {
    const double lost = lost_ / std::max(least_absorbed, 1 - mean_rho_ * lit_share_);
    return arrived_ + std::abs(lost) > 0 ? lost / (arrived_ + std::abs(lost)) : 0;
}

double Shooting::shots_needed(double enough) const {
    if (missing_.size() < 3 || !(missing_.back() > enough)) return 0;
    const double rate = missing_.back() / missing_[missing_.size() - 2];
    if (!(rate < 1)) return 1e30;
    return shots_ + unshot_.count * std::log(enough / missing_.back()) / std::log(rate);
}

std::vector<float> Shooting::ambient() const {
    // B_ambient = R sum_j dB_j A_j / sum_k A_k, R = 1 / (1 - rho_ave) (corrections 34: display only, capped where
    // rho_ave -> 1).
    const int channels = static_cast<int>(weight_.size());
    std::vector<double> sum(channels, 0);
    for (std::uint32_t p = 0; p < unshot_.count; ++p)
        for (int c = 0; c < channels; ++c) sum[c] += double(unshot_[p][c]) * patch_area_[p];
    std::vector<float> ambient(channels, 0);
    for (int c = 0; c < channels; ++c)
        if (total_area_ > 0)
            ambient[c] = static_cast<float>(sum[c] / total_area_ / (1 - std::min(mean_rho_channel_[c], 0.98)));
    return ambient;
}

std::vector<float> Shooting::unshot_at_vertices() const {
    const Mesh& mesh = *mesh_;
    std::vector<float> value(mesh.coarse_vertex_count, 0), count(mesh.coarse_vertex_count, 0);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        const std::uint32_t p = mesh.coarse_patch[e];
        const float exitance = patch_area_[p] > 0 ? unshot_flux_[p] / patch_area_[p] : 0;
        for (int k = 0; k < 3; ++k) value[mesh.nodes[e].vertices[k]] += exitance, count[mesh.nodes[e].vertices[k]] += 1;
    }
    for (std::size_t v = 0; v < value.size(); ++v)
        if (count[v] > 0) value[v] /= count[v];
    return value;
}

} // namespace lueur
