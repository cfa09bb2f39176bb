#include "core/solve/light_bases.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/best_vectors.h"

namespace lueur {

namespace {

// sum += factor * basis, channel by channel; `factor` is padded with zeros to the stride.
LUEUR_BEST_VECTORS void add_rows(const float* basis, const float* factor, std::size_t stride, std::size_t rows,
                                 float* sum) {
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t c = 0; c < stride; ++c) sum[i * stride + c] += factor[c] * basis[i * stride + c];
}

void add_multiple(const ChannelField& basis, const std::vector<float>& factor, ChannelField& sum) {
    const auto stride = static_cast<std::size_t>(sum.stride);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sum.count, 1024),
                      [&](const tbb::blocked_range<std::size_t>& rows) {
                          add_rows(basis.values.data() + rows.begin() * stride, factor.data(), stride, rows.size(),
                                   sum.values.data() + rows.begin() * stride);
                      });
}

bool is_zero(const std::vector<double>& exitance) {
    return std::all_of(exitance.begin(), exitance.end(), [](double e) { return e == 0; });
}

} // namespace

void LightBases::keep_for(const LightBasesRoom& room, const Exitances& rho) {
    if (room.receivers == room_.receivers && room.channels == room_.channels && room.luminaires == room_.luminaires &&
        rho == rho_)
        return;
    forget();
    room_ = room;
    rho_ = rho;
    bases_.resize(room.luminaires);
    given_up_.assign(room.luminaires, 0);
    std::erase_if(wanted_, [&](std::size_t l) { return l >= room.luminaires; });
}

void LightBases::forget() {
    room_ = {};
    rho_.clear();
    bases_.clear();
    given_up_.clear();
    reference_exitance_.clear();
    reference_ = {};
    latest_.reset();
}

void LightBases::want(std::size_t luminaire) {
    std::erase(wanted_, luminaire);
    wanted_.push_back(luminaire);
}

std::size_t LightBases::count() const {
    std::size_t number = 0;
    for (std::size_t l = 0; l < bases_.size(); ++l) number += has(l);
    return number;
}

std::size_t LightBases::bytes() const {
    std::size_t values = 0;
    for (const LightSolution& b : bases_)
        values += b.gathered.values.size() + b.radiosity.values.size() + b.arriving.values.size();
    return values * sizeof(float);
}

std::size_t LightBases::most() const {
    const std::size_t each = 3 * ChannelField(1, room_.channels).values.size() * sizeof(float) * room_.receivers;
    return each > 0 ? room_.most_bytes / each : 0;
}

// What is left of a luminaire that was far brighter, and of many changes, is rounding.
bool LightBases::is_near_latest(const Exitances& exitance) const {
    constexpr int most_changes = 64;
    constexpr double most_dimmed = 8;
    if (!latest_ || latest_->changes >= most_changes) return false;
    std::size_t changed = 0;
    for (std::size_t l = 0; l < exitance.size(); ++l) {
        if (exitance[l] == latest_->exitance[l]) continue;
        if (!has(l) || exitance[l].size() != latest_->exitance[l].size()) return false;
        ++changed;
        for (std::size_t c = 0; c < exitance[l].size(); ++c)
            if (most_dimmed * std::abs(exitance[l][c]) < latest_->brightest[l][c]) return false;
    }
    return 2 * changed <= count();
}

// From nothing, or from the reference; false when neither leads to these exitances.
bool LightBases::begin_sum(const Exitances& exitance) {
    const auto can_start = [&](bool from_reference) {
        for (std::size_t l = 0; l < exitance.size(); ++l)
            if (!has(l) && (from_reference ? exitance[l] != reference_exitance_[l] : !is_zero(exitance[l])))
                return false;
        return true;
    };
    const bool from_nothing = can_start(false); // the better start: nothing is left of a solution that was brighter
    if (!from_nothing && (reference_exitance_.size() != exitance.size() || !can_start(true))) return false;
    latest_.emplace();
    latest_->exitance = from_nothing ? exitance : reference_exitance_;
    if (from_nothing) {
        for (std::vector<double>& e : latest_->exitance) std::ranges::fill(e, 0.0);
        latest_->solution = {ChannelField(room_.receivers, room_.channels),
                             ChannelField(room_.receivers + 1, room_.channels),
                             ChannelField(room_.receivers, room_.channels)};
    } else
        latest_->solution = reference_;
    latest_->brightest = latest_->exitance;
    return true;
}

std::optional<LightSolution> LightBases::sum(const Exitances& exitance) {
    if (exitance.size() != bases_.size() || room_.receivers == 0) return {};
    if (!is_near_latest(exitance) && !begin_sum(exitance)) return {};
    LightSolution& total = latest_->solution;
    std::vector<float> factor(static_cast<std::size_t>(total.gathered.stride), 0);
    for (std::size_t l = 0; l < exitance.size(); ++l) {
        std::vector<double>& before = latest_->exitance[l];
        if (!has(l) || exitance[l] == before) continue;
        for (std::size_t c = 0; c < exitance[l].size(); ++c) {
            factor[c] = static_cast<float>(exitance[l][c] - before[c]);
            latest_->brightest[l][c] = std::max(latest_->brightest[l][c], std::abs(exitance[l][c]));
        }
        before = exitance[l];
        ++latest_->changes;
        add_multiple(bases_[l].gathered, factor, total.gathered);
        add_multiple(bases_[l].radiosity, factor, total.radiosity);
        add_multiple(bases_[l].arriving, factor, total.arriving);
    }
    return total;
}

bool LightBases::has_reference(const Exitances& exitance) const {
    if (reference_exitance_ == exitance && !exitance.empty()) return true;
    // Sums that can be had need none: theirs was the better start.
    if (exitance.size() != bases_.size()) return false;
    for (std::size_t l = 0; l < exitance.size(); ++l)
        if (!has(l) && (reference_exitance_.size() != exitance.size() || exitance[l] != reference_exitance_[l]))
            return false;
    return true;
}

void LightBases::set_reference(const Exitances& exitance, LightSolution settled) {
    reference_exitance_ = exitance;
    reference_ = std::move(settled);
    latest_.reset();
}

std::optional<std::size_t> LightBases::next() const {
    if (count() >= most()) return {};
    const auto lacks = [&](std::size_t l) { return !has(l) && !given_up_[l]; };
    for (auto l = wanted_.rbegin(); l != wanted_.rend(); ++l)
        if (*l < bases_.size() && lacks(*l)) return *l;
    for (std::size_t l = 0; l < bases_.size(); ++l)
        if (lacks(l)) return l;
    return {};
}

void LightBases::add(std::size_t luminaire, LightSolution basis) {
    bases_[luminaire] = std::move(basis);
    latest_.reset();
    if (count() == bases_.size()) reference_exitance_.clear(), reference_ = {}; // needed no more
}

void LightBases::give_up(std::size_t luminaire) {
    given_up_[luminaire] = 1;
}

} // namespace lueur
