// What the worker shows the world: an immutable picture of the solution so far. Read it from any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/scene.h"
#include "core/solve/field.h"
#include "core/solve/status.h"
#include "core/transport/mesh.h"

namespace lueur {

class World;          // core/transport/world.h
struct HierarchyView; // core/solve/hierarchy_view.h

struct Snapshot {
    std::uint64_t revision = 0;          // grows with each publication
    std::uint64_t document_revision = 0; // of the document it belongs to
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Mesh> mesh; // null before the first mesh; the same pointer while it has not changed
    std::shared_ptr<const World> world;
    std::shared_ptr<const Field> field;
    std::shared_ptr<const HierarchyView> hierarchy; // of the hierarchical solver; else null
    SolveStatus status;
    std::vector<ConvergencePoint> history;
};

// What is under a ray: surface, position and light.
struct Probe {
    glm::vec3 position{0}, normal{0}; // m
    SurfaceIndex surface{};
    ObjectIndex object{};
    MaterialIndex material{};
    std::optional<LuminaireIndex> luminaire;
    Xyz irradiance{0}; // Y in lx
    Spectrum
        irradiance_spectrum;     // W m^-2 nm^-1; empty with rgb wavelengths and where the scene is too large to keep it
    double irradiance_watts = 0; // W m^-2, 380..780 nm
    Xyz radiance{0};             // towards the eye, Y in cd m^-2; textures included
    double radiance_watts = 0;   // W m^-2 sr^-1, 380..780 nm; 0 where irradiance_spectrum is empty
    Rgb rgb{0};                  // linear sRGB of the radiance, cd m^-2
    float error = 0;             // lx, one standard deviation of the illuminance
    double interval_factor = 1.96; // times that: 95 %
    float unshot = 0;
    float colour_difference = 0; // CIEDE2000 from the trichromatic approach, where that is solved beside
};

std::optional<Probe> probe(const Snapshot& snapshot, glm::vec3 origin, glm::vec3 direction);

} // namespace lueur
