#include "core/transport/light_samples.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <unordered_map>

#include <Eigen/Dense>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/gather_rows.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;
// Place in cells and normal: normals 40 degrees apart are as unlike as places a cell apart.
using Feature = Eigen::Matrix<float, 6, 1>;
constexpr float normal_scale = 1.5f;
constexpr int most_read = 10;  // samples that a vertex may read
constexpr float ridge = 0.04f; // of the plane's slopes, of the squared distance to the farthest sample read
constexpr float least_weight = 0.02f;
constexpr std::uint32_t most_tries = 8; // for a sample outside solids
constexpr float wider = 1.25f;
constexpr float close_cell = 0.7f;            // of the distance to what is around: wider groups are cut
constexpr std::uint32_t parts_of_a_group = 6; // that a cut makes, of a surface's two dimensions and what crosses it
constexpr int most_cuts = 3;

struct GroupKey {
    std::uint32_t object;
    glm::ivec3 place, look;
    bool back;
    std::uint8_t level; // the cube's edge is cell / 2^level
    bool operator==(const GroupKey&) const = default;
};
struct GroupHash {
    std::size_t operator()(const GroupKey& key) const {
        std::uint64_t hash = 0x9e3779b97f4a7c15ull ^ key.object;
        for (const int part :
             {key.place.x, key.place.y, key.place.z,
              key.look.x + 8 * key.look.y + 64 * key.look.z + (key.back ? 4096 : 0) + (key.level << 13)}) {
            hash = (hash ^ static_cast<std::uint32_t>(part)) * 0xff51afd7ed558ccdull;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

std::uint32_t object_of(const Scene& scene, const MeshVertex& vertex) {
    return static_cast<std::uint32_t>(at(scene.geometry->surfaces[vertex.surface].object));
}

struct Grouping {
    float cell, look;                // m; steps of the normal
    std::vector<std::uint8_t> level; // of each vertex
};

// False when there are more than `most`.
bool group(const Scene& scene, const Mesh& mesh, const Grouping& by, std::uint32_t most, LightSamples& samples) {
    std::unordered_map<GroupKey, std::uint32_t, GroupHash> known;
    samples.size.clear();
    samples.cell = by.cell;
    samples.of_vertex.resize(mesh.coarse_vertex_count);
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        const MeshVertex& vertex = mesh.vertices[v];
        const float cubes = std::exp2(float(by.level[v])) / by.cell;
        const GroupKey key{object_of(scene, vertex), glm::ivec3(glm::floor(vertex.position * cubes)),
                           glm::ivec3(glm::round(by.look * vertex.normal)), vertex.back, by.level[v]};
        const auto [found, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(samples.size.size()));
        if (fresh) {
            if (samples.size.size() == most) return false;
            samples.size.push_back(0);
        }
        ++samples.size[found->second];
        samples.of_vertex[v] = found->second;
    }
    return true;
}

Feature feature_of(const MeshVertex& vertex, float cell) {
    const glm::vec3 p = vertex.position / cell, n = normal_scale * vertex.normal;
    return Feature(p.x, p.y, p.z, n.x, n.y, n.z);
}

// What is around vertices, asked when it is first needed. Not for two threads at the same vertex.
class Around {
public:
    Around(const Mesh& mesh, const World& world, const std::vector<glm::vec3>& origins)
        : mesh_(mesh)
        , world_(world)
        , origins_(origins)
        , known_(mesh.coarse_vertex_count) {}

    const LookAround& operator()(std::uint32_t v) {
        std::optional<LookAround>& known = known_[v];
        if (!known) known = look_around(world_, origins_[v], mesh_.vertices[v].normal);
        return *known;
    }

private:
    const Mesh& mesh_;
    const World& world_;
    const std::vector<glm::vec3>& origins_;
    std::vector<std::optional<LookAround>> known_;
};

// What is around each sample, m, where a group has several vertices; else far.
std::vector<float> choose_samples(const Mesh& mesh, Around& around_of, LightSamples& samples) {
    const auto groups = static_cast<std::uint32_t>(samples.size.size());
    std::vector<std::uint32_t> first(groups + 1, 0), member(samples.of_vertex.size());
    for (std::uint32_t g = 0; g < groups; ++g) first[g + 1] = first[g] + samples.size[g];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t v = 0; v < samples.of_vertex.size(); ++v) member[next[samples.of_vertex[v]]++] = v;
    samples.vertex.resize(groups);
    std::vector<float> distance(groups, 1e30f);
    tbb::parallel_for(Range(0, groups, 64), [&](const Range& range) {
        std::vector<std::pair<float, std::uint32_t>> nearest;
        for (std::uint32_t g = range.begin(); g < range.end(); ++g) {
            samples.vertex[g] = member[first[g]];
            if (samples.size[g] == 1) continue;
            Feature middle = Feature::Zero();
            for (std::uint32_t i = first[g]; i < first[g + 1]; ++i)
                middle += feature_of(mesh.vertices[member[i]], samples.cell) / float(samples.size[g]);
            nearest.clear();
            for (std::uint32_t i = first[g]; i < first[g + 1]; ++i)
                nearest.emplace_back((feature_of(mesh.vertices[member[i]], samples.cell) - middle).squaredNorm(),
                                     member[i]);
            const auto tries = std::min(nearest.size(), std::size_t(most_tries));
            std::partial_sort(nearest.begin(), nearest.begin() + std::ptrdiff_t(tries), nearest.end());
            samples.vertex[g] = nearest[0].second;
            for (std::size_t t = 0; t < tries; ++t) {
                const std::uint32_t v = nearest[t].second;
                const LookAround& around = around_of(v);
                if (around.buried) continue;
                samples.vertex[g] = v;
                distance[g] = around.distance;
                break;
            }
        }
    });
    return distance;
}

// Groups wider than what is around them is away, in a shelf or under a seat: there light changes from vertex to vertex
// (Ward, Rubinstein & Clear 1988). Their vertices go one level down, the worst first, as far as `room` for more samples
// goes; false when there is nothing to be cut.
bool cut_groups(const LightSamples& samples, std::span<const float> distance, std::uint32_t room, Grouping& by) {
    std::vector<std::uint8_t> level(samples.count(), 0);
    for (std::uint32_t v = 0; v < samples.of_vertex.size(); ++v) level[samples.of_vertex[v]] = by.level[v];
    std::vector<std::pair<float, std::uint32_t>> wide;
    for (std::uint32_t g = 0; g < samples.count(); ++g)
        if (const float edge = by.cell * std::exp2(-float(level[g])); edge > close_cell * distance[g])
            wide.emplace_back(-edge / std::max(1e-20f, distance[g]), g);
    std::sort(wide.begin(), wide.end());
    std::vector<std::uint8_t> cut(samples.count(), 0);
    std::uint32_t more = 0, cuts = 0;
    for (const auto& [width, g] : wide) {
        more += std::min(samples.size[g], parts_of_a_group) - 1;
        if (more > room) break;
        cut[g] = 1, ++cuts;
    }
    for (std::uint32_t v = 0; v < samples.of_vertex.size(); ++v) by.level[v] += cut[samples.of_vertex[v]];
    return cuts > 0;
}

// Samples of one side of one object, searched by place and normal (Bentley 1975).
class SampleTree {
public:
    struct Point {
        Feature at;
        std::uint32_t sample;
    };
    struct Near {
        float distance2;
        const Point* point;
    };

    explicit SampleTree(std::span<Point> points)
        : points_(points) {
        build(0, points_.size());
    }

    // The most_read nearest, the nearest first; as many as there are.
    int nearest(const Feature& at, std::array<Near, most_read>& found) const {
        int count = 0;
        search(0, points_.size(), at, found, count);
        return count;
    }

private:
    static constexpr std::size_t leaf = 8;

    void build(std::size_t first, std::size_t last) {
        if (last - first <= leaf) return;
        const std::size_t middle = (first + last) / 2;
        const int axis = widest(first, last);
        std::nth_element(points_.begin() + std::ptrdiff_t(first), points_.begin() + std::ptrdiff_t(middle),
                         points_.begin() + std::ptrdiff_t(last), [axis](const Point& a, const Point& b) {
                             return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.sample < b.sample;
                         });
        axes_.resize(std::max(axes_.size(), middle + 1), 0);
        axes_[middle] = static_cast<std::uint8_t>(axis);
        build(first, middle);
        build(middle + 1, last);
    }
    int widest(std::size_t first, std::size_t last) const {
        Feature low = points_[first].at, high = low;
        for (std::size_t i = first; i < last; ++i)
            low = low.cwiseMin(points_[i].at), high = high.cwiseMax(points_[i].at);
        int axis = 0;
        (high - low).maxCoeff(&axis);
        return axis;
    }
    void look(const Point& point, const Feature& at, std::array<Near, most_read>& found, int& count) const {
        const float d = (point.at - at).squaredNorm();
        const auto before = [&](const Near& a) {
            return d != a.distance2 ? d < a.distance2 : point.sample < a.point->sample;
        };
        if (count == most_read && !before(found[most_read - 1])) return;
        int k = count < most_read ? count++ : most_read - 1;
        for (; k > 0 && before(found[std::size_t(k - 1)]); --k) found[std::size_t(k)] = found[std::size_t(k - 1)];
        found[std::size_t(k)] = {d, &point};
    }
    void search(std::size_t first, std::size_t last, const Feature& at, std::array<Near, most_read>& found,
                int& count) const {
        if (last - first <= leaf) {
            for (std::size_t i = first; i < last; ++i) look(points_[i], at, found, count);
            return;
        }
        const std::size_t middle = (first + last) / 2;
        const int axis = axes_[middle];
        const float across = at[axis] - points_[middle].at[axis];
        look(points_[middle], at, found, count);
        if (across < 0)
            search(first, middle, at, found, count);
        else
            search(middle + 1, last, at, found, count);
        if (count == most_read && across * across > found[most_read - 1].distance2) return;
        if (across < 0)
            search(middle + 1, last, at, found, count);
        else
            search(first, middle, at, found, count);
    }

    std::span<Point> points_;
    std::vector<std::uint8_t> axes_;
};

using Readings = std::vector<LightSamples::Reading>;

// Weights of the samples in the value at `at` of a plane through them: the nearer ones count more, the farthest found
// nothing, so that what is read changes without a step. None is negative: light is not.
void read_plane(const Feature& at, std::span<const SampleTree::Near> near, Readings& out) {
    const auto n = near.size();
    if (n == 1 || near[0].distance2 < 1e-8f) {
        out.push_back({near[0].point->sample, 1});
        return;
    }
    const float reach = n < most_read ? 2 * near[n - 1].distance2 : near[n - 1].distance2;
    std::array<float, most_read> w{};
    float sum = 0;
    Feature mean = Feature::Zero();
    for (std::size_t k = 0; k < n; ++k) {
        const float fade = std::max(0.0f, 1 - near[k].distance2 / reach);
        w[k] = (fade * fade + 1e-6f) / (near[k].distance2 + 1e-3f * reach);
        sum += w[k];
        mean += w[k] * (near[k].point->at - at);
    }
    mean /= sum;
    Eigen::Matrix<float, 6, 6> spread = Eigen::Matrix<float, 6, 6>::Identity() * (ridge * reach * sum);
    for (std::size_t k = 0; k < n; ++k) {
        const Feature d = near[k].point->at - at - mean;
        spread += w[k] * d * d.transpose();
    }
    const Feature slope = spread.llt().solve(mean);
    float all = 0;
    for (std::size_t k = 0; k < n; ++k) {
        w[k] = std::max(0.0f, w[k] * (1 / sum - slope.dot(near[k].point->at - at - mean)));
        if (w[k] < least_weight) w[k] = 0;
        all += w[k];
    }
    if (!(all > 0)) {
        out.push_back({near[0].point->sample, 1});
        return;
    }
    for (std::size_t k = 0; k < n; ++k)
        if (w[k] > 0) out.push_back({near[k].point->sample, w[k] / all});
}

void add_readings(const Scene& scene, const Mesh& mesh, Around& around, LightSamples& samples) {
    const auto vertices = static_cast<std::uint32_t>(samples.of_vertex.size());
    samples.first_reading.assign(vertices + 1, 0);
    samples.readings.clear();
    if (samples.count() == vertices) return;
    // Samples and other vertices of each side of each object.
    const auto side = [&](std::uint32_t v) { return 2 * object_of(scene, mesh.vertices[v]) + mesh.vertices[v].back; };
    const std::size_t sides = 2 * scene.objects.size();
    std::vector<std::vector<SampleTree::Point>> points(sides);
    std::vector<std::vector<std::uint32_t>> readers(sides);
    for (std::uint32_t v = 0; v < vertices; ++v)
        if (!samples.is_sample(v)) readers[side(v)].push_back(v);
    // What lies inside a solid is not read, but where all of an object does.
    std::vector<std::uint8_t> buried(samples.count(), 0);
    tbb::parallel_for(Range(0, samples.count(), 64), [&](const Range& range) {
        for (std::uint32_t g = range.begin(); g < range.end(); ++g)
            if (const std::uint32_t v = samples.vertex[g]; !readers[side(v)].empty()) buried[g] = around(v).buried;
    });
    for (const bool inside : {false, true})
        for (std::uint32_t g = 0; g < samples.count(); ++g) {
            std::vector<SampleTree::Point>& list = points[side(samples.vertex[g])];
            if (buried[g] == inside && (!inside || list.empty() || buried[list.front().sample]))
                list.push_back({feature_of(mesh.vertices[samples.vertex[g]], samples.cell), g});
        }
    std::vector<Readings> found(sides);
    std::vector<std::vector<std::uint32_t>> counts(sides);
    tbb::parallel_for(std::size_t(0), sides, [&](std::size_t s) {
        if (readers[s].empty()) return;
        const SampleTree tree(points[s]);
        counts[s].resize(readers[s].size());
        std::vector<Readings> of_block((readers[s].size() + 1023) / 1024);
        tbb::parallel_for(std::size_t(0), of_block.size(), [&](std::size_t b) {
            std::array<SampleTree::Near, most_read> near;
            for (std::size_t i = 1024 * b; i < std::min(readers[s].size(), 1024 * (b + 1)); ++i) {
                const Feature at = feature_of(mesh.vertices[readers[s][i]], samples.cell);
                const std::size_t before = of_block[b].size();
                read_plane(at, std::span(near).first(static_cast<std::size_t>(tree.nearest(at, near))), of_block[b]);
                counts[s][i] = static_cast<std::uint32_t>(of_block[b].size() - before);
            }
        });
        for (const Readings& block : of_block) found[s].insert(found[s].end(), block.begin(), block.end());
    });
    for (std::size_t s = 0; s < sides; ++s)
        for (std::size_t i = 0; i < readers[s].size(); ++i) samples.first_reading[readers[s][i] + 1] = counts[s][i];
    for (std::uint32_t v = 0; v < vertices; ++v) samples.first_reading[v + 1] += samples.first_reading[v];
    samples.readings.resize(samples.first_reading[vertices]);
    for (std::size_t s = 0; s < sides; ++s) {
        std::size_t next = 0;
        for (const std::uint32_t v : readers[s])
            for (std::uint32_t i = samples.first_reading[v]; i < samples.first_reading[v + 1]; ++i)
                samples.readings[i] = found[s][next++];
        found[s] = {};
    }
}

} // namespace

std::uint32_t count_light_samples(const Scene& scene, float cell, std::uint32_t most) {
    const Geometry& geometry = *scene.geometry;
    std::unordered_map<GroupKey, std::uint32_t, GroupHash> known;
    for (std::size_t t = 0; t < geometry.triangles.size() && known.size() < most; ++t) {
        const glm::uvec3 corners = geometry.triangles[t];
        const glm::vec3 a = geometry.vertices[corners.x].position;
        const glm::vec3 cross =
            glm::cross(geometry.vertices[corners.y].position - a, geometry.vertices[corners.z].position - a);
        const float length = glm::length(cross);
        for (int k = 0; k < 3 && length > 0; ++k) {
            const Vertex& v = geometry.vertices[corners[k]];
            const glm::vec3 normal = v.normal == glm::vec3(0) ? cross / length : v.normal;
            const auto object =
                static_cast<std::uint32_t>(at(geometry.surfaces[at(geometry.triangle_surface[t])].object));
            known.try_emplace(
                {object, glm::ivec3(glm::floor(v.position / cell)), glm::ivec3(glm::round(2.0f * normal)), false, 0});
        }
    }
    return static_cast<std::uint32_t>(known.size());
}

LightSamples make_light_samples(const Scene& scene, const Mesh& mesh, const World& world,
                                const std::vector<glm::vec3>& origins, float cell, std::uint32_t most) {
    LightSamples samples;
    // First normals within about 30 degrees, then within 50, then wider cubes.
    Grouping by{cell, 2, std::vector<std::uint8_t>(mesh.coarse_vertex_count, 0)};
    for (; !group(scene, mesh, by, most / 8 * 3, samples); by.look = 1)
        if (by.look == 1) by.cell *= wider;
    Around around(mesh, world, origins);
    std::vector<float> distance = choose_samples(mesh, around, samples);
    for (int cut = 0; cut < most_cuts; ++cut) {
        const Grouping before = by;
        if (!cut_groups(samples, distance, most - samples.count(), by)) break;
        if (!group(scene, mesh, by, most, samples)) { // parts were more than thought
            group(scene, mesh, before, most, samples);
            choose_samples(mesh, around, samples);
            break;
        }
        distance = choose_samples(mesh, around, samples);
    }
    add_readings(scene, mesh, around, samples);
    return samples;
}

} // namespace lueur
