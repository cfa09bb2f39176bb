#include "editor/commands/interrupt.h"

namespace lueur {

namespace {
// A signal handler reaches nothing but what has static storage.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);
void on_interrupt(int) {
    interrupted = true;
}
} // namespace

Interrupt::Interrupt() {
    interrupted = false;
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART; // a write of a file that is under way is finished
    sigaction(SIGINT, &action, &before_);
}

Interrupt::~Interrupt() {
    sigaction(SIGINT, &before_, nullptr);
}

const std::atomic<bool>& Interrupt::requested() const {
    return interrupted;
}

} // namespace lueur
