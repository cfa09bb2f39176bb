#include "core/solve/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/sampling.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;

constexpr std::size_t most_neighbours = 20;
constexpr std::uint32_t rows_at_a_time = 1 << 15;
constexpr float same_plane = 0.97f;     // cosine between normals
constexpr double least_gain = 0.8;      // variance left: for less it is not worth the bend
constexpr float reach_of_a_pass = 0.5f; // of the distance around, for 32 rays

// Neighbours of each vertex along edges, as rows.
struct Ring {
    std::vector<std::uint32_t> first, neighbour;
    // Each element tells each corner of the next one: at the rim, where an edge has one element, one way suffices.
    Ring(std::span<const glm::uvec3> elements, std::size_t vertices)
        : first(vertices + 1, 0) {
        for (const glm::uvec3& e : elements)
            for (int k = 0; k < 3; ++k) first[e[k] + 1] += 1;
        for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
        neighbour.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (const glm::uvec3& e : elements)
            for (int k = 0; k < 3; ++k) {
                neighbour[next[e[k]]++] = e[(k + 1) % 3];
            }
    }
    std::span<const std::uint32_t> of(std::uint32_t v) const {
        return std::span(neighbour).subspan(first[v], first[v + 1] - first[v]);
    }
};

struct Row {
    std::array<std::uint32_t, most_neighbours> vertex;
    std::array<float, most_neighbours> weight;
    std::size_t count = 0;
    bool has(std::uint32_t v) const {
        return std::find(vertex.begin(), vertex.begin() + count, v) != vertex.begin() + count;
    }
};

// Weighted least squares h0 + g . x: h0 as a linear map of the values. False: no plane, or nothing gained.
bool fit_plane(std::span<const glm::dvec2> place, Row& row) {
    // Normal matrix of (1, x, y).
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t k = 0; k < row.count; ++k) {
        const double w = double(row.weight[k]), x = place[k].x, y = place[k].y;
        s += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y, syy += w * y * y;
    }
    const double c0 = sxx * syy - sxy * sxy, c1 = sxy * sy - sx * syy, c2 = sx * sxy - sxx * sy;
    const double determinant = s * c0 + sx * c1 + sy * c2;
    const double scale = s * (sxx + syy) * (sxx + syy);
    if (!(determinant > 1e-3 * scale)) return false;
    double variance = 0;
    for (std::size_t k = 0; k < row.count; ++k) {
        const double w = double(row.weight[k]) * (c0 + c1 * place[k].x + c2 * place[k].y) / determinant;
        row.weight[k] = static_cast<float>(w);
        variance += w * w;
    }
    return variance < least_gain;
}

Row row_of(const Mesh& mesh, const Ring& ring, std::span<const std::uint8_t> buried, std::span<const float> distance,
           float reach, float farthest, std::uint32_t v) {
    Row row;
    if (buried[v]) return row;
    const MeshVertex& at = mesh.vertices[v];
    const Frame frame(at.normal);
    std::array<glm::dvec2, most_neighbours> place;
    row.vertex[0] = v, row.weight[0] = 1, place[0] = {0, 0};
    row.count = 1;
    for (std::size_t k = 0; k < row.count && row.count < most_neighbours; ++k) // outwards, ring by ring
        for (const std::uint32_t n : ring.of(row.vertex[k])) {
            if (row.count == most_neighbours || buried[n]) continue;
            const MeshVertex& other = mesh.vertices[n];
            const glm::vec3 d = other.position - at.position;
            const float radius = std::min(farthest, reach * std::min(distance[v], distance[n]));
            const float far = glm::dot(d, d) / (radius * radius);
            if (!(far < 1) || glm::dot(at.normal, other.normal) < same_plane || row.has(n)) continue;
            row.vertex[row.count] = n;
            row.weight[row.count] = (1 - far) * (1 - far);
            place[row.count] = glm::dvec2(glm::dot(d, frame.x), glm::dot(d, frame.y)) / double(radius);
            ++row.count;
        }
    if (row.count < 4 || !fit_plane(std::span(place).first(row.count), row)) row.count = 0;
    return row;
}

} // namespace

float smoothing_reach(std::uint32_t rays) {
    return rays > 0 ? reach_of_a_pass * std::pow(static_cast<float>(rays) / 32, -1 / 6.0f) : 0;
}

Smoothing make_smoothing(const Mesh& mesh, std::span<const glm::uvec3> elements, std::span<const std::uint8_t> buried,
                         std::span<const float> distance, float reach, float farthest) {
    const std::uint32_t count = static_cast<std::uint32_t>(distance.size());
    const Ring ring(elements, count);
    Smoothing smoothing;
    smoothing.first.reserve(count + 1);
    smoothing.first.push_back(0);
    std::vector<Row> rows; // of some vertices at a time: most of a fine mesh's are empty
    for (std::uint32_t begin = 0; begin < count; begin += rows_at_a_time) {
        rows.assign(std::min(rows_at_a_time, count - begin), {});
        tbb::parallel_for(Range(0, static_cast<std::uint32_t>(rows.size()), 128), [&](const Range& range) {
            for (std::uint32_t r = range.begin(); r < range.end(); ++r)
                rows[r] = row_of(mesh, ring, buried, distance, reach, farthest, begin + r);
        });
        for (const Row& row : rows) {
            smoothing.neighbour.insert(smoothing.neighbour.end(), row.vertex.begin(), row.vertex.begin() + row.count);
            smoothing.weight.insert(smoothing.weight.end(), row.weight.begin(), row.weight.begin() + row.count);
            smoothing.first.push_back(static_cast<std::uint32_t>(smoothing.neighbour.size()));
        }
    }
    return smoothing;
}

void smooth(const Smoothing& smoothing, ChannelField& field) {
    if (smoothing.empty()) return;
    const ChannelField before = field;
    const auto stride = static_cast<std::size_t>(field.stride);
    const auto rows = static_cast<std::uint32_t>(std::min<std::size_t>(field.count, smoothing.first.size() - 1));
    tbb::parallel_for(Range(0, rows, 128), [&](const Range& range) {
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
            const std::uint32_t first = smoothing.first[v], last = smoothing.first[v + 1];
            if (first == last) continue;
            float* out = field[v];
            std::fill_n(out, stride, 0.0f);
            for (std::uint32_t k = first; k < last; ++k) {
                const float weight = smoothing.weight[k];
                const float* row = before[smoothing.neighbour[k]];
                for (std::size_t c = 0; c < stride; ++c) out[c] += weight * row[c];
            }
        }
    });
}

void smooth(const Smoothing& smoothing, std::vector<float>& values) {
    if (smoothing.empty()) return;
    const std::vector<float> before = values;
    for (std::size_t v = 0; v + 1 < smoothing.first.size(); ++v) {
        if (smoothing.first[v] == smoothing.first[v + 1]) continue;
        values[v] = 0;
        for (std::uint32_t k = smoothing.first[v]; k < smoothing.first[v + 1]; ++k)
            values[v] += smoothing.weight[k] * before[smoothing.neighbour[k]];
    }
}

} // namespace lueur
