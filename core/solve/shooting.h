// Progressive shooting (Cohen, Chen, Wallace & Greenberg 1988; the lecture's pseudo code with its slips mended: LECTURE
// corrections 31-34).
//
// Each shot takes the patch with the largest unshot flux and lights all vertices: dH_i = F_(i<-j) dB_j, F from the
// vertex to the shooter's polygon (exact) times stratified shadow rays (Wallace 1989). Luminaires shoot first, with
// their direct light as transport keeps it. Coarse elements receive rho times the mean of what their vertices receive;
// patches of several elements shoot (Cohen et al. 1986). A shot is scaled down where its receivers would send on more
// flux than it took, so that the unshot flux goes down with every shot.
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
    // forgotten).
    Shooting(const World& world, const Mesh& mesh, std::vector<glm::vec3> origins, std::vector<std::uint8_t> buried,
             std::vector<ChannelField> direct, std::vector<double> emitted_flux, ChannelField rho,
             std::vector<float> weight, std::uint32_t seed);

    bool shoot(); // one shot; false when nothing is left to shoot

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
    void deliver(const std::vector<float>& form_factor, const float* radiosity, double shot_flux);
    void receive(const ChannelField& irradiance);

    const World* world_ = nullptr;
    const Mesh* mesh_ = nullptr;
    std::vector<glm::vec3> origins_;
    std::vector<std::uint8_t> buried_;
    std::vector<ChannelField> direct_;
    std::vector<double> emitted_; // weighted flux of each luminaire
    std::vector<std::uint8_t> luminaire_shot_;
    ChannelField rho_; // of each patch
    std::vector<float> patch_area_;
    std::vector<std::uint32_t> patch_first_,
        patch_elements_; // coarse elements of patch p: patch_elements_[patch_first_[p]..patch_first_[p+1]]
    std::vector<float> weight_;
    ChannelField h_;                 // vertices
    ChannelField unshot_;            // patches, radiosity
    std::vector<float> unshot_flux_; // patches, weighted
    std::vector<double> mean_rho_channel_;
    double total_area_ = 0, emitted_total_ = 0, unshot_total_ = 0, mean_rho_ = 0;
    std::uint32_t seed_ = 1, shots_ = 0, luminaires_shot_ = 0, last_shooter_ = no_index;
    std::uint64_t rays_ = 0;
};

} // namespace lueur
