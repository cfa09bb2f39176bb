#include "core/scene/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/files.h"
#include "core/scene/scene_file.h"

namespace lueur {

namespace {

constexpr double total_reads = 1 << 20;                   // texels read for a mean, about
constexpr double fewest_reads = 64, most_reads = 1 << 16; // of one triangle
constexpr double exact_rows =
    16; // up to so many texels along both axes each is weighted by the part of it that is covered

glm::dvec3 texel(const TextureImage& image, double x, double y) { // in texels; repeats
    const auto wrapped = [](double index, int size) {
        const double rest = index - std::floor(index / size) * size;
        return std::clamp(static_cast<int>(rest), 0, size - 1);
    };
    const auto row = static_cast<std::size_t>(wrapped(y, image.height)),
               column = static_cast<std::size_t>(wrapped(x, image.width));
    return glm::dvec3(image.rgb[row * static_cast<std::size_t>(image.width) + column]);
}

using Polygon = std::array<glm::dvec2, 8>; // a triangle cut by a square has at most 7 corners

// Keeps what lies on one side of x = at (axis 0) or y = at (axis 1) (Sutherland & Hodgman 1974).
std::size_t cut(Polygon& polygon, std::size_t count, int axis, double at, double side) {
    Polygon result;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % count];
        const double from = side * (p[axis] - at), to = side * (q[axis] - at);
        if (from >= 0) result[kept++] = p;
        if ((from < 0) != (to < 0) && kept < result.size()) result[kept++] = p + (q - p) * (from / (from - to));
    }
    polygon = result;
    return kept;
}

// Area of the triangle inside the unit square whose corner is (x, y).
double covered_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, double x, double y) {
    Polygon polygon{a, b, c};
    std::size_t count = cut(polygon, 3, 0, x, 1);
    count = cut(polygon, count, 0, x + 1, -1);
    count = cut(polygon, count, 1, y, 1);
    count = cut(polygon, count, 1, y + 1, -1);
    double twice = 0;
    for (std::size_t i = 2; i < count; ++i) {
        const glm::dvec2 u = polygon[i - 1] - polygon[0], v = polygon[i] - polygon[0];
        twice += u.x * v.y - u.y * v.x;
    }
    return std::abs(twice) / 2;
}

// Mean at points spread evenly over the triangle by the R2 sequence (Roberts 2018): pictures that repeat many times do
// not beat with it.
glm::dvec3 sampled_mean(const TextureImage& image, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                        int samples) {
    glm::dvec3 sum{0};
    double u = 0.5, v = 0.5;
    for (int i = 0; i < samples; ++i) {
        u = u + 0.7548776662466927 - (u >= 1 - 0.7548776662466927 ? 1 : 0);
        v = v + 0.5698402909980532 - (v >= 1 - 0.5698402909980532 ? 1 : 0);
        const bool folded = u + v > 1; // the square folded onto the triangle keeps area
        const glm::dvec2 p = a + (b - a) * (folded ? 1 - u : u) + (c - a) * (folded ? 1 - v : v);
        sum += texel(image, p.x, p.y);
    }
    return sum / static_cast<double>(samples);
}

// Mean over a triangle in texel coordinates: a small one exactly, a larger one by the texel centres inside it, row by
// row; one that holds more texels than may be read, a sliver and one without area are sampled.
glm::dvec3 mean_over(const TextureImage& image, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                     double reads) {
    const double low_y = std::min({a.y, b.y, c.y}), high_y = std::max({a.y, b.y, c.y});
    const double low_x = std::min({a.x, b.x, c.x}), high_x = std::max({a.x, b.x, c.x});
    const double extent = std::max(high_x - low_x, high_y - low_y);
    if ((high_x - low_x) * (high_y - low_y) > 2 * reads || extent > reads)
        return sampled_mean(image, a, b, c, static_cast<int>(reads));
    glm::dvec3 sum{0};
    double weight = 0;
    if (extent <= exact_rows) {
        for (double y = std::floor(low_y); y < high_y; y += 1)
            for (double x = std::floor(low_x); x < high_x; x += 1)
                if (const double part = covered_area(a, b, c, x, y); part > 0) {
                    sum += part * texel(image, x, y);
                    weight += part;
                }
        return weight > 1e-12 ? sum / weight : sampled_mean(image, a, b, c, 256);
    }
    for (double y = std::floor(low_y) + 0.5; y <= high_y; y += 1) {
        double from = 1e300, to = -1e300;
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            if ((p.y <= y) == (q.y <= y)) continue;
            const double x = p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        for (double x = std::ceil(from - 0.5) + 0.5; x < to; x += 1) {
            sum += texel(image, x, y);
            weight += 1;
        }
    }
    return weight >= 64 ? sum / weight : sampled_mean(image, a, b, c, 1024);
}

} // namespace

Rgb mean_texel(const TextureImage& image, std::span<const Vertex> vertices, std::span<const glm::uvec3> triangles) {
    if (image.rgb.empty()) return Rgb(0.5);
    const glm::dvec2 size(image.width, image.height);
    std::vector<double> weight;
    double area = 0;
    for (const glm::uvec3& t : triangles) {
        const Vertex &a = vertices[t.x], &b = vertices[t.y], &c = vertices[t.z];
        const bool has_uv = std::isfinite(a.uv.x + a.uv.y + b.uv.x + b.uv.y + c.uv.x + c.uv.y);
        const double twice =
            glm::length(glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position)));
        weight.push_back(has_uv && std::isfinite(twice) ? twice : 0);
        area += weight.back();
    }
    glm::dvec3 sum{0};
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (weight[i] == 0) continue;
        const glm::uvec3& t = triangles[i];
        const double reads = std::clamp(total_reads * weight[i] / area, fewest_reads, most_reads);
        sum += weight[i] * mean_over(image, glm::dvec2(vertices[t.x].uv) * size, glm::dvec2(vertices[t.y].uv) * size,
                                     glm::dvec2(vertices[t.z].uv) * size, reads);
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
    texture.path = scene.folder.empty() || file.is_relative()
                       ? file.generic_string()
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
