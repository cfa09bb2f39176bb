#include "editor/chart/milestones.h"

#include <algorithm>

namespace lueur {

bool Milestones::Counter::passed(std::uint32_t now) {
    if (now < seen) next = 1; // started anew
    const bool due = now != seen && now >= next;
    seen = now;
    if (due) next = now + std::max(1u, now / 2);
    return due;
}

bool Milestones::due(const SolveStatus& status) {
    if (status.rays_per_receiver != rays_per_receiver_) {
        rays_per_receiver_ = status.rays_per_receiver;
        sweeps_ = {};
    }
    const bool swept = sweeps_.passed(status.sweeps), shot = count_shots_ && shots_.passed(status.shots);
    return swept || shot;
}

} // namespace lueur
