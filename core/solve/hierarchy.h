// Hierarchical radiosity: links between elements of all sizes, refined, gathered over, pushed and pulled.
//
// After Hanrahan, Salzman & Aupperle 1991 as the lecture has it, with its slips mended (LECTURE corrections 37-45), for
// all channels at once: `form_factor` (Oracle1) links where F is small, `flux` (Oracle2, BF refinement) where the flux
// a link carries is, from coarse to fine, with solves in between. Luminaires are sources as any other surface. `error`
// is what grew out of it: direct light apart, clusters above the surfaces, a link cut where its estimated error (F over
// the receiver with visibility, and the radiosity over the source) matters, and rows that sum to 1 where nothing but
// lit surfaces is seen.
//
// Geometry makes the links; sources and paints may change and keep them. Every step is small, and what is done does not
// depend on the time or the number of threads.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/solve/channel_field.h"
#include "core/solve/hierarchy_links.h"
#include "core/transport/time_slice.h"

namespace lueur {

struct Link {
    std::uint32_t receiver, source;
    float form_factor; // F_rs
    float spread;      // of F over the receiver
};

struct HierarchySettings {
    RefinementOracle oracle = RefinementOracle::error;
    // form_factor: F. flux: flux of a link / emitted flux. error: error of a link / mean irradiance, times the root of
    // the receiver's share of the area. 0: from target_error.
    double tolerance = 0;
    double target_error = 0.02; // relative RMS error of irradiance
    float smallest_area = 0;    // m^2: elements of less are not cut
    std::uint32_t most_links = 6'000'000, most_elements = 400'000;
};

// The tolerance at which the irradiance should be off by about target_error; how that follows stands with it.
double tolerance_for(RefinementOracle oracle, double target_error);

// Sources and paints in channels.
struct HierarchySources {
    std::vector<std::uint32_t> surface_material;
    std::vector<std::vector<double>> material_rho;
    std::vector<std::vector<double>> luminaire_exitance;
    std::vector<std::optional<std::size_t>> root_luminaire; // that shines from this root
    std::vector<float> weight; // of each channel in "how bright": luminous, and a little of all wavelengths
};

// D of each luminaire at a point of a surface: irradiance for unit exitance.
using DirectAt = std::function<void(glm::vec3 position, glm::vec3 normal, float* factors)>;

class Hierarchy {
public:
    // `world` must outlive it. direct: luminaires' light apart, from this; empty: luminaires are linked as other
    // surfaces.
    Hierarchy(const Scene& scene, const World& world, const HierarchySettings& settings, DirectAt direct = {});

    void set_sources(HierarchySources sources); // keeps the links, and the solution so far as the first guess

    bool
    step(const std::atomic<bool>& cancel); // about 5 ms or a sweep; false when nothing is left to do, or it has failed
    const std::string& failure() const { return failure_; }

    const ElementTree& tree() const { return tree_; }
    const std::vector<Link>& links() const { return links_; }  // by receiver; those of the last round while refining
    std::span<const Link> links_of(std::uint32_t node) const { // its own, not those of nodes above
        return {links_.data() + first_link_[node], links_.data() + first_link_[node + 1]};
    }
    const NodePoints& points_of(std::uint32_t node) const { return points_[node]; }
    std::uint32_t link_count() const; // while refining: so far
    std::uint32_t element_count() const { return leaves_; }
    std::uint32_t level_count() const { return levels_; } // cuts of the most finely cut surface
    std::uint32_t sweeps() const { return sweeps_; }
    std::uint32_t rounds() const { return rounds_; } // of refinement
    std::uint64_t rays() const { return rays_; }
    const char* doing() const; // a word for the phase
    bool refining() const {    // links are being made
        return phase_ == Phase::look || phase_ == Phase::begin || phase_ == Phase::refine || phase_ == Phase::list;
    }
    bool settled() const { return phase_ == Phase::settled; }
    double progress() const;                                    // of the round
    double residual() const { return residual_; }               // change of B in the last sweep / B, worst channel
    double estimated_error() const { return estimated_error_; } // relative RMS of irradiance, links' errors independent
    double error_bound() const { return error_bound_; }         // mean, links' errors all the same way and reflected on
    double row_sum(std::uint32_t leaf) const {
        return row_sum_[leaf];
    } // of F over the links of a leaf and those above it
    double tolerance() const { return tolerance_; }

    // Of leaves: irradiance by links, buried ones 0. With direct light apart that is not in it.
    const ChannelField& irradiance() const { return total_; }      // times scale
    float scale(std::uint32_t leaf) const { return scale_[leaf]; } // that makes its row sum to 1 where it should
    const ChannelField& radiosity() const { return b_; }           // of all nodes: mean over their area
    float brightness(std::uint32_t node) const { return brightness_[node]; } // of B, weighted
    bool limited() const { return limited_; }                                // by most_links or most_elements
    std::uint32_t rows_above_one() const { return rows_above_one_; }         // leaves whose rows had to be scaled down
    bool buried(std::uint32_t node) const { return points_[node].count == 0; }
    float error_at(std::uint32_t leaf) const { return leaf_error_[leaf]; } // weighted irradiance

private:
    // A round: its links are begun with, looked at and cut (new nodes looked at), listed by receiver; then sweeps, each
    // gathers, pushes and pulls; what the links' errors come to is measured. relight: sources are new.
    enum class Phase { relight, look, begin, refine, list, sweep, push, pull, measure, settled, failed };
    enum class Verdict : std::uint8_t { drop, keep, cut_receiver, cut_source };
    struct Work { // a link to be looked at, or (pair) two nodes that may be linked both ways
        std::uint32_t receiver, source;
        bool pair = false, estimated = false;
        LinkEstimate there{}, back{};
        Verdict verdict = Verdict::keep;
    };

    static constexpr std::size_t nodes_a_look = 64; // at the clock

    void start_round();
    void begin_round(TimeSlice& slice);
    void look_at_new_nodes(const std::atomic<bool>& cancel);
    void light_node(std::uint32_t node);
    void refine_some();
    void judge(Work& work) const;
    Verdict by_form_factor(const Work& work) const;
    Verdict by_flux(const Work& work) const;
    Verdict by_error(const Work& work) const;
    Verdict cut_one(std::uint32_t receiver, std::uint32_t source, bool prefer_source) const;
    bool can_cut(std::uint32_t node) const;
    void apply(const Work& work);
    void cut(std::uint32_t node);
    void start_listing();
    void list_links(TimeSlice& slice);
    void add_to_row(std::uint32_t node);
    bool gather(const std::atomic<bool>& cancel); // a slice of it; true at the end
    std::size_t room_for_nodes() const;           // that there may be in the end
    void resize_values();
    void set_leaf_source(std::uint32_t leaf);
    void relight(TimeSlice& slice);
    void start_pushing(bool sources_only);
    void push(TimeSlice& slice);
    void push_to(std::uint32_t node);
    void pull(TimeSlice& slice);
    void pull_to(std::uint32_t node);
    void end_sweep();
    void extrapolate(const std::vector<double>& change, const std::vector<double>& alignment);
    void measure_errors(TimeSlice& slice);
    void measure_node(std::uint32_t node);
    void end_measuring();
    double settled_residual() const;
    float bright(const float* channels) const;
    double contrast(std::uint32_t receiver, std::uint32_t source) const;
    bool is_next_tolerance_finer() const;

    const World& world_;
    HierarchySettings settings_;
    DirectAt direct_;
    std::size_t emitters_ = 0;
    HierarchySources sources_;
    int channels_ = 0;
    ElementTree tree_;
    std::vector<NodePoints> points_;
    std::vector<float> direct_mean_, direct_spread_; // nodes * emitters, of elements

    Phase phase_ = Phase::look;
    std::string failure_;
    std::uint32_t looked_ = 0; // nodes that have points
    std::uint32_t leaves_ = 0, levels_ = 0;
    std::deque<Work> work_;     // what is done is taken off; millions may come, and none is moved
    std::size_t work_done_ = 0; // in this round
    std::uint32_t gather_cursor_ = 0;
    std::size_t cursor_ = 0;       // of begin, relight, push, pull or measure, whichever goes on
    Phase resume_ = Phase::sweep;  // after new sources,
    std::size_t round_cursor_ = 0; // there
    std::vector<Link> links_;
    std::deque<Link> kept_; // of this round so far
    struct Listing {
        std::size_t links = 0, counted = 0, placed = 0, summed = 0;
        std::vector<std::uint32_t> next; // place in links_, of each node
    } listing_;
    struct Pushing {
        bool sources_only = false;
        std::vector<double> change, norm, along, before; // of B, by channel
        double light = 0, area = 0;
    } pushing_;
    struct Measuring {
        std::vector<float> square, sum; // of the links' errors, of nodes
        double errors = 0, bounds = 0, light = 0, mean = 0;
    } measuring_;
    std::vector<std::uint32_t> first_link_; // of each node in links_, one more than nodes
    bool cut_any_ = false, limited_ = false, begun_ = false;
    double tolerance_ = 0, final_tolerance_ = 0;
    std::uint32_t rounds_ = 0, rounds_of_solve_ = 0, sweeps_ = 0, sweeps_of_round_ = 0;
    std::uint64_t rays_ = 0;

    ChannelField source_, gathered_, total_,
        b_; // of nodes: E or what direct light leaves; H by own links; with those above; B
    std::vector<float> scale_, row_sum_, leaf_error_;
    std::vector<float> brightness_, brightness_spread_; // of B, weighted
    std::vector<float> arriving_;                       // irradiance by links, weighted: mean over the node
    std::vector<float> direct_brightness_;              // of direct irradiance, weighted; of elements
    double mean_irradiance_ = 0, total_area_ = 0, emitted_flux_ = 0, mean_rho_ = 0;
    double residual_ = 1, last_residual_ = 1, estimated_error_ = 1, links_error_ = 1, error_bound_ = 1;
    std::vector<float> extrapolation_; // of the next sweep, by channel
    std::vector<double> change_before_, ratio_before_;
    ChannelField step_before_; // of B in the last sweep
    std::uint32_t sweeps_since_ = 0;
    std::uint32_t growing_ = 0; // sweeps in a row whose residual grew
    std::uint32_t rows_above_one_ = 0;
};

} // namespace lueur
