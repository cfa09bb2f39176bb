// A solution in the making: mesh, transport and radiosities of one scene, brought forward in small steps.
//
// Thread: one at a time; a step uses the calling TBB arena for its parallel loops. Everything handed out (mesh, world,
// field) is immutable and may be kept and read from any thread.
#pragma once

#include <atomic>
#include <memory>

#include "core/scene/scene.h"
#include "core/solve/field.h"
#include "core/solve/status.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

struct HierarchyView; // hierarchy_view.h

// What an edit left valid; all stages after it are redone.
enum class SolveFrom { mesh, transport, sources, reflectance, black, nothing };

class Solution {
public:
    explicit Solution(std::shared_ptr<const Scene> scene);
    ~Solution();
    Solution(Solution&&) noexcept;
    Solution& operator=(Solution&&) noexcept;

    // transport: other rays, form factors or links on the same mesh; sources: new exitances (no ray); reflectance: new
    // reflectances or wavelengths (no ray); black: start again from zero on kept rays.
    void update(std::shared_ptr<const Scene> scene, SolveFrom stale);

    // One small step (about 5 ms of work a core); stops early and resumably when `cancel` becomes true. False when
    // nothing is left to do. `one_shot`: a step of the shooting solver is a single shot, to be looked at.
    bool step(const std::atomic<bool>& cancel, bool one_shot = false);

    // A settled solution brings forward by some 5 ms what makes the next edits cheap: what each luminaire alone does,
    // so that another dimmer or spectrum is a sum. Changes nothing that is seen; false when nothing is left to do.
    bool prepare_edits(const std::atomic<bool>& cancel);

    // Brings status().estimated_error up to date with field() where the solver was stopped on its way; a settled one
    // is.
    void take_stock();

    const SolveStatus& status() const;
    const std::shared_ptr<const Scene>& scene() const;
    std::shared_ptr<const Mesh> mesh() const;               // null before it is made
    std::shared_ptr<const World> world() const;             // null before it is made
    std::shared_ptr<const HierarchyView> hierarchy() const; // hierarchical: of the last round; else null
    std::shared_ptr<const Field> field() const;             // as of now; null before there is a mesh

    struct State; // solution_state.h, for the rest of core/solve and core/view
    const State& state() const { return *state_; }

private:
    std::unique_ptr<State> state_;
};

} // namespace lueur
