// The one or two leaves at each edge of a mesh, in one array: edges are looked up a dozen times a split, and there are
// three for two triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lueur {

class EdgeTable {
public:
    using Leaves = std::array<std::uint32_t, 2>; // all bits set: none

    // Of so many edges it does not grow.
    void reserve(std::size_t edges) {
        std::size_t slots = 16;
        while (slots * most_filled / 10 < edges) slots *= 2;
        if (slots > slots_.size()) rebuild(slots);
    }
    // Leaves of an edge, none if it was not there.
    Leaves& at(std::uint64_t edge) {
        if ((used_ + 1) * 10 > slots_.size() * most_filled) rebuild(std::max<std::size_t>(16, 2 * slots_.size()));
        Slot& slot = slots_[place_of(edge)];
        if (slot.edge == empty) slot.edge = edge, ++used_;
        return slot.leaves;
    }
    Leaves find(std::uint64_t edge) const {
        return slots_.empty() ? none : slots_[place_of(edge)].leaves; // of an empty slot: none
    }

private:
    static constexpr std::uint64_t empty = ~std::uint64_t(0);
    static constexpr Leaves none{0xffffffffu, 0xffffffffu};
    static constexpr std::size_t most_filled = 7; // tenths
    struct Slot {
        std::uint64_t edge = empty;
        Leaves leaves = none;
    };

    // Where it is, or the empty slot where it belongs (linear probing).
    std::size_t place_of(std::uint64_t edge) const {
        std::uint64_t hash = edge * 0x9e3779b97f4a7c15ull;
        hash ^= hash >> 32;
        std::size_t place = hash & (slots_.size() - 1);
        while (slots_[place].edge != edge && slots_[place].edge != empty) place = (place + 1) & (slots_.size() - 1);
        return place;
    }
    void rebuild(std::size_t slots) {
        std::vector<Slot> before(slots);
        before.swap(slots_);
        used_ = 0;
        for (const Slot& slot : before)
            if (slot.edge != empty && slot.leaves != none) slots_[place_of(slot.edge)] = slot, ++used_;
    }

    std::vector<Slot> slots_; // a power of two
    std::size_t used_ = 0;
};

} // namespace lueur
