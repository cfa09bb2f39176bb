#include "editor/commands/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace lueur {

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    wipe();
}

void ProgressBar::show(std::string_view what, double share, std::string_view note) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (drawn_ && what == what_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    what_ = what;
    drawn_ = true;
    constexpr int width = 30;
    const double clamped = share > 0 ? std::min(share, 1.0) : 0.0;
    const int full = static_cast<int>(clamped * width);
    fmt::print(stderr, "\r{:<16} [{:#<{}}{:<{}}] {:3.0f} %  {}\x1b[K", what, "", full, "", width - full, 100 * clamped,
               note);
    std::fflush(stderr);
}

void ProgressBar::wipe() {
    if (!drawn_) return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
    drawn_ = false;
}

} // namespace lueur
