#include "editor/worker.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <tbb/task_arena.h>

#include "core/solve/solution.h"

namespace lueur {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_history = 2000; // points of the convergence plot; thinned to half when full

SolveFrom solve_from(Stage stage) {
    switch (stage) {
    case Stage::mesh:
        return SolveFrom::mesh;
    case Stage::transport:
        return SolveFrom::transport;
    case Stage::sources:
        return SolveFrom::sources;
    case Stage::reflectance:
        return SolveFrom::reflectance;
    case Stage::view:
    case Stage::display:
    case Stage::nothing:
        return SolveFrom::nothing;
    }
    return SolveFrom::mesh;
}

int worker_threads(int wanted) {
    if (wanted > 0) return wanted;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

// The hand that drags comes before the light that travels: the window's threads get the processor first when they want
// it.
void lower_priority_of_this_thread() {
#ifdef __linux__
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10); // on Linux a thread's own; refused is no harm
#endif
}

} // namespace

struct Worker::State {
    explicit State(WorkerParams p)
        : params(std::move(p))
        , arena(worker_threads(params.threads)) {}

    const WorkerParams params;
    tbb::task_arena arena;
    std::thread thread;

    mutable std::mutex mutex;
    std::condition_variable work;              // something to do for the worker
    mutable std::condition_variable published; // a new snapshot for those who wait

    // Under the mutex.
    bool quit = false, paused = false, restart = false;
    int steps = 0;
    std::shared_ptr<const Scene> pending_scene;
    std::uint64_t pending_revision = 0;
    Stage pending_stage = Stage::nothing;
    std::shared_ptr<const Snapshot> snapshot = std::make_shared<Snapshot>();

    std::atomic<bool> cancel{false}; // what runs now is stale

    // The worker's own.
    std::unique_ptr<Solution> solution;
    std::uint64_t document_revision = 0, snapshot_revision = 0;
    std::vector<ConvergencePoint> history;
    std::optional<double> shown_error; // of the last field that was published since the last edit
    Clock::time_point last_publication{};
    double publication_seconds = 0; // that the last one took
    bool field_stale = true;        // the solution has moved on since
    bool edit_unshown = false;      // the light that was published is that of a scene before

    bool has_request() const { return pending_scene || restart; }

    void run();
    void take_requests(std::unique_lock<std::mutex>& lock);
    void publish(bool is_paused);
    void note_history();
};

void Worker::State::note_history() {
    const SolveStatus& s = solution->status();
    if (!history.empty() && history.back().seconds >= s.seconds) return;
    if (history.size() >= most_history) {
        for (std::size_t k = 0; 2 * k < history.size(); ++k) history[k] = history[2 * k];
        history.resize(history.size() / 2);
    }
    history.push_back({s.seconds, s.unshot_share, shown_error.value_or(s.estimated_error)});
}

// Applies what was submitted since the last look; called and left with the lock held.
void Worker::State::take_requests(std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<const Scene> scene = std::exchange(pending_scene, nullptr);
    const Stage stage = std::exchange(pending_stage, Stage::nothing);
    const bool from_black = std::exchange(restart, false);
    if (scene) document_revision = pending_revision;
    cancel.store(false);
    lock.unlock();
    if (scene && !solution)
        solution = std::make_unique<Solution>(scene);
    else if (scene)
        solution->update(scene, solve_from(stage));
    if (from_black && solution) solution->update(solution->scene(), SolveFrom::black);
    const bool stale = from_black || solve_from(stage) != SolveFrom::nothing;
    if (stale) {
        history.clear();
        shown_error.reset();
    }
    field_stale = field_stale || stale;
    edit_unshown = edit_unshown || stale;
    lock.lock();
}

void Worker::State::publish(bool is_paused) {
    const Clock::time_point start = Clock::now();
    auto next = std::make_shared<Snapshot>();
    next->revision = ++snapshot_revision;
    next->document_revision = document_revision;
    next->scene = solution->scene();
    next->mesh = solution->mesh();
    next->world = solution->world();
    next->hierarchy = solution->hierarchy();
    // An edit of the display or the camera shows the same light.
    next->field = field_stale || !snapshot->field ? solution->field() : snapshot->field;
    field_stale = edit_unshown = false;
    next->status = solution->status();
    // A field that is lit at all knows its error better than the solver, which looks at it now and then.
    if (next->field && next->field->scene_error > 0)
        shown_error = next->status.estimated_error = next->field->scene_error;
    if (shown_error && !history.empty()) history.back().error = *shown_error;
    next->status.paused = is_paused;
    next->history = history;
    {
        const std::lock_guard lock(mutex);
        snapshot = std::move(next);
    }
    published.notify_all();
    last_publication = Clock::now();
    publication_seconds = std::chrono::duration<double>(last_publication - start).count();
    if (params.wake) params.wake();
}

void Worker::State::run() {
    lower_priority_of_this_thread();
    bool unpublished = false, preparing = false;
    std::unique_lock lock(mutex);
    while (!quit) {
        if (has_request()) {
            take_requests(lock);
            unpublished = preparing = true; // it prepares again when it is done
        }
        const bool finished = !solution || solution->status().settled || solution->status().stage == SolveStage::failed;
        const bool may_run = !finished && (!paused || steps > 0);
        if (!may_run) {
            if (unpublished) {
                const bool is_paused = paused;
                lock.unlock();
                publish(is_paused);
                unpublished = false;
                lock.lock();
            } else if (preparing && solution && !paused) {
                lock.unlock();
                const bool more = solution->prepare_edits(cancel);
                lock.lock();
                preparing = more;
            } else if (!quit && !has_request()) {
                work.wait(lock);
            }
            continue;
        }
        preparing = true;
        const bool single = paused;
        if (single) --steps;
        const bool is_paused = paused;
        lock.unlock();
        const std::uint32_t sweeps = solution->status().sweeps, shots = solution->status().shots;
        const SolveStage stage_before = solution->status().stage;
        do {
            solution->step(cancel, single);
            field_stale = true;
            // A single step shows something new: a sweep, a shot or the end of a stage.
        } while (single && !cancel.load() && !solution->status().settled &&
                 solution->status().stage != SolveStage::failed && solution->status().sweeps == sweeps &&
                 solution->status().shots == shots && solution->status().stage == stage_before);
        note_history();
        unpublished = true;
        const double since = std::chrono::duration<double>(Clock::now() - last_publication).count();
        // A large field is shown less often, so that showing takes a small share of the time; but an edit at once,
        // however soon the next one comes: the hand that drags is led by what it sees.
        const double interval = edit_unshown ? 0 : std::max(params.publish_interval, 6 * publication_seconds);
        if ((edit_unshown || !cancel.load()) && solution->mesh() && (single || since > interval)) {
            publish(is_paused);
            unpublished = false;
        }
        lock.lock();
    }
}

Worker::Worker(WorkerParams params)
    : state_(std::make_unique<State>(std::move(params))) {
    state_->thread = std::thread([state = state_.get()] { state->arena.execute([state] { state->run(); }); });
}

Worker::~Worker() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->quit = true;
        state_->cancel.store(true);
    }
    state_->work.notify_all();
    state_->thread.join();
}

void Worker::submit(std::shared_ptr<const Scene> scene, std::uint64_t document_revision, Stage stale) {
    {
        const std::lock_guard lock(state_->mutex);
        State& s = *state_;
        s.pending_stage = s.pending_scene ? std::min(s.pending_stage, stale) : stale;
        s.pending_scene = std::move(scene);
        s.pending_revision = document_revision;
        if (solve_from(stale) != SolveFrom::nothing) s.cancel.store(true);
    }
    state_->work.notify_all();
}

void Worker::set_paused(bool paused) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->paused = paused;
        state_->steps = 0;
        if (state_->snapshot->scene) {
            auto next = std::make_shared<Snapshot>(*state_->snapshot);
            next->status.paused = paused;
            state_->snapshot = std::move(next);
        }
    }
    state_->work.notify_all();
}

void Worker::step() {
    {
        const std::lock_guard lock(state_->mutex);
        if (state_->paused) ++state_->steps;
    }
    state_->work.notify_all();
}

void Worker::restart() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->restart = true;
        state_->cancel.store(true);
    }
    state_->work.notify_all();
}

std::shared_ptr<const Snapshot> Worker::latest() const {
    const std::lock_guard lock(state_->mutex);
    return state_->snapshot;
}

bool Worker::wait_settled(std::uint64_t document_revision, double seconds) const {
    std::unique_lock lock(state_->mutex);
    return state_->published.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
        const Snapshot& s = *state_->snapshot;
        return s.document_revision >= document_revision && (s.status.settled || s.status.stage == SolveStage::failed);
    });
}

} // namespace lueur
