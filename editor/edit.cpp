#include "editor/edit.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/scene/scene_file.h"
#include "core/scene/solver_words.h"
#include "core/solve/choose_solver.h"
#include "core/spectrum/overload.h"

namespace lueur {

namespace {

// The name of an entry for a person; edits that come from outside may name one that is not there.
template <typename Index, typename Entry>
std::string name_of(const std::vector<Entry>& entries, Index index) {
    return at(index) < entries.size() ? entries[at(index)].name : fmt::format("number {}", at(index));
}

template <typename Index, typename Entry>
std::optional<std::string> no_such(const char* kind, const std::vector<Entry>& entries, Index index) {
    if (at(index) < entries.size()) return {};
    return fmt::format("there is no {} {}; the scene has {}", kind, at(index), entries.size());
}

Stage stage_of_settings(const Scene& scene, const SolveSettings& after) {
    const SolveSettings& before = scene.solve;
    if (after.element_size != before.element_size) return Stage::mesh;
    // Rays already traced were drawn from another sequence, or are more than are allowed now.
    if (after.seed != before.seed || after.max_rays < before.max_rays) return Stage::transport;
    // Form factors and links are kept by the solvers that use them; to the others these settings are nothing.
    const SolverKind solver = chosen_solver(after);
    if (solver == chosen_solver(scene)) {
        const bool other_factors = after.form_factors != before.form_factors ||
                                   after.form_factor_samples != before.form_factor_samples ||
                                   after.matrix_memory != before.matrix_memory;
        const bool other_links = after.oracle != before.oracle || after.link_tolerance != before.link_tolerance;
        if (uses_form_factors(solver) && other_factors) return Stage::transport;
        if (solver == SolverKind::hierarchical && other_links) return Stage::transport;
    }
    // Another target or more rays: the solver goes on from the rays it has, or has met the target already.
    return after == before ? Stage::nothing : Stage::reflectance;
}

std::string unused_name(const std::vector<Material>& materials, const std::string& wanted) {
    const auto taken = [&](const std::string& name) {
        return std::ranges::any_of(materials, [&](const Material& material) { return material.name == name; });
    };
    if (!taken(wanted)) return wanted;
    for (int number = 2;; ++number)
        if (auto name = fmt::format("{} {}", wanted, number); !taken(name)) return name;
}

// A texture's mean is taken over the triangles that use it: it must follow when objects come or go.
void take_mean_again(Scene& scene, MaterialIndex material) {
    if (const auto texture = scene.materials[at(material)].texture; texture && texture->image)
        set_texture(scene, material, *texture);
}

// Changes the scene in place; the reason when the edit names something that is not there.
std::optional<std::string> change(const Edit& edit, Scene& scene) {
    return std::visit(
        Overload{
            [&](const SetReflectance& e) -> std::optional<std::string> {
                if (auto reason = no_such("material", scene.materials, e.material)) return reason;
                auto& material = scene.materials[at(e.material)];
                material.reflectance = e.reflectance;
                material.texture.reset(); // paint covers the picture: a texture brings its own mean reflectance
                return {};
            },
            [&](const SetTexture& e) -> std::optional<std::string> {
                if (auto reason = no_such("material", scene.materials, e.material)) return reason;
                if (!e.texture) {
                    scene.materials[at(e.material)].texture.reset();
                    return {};
                }
                if (!e.texture->image || e.texture->image->rgb.empty())
                    return fmt::format("texture {} has no picture; a texture must be read before it is used",
                                       e.texture->path);
                set_texture(scene, e.material, *e.texture);
                return {};
            },
            [&](const SetTwoSided& e) -> std::optional<std::string> {
                if (auto reason = no_such("material", scene.materials, e.material)) return reason;
                scene.materials[at(e.material)].two_sided = e.two_sided;
                return {};
            },
            [&](const GiveOwnMaterial& e) -> std::optional<std::string> {
                if (auto reason = no_such("object", scene.objects, e.object)) return reason;
                auto& object = scene.objects[at(e.object)];
                if (auto reason = no_such("material", scene.materials, object.material)) return reason;
                const bool shared = std::ranges::count(scene.objects, object.material, &Object::material) > 1;
                if (!shared) return {};
                Material own = scene.materials[at(object.material)];
                own.name = unused_name(scene.materials, object.name);
                const MaterialIndex before = object.material, after = MaterialIndex(scene.materials.size());
                object.material = after;
                scene.materials.push_back(std::move(own));
                take_mean_again(scene, before);
                take_mean_again(scene, after);
                return {};
            },
            [&](const AssignMaterial& e) -> std::optional<std::string> {
                if (auto reason = no_such("object", scene.objects, e.object)) return reason;
                if (auto reason = no_such("material", scene.materials, e.material)) return reason;
                const MaterialIndex before = std::exchange(scene.objects[at(e.object)].material, e.material);
                if (before == e.material) return {};
                if (at(before) < scene.materials.size()) take_mean_again(scene, before);
                take_mean_again(scene, e.material);
                return {};
            },
            [&](const SetDimmer& e) -> std::optional<std::string> {
                if (auto reason = no_such("luminaire", scene.luminaires, e.luminaire)) return reason;
                scene.luminaires[at(e.luminaire)].dimmer = e.dimmer;
                return {};
            },
            [&](const SetPower& e) -> std::optional<std::string> {
                if (auto reason = no_such("luminaire", scene.luminaires, e.luminaire)) return reason;
                scene.luminaires[at(e.luminaire)].unit = e.unit;
                scene.luminaires[at(e.luminaire)].power = e.power;
                return {};
            },
            [&](const SetEmissionSpectrum& e) -> std::optional<std::string> {
                if (auto reason = no_such("luminaire", scene.luminaires, e.luminaire)) return reason;
                scene.luminaires[at(e.luminaire)].spectrum = e.spectrum;
                return {};
            },
            [&](const SetEmitSide& e) -> std::optional<std::string> {
                if (auto reason = no_such("luminaire", scene.luminaires, e.luminaire)) return reason;
                scene.luminaires[at(e.luminaire)].side = e.side;
                return {};
            },
            [&](const SetCamera& e) -> std::optional<std::string> {
                scene.camera = e.camera;
                return {};
            },
            [&](const SetDisplay& e) -> std::optional<std::string> {
                scene.display = e.display;
                return {};
            },
            [&](const SetSolve& e) -> std::optional<std::string> {
                if (const auto known = parse_wavelengths(to_string(e.solve.wavelengths)); !known) return known.error();
                scene.solve = e.solve;
                return {};
            },
            [&](const ReplaceScene& e) -> std::optional<std::string> {
                scene = e.scene;
                return {};
            },
        },
        edit);
}

} // namespace

Stage first_stale_stage(const Edit& edit, const Scene& before) {
    return std::visit(
        Overload{
            [](const SetReflectance&) { return Stage::reflectance; },
            [](const SetTexture&) { return Stage::reflectance; },
            [](const SetTwoSided&) { return Stage::mesh; }, // a second side is a second set of elements
            // The light stays as it is, but the solver keeps a reflectance a material, and here is a new one.
            [](const GiveOwnMaterial&) { return Stage::reflectance; },
            [&](const AssignMaterial& e) {
                if (at(e.object) >= before.objects.size() || at(e.material) >= before.materials.size())
                    return Stage::nothing;
                const auto now = before.objects[at(e.object)].material;
                if (now == e.material) return Stage::nothing;
                if (at(now) >= before.materials.size()) return Stage::mesh;
                const bool sides_change =
                    before.materials[at(now)].two_sided != before.materials[at(e.material)].two_sided;
                return sides_change ? Stage::mesh : Stage::reflectance;
            },
            [](const SetDimmer&) { return Stage::sources; },
            [](const SetPower&) { return Stage::sources; },
            [](const SetEmissionSpectrum&) { return Stage::sources; },
            [](const SetEmitSide&) { return Stage::mesh; }, // a side that emits must have elements
            [](const SetCamera&) { return Stage::view; },
            [](const SetDisplay&) { return Stage::display; },
            [&](const SetSolve& e) { return stage_of_settings(before, e.solve); },
            [](const ReplaceScene&) { return Stage::mesh; },
        },
        edit);
}

std::expected<Scene, std::string> apply(const Edit& edit, const Scene& scene) {
    Scene after = scene;
    if (auto reason = change(edit, after)) return std::unexpected(*reason);
    // One set of rules for values, the scene file's. Faults that were there before are not this edit's.
    const auto faults = check(after);
    if (!faults.empty()) {
        const auto before = check(scene);
        for (const auto& fault : faults)
            if (std::ranges::find(before, fault) == before.end()) return std::unexpected(fault);
    }
    return after;
}

std::string describe(const Edit& edit, const Scene& scene) {
    const auto material = [&](MaterialIndex index) { return name_of(scene.materials, index); };
    const auto object = [&](ObjectIndex index) { return name_of(scene.objects, index); };
    const auto luminaire = [&](LuminaireIndex index) { return name_of(scene.luminaires, index); };
    return std::visit(
        Overload{
            [&](const SetReflectance& e) { return "Repaint " + material(e.material); },
            [&](const SetTexture& e) {
                return (e.texture ? "Put a texture on " : "Take the texture off ") + material(e.material);
            },
            [&](const SetTwoSided& e) {
                return fmt::format("Make {} {}", material(e.material), e.two_sided ? "two-sided" : "one-sided");
            },
            [&](const GiveOwnMaterial& e) { return fmt::format("Give {} its own material", object(e.object)); },
            [&](const AssignMaterial& e) {
                return fmt::format("Paint {} as {}", object(e.object), material(e.material));
            },
            [&](const SetDimmer& e) { return "Dim " + luminaire(e.luminaire); },
            [&](const SetPower& e) { return "Change the power of " + luminaire(e.luminaire); },
            [&](const SetEmissionSpectrum& e) { return "Change the spectrum of " + luminaire(e.luminaire); },
            [&](const SetEmitSide& e) { return "Change the side that " + luminaire(e.luminaire) + " lights"; },
            [&](const SetCamera&) { return std::string("Move the camera"); },
            [&](const SetDisplay&) { return std::string("Change the display"); },
            [&](const SetSolve&) { return std::string("Change how it is solved"); },
            [&](const ReplaceScene&) { return std::string("Replace the scene"); },
        },
        edit);
}

bool same_target(const Edit& a, const Edit& b) {
    return std::visit(
        Overload{
            // Another kind of reflectance or spectrum is a choice of its own, not a slider's next value.
            [](const SetReflectance& x, const SetReflectance& y) {
                return x.material == y.material && x.reflectance.index() == y.reflectance.index();
            },
            [](const SetDimmer& x, const SetDimmer& y) { return x.luminaire == y.luminaire; },
            [](const SetPower& x, const SetPower& y) { return x.luminaire == y.luminaire && x.unit == y.unit; },
            [](const SetEmissionSpectrum& x, const SetEmissionSpectrum& y) {
                return x.luminaire == y.luminaire && x.spectrum.index() == y.spectrum.index();
            },
            [](const SetCamera&, const SetCamera&) { return true; },
            [](const SetDisplay&, const SetDisplay&) { return true; },
            [](const SetSolve&, const SetSolve&) { return true; },
            [](const auto&, const auto&) { return false; },
        },
        a, b);
}

} // namespace lueur
