// A chart in the making beside a window: what the window's thread asks for never waits for the runs.
#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "editor/chart/chart_job.h"
#include "tests/support/scenes.h"

namespace lueur {
namespace {

ChartParams one_small_run() {
    ChartParams params;
    params.points = 10;
    params.reference_paths = 16;
    params.levels = 1;
    params.methods = {{SolverKind::gathering, FormFactorMethod::automatic, RefinementOracle::error}};
    return params;
}

// Holds every thread that comes by until it is opened, and knows of the first.
class Gate {
public:
    void pass() {
        std::unique_lock lock(mutex_);
        reached_ = true;
        moved_.notify_all();
        moved_.wait(lock, [this] { return open_; });
    }
    void wait_until_reached() {
        std::unique_lock lock(mutex_);
        moved_.wait(lock, [this] { return reached_; });
    }
    void open() {
        const std::lock_guard lock(mutex_);
        open_ = true;
        moved_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable moved_;
    bool reached_ = false, open_ = false;
};

TEST(ChartJob, TheWindowNeverWaitsForWhatItCancels) {
    Gate gate;
    ChartJob job([&] { gate.pass(); });
    EXPECT_FALSE(job.view().running);
    const auto first = std::make_shared<const Scene>(test::small_room());
    const auto second = std::make_shared<const Scene>(test::small_room());
    job.start(first, one_small_run());
    gate.wait_until_reached(); // its thread is in the middle of a step that does not end
    EXPECT_TRUE(job.view().running);
    EXPECT_EQ(job.view().scene, first);
    auto window = std::async(std::launch::async, [&] {
        job.cancel();
        job.start(second, one_small_run());
        job.cancel();
        job.start(second, one_small_run());
    });
    // A step that does not end is waited for for ever, by whom it is: no slow machine is taken for that.
    const bool went_on = window.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
    EXPECT_TRUE(went_on);
    if (went_on) {
        EXPECT_EQ(job.view().scene, second);
        EXPECT_TRUE(job.view().running);
        EXPECT_EQ(job.view().chart, nullptr) << "nothing of the chart before";
    }
    gate.open();
    window.wait();
    while (job.view().running) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const ChartJob::View made = job.view();
    ASSERT_NE(made.chart, nullptr) << made.what;
    EXPECT_EQ(made.scene, second);
    ASSERT_EQ(made.chart->runs.size(), 1u);
    EXPECT_EQ(made.chart->runs[0].end, RunEnd::settled) << "it was not cancelled with the ones before";
}

} // namespace
} // namespace lueur
