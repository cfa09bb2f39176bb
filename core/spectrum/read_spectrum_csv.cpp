#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/spectrum/spectrum.h"

namespace lueur {

namespace {

constexpr std::string_view allowed_file =
    "allowed: a text file, a header line wavelength_nm,NAME,... and rows of numbers";
constexpr std::size_t max_errors = 100; // a file of another kind must not drown the reader

struct Cell {
    std::string_view text; // trimmed
    std::size_t column;    // 1-based, of its first character
};

struct Table {
    std::string file;
    std::vector<std::string> errors;

    void error(std::size_t line, std::size_t column, const std::string& what) {
        errors.push_back(fmt::format("{}:{}:{}: {}", file, line, column, what));
    }
};

std::vector<Cell> split(std::string_view line) {
    std::vector<Cell> cells;
    std::size_t start = 0;
    while (true) {
        const std::size_t comma = std::min(line.find(',', start), line.size());
        std::size_t first = start, last = comma;
        while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
        while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
        cells.push_back({line.substr(first, last - first), first + 1});
        if (comma == line.size()) return cells;
        start = comma + 1;
    }
}

std::optional<double> number(Table& table, std::size_t line, const Cell& cell) {
    constexpr std::string_view allowed = "allowed: a finite number such as 0.25 or 1e-3";
    if (cell.text.empty()) {
        table.error(line, cell.column, fmt::format("an empty cell; {}", allowed));
        return std::nullopt;
    }
    const std::string_view digits = cell.text.starts_with('+') ? cell.text.substr(1) : cell.text;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range || (error == std::errc() && !std::isfinite(value))) {
        table.error(line, cell.column, fmt::format("\"{}\" is not finite; {}", cell.text, allowed));
        return std::nullopt;
    }
    if (error != std::errc() || end != digits.data() + digits.size()) {
        table.error(line, cell.column, fmt::format("\"{}\" is not a number; {}", cell.text, allowed));
        return std::nullopt;
    }
    return value;
}

// The index of the wanted column among the header's cells.
std::optional<std::size_t> find_column(Table& table, std::size_t line, const std::vector<Cell>& header,
                                       const std::string& column) {
    if (header.front().text != "wavelength_nm") {
        table.error(line, header.front().column,
                    fmt::format("the first column is \"{}\"; allowed: wavelength_nm, then one or more columns of "
                                "values, parted by commas",
                                header.front().text));
        return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (std::size_t i = 1; i < header.size(); ++i) names.push_back(header[i].text);
    if (names.empty()) {
        table.error(line, header.front().column,
                    "there is no column of values; allowed: wavelength_nm, then one or more columns of values");
        return std::nullopt;
    }
    if (column.empty()) return 1;
    std::optional<std::size_t> found;
    for (std::size_t i = 1; i < header.size(); ++i) {
        if (header[i].text != column) continue;
        if (found) {
            table.error(line, header[i].column,
                        fmt::format("column \"{}\" is there twice; allowed: each name once", column));
            return std::nullopt;
        }
        found = i;
    }
    if (!found)
        table.error(line, 1, fmt::format("there is no column \"{}\"; allowed: {}", column, fmt::join(names, ", ")));
    return found;
}

std::expected<std::string, std::string> read_text(const std::filesystem::path& file) {
    const std::string name = file.string();
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        return std::unexpected(fmt::format("{}: there is no such file; {}", name, allowed_file));
    if (std::filesystem::is_directory(status))
        return std::unexpected(fmt::format("{}: is a folder; {}", name, allowed_file));
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream.good() && !stream.eof())
        return std::unexpected(fmt::format("{}: cannot be read; {}", name, allowed_file));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3); // byte order mark of UTF-8
    if (text.find('\0') != std::string::npos)
        return std::unexpected(fmt::format("{}: is not UTF-8 text; {}", name, allowed_file));
    return text;
}

} // namespace

std::expected<Spectrum, std::vector<std::string>> read_spectrum_csv(const std::filesystem::path& file,
                                                                    const std::string& column) {
    const auto text = read_text(file);
    if (!text) return std::unexpected(std::vector{text.error()});

    Table table{file.string(), {}};
    Spectrum spectrum;
    std::size_t column_count = 0; // 0: no header yet
    std::optional<std::size_t> wanted;
    std::size_t line_number = 0;
    for (std::size_t start = 0; start < text->size() && table.errors.size() < max_errors;) {
        const std::size_t end = std::min(text->find('\n', start), text->size());
        std::string_view line(text->data() + start, end - start);
        start = end + 1;
        ++line_number;
        if (line.ends_with('\r')) line.remove_suffix(1);
        const std::vector<Cell> cells = split(line);
        if (cells.front().text.starts_with('#') || (cells.size() == 1 && cells.front().text.empty())) continue;

        if (column_count == 0) {
            column_count = cells.size();
            wanted = find_column(table, line_number, cells, column);
            if (cells.front().text != "wavelength_nm") break; // not a spectrum file: its rows would all be wrong
            continue;
        }
        if (cells.size() != column_count) {
            table.error(line_number, cells.back().column,
                        fmt::format("{} cells; allowed: {}, as the header has", cells.size(), column_count));
            continue;
        }
        const std::optional<double> nm = number(table, line_number, cells.front());
        if (nm && *nm <= 0) {
            table.error(line_number, cells.front().column, fmt::format("wavelength {}; allowed: nm, above 0", *nm));
        } else if (nm) {
            if (!spectrum.nm.empty() && *nm <= spectrum.nm.back())
                table.error(line_number, cells.front().column,
                            fmt::format("wavelength {} {} {}; allowed: wavelengths that increase from row to row", *nm,
                                        *nm == spectrum.nm.back() ? "repeats" : "follows", spectrum.nm.back()));
            spectrum.nm.push_back(*nm);
        }
        if (wanted) {
            const std::optional<double> value = number(table, line_number, cells[*wanted]);
            if (value) spectrum.value.push_back(*value);
        }
    }
    if (column_count == 0) {
        table.errors.push_back(fmt::format("{}: is empty; {}", table.file, allowed_file));
    } else if (table.errors.empty() && spectrum.nm.size() < 2) {
        table.errors.push_back(
            fmt::format("{}: {} rows of numbers; allowed: two or more", table.file, spectrum.nm.size()));
    }
    if (table.errors.size() >= max_errors)
        table.errors.push_back(fmt::format("{}: further errors are not shown", table.file));
    if (!table.errors.empty()) return std::unexpected(std::move(table.errors));
    return spectrum;
}

} // namespace lueur
