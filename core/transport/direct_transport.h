// Direct light at the vertices of a mesh that refines itself where direct light bends: shadow edges, contacts, places
// near a lamp.
//
// Refinement looks at geometry only (luminaires as guessed_exitances has them), so that no edit of a lamp or a
// paint changes the mesh, and a solution after edits is the solution of the same scene opened afresh.
//
// Kept in rows: of the luminaires that a place sees, few of a hall's hundreds. Rows are those of the samples of the
// coarse mesh (light_samples.h), then those of the vertices that refinement adds.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/transport/direct_light.h"
#include "core/transport/edge_refinement.h"
#include "core/transport/light_samples.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

struct DirectParams {
    float tolerance = 0.05f; // relative misfit of an edge's middle that splits it
    float smallest_edge = 0; // m: shorter edges are not split
    float element_size = 0;  // m: what stands for less than such an element is lit less finely
    std::uint32_t most_vertices = 60000;
    Room room = Room::as_far_as_it_goes;
};

// What one emitter gives one place: D, irradiance for unit exitance, and its standard deviation: of the stratified
// points in a penumbra; next to one, of the few probes that found a vertex wholly lit or wholly dark.
struct DirectShare {
    std::uint32_t emitter;
    float factor, deviation;
};
using DirectRow = std::vector<DirectShare>; // by emitter

class DirectTransport {
public:
    // `mesh` and `world` must outlive it; refine() grows the mesh. samples: of the mesh as it is now; without any, all
    // vertices are samples.
    DirectTransport(const World& world, Mesh& mesh, std::vector<Emitter> emitters, const DirectParams& params,
                    LightSamples samples = {});

    // Each brings its stage forward by one time slice; true when the stage is done.
    bool sketch(const std::atomic<bool>& cancel);         // a first guess of D at the vertices there are, one ray each
    bool light_vertices(const std::atomic<bool>& cancel); // D at the vertices there are
    // Then split, level by level, at most until there have been so many. light_vertices() lights the new ones: call it
    // to its end before refine(), and once more after it.
    bool refine(const std::atomic<bool>& cancel, std::uint32_t levels = no_index);
    bool is_lit() const { return lit_rows_ > 0 || rows_.empty(); } // no longer guessed
    bool refined() const { return refined_ || emitters_.empty(); } // all levels

    // The mesh was cut by someone else: its new vertices have what their parents
    // have, until light_vertices has been called to its end.
    void follow_mesh();

    std::size_t lit_vertices() const { return buried_.size(); } // that it knows of
    std::uint32_t sketched_vertices() const {                   // the first ones
        if (samples_.count() == 0) return sketch_cursor_;
        return sketch_cursor_ < row_count() ? 0 : static_cast<std::uint32_t>(guessed_.size());
    }
    std::size_t emitter_count() const { return emitters_.size(); }
    const std::vector<Emitter>& emitters() const { return emitters_; }
    // Irradiance at all vertices, were the luminaires as guessed (guessed_exitances).
    const std::vector<float>& guessed_light() const { return guessed_; }
    const LightSamples& samples() const { return samples_; }
    const std::vector<DirectRow>& rows() const { return rows_; }
    std::uint32_t row_count() const { return static_cast<std::uint32_t>(rows_.size()); }
    // Of `stride` numbers at each row: adds those at all vertices, one after the other.
    void read_rows(std::span<const float> at_rows, std::size_t stride, std::span<float> at_vertices) const;
    // f(share, weight) of all shares that D at a vertex is made of.
    template <typename F>
    void each_share(std::uint32_t v, const F& f) const {
        if (const std::uint32_t row = row_of(v); row != no_index) {
            for (const DirectShare& share : rows_[row]) f(share, 1.0f);
            return;
        }
        for (const LightSamples::Reading& r : samples_.readings_of(v))
            for (const DirectShare& share : rows_[r.sample]) f(share, r.weight);
    }
    // Adds weight * D of each emitter at a vertex.
    void add_factors(std::uint32_t v, float weight, std::span<float> factors) const {
        each_share(
            v, [&](const DirectShare& share, float part) { factors[share.emitter] += weight * part * share.factor; });
    }
    std::size_t bytes() const; // of memory that rows take
    const std::vector<std::uint8_t>& buried() const {
        return buried_;
    }                                         // one a vertex; set for dark vertices inside solids
    double misfit() const { return misfit_; } // RMS relative misfit at the middles of edges that were left whole
    std::uint64_t rays() const { return rays_.load(); }
    double progress() const; // of the stage that runs, 0..1

private:
    enum class Care { looked_at, kept }; // whether light bends somewhere is told by less than what is shown there
    DirectRow sketched_row(std::uint32_t v) const;
    DirectRow row_at(glm::vec3 origin, glm::vec3 normal, float size, Care care) const;
    float guessed_light(const DirectRow& row) const;
    void follow_vertices();
    void follow_places();
    void read_guessed_light();
    void spread_deviations();
    bool begin_level(const std::atomic<bool>& cancel);
    bool look(const std::atomic<bool>& cancel);
    std::vector<float> bent_edges(); // their misfits, 0 where they are straight
    void split_bent();
    std::uint32_t sampled_vertices() const { return static_cast<std::uint32_t>(samples_.of_vertex.size()); }
    std::uint32_t row_of(std::uint32_t v) const { // no_index: it reads samples
        if (v >= sampled_vertices()) return v - sampled_vertices() + samples_.count();
        return samples_.is_sample(v) ? samples_.of_vertex[v] : no_index;
    }
    std::uint32_t vertex_of(std::uint32_t row) const {
        return row < samples_.count() ? samples_.vertex[row] : row - samples_.count() + sampled_vertices();
    }

    const World& world_;
    Mesh& mesh_;
    std::vector<Emitter> emitters_;
    DirectParams params_;
    LightSamples samples_;
    EdgeRefinement edges_; // of this level, and their D:
    std::vector<DirectRow> edge_rows_;
    std::vector<float> weight_; // guessed_exitances
    struct Piece {              // a luminaire, or one of its parts
        const Emitter* emitter;
        std::uint32_t luminaire;
    };
    std::vector<Piece> pieces_;
    std::vector<DirectRow> rows_;
    std::vector<std::uint8_t> known_; // of each row: lit when its edge was looked at
    std::vector<float> row_area_;     // m^2 that each row stands for
    std::vector<float> guessed_;      // of each vertex
    std::vector<std::uint8_t> buried_;
    std::vector<glm::vec3> origins_;
    std::uint32_t sketch_cursor_ = 0, row_cursor_ = 0, lit_rows_ = 0;

    std::uint32_t edge_cursor_ = 0;
    bool refined_ = false;
    std::uint32_t level_ = 0;    // so many are done
    bool spread_pending_ = true; // spread_deviations, when the vertices are lit
    float floor_ = 0;
    double misfit_ = 0, misfit_sum_ = 0;
    std::uint64_t misfit_count_ = 0;
    mutable std::atomic<std::uint64_t> rays_{0};
};

} // namespace lueur
