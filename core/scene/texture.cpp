#include "core/scene/texture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/files.h"
#include "core/scene/scene_file.h"

namespace lueur {

namespace {

constexpr double most_rows = 2048; // texels read along each axis of one triangle; beyond it every n-th

glm::dvec3 texel(const TextureImage& image, double x, double y) { // in texels; repeats
    const auto wrapped = [](double index, int size) {
        const double rest = index - std::floor(index / size) * size;
        return std::clamp(static_cast<int>(rest), 0, size - 1);
    };
    const auto row = static_cast<std::size_t>(wrapped(y, image.height)), column = static_cast<std::size_t>(wrapped(x, image.width));
    return glm::dvec3(image.rgb[row * static_cast<std::size_t>(image.width) + column]);
}

// Mean over a triangle in texel coordinates: texel centres inside it, row by row; a triangle that holds few is sampled instead.
glm::dvec3 mean_over(const TextureImage& image, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double low_y = std::min({a.y, b.y, c.y}), high_y = std::max({a.y, b.y, c.y});
    const double low_x = std::min({a.x, b.x, c.x}), high_x = std::max({a.x, b.x, c.x});
    const double step_y = std::max(1.0, std::ceil((high_y - low_y) / most_rows)), step_x = std::max(1.0, std::ceil((high_x - low_x) / most_rows));
    glm::dvec3 sum{0};
    double count = 0;
    if (high_y - low_y < 1e9 && high_x - low_x < 1e9)
        for (double y = std::floor(low_y) + 0.5; y <= high_y; y += step_y) {
            double from = 1e300, to = -1e300;
            for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
                if ((p.y <= y) == (q.y <= y)) continue;
                const double x = p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y);
                from = std::min(from, x);
                to = std::max(to, x);
            }
            for (double x = low_x + std::max(0.0, std::ceil((from - low_x) / step_x - 0.5)) * step_x + 0.5 * step_x; x < to; x += step_x) {
                if (x < from) continue;
                sum += texel(image, x, y);
                count += 1;
            }
        }
    constexpr int samples = 8; // along an edge
    if (count >= samples * samples) return sum / count;
    sum = glm::dvec3(0);
    for (int i = 0; i < samples; ++i)
        for (int j = 0; j < samples; ++j) { // the square folded onto the triangle keeps area
            double u = (i + 0.5) / samples, v = (j + 0.5) / samples;
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const glm::dvec2 p = a + (b - a) * u + (c - a) * v;
            sum += texel(image, p.x, p.y);
        }
    return sum / static_cast<double>(samples * samples);
}

} // namespace

Rgb mean_texel(const TextureImage& image, std::span<const Vertex> vertices, std::span<const glm::uvec3> triangles) {
    if (image.rgb.empty()) return Rgb(0.5);
    const glm::dvec2 size(image.width, image.height);
    glm::dvec3 sum{0};
    double area = 0;
    for (const glm::uvec3& t : triangles) {
        const Vertex &a = vertices[t.x], &b = vertices[t.y], &c = vertices[t.z];
        const double weight = glm::length(glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position)));
        if (!(weight > 0)) continue;
        const glm::dvec2 p = glm::dvec2(a.uv) * size, q = glm::dvec2(b.uv) * size, r = glm::dvec2(c.uv) * size;
        if (!std::isfinite(p.x + p.y + q.x + q.y + r.x + r.y)) continue;
        sum += weight * mean_over(image, p, q, r);
        area += weight;
    }
    if (area == 0) {
        for (const glm::vec3& value : image.rgb) sum += glm::dvec3(value);
        area = static_cast<double>(image.rgb.size());
    }
    return glm::clamp(sum / area, 0.0, 1.0);
}

bool has_no_uv(std::span<const Vertex> vertices, std::span<const glm::uvec3> triangles) {
    if (triangles.empty()) return false;
    const glm::vec2 first = vertices[triangles[0].x].uv;
    return std::all_of(triangles.begin(), triangles.end(), [&](const glm::uvec3& t) {
        return vertices[t.x].uv == first && vertices[t.y].uv == first && vertices[t.z].uv == first;
    });
}

std::vector<glm::uvec3> triangles_of_material(const Scene& scene, MaterialIndex material) {
    const Geometry& geometry = *scene.geometry;
    std::vector<glm::uvec3> triangles;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        const Surface& surface = geometry.surfaces[at(geometry.triangle_surface[i])];
        if (scene.objects[at(surface.object)].material == material) triangles.push_back(geometry.triangles[i]);
    }
    return triangles;
}

std::expected<Texture, std::string> load_texture(const Scene& scene, const std::filesystem::path& file) {
    const std::filesystem::path full = scene.folder / file; // an absolute path stays itself
    if (const auto why = why_unreadable(full)) return std::unexpected(fmt::format("{}: {}", full.string(), *why));
    auto image = read_texture(full);
    if (!image) return std::unexpected(image.error());
    Texture texture;
    texture.path = scene.folder.empty() || file.is_relative() ? file.generic_string()
                                                             : full.lexically_normal().lexically_proximate(scene.folder).generic_string();
    texture.image = std::make_shared<const TextureImage>(std::move(*image));
    return texture;
}

void set_texture(Scene& scene, MaterialIndex material, Texture texture) {
    texture.mean = mean_texel(*texture.image, scene.geometry->vertices, triangles_of_material(scene, material));
    Material& changed = scene.materials[at(material)];
    changed.reflectance = texture.mean;
    changed.texture = std::move(texture);
}

} // namespace lueur
