#include "editor/commands/measure_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/units.h"
#include "editor/commands/csv.h"
#include "editor/commands/number_text.h"

namespace lueur {

namespace {

constexpr std::array<const char*, 6> needed{"x", "y", "z", "nx", "ny", "nz"};
constexpr std::array<const char*, 6> appended{"illuminance_lx", "irradiance_w_m2", "standard_error_percent",
                                              "irradiance_r",   "irradiance_g",    "irradiance_b"};
constexpr double normal_tolerance = 1e-3; // of the length of a unit normal: what four digits a component leave

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

} // namespace

std::expected<MeasureTable, std::vector<std::string>> parse_measure_table(const std::string& text,
                                                                          const std::string& file, UpAxis up) {
    std::vector<std::string> faults;
    const auto complain = [&](std::size_t line, std::size_t column, const std::string& what) {
        faults.push_back(fmt::format("{}:{}:{}: {}", file, line, column, what));
    };

    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    const std::string_view whole =
        std::string_view(text).starts_with(byte_order_mark) ? std::string_view(text).substr(3) : text;
    const auto records = parse_csv(whole);
    if (records.empty()) {
        complain(1, 1, "the file is empty; a header with the columns x,y,z,nx,ny,nz is needed");
        return std::unexpected(faults);
    }

    const CsvRecord& header = records.front();
    if (header.fault) {
        complain(header.fault->line, header.fault->column, header.fault->what);
        return std::unexpected(faults);
    }
    std::array<std::size_t, 6> column_of{};
    std::string absent;
    for (std::size_t i = 0; i < needed.size(); ++i) {
        const auto is_it = [&](const CsvField& field) { return trimmed(field.text) == needed[i]; };
        const auto found = std::ranges::find_if(header.fields, is_it);
        if (found == header.fields.end()) {
            absent += (absent.empty() ? "" : ", ") + std::string(needed[i]);
            continue;
        }
        column_of[i] = static_cast<std::size_t>(found - header.fields.begin());
        const auto again = std::find_if(found + 1, header.fields.end(), is_it);
        if (again != header.fields.end())
            complain(again->line, again->column, fmt::format("a second column {}; one is allowed", needed[i]));
    }
    if (!absent.empty())
        complain(1, 1, fmt::format("the header lacks {}; the columns x,y,z,nx,ny,nz are needed, in any order", absent));
    for (const CsvField& field : header.fields)
        for (const char* name : appended)
            if (trimmed(field.text) == name)
                complain(field.line, field.column,
                         fmt::format("a column {} is there already; rename it or take it out", name));
    if (!faults.empty()) return std::unexpected(faults);

    MeasureTable table;
    table.header = std::string(text.substr(0, text.size() - whole.size())) + std::string(header.raw);
    const auto after_header = static_cast<std::size_t>(header.raw.data() - whole.data()) + header.raw.size();
    table.line_end = whole.substr(after_header).starts_with("\r\n") ? "\r\n" : "\n";

    for (std::size_t r = 1; r < records.size(); ++r) {
        const CsvRecord& record = records[r];
        const CsvField& start = record.fields.front();
        if (record.fault) {
            complain(record.fault->line, record.fault->column, record.fault->what);
            continue;
        }
        if (record.fields.size() != header.fields.size()) {
            complain(start.line, start.column,
                     record.raw.empty()
                         ? "an empty line; a row or the end of the file is needed"
                         : fmt::format("{} fields; the header has {}", record.fields.size(), header.fields.size()));
            continue;
        }
        std::array<double, 6> value{};
        bool read = true;
        for (std::size_t i = 0; i < needed.size(); ++i) {
            const CsvField& field = record.fields[column_of[i]];
            const auto number = number_from_text(trimmed(field.text));
            if (number) {
                value[i] = *number;
            } else {
                read = false;
                complain(field.line, field.column,
                         fmt::format("{} is '{}'; a finite number is needed", needed[i], field.text));
            }
        }
        if (!read) continue;
        const glm::dvec3 normal{value[3], value[4], value[5]};
        const double length = std::hypot(normal.x, normal.y, normal.z);
        if (!(std::abs(length - 1) <= normal_tolerance)) {
            const CsvField& field = record.fields[column_of[3]];
            complain(
                field.line, field.column,
                fmt::format("the normal has the length {:.6g}; 1 to within {} is allowed", length, normal_tolerance));
            continue;
        }
        table.rows.emplace_back(record.raw);
        table.points.push_back({world_from_file({value[0], value[1], value[2]}, LengthUnit::metre, up),
                                world_from_file(normal / length, LengthUnit::metre, up)});
    }
    if (!faults.empty()) return std::unexpected(faults);
    return table;
}

std::string completed_table(const MeasureTable& table, const std::vector<Irradiance>& measured, bool rgb) {
    std::string text = table.header;
    const std::size_t columns = rgb ? 6 : 3;
    for (std::size_t i = 0; i < columns; ++i) text += fmt::format(",{}", appended[i]);
    text += table.line_end;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const Irradiance& e = measured[r];
        text += fmt::format("{},{:.7g},{:.7g},{:.4g}", table.rows[r], e.illuminance_lx, e.irradiance_w_m2,
                            e.standard_error_percent);
        if (rgb)
            for (std::size_t k = 0; k < 3; ++k) text += fmt::format(",{:.7g}", e.channels[k]);
        text += table.line_end;
    }
    return text;
}

} // namespace lueur
