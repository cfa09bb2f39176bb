// A chart of methods in the making, on a thread of its own, for a window that goes on.
//
// Threads: every member may be called from any one thread at a time; none waits for the runs but the destructor, which
// waits for a step of what is being cancelled: some 10 ms, more where a matrix or a final gather begins. A chart that
// is begun while another ends waits for that one on its own thread, so that the two do not slow each other down.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "editor/chart/run_chart.h"

namespace lueur {

class ChartJob {
public:
    explicit ChartJob(std::function<void()> wake); // called from the thread when there is something new, at most 10 a s
    ~ChartJob();                                   // cancels
    ChartJob(const ChartJob&) = delete;
    ChartJob& operator=(const ChartJob&) = delete;

    void start(std::shared_ptr<const Scene> scene, ChartParams params); // cancels what is running
    void cancel();                                                      // keeps the runs that are done

    struct View {
        bool running = false;
        double share = 0; // 0..1
        std::string what; // is being run; or why there is no chart
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const MethodChart> chart; // finished runs only; null: none yet
    };
    View view() const;

private:
    // One chart, of the window's thread and its own.
    struct Making {
        std::atomic<bool> cancel{false};
        mutable std::mutex mutex;
        View view; // under the mutex
    };
    void run(Making& making, const Scene& scene, const ChartParams& params) const;

    const std::function<void()> wake_;
    std::shared_ptr<Making> making_; // the newest
    std::thread thread_;             // of the newest; it joins the one before
};

} // namespace lueur
