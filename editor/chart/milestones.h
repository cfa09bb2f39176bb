// When to look at a solve that goes on: by what has been done, never by the clock, so that the same seed gives the same
// looks on every machine.
#pragma once

#include <cstdint>

#include "core/solve/status.h"

namespace lueur {

class Milestones {
public:
    explicit Milestones(bool count_shots) // steps take one shot at a time: what is done is known shot by shot
        : count_shots_(count_shots) {}

    // After each step. True where the solver has finished its first, 2nd, 3rd, 4th, 6th, 9th ... (each time half as
    // many again) sweep over new rays or shot.
    bool due(const SolveStatus& status);

private:
    struct Counter {
        std::uint32_t seen = 0, next = 1;
        bool passed(std::uint32_t now);
    };
    bool count_shots_;
    Counter sweeps_, shots_;
    std::uint32_t rays_per_receiver_ = 0;
};

} // namespace lueur
