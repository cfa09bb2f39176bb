// Loops that can be left and taken up again: long stages stay small steps.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

inline constexpr double step_seconds = 0.005;

// For loops that are not parallel: whether the step's time is over, or it is cancelled. Looks at the clock every so
// many calls.
class TimeSlice {
public:
    explicit TimeSlice(const std::atomic<bool>& cancel, std::uint32_t calls_a_look = 1)
        : cancel_(cancel)
        , calls_a_look_(calls_a_look) {}
    bool over() {
        if (++calls_ % calls_a_look_ != 0) return false;
        return cancel_.load(std::memory_order_relaxed) ||
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() > step_seconds;
    }

private:
    const std::atomic<bool>& cancel_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    const std::uint32_t calls_a_look_;
    std::uint32_t calls_ = 0;
};

// Calls f(i) for i from cursor on, `block` of them between two looks at the clock, and moves the cursor past what is
// done. What is done does not depend on the time. True at the end.
template <typename F>
bool run_slice(std::size_t& cursor, std::size_t end, std::size_t block, TimeSlice& slice, const F& f) {
    while (cursor < end) {
        for (const std::size_t last = std::min(end, cursor + block); cursor < last; ++cursor) f(cursor);
        if (slice.over()) break;
    }
    return cursor >= end;
}

// Calls f(first, last) for blocks of [cursor, end) in parallel until the end, `step_seconds` are over, or `cancel` is
// set; moves the cursor past what is done. What is done does not depend on the time. True at the end.
template <typename F>
bool run_slice(std::uint32_t& cursor, std::uint32_t end, std::uint32_t block, const std::atomic<bool>& cancel,
               const F& f) {
    const auto seconds_since = [](std::chrono::steady_clock::time_point then) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
    };
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t chunk = std::uint64_t(8) * block;
    while (cursor < end) {
        if (cancel.load(std::memory_order_relaxed)) return false;
        const auto chunk_start = std::chrono::steady_clock::now();
        const std::uint32_t last = static_cast<std::uint32_t>(std::min<std::uint64_t>(end, cursor + chunk));
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(cursor, last, block),
                          [&](const tbb::blocked_range<std::uint32_t>& range) { f(range.begin(), range.end()); });
        cursor = last;
        if (seconds_since(start) > step_seconds) break;
        if (seconds_since(chunk_start) < 0.2 * step_seconds)
            chunk *= 2; // waking threads for less costs more than it gives
    }
    return cursor >= end;
}

} // namespace lueur
