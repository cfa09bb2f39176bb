// The last gather, at the vertices that are shown: each vertex takes the links of its element and of the nodes above
// it, with form factors and visibility of its own (after Smits 1994's local pass; Lischinski, Tampieri & Greenberg
// 1993). What a link smears over its receiver, the fall of light towards a corner or a contact shadow, comes back; the
// links and the radiosities they carry stay. Factors are kept, so that an edit of a lamp or a paint costs no ray.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/solve/hierarchy_field.h"
#include "core/transport/world.h"

namespace lueur {

class FinalGather {
public:
    // How many factors there will be, and what they take: known before any memory is taken. Counts in slices from
    // `count` on: vertices counted and factors so far; true at the end.
    struct Count {
        std::uint32_t vertices = 0;
        std::uint64_t factors = 0;
    };
    static bool count_factors(const Hierarchy& hierarchy, const std::vector<LeafReading>& readings,
                              const std::vector<std::uint8_t>& buried, const std::atomic<bool>& cancel, Count& count);
    static std::uint64_t bytes(std::uint64_t factors) { return factors * (sizeof(std::uint32_t) + sizeof(float)); }
    static constexpr std::uint64_t most_factors = 40'000'000; // 305 MiB

    // origins: where rays of the vertices start; buried ones take no part. All must outlive trace().
    // factors: as count_factors found them.
    FinalGather(const Mesh& mesh, const std::vector<glm::vec3>& origins, std::vector<LeafReading> readings,
                std::vector<std::uint8_t> buried, std::uint64_t factors);

    std::size_t factors() const { return source_.size(); }
    bool trace(const World& world, const Hierarchy& hierarchy,
               const std::atomic<bool>& cancel); // a slice; true at the end
    double progress() const { return vertices_ > 0 ? double(cursor_) / vertices_ : 1; }
    std::uint64_t rays() const { return rays_.load(); }

    // At the vertices from `cursor` on, by one time slice, into `irradiance`, which has a row for each; true at the
    // end.
    bool gather(const Hierarchy& hierarchy, const std::atomic<bool>& cancel, std::uint32_t& cursor,
                ChannelField& irradiance) const;

private:
    void look_from(const World& world, const Hierarchy& hierarchy, std::uint32_t vertex);

    const Mesh& mesh_;
    const std::vector<glm::vec3>& origins_;
    std::vector<LeafReading> readings_;
    std::vector<std::uint8_t> buried_;
    std::uint32_t vertices_ = 0, listed_ = 0, cursor_ = 0; // sources listed of so many, factors found of so many
    std::vector<std::size_t> first_;                       // of each vertex, one more than vertices
    std::vector<std::uint32_t> source_;                    // node
    std::vector<float> factor_;                            // F from the vertex
    std::vector<float> scale_;                             // of the row
    std::atomic<std::uint64_t> rays_{0};
};

} // namespace lueur
