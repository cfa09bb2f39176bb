// A reading hall of any number of triangles under 200 luminaires, made in code: what programs are measured on that must
// grow with the scene.
//
// 40 m by 20 m by 6 m, with columns, bookcases, tables, chairs, globes, vases and sculptures. More triangles are more
// furniture at first, then finer surfaces: a chair of the largest hall has some 2,000 triangles, each smaller than any
// element that light is solved on. Solids are closed, furniture does not overlap; the same file for the same numbers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace lueur::test {

struct HallParams {
    std::size_t triangles = 100'000; // about; at least some 6,000
    int luminaires_along = 20, luminaires_across = 10;
};

// Writes FOLDER/NAME.toml and FOLDER/NAME.glb; what it has in the end. Throws what writing throws.
struct HallSize {
    std::size_t triangles = 0, objects = 0, luminaires = 0;
};
HallSize write_hall(const std::filesystem::path& folder, const std::string& name, const HallParams& params);

} // namespace lueur::test
