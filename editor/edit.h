// Every change a person, a batch command or a test can make to a document, and what it costs.
#pragma once

#include <expected>
#include <string>
#include <variant>

#include "core/scene/scene.h"

namespace lueur {

struct SetReflectance {
    MaterialIndex material;
    Reflectance reflectance;
}; // takes a texture off: paint covers the picture
struct SetTexture {
    MaterialIndex material;
    std::optional<Texture> texture;
};
struct SetTwoSided {
    MaterialIndex material;
    bool two_sided;
};
struct GiveOwnMaterial {
    ObjectIndex object;
}; // a copy of its material for this object alone; changes nothing when it has one already
struct AssignMaterial {
    ObjectIndex object;
    MaterialIndex material;
};
struct SetDimmer {
    LuminaireIndex luminaire;
    double dimmer;
};
struct SetPower {
    LuminaireIndex luminaire;
    PowerUnit unit;
    double power;
};
struct SetEmissionSpectrum {
    LuminaireIndex luminaire;
    EmissionSpectrum spectrum;
};
struct SetEmitSide {
    LuminaireIndex luminaire;
    EmitSide side;
};
struct SetCamera {
    Camera camera;
};
struct SetDisplay {
    DisplaySettings display;
};
struct SetSolve {
    SolveSettings solve;
};
struct ReplaceScene {
    Scene scene;
};

using Edit = std::variant<SetReflectance, SetTexture, SetTwoSided, GiveOwnMaterial, AssignMaterial, SetDimmer, SetPower,
                          SetEmissionSpectrum, SetEmitSide, SetCamera, SetDisplay, SetSolve, ReplaceScene>;

// The stages of the flow, in order; an edit makes one and all after it stale.
enum class Stage { mesh, transport, sources, reflectance, view, display, nothing };

Stage first_stale_stage(const Edit& edit, const Scene& before);

// The scene after the edit; an index out of range or a value outside its allowed range is an error in one line and
// changes nothing.
std::expected<Scene, std::string> apply(const Edit& edit, const Scene& scene);

std::string describe(const Edit& edit, const Scene& scene); // "Repaint left wall", for the undo menu

// Two edits of the same thing (a slider being dragged) become one step of undo.
bool same_target(const Edit& a, const Edit& b);

} // namespace lueur
