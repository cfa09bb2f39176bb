#include "core/solve/error_mesh.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;

// Lists of what belongs to each of `count`, one after another: first[i]..first[i + 1] of `of`.
void make_lists(std::uint32_t count, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& belongs,
                std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& of) {
    first.assign(count + 1, 0);
    for (const auto& [owner, item] : belongs) ++first[owner + 1];
    for (std::uint32_t i = 0; i < count; ++i) first[i + 1] += first[i];
    of.resize(belongs.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& [owner, item] : belongs) of[next[owner]++] = item;
}

// Of the terms in each vertex's list; 0 where it is empty.
template <typename Term>
std::vector<float> mean_of_squares(std::size_t count, const std::vector<std::uint32_t>& first, const Term& term) {
    std::vector<float> mean(count, 0);
    const auto known = static_cast<std::uint32_t>(first.empty() ? 0 : std::min(count, first.size() - 1));
    tbb::parallel_for(Range(0, known, 1024), [&](const Range& range) {
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
            float sum = 0;
            for (std::uint32_t k = first[v]; k < first[v + 1]; ++k) sum += term(v, k);
            if (first[v + 1] > first[v]) mean[v] = sum / static_cast<float>(first[v + 1] - first[v]);
        }
    });
    return mean;
}

} // namespace

Bends::Bends(std::span<const glm::uvec3> elements, const Mesh& mesh, const std::vector<std::uint8_t>& left_out) {
    struct Edge {
        std::uint64_t key;
        std::uint32_t element, far;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * elements.size());
    std::uint32_t count = 0;
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = elements[e][k], b = elements[e][(k + 1) % 3];
            count = std::max(count, a + 1);
            edges.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), e, elements[e][(k + 2) % 3]});
        }
    tbb::parallel_sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
        return x.key != y.key ? x.key < y.key : x.element < y.element;
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> around, beside;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto a = static_cast<std::uint32_t>(edges[i].key >> 32), b = static_cast<std::uint32_t>(edges[i].key);
        if (left_out[a] || left_out[b]) continue;
        if (i == 0 || edges[i - 1].key != edges[i].key) beside.insert(beside.end(), {{a, b}, {b, a}});
        if (i + 1 >= edges.size() || edges[i].key != edges[i + 1].key) continue;
        const std::uint32_t c = edges[i].far, d = edges[i + 1].far;
        if (left_out[c] || left_out[d]) continue;
        const glm::vec3 p = mesh.vertices[a].position, ab = mesh.vertices[b].position - p,
                        ac = mesh.vertices[c].position - p, ad = mesh.vertices[d].position - p;
        const float bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
        const float det = bb * cc - bc * bc;
        if (!(det > 1e-6f * bb * cc)) continue;
        const float u = (cc * glm::dot(ad, ab) - bc * glm::dot(ad, ac)) / det,
                    w = (bb * glm::dot(ad, ac) - bc * glm::dot(ad, ab)) / det;
        // A far corner a long way off says more of that than of this edge.
        for (const std::uint32_t v : {a, b, c, d}) around.emplace_back(v, static_cast<std::uint32_t>(sides_.size()));
        sides_.push_back({{a, b, c, d}, u, w, 1 / std::max(1.0f, std::abs(u) + std::abs(w))});
    }
    make_lists(count, around, first_side_, side_of_);
    make_lists(count, beside, first_neighbour_, neighbour_of_);
}

std::vector<float> Bends::at_vertices(std::span<const float> value) const {
    std::vector<float> square(sides_.size());
    tbb::parallel_for(Range(0, static_cast<std::uint32_t>(sides_.size()), 2048), [&](const Range& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            const auto& [v, u, w, scale] = sides_[i];
            const float a = value[v[0]];
            const float miss = scale * (value[v[3]] - a - u * (value[v[1]] - a) - w * (value[v[2]] - a));
            square[i] = miss * miss;
        }
    });
    std::vector<float> bend =
        mean_of_squares(value.size(), first_side_, [&](std::uint32_t, std::uint32_t k) { return square[side_of_[k]]; });
    for (float& b : bend) b = std::sqrt(b);
    return bend;
}

std::vector<float> Bends::neighbour_differences(std::span<const float> value) const {
    return mean_of_squares(value.size(), first_neighbour_, [&](std::uint32_t v, std::uint32_t k) {
        const float d = value[v] - value[neighbour_of_[k]];
        return d * d;
    });
}

ErrorMesh make_error_mesh(const Mesh& mesh, std::uint32_t level, std::vector<std::uint8_t> buried,
                          const std::vector<std::uint8_t>& buried_coarse, bool with_bends) {
    ErrorMesh made;
    made.element_count = mesh.elements.size();
    made.level = level;
    made.buried = std::move(buried);
    made.area = vertex_areas(mesh);
    made.rim_area.assign(made.buried.size(), 0);
    for (const glm::uvec3& e : mesh.elements) {
        if (const int inside = made.buried[e.x] + made.buried[e.y] + made.buried[e.z]; inside == 0 || inside == 3)
            continue;
        const glm::vec3 a = mesh.vertices[e.x].position, b = mesh.vertices[e.y].position,
                        c = mesh.vertices[e.z].position;
        const float of_vertex = glm::length(glm::cross(b - a, c - a)) / 6;
        for (int k = 0; k < 3; ++k)
            if (made.buried[e[k]]) made.rim_area[e[k]] += 0.5f * of_vertex;
    }
    for (std::size_t v = 0; v < made.area.size(); ++v)
        if (!made.buried[v]) made.seen_area += made.area[v];
    if (!with_bends) return made;
    made.fine = Bends(mesh.elements, mesh, made.buried);
    made.coarse_elements = elements_of_level(mesh, level);
    made.coarse = Bends(made.coarse_elements, mesh, buried_coarse);
    return made;
}

} // namespace lueur
