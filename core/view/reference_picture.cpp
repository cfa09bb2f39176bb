#include "core/view/reference_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "core/scene/spectral_content.h"
#include "core/solve/path_tracer.h"
#include "core/solve/relative_error.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

struct Sums {
    glm::dvec3 xyz{0};
    double square = 0; // of Y
};

struct Painter {
    const Solution::State& s;
    PathLights lights;
    std::vector<std::array<std::vector<double>, 3>> by_texel; // of each material
    PictureQuantity quantity;

    Painter(const Solution& solution, PictureQuantity wanted)
        : s(solution.state())
        , lights(make_path_lights(s))
        , quantity(wanted) {
        for (const Material& material : s.scene->materials)
            by_texel.push_back(texel_channels(material, *s.wavelengths));
    }

    glm::dvec3 sample(const Ray& ray, std::uint32_t pixel, std::uint32_t pass, std::uint32_t seed) const {
        const Hit hit = seen_hit(*s.world, ray);
        if (!hit.any() || hit.back_face) return glm::dvec3(0);
        const std::size_t channels = s.wavelengths->xyz_weight.size();
        const glm::uvec3 corners = s.mesh.nodes[hit.element].vertices;
        const float weight[3] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
        glm::vec3 position(0), normal(0), centre(0);
        glm::vec2 uv(0);
        for (int k = 0; k < 3; ++k) {
            const MeshVertex& v = s.mesh.vertices[corners[k]];
            position += weight[k] * v.position;
            normal += weight[k] * v.normal;
            uv += weight[k] * v.uv;
        }
        normal = glm::normalize(normal);
        std::array<double, max_channels> radiance{};
        const std::span<double> light(radiance.data(), channels);
        const double y =
            trace_path(s, lights, position + s.world->epsilon() * normal, normal, hash(seed, pixel), pass, 0, light);
        const glm::dvec3 grey = xyz_from_rgb(srgb) * glm::dvec3(1); // Y is 1
        if (quantity == PictureQuantity::illuminance) return y * grey;

        const std::uint32_t surface = s.mesh.coarse_surface[hit.element], material = s.material_of(surface);
        const auto& texture = s.scene->materials[material].texture;
        if (texture && texture->image && !texture->image->rgb.empty()) {
            const glm::vec3 texel = sample_texture(*texture->image, uv);
            for (std::size_t k = 0; k < channels; ++k) {
                double rho = 0;
                for (int c = 0; c < 3; ++c)
                    rho += double(texel[c]) * by_texel[material][static_cast<std::size_t>(c)][k];
                light[k] *= rho / std::numbers::pi;
            }
        } else
            for (std::size_t k = 0; k < channels; ++k) light[k] *= s.material_rho[material][k] / std::numbers::pi;
        if (const auto l = s.luminaire_of(surface, s.mesh.coarse_back[hit.element] != 0))
            for (std::size_t k = 0; k < channels; ++k) light[k] += s.luminaire_exitance[*l][k] / std::numbers::pi;
        const glm::dvec3 xyz = xyz_from_channels(*s.wavelengths, std::span<const double>(light));
        return quantity == PictureQuantity::luminance ? xyz.y * grey : xyz;
    }
};

double picture_error(const std::vector<Sums>& sums, std::uint32_t passes, std::vector<float>& standard_error) {
    const double n = passes;
    double mean = 0;
    for (const Sums& pixel : sums) mean += pixel.xyz.y / n / double(sums.size());
    double square = 0, counted = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double y = sums[i].xyz.y / n, variance = std::max(0.0, sums[i].square / n - y * y) / (n - 1);
        standard_error[i] = static_cast<float>(std::sqrt(variance));
        if (!(y > dark_share * mean)) continue;
        square += variance / (y * y);
        counted += 1;
    }
    return counted > 0 ? std::sqrt(square / counted) : 0;
}

} // namespace

ReferencePicture trace_picture(const Solution& solution, const Camera& camera, const ReferencePictureParams& params,
                               const std::atomic<bool>& cancel, const std::function<void(double)>& progress) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const std::size_t width = static_cast<std::size_t>(params.width), pixels = width * std::size_t(params.height);
    ReferencePicture picture{{params.width, params.height, {}}, std::vector<float>(pixels, 0), 1, 0};
    if (!solution.world() || pixels == 0) return picture;
    const Painter painter(solution, params.quantity);
    const double aspect = double(params.width) / params.height;
    std::vector<Sums> sums(pixels);
    constexpr int rows_of_a_slice = 16;
    while (picture.passes < params.most_passes) {
        for (int first = 0; first < params.height; first += rows_of_a_slice) {
            if (cancel.load(std::memory_order_relaxed)) return {};
            tbb::parallel_for(first, std::min(first + rows_of_a_slice, params.height), [&](int y) {
                for (int x = 0; x < params.width; ++x) {
                    const std::size_t pixel = std::size_t(y) * width + static_cast<std::size_t>(x);
                    const auto number = static_cast<std::uint32_t>(pixel);
                    const glm::vec2 place = random_offset(hash(params.seed, picture.passes), number);
                    const Ray ray = camera_ray(camera, aspect, (x + double(place.x)) / params.width,
                                               (y + double(place.y)) / params.height);
                    const glm::dvec3 xyz = painter.sample(ray, number, picture.passes, params.seed);
                    sums[pixel].xyz += xyz;
                    sums[pixel].square += xyz.y * xyz.y;
                }
            });
        }
        ++picture.passes;
        if (picture.passes < 2) continue;
        picture.relative_error = picture_error(sums, picture.passes, picture.standard_error);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        const double by_error = std::pow(params.target_error / std::max(1e-9, picture.relative_error), 2.0),
                     by_time = params.time_limit > 0 ? seconds / params.time_limit : 0,
                     by_passes = double(picture.passes) / params.most_passes;
        if (progress) progress(std::min(1.0, std::max({by_error, by_time, by_passes})));
        if (by_error >= 1 || by_time >= 1) break;
    }
    for (const Sums& pixel : sums) picture.image.xyz.push_back(glm::vec3(pixel.xyz / double(picture.passes)));
    return picture;
}

} // namespace lueur
