// Direct light at the vertices of a mesh that refines itself where direct light bends: shadow edges, contacts, places
// near a lamp.
//
// Refinement looks at geometry only (luminaires as guessed_exitances has them), so that no edit of a lamp or a
// paint changes the mesh, and a solution after edits is the solution of the same scene opened afresh.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/transport/direct_light.h"
#include "core/transport/edge_refinement.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

struct DirectParams {
    float tolerance = 0.05f; // relative misfit of an edge's middle that splits it
    float smallest_edge = 0; // m: shorter edges are not split
    float element_size = 0;  // m: what stands for less than such an element is lit less finely
    std::uint32_t most_vertices = 60000;
};

class DirectTransport {
public:
    // `mesh` and `world` must outlive it; refine() grows the mesh.
    DirectTransport(const World& world, Mesh& mesh, std::vector<Emitter> emitters, const DirectParams& params);

    // Each brings its stage forward by one time slice; true when the stage is done.
    bool sketch(const std::atomic<bool>& cancel);         // a first guess of D at the vertices there are, one ray each
    bool light_vertices(const std::atomic<bool>& cancel); // D at the vertices there are
    // Then split, level by level, at most until there have been so many. light_vertices() lights the new ones: call it
    // to its end before refine(), and once more after it.
    bool refine(const std::atomic<bool>& cancel, std::uint32_t levels = no_index);
    bool refined() const { return refined_ || emitters_.empty(); } // all levels

    // The mesh was cut by someone else: its new vertices have what their parents
    // have, until light_vertices has been called to its end.
    void follow_mesh();

    std::size_t lit_vertices() const { return buried_.size(); }        // that it knows of
    std::uint32_t sketched_vertices() const { return sketch_cursor_; } // the first ones
    std::size_t emitter_count() const { return emitters_.size(); }
    const std::vector<Emitter>& emitters() const { return emitters_; }
    // Of factors D: irradiance, were the luminaires as guessed.
    float guessed_light(const float* factors) const;
    // D of each emitter at a vertex: irradiance for unit exitance.
    const float* at_vertex(std::uint32_t v) const { return factors_.data() + std::size_t(v) * emitters_.size(); }
    // Standard deviation of D at a vertex, one an emitter: of the stratified points in a penumbra; next to one, of the
    // few probes that found a vertex wholly lit or wholly dark.
    const float* deviation_at_vertex(std::uint32_t v) const {
        return deviations_.data() + std::size_t(v) * emitters_.size();
    }
    const std::vector<std::uint8_t>& buried() const {
        return buried_;
    }                                         // one a vertex; set for dark vertices inside solids
    double misfit() const { return misfit_; } // RMS relative misfit at the middles of edges that were left whole
    std::uint64_t rays() const { return rays_.load(); }
    double progress() const; // of the stage that runs, 0..1

private:
    enum class Care { looked_at, kept }; // whether light bends somewhere is told by less than what is shown there
    void light(glm::vec3 origin, glm::vec3 normal, float size, Care care, float* factors, float* deviations) const;
    void spread_deviations();
    bool begin_level(const std::atomic<bool>& cancel);
    bool look(const std::atomic<bool>& cancel);
    void judge();
    void split_bent();
    void follow_vertices();

    const World& world_;
    Mesh& mesh_;
    std::vector<Emitter> emitters_;
    DirectParams params_;
    EdgeRefinement edges_; // of this level, and their D:
    std::vector<float> edge_factors_, edge_deviations_;
    std::vector<float> weight_;                // guessed_exitances
    std::vector<float> factors_, deviations_;  // vertices * emitters
    std::vector<std::uint8_t> buried_, known_; // known: lit when its edge was looked at
    std::vector<glm::vec3> origins_;
    std::vector<float> area_; // m^2, of each vertex
    std::uint32_t sketch_cursor_ = 0, vertex_cursor_ = 0;

    std::uint32_t edge_cursor_ = 0;
    enum class Part { prepare, begin, look, plan, split } part_ = Part::prepare; // of a level
    bool refined_ = false;
    std::uint32_t level_ = 0;    // so many are done
    bool spread_pending_ = true; // spread_deviations, when the vertices are lit
    float floor_ = 0;
    double misfit_ = 0, misfit_sum_ = 0;
    std::uint64_t misfit_count_ = 0;
    mutable std::atomic<std::uint64_t> rays_{0};
};

} // namespace lueur
