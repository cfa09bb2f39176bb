// The table of points that `lueur measure` reads and completes: a CSV (RFC 4180: quoted fields, quotes doubled inside,
// commas).
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/view/measure.h"

namespace lueur {

struct MeasureTable {
    std::string header;               // as written, without its line end
    std::vector<std::string> rows;    // ditto
    std::string line_end;             // "\n" or "\r\n", the header's
    std::vector<MeasurePoint> points; // one a row; metres, Y up, unit normals
};

// The columns x,y,z,nx,ny,nz in any order; positions in metres in axes with `up`. All errors in one go, each
// `FILE:LINE:COLUMN: what is wrong; what is allowed` (column counts characters).
std::expected<MeasureTable, std::vector<std::string>> parse_measure_table(const std::string& text,
                                                                          const std::string& file, UpAxis up);

// The table with what was measured behind each row. `rgb`: with the three channels, too.
std::string completed_table(const MeasureTable& table, const std::vector<Irradiance>& measured, bool rgb);

} // namespace lueur
