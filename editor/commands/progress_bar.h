// A bar on stderr that says how far long work is; silent when stderr is not a terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace lueur {

class ProgressBar {
public:
    ProgressBar();
    ~ProgressBar(); // wipes the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // At most ten times a second reaches the terminal. `share` 0..1; `note` stands behind the bar.
    void show(std::string_view what, double share, std::string_view note = {});
    void wipe(); // before a line of text is written

private:
    bool terminal_;
    bool drawn_ = false;
    std::string what_;
    std::chrono::steady_clock::time_point last_{};
};

} // namespace lueur
