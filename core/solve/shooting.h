// Progressive shooting (Cohen, Chen, Wallace & Greenberg 1988; the lecture's pseudo code with its slips mended: LECTURE
// corrections 31-34).
//
// Each shot takes the patch with the largest unshot flux and lights all vertices: dH_i = F_(i<-j) dB_j, F from the
// vertex to the shooter's polygon (exact) times stratified shadow rays (Wallace 1989). Luminaires shoot first, with
// their direct light as transport keeps it. Coarse elements receive rho times the mean of what their vertices receive;
// patches of several elements shoot (Cohen et al. 1986). The mean over the vertices of elements that touch the shooter
// is too much, that of few vertices far away may be anything: a shot is scaled so that no more arrives than was shot,
// and exactly that where the shooter sees lit surfaces only. So every shot takes at least 1 - rho of its flux away, and
// what is multiplied by 1 / (1 - rho) in a white room is the flux that there is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/solve/channel_field.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

class Shooting {
public:
    Shooting() = default;
    // direct[l]: irradiance at the coarse vertices for luminaire l, already times its exitance. `weight`: of each
    // channel in "the largest unshot flux" (luminous efficacy, and a little of all wavelengths so that blue is not
    // forgotten). lit: of what coarse vertices send, the share that meets lit surfaces, by rays; closed: those that see
    // such surfaces only; lit_share: of all that surfaces send.
    struct Scenery {
        std::vector<glm::vec3> origins;
        std::vector<float> lit;
        std::vector<std::uint8_t> buried, closed;
        std::vector<std::uint8_t> luminaire_closed;
        double lit_share = 1;
    };
    Shooting(const World& world, const Mesh& mesh, Scenery scenery, std::vector<ChannelField> direct,
             std::vector<double> emitted_flux, ChannelField rho, std::vector<float> weight, std::uint32_t seed);

    bool shoot(); // one shot; false when nothing is left to shoot

    // Of all the light that arrives in the end, the share that is still missing: each unit unshot is reflected on,
    // 1 / (1 - rho_ave) times if nothing is lost.
    double missing_share() const;
    // Of all the light that arrives in the end, the share that shots have lost (below 0: made), as far as it is known:
    // what arrived of each, against what the rays of its patch say must, beyond what they leave open; reflected on.
    double lost_share() const;
    // Shots that will have been taken when that is down to `enough`, at the rate of the last patches(); 0: not yet
    // known.
    double shots_needed(double enough) const;
    std::uint32_t patches() const { return unshot_.count; }

    double unshot_share() const;                                 // weighted unshot flux / emitted flux
    std::uint32_t last_shooter() const { return last_shooter_; } // patch, or no_index after a luminaire
    std::uint32_t shots() const { return shots_; }
    std::uint32_t luminaires_shot() const { return luminaires_shot_; }
    const std::vector<std::uint8_t>& luminaire_has_shot() const { return luminaire_shot_; }
    std::uint64_t rays() const { return rays_; }
    double mean_reflectance() const { return mean_rho_; } // area-weighted, luminous: the ambient term's rho_ave

    const ChannelField& indirect() const {
        return h_;
    }                                   // irradiance from patches (not luminaires) at the coarse vertices
    std::vector<float> ambient() const; // irradiance of the ambient term, per channel
    std::vector<float>
    unshot_at_vertices() const; // weighted unshot radiosity, mean over the patches around each vertex

private:
    template <int Channels>
    void add_patch_mean(std::uint32_t patch, const float* values, int stride, float* out) const;
    std::vector<float> form_factors_to(std::uint32_t patch);
    void deliver(const std::vector<float>& form_factor, std::uint32_t shooter, const float* radiosity);
    void receive(const ChannelField& irradiance, float scale);
    double arriving(const ChannelField& irradiance) const; // weighted flux

    const World* world_ = nullptr;
    const Mesh* mesh_ = nullptr;
    std::vector<glm::vec3> origins_;
    std::vector<std::uint8_t> buried_, patch_closed_, luminaire_closed_;
    std::vector<ChannelField> direct_;
    std::vector<double> emitted_; // weighted flux of each luminaire
    std::vector<std::uint8_t> luminaire_shot_;
    ChannelField rho_; // of each patch
    std::vector<float> patch_area_;
    std::vector<float> patch_lit_, patch_lit_spread_; // share of what a patch sends that must arrive; its vertices'
    std::vector<std::uint32_t> patch_first_,
        patch_elements_; // coarse elements of patch p: patch_elements_[patch_first_[p]..patch_first_[p+1]]
    std::vector<float> weight_;
    ChannelField h_;                 // vertices
    ChannelField unshot_;            // patches, radiosity
    std::vector<float> unshot_flux_; // patches, weighted
    std::vector<double> mean_rho_channel_;
    double total_area_ = 0, emitted_total_ = 0, unshot_total_ = 0, mean_rho_ = 0;
    double lit_share_ = 1, arrived_ = 0, lost_ = 0; // weighted flux that has arrived, that should have besides
    std::vector<double> missing_;                   // after each round of as many shots as there are patches
    std::uint32_t seed_ = 1, shots_ = 0, luminaires_shot_ = 0, last_shooter_ = no_index;
    std::uint64_t rays_ = 0;
};

} // namespace lueur
