// Indices found by a hash of what they stand for: open addressing, so that millions cost no allocation each.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace lueur {

class IndexTable {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    explicit IndexTable(std::size_t most_indices)
        : slots_(std::bit_ceil(most_indices * 2 + 2), none) {}

    // The index already there for which `same(index)`, or none.
    template <typename Same>
    std::uint32_t find(std::uint64_t hash, const Same& same) const {
        return slots_[slot(hash, same)];
    }

    // The index already there, or `fresh`, which is then put in.
    template <typename Same>
    std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t fresh, const Same& same) {
        std::uint32_t& found = slots_[slot(hash, same)];
        if (found == none) found = fresh;
        return found;
    }

private:
    template <typename Same>
    std::size_t slot(std::uint64_t hash, const Same& same) const {
        hash ^= hash >> 32;
        hash *= 0x9e3779b97f4a7c15ull;
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = (hash >> 20) & mask;
        while (slots_[i] != none && !same(slots_[i])) i = (i + 1) & mask;
        return i;
    }

    std::vector<std::uint32_t> slots_;
};

} // namespace lueur
