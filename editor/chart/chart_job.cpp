#include "editor/chart/chart_job.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <tbb/task_arena.h>

namespace lueur {

ChartJob::ChartJob(std::function<void()> wake)
    : wake_(std::move(wake)) {}

ChartJob::~ChartJob() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

void ChartJob::cancel() {
    if (making_) making_->cancel.store(true);
}

void ChartJob::start(std::shared_ptr<const Scene> scene, ChartParams params) {
    cancel();
    making_ = std::make_shared<Making>();
    making_->view = {true, 0, {}, scene, nullptr};
    thread_ = std::thread([this, before = std::move(thread_), making = making_, scene = std::move(scene),
                           params = std::move(params)]() mutable {
        if (before.joinable()) before.join();
        run(*making, *scene, params);
    });
}

ChartJob::View ChartJob::view() const {
    if (!making_) return {};
    const std::lock_guard lock(making_->mutex);
    return making_->view;
}

void ChartJob::run(Making& making, const Scene& scene, const ChartParams& params) const {
    using Clock = std::chrono::steady_clock;
#ifdef __linux__
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10); // the window comes first; refused is no harm
#endif
    std::size_t published = 0;
    Clock::time_point last{};
    const auto progress = [&](double share, const std::string& what, const MethodChart& so_far) {
        const std::size_t done = so_far.runs.empty() ? 0 : so_far.runs.size() - 1; // the last is running
        if (done == published && Clock::now() - last < std::chrono::milliseconds(100)) return;
        last = Clock::now();
        std::shared_ptr<MethodChart> chart;
        if (done != published) {
            chart = std::make_shared<MethodChart>(so_far);
            chart->runs.pop_back();
            published = done;
        }
        {
            const std::lock_guard lock(making.mutex);
            making.view.share = share;
            making.view.what = what;
            if (chart) making.view.chart = std::move(chart);
        }
        if (wake_) wake_();
    };
    std::shared_ptr<const MethodChart> chart;
    std::string what;
    try {
        // Half of the processors: the live solve and the window go on beside it.
        tbb::task_arena arena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2));
        MethodChart made = arena.execute([&] { return run_chart(scene, params, making.cancel, progress); });
        if (made.points == 0 && !making.cancel) what = "the scene has no lit surface to measure on";
        if (!made.runs.empty()) chart = std::make_shared<const MethodChart>(std::move(made));
    } catch (const std::exception& error) {
        what = error.what();
    }
    {
        const std::lock_guard lock(making.mutex);
        making.view.running = false;
        making.view.share = 1;
        making.view.what = what;
        if (chart) making.view.chart = std::move(chart);
    }
    if (wake_) wake_();
}

} // namespace lueur
