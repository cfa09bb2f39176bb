// What each luminaire alone makes of the scene: light is linear in what is emitted, so that another dimmer or spectrum
// is a sum of what is known, channel by channel, and needs no sweep.
//
// Of gathering on kept rows. For each luminaire: one reflection of its direct light gathered at the receivers, and the
// solution of it, for an exitance of 1 W m^-2 nm^-1 in every channel. As long as not all luminaires have a basis, edits
// of those that have one start from a settled solution: H = H_settled + sum (E - E_settled) H_1.
// The system's residual is found anew of every sum; where it is too large (nearly all light put out) sweeps go on.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/solve/gather_system.h"

namespace lueur {

// How large the solutions are, how many there may be, and what memory.
struct LightBasesRoom {
    std::uint32_t receivers = 0;
    int channels = 0;
    std::size_t luminaires = 0;
    std::size_t most_bytes = std::size_t(512) << 20; // that bases may take
};

struct LightSolution {
    ChannelField gathered;  // one reflection of direct light, at the receivers
    ChannelField radiosity; // U of gather_system.h; one row more, zero
    ChannelField arriving;  // W U
};

using Exitances = std::vector<std::vector<double>>; // luminaires x channels, W m^-2 nm^-1

class LightBases {
public:
    // Of other receivers, rays or reflectances all is forgotten; `rho`: of each material, in channels.
    void keep_for(const LightBasesRoom& room, const Exitances& rho);
    void forget();

    // A luminaire was edited: its basis comes first.
    void want(std::size_t luminaire);

    // The solution for these exitances, where it is known.
    std::optional<LightSolution> sum(const Exitances& exitance);

    // A settled solution to start from.
    bool has_reference(const Exitances& exitance) const;
    void set_reference(const Exitances& exitance, LightSolution settled);

    // The luminaire whose basis is the next to be made; nothing: all are there, or their memory is used up.
    std::optional<std::size_t> next() const;
    void add(std::size_t luminaire, LightSolution basis);
    void give_up(std::size_t luminaire); // it cannot be had

    std::size_t count() const;
    std::size_t bytes() const; // that all bases kept take

private:
    bool has(std::size_t luminaire) const { return !bases_[luminaire].gathered.values.empty(); }
    std::size_t most() const; // bases
    bool is_near_latest(const Exitances& exitance) const;
    bool begin_sum(const Exitances& exitance);

    LightBasesRoom room_;
    Exitances rho_;
    std::vector<LightSolution> bases_; // one a luminaire; empty: none yet
    std::vector<std::uint8_t> given_up_;
    std::vector<std::size_t> wanted_; // the latest last
    Exitances reference_exitance_;
    LightSolution reference_;
    // The sum that was asked for last: a slider that is dragged changes little of it.
    struct Latest {
        Exitances exitance, brightest; // what it is of; the most that each luminaire has been since it was begun
        LightSolution solution;
        int changes = 0; // since then
    };
    std::optional<Latest> latest_;
};

} // namespace lueur
