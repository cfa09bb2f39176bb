// Ctrl-C as a flag that long work looks at.
#pragma once

#include <atomic>
#include <csignal>

namespace lueur {

// While it lives, SIGINT sets the flag instead of ending the program; one at a time.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    const std::atomic<bool>& requested() const;

private:
    struct sigaction before_;
};

} // namespace lueur
