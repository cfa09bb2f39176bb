// Illuminance at points of an asset scene by a long run of the path tracer, kept so that a test need not trace it
// again.
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/view/measure.h"
#include "tests/support/source_folder.h"

namespace lueur::test {

struct StoredIrradiance {
    std::vector<MeasurePoint> points;
    std::vector<Irradiance> truth; // illuminance_lx and standard_error_percent alone
};

// tests/view/data/cornell_illuminance.csv: 1,000 points of assets/cornell.toml by area, 65,536 paths each, made by
// lueur measure assets/cornell.toml --points POINTS.csv -o OUT.csv --solver reference --rays 65536 --seed 9
inline StoredIrradiance stored_irradiance(const std::string& name) {
    StoredIrradiance stored;
    std::ifstream in(source_folder() / "tests/view/data" / name);
    std::string line;
    std::getline(in, line); // x,y,z,nx,ny,nz,illuminance_lx,standard_error_percent
    while (std::getline(in, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream fields(line);
        MeasurePoint p;
        Irradiance h;
        fields >> p.position.x >> p.position.y >> p.position.z >> p.normal.x >> p.normal.y >> p.normal.z;
        fields >> h.illuminance_lx >> h.standard_error_percent;
        if (!fields) return {};
        stored.points.push_back(p), stored.truth.push_back(h);
    }
    return stored;
}

} // namespace lueur::test
