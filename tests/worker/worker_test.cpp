// The worker: edits while it solves are safe, end where a fresh solve ends, and cost nothing when there is nothing to
// do. Runs under ThreadSanitizer too (tests/run).
#include <chrono>
#include <cmath>
#include <ctime>
#include <random>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document.h"
#include "editor/worker.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

#ifdef __SANITIZE_THREAD__
constexpr double patience = 300;
constexpr int rounds = 1, edits_a_round = 25;
#else
constexpr double patience = 60;
constexpr int rounds = 4, edits_a_round = 40;
#endif

Scene quick_room() {
    Scene scene = test::small_room();
    scene.solve.element_size = 1;
    scene.solve.target_error = 0.05;
    return scene;
}

double cpu_seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

class RandomEdits {
public:
    explicit RandomEdits(std::uint32_t seed)
        : random_(seed) {}
    Edit next(const Scene& scene) {
        const auto material = static_cast<MaterialIndex>(pick(scene.materials.size()));
        const auto luminaire = static_cast<LuminaireIndex>(pick(scene.luminaires.size()));
        switch (pick(9)) {
        case 0:
            return SetReflectance{material, uniform(0, 0.95)};
        case 1:
            return SetReflectance{material, Rgb(uniform(0, 0.9), uniform(0, 0.9), uniform(0, 0.9))};
        case 2:
            return SetDimmer{luminaire, uniform(0, 1.5)};
        case 3:
            return SetEmissionSpectrum{luminaire, Blackbody{uniform(1800, 8000)}};
        case 4:
            return SetPower{luminaire, PowerUnit::lumen, uniform(100, 4000)};
        case 5:
            return GiveOwnMaterial{static_cast<ObjectIndex>(pick(scene.objects.size()))};
        case 6: {
            DisplaySettings display = scene.display;
            display.gamma = glm::dvec3(uniform(1, 3));
            return SetDisplay{display};
        }
        case 7:
            return SetTwoSided{material, pick(2) == 0};
        default: {
            Camera camera = scene.camera;
            camera.position.x += 0.1;
            return SetCamera{camera};
        }
        }
    }
    std::size_t pick(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

private:
    std::mt19937 random_;
};

} // namespace

TEST(Worker, SettlesAndSleeps) {
    Document document(quick_room());
    Worker worker({.threads = 1, .publish_interval = 0.01, .wake = {}});
    EXPECT_EQ(worker.latest()->mesh, nullptr);
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    ASSERT_TRUE(worker.wait_settled(document.revision(), patience));
    const auto snapshot = worker.latest();
    EXPECT_TRUE(snapshot->status.settled);
    EXPECT_EQ(snapshot->scene, document.shared_scene());
    ASSERT_NE(snapshot->field, nullptr);
    EXPECT_EQ(snapshot->field->irradiance_xyz.size(), snapshot->mesh->vertices.size());
    EXPECT_FALSE(snapshot->history.empty());
    // First it prepares for edits to come, which takes a while under a sanitizer.
    double used = 1;
    for (int tries = 0; tries < 60 && used >= 0.05; ++tries) {
        const double before = cpu_seconds();
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        used = cpu_seconds() - before;
    }
    EXPECT_LT(used, 0.05);                // asleep
    EXPECT_EQ(worker.latest(), snapshot); // and quiet
}

TEST(Worker, RandomEditsWhileSolvingSettleWhereAFreshSolveDoes) {
    RandomEdits edits(7);
    // auto keeps the wavelengths it has while they are good enough: its history shows within the colour error allowed.
    Scene scene = quick_room();
    scene.solve.wavelengths = {WavelengthRule::uniform, 31};
    Document document(std::move(scene));
    std::atomic<int> wakes{0};
    Worker worker({.threads = 1, .publish_interval = 0.002, .wake = [&] { ++wakes; }});
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    for (int round = 0; round < rounds; ++round) {
        for (int k = 0; k < edits_a_round; ++k) {
            Stage stage = Stage::nothing;
            if (edits.pick(8) == 0 && document.can_undo())
                stage = document.undo();
            else if (edits.pick(8) == 0 && document.can_redo())
                stage = document.redo();
            else if (const auto applied = document.apply(edits.next(document.scene())))
                stage = *applied;
            worker.submit(document.shared_scene(), document.revision(), stage);
            if (edits.pick(3) == 0) std::this_thread::sleep_for(std::chrono::microseconds(edits.pick(20000)));
            const auto seen = worker.latest(); // read while it is being solved: whole and sound
            if (!seen->field) continue;
            for (const glm::vec3& h : seen->field->irradiance_xyz) ASSERT_TRUE(std::isfinite(h.y) && h.y >= 0);
        }
        ASSERT_TRUE(worker.wait_settled(document.revision(), patience));
        const auto snapshot = worker.latest();
        ASSERT_TRUE(snapshot->status.settled) << snapshot->status.message;
        const Solution fresh = test::solved(document.scene());
        ASSERT_EQ(snapshot->field->irradiance_xyz.size(), fresh.field()->irradiance_xyz.size());
        EXPECT_LT(test::field_difference(*snapshot->field, *fresh.field()), 1e-3);
    }
    EXPECT_GT(wakes.load(), 0);
}

TEST(Worker, AFloodOfEditsEndsSettled) {
    Document document(quick_room());
    Worker worker({.threads = 1, .publish_interval = 0.01, .wake = {}});
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    for (int k = 1; k <= 1000; ++k) {
        ASSERT_TRUE(document.apply(SetDimmer{LuminaireIndex{0}, k / 1000.0}));
        worker.submit(document.shared_scene(), document.revision(), Stage::sources);
    }
    ASSERT_TRUE(worker.wait_settled(document.revision(), patience));
    EXPECT_EQ(worker.latest()->scene->luminaires[0].dimmer, 1.0);
    const Solution fresh = test::solved(document.scene());
    EXPECT_LT(test::field_difference(*worker.latest()->field, *fresh.field()), 1e-3);
}

// The hand that drags a slider sees what it does while it moves.
TEST(Worker, EditsAreShownHoweverSoonTheNextComes) {
    Document document(quick_room());
    Worker worker({.threads = 1, .publish_interval = 0.01, .wake = {}});
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    ASSERT_TRUE(worker.wait_settled(document.revision(), patience));
    std::set<std::uint64_t> shown;
    for (int k = 1; k <= 2000; ++k) {
        const double grey = 0.2 + 0.6 * k / 2000;
        const auto stage = document.apply(SetReflectance{MaterialIndex{0}, grey});
        ASSERT_TRUE(stage);
        worker.submit(document.shared_scene(), document.revision(), *stage);
        shown.insert(worker.latest()->document_revision);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_GE(shown.size(), 10u);
}

TEST(Worker, PausesStepsAndRestarts) {
    Scene scene = quick_room();
    scene.solve.solver = SolverKind::shooting;
    Document document(scene);
    Worker worker({.threads = 1, .publish_interval = 0.001, .wake = {}});
    worker.set_paused(true);
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    EXPECT_FALSE(worker.wait_settled(document.revision(), 0.2));
    const auto step_until = [&](std::uint32_t shots) {
        for (int k = 0; k < 2000 && worker.latest()->status.shots < shots; ++k) {
            const std::uint64_t before = worker.latest()->revision;
            worker.step();
            for (int wait = 0; wait < 5000 && worker.latest()->revision == before; ++wait)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    };
    step_until(3);
    const auto paused = worker.latest();
    ASSERT_EQ(paused->status.shots, 3u);
    EXPECT_TRUE(paused->status.paused);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(worker.latest()->status.shots, paused->status.shots); // it waits
    worker.restart();
    for (int wait = 0; wait < 5000 && worker.latest()->revision == paused->revision; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(worker.latest()->status.shots, 0u); // from black
    step_until(1);
    EXPECT_EQ(worker.latest()->status.shots, 1u); // a step is one shot
    worker.set_paused(false);
    EXPECT_TRUE(worker.wait_settled(document.revision(), patience));
}

TEST(Worker, EndsWhileItWorks) {
    for (int k = 0; k < 5; ++k) {
        Document document(test::small_room());
        Worker worker({.threads = 1, .publish_interval = 0.001, .wake = {}});
        worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
        std::this_thread::sleep_for(std::chrono::milliseconds(10 * k));
    } // the destructor cancels and joins
    SUCCEED();
}

// What edits cost: display and camera edits start no solver work, a dimmer traces no ray.
TEST(Worker, EditsTraceNoMoreThanTheyMust) {
    Document document(quick_room());
    Worker worker({.threads = 1, .publish_interval = 0.01, .wake = {}});
    worker.submit(document.shared_scene(), document.revision(), Stage::mesh);
    ASSERT_TRUE(worker.wait_settled(document.revision(), patience));
    const auto before = worker.latest();
    const auto after = [&](const Edit& edit) {
        const auto stage = document.apply(edit);
        EXPECT_TRUE(stage);
        worker.submit(document.shared_scene(), document.revision(), stage.value_or(Stage::mesh));
        EXPECT_TRUE(worker.wait_settled(document.revision(), patience));
        return worker.latest();
    };
    DisplaySettings display = document.scene().display;
    display.gamma = glm::dvec3(1.7);
    const auto shown = after(SetDisplay{display});
    EXPECT_EQ(shown->status.rays, before->status.rays);
    EXPECT_EQ(shown->status.sweeps, before->status.sweeps);
    EXPECT_EQ(shown->status.seconds, before->status.seconds);
    const auto dimmed = after(SetDimmer{LuminaireIndex{0}, 0.3});
    const auto painted = after(SetReflectance{MaterialIndex{1}, 0.5});
    EXPECT_EQ(dimmed->status.rays, before->status.rays);
    EXPECT_EQ(painted->status.rays, before->status.rays);
    EXPECT_EQ(painted->mesh, before->mesh);
    EXPECT_GT(painted->status.last_edit_seconds, 0);
}
