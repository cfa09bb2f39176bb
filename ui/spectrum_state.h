// What the panels remember of spectra between frames: the library as it was listed, and a point that is being dragged.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/scene.h"
#include "core/spectrum/spectrum_library.h"

namespace lueur {

struct ShelfSpectrum {
    Spectrum spectrum;   // empty where reading failed
    glm::vec3 colour{0}; // sRGB, encoded
    std::string note;    // colour temperature of a light, luminous reflectance of a paint
};

struct SpectrumShelf {
    std::optional<SpectrumLibrary> library;       // none before it is first shown
    std::vector<std::string> errors;              // of its files
    std::map<std::size_t, ShelfSpectrum> spectra; // of the entries that were shown
    std::string filter;                           // of the picker
    std::filesystem::path columns_file;           // whose columns these are:
    std::vector<std::string> columns;
};

struct CurveDrag {
    unsigned owner = 0; // the curve that a point was last dragged or chosen on; 0: none
    int point = -1;     // being dragged
    int chosen = -1;    // the last one touched
    bool moved = false; // some edit came of it
    double top = 1;     // of the axis, while a point is dragged
    bool active() const { return point >= 0; }
};

// Where a spectrum file goes that is dropped beside the picture: what the panel in front has open.
using SpectrumTarget = std::variant<std::monostate, MaterialIndex, LuminaireIndex>;

} // namespace lueur
