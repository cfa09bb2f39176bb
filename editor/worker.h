// The thread that solves. It owns the solution; everybody else sees immutable snapshots.
//
// Threads: every member may be called from any thread. submit() never waits for the solver: it cancels what the edit
// made stale (within one small step, <= 10 ms) and returns. When the target error is met the worker prepares for edits
// of the luminaires (Solution::prepare_edits), then sleeps and uses no CPU.
#pragma once

#include <functional>
#include <memory>

#include "editor/edit.h"
#include "editor/snapshot.h"

namespace lueur {

struct WorkerParams {
    int threads = 0;                    // 0: one fewer than the machine has, at least one (the window keeps one)
    double publish_interval = 1.0 / 30; // seconds between snapshots while solving; an edit is shown at once
    std::function<void()> wake;         // called after each publication, from the worker's thread (glfwPostEmptyEvent)
};

class Worker {
public:
    explicit Worker(WorkerParams params = {});
    ~Worker(); // cancels and joins
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    // The scene changed; everything from `stale` on is to be done again. Several submissions before the worker looks
    // are merged.
    void submit(std::shared_ptr<const Scene> scene, std::uint64_t document_revision, Stage stale);

    void set_paused(bool paused);
    void step();    // while paused: one sweep or one shot
    void restart(); // throw the solution away, keep the rays and start from black

    std::shared_ptr<const Snapshot> latest() const; // never null
    // Waits until a snapshot of `document_revision` or later is settled or failed; false after the time is out.
    bool wait_settled(std::uint64_t document_revision, double seconds) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lueur
