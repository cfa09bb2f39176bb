// `.sp`, `.cmf`: the CGATS.17 text that Argyll CMS and colord write (ANSI CGATS.17:2009; Argyll's doc/File_Formats).
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

#include "core/spectrum/spectrum_text.h"

namespace lueur {

namespace {

// Words of the file; a text in quotes is one word, without them. '#' starts a comment.
std::vector<Cell> words(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    std::vector<Cell> cells;
    std::string_view line;
    for (SpectrumLines lines(text); lines.next(line);) {
        for (std::size_t start = line.find_first_not_of(blanks); start != std::string_view::npos;) {
            if (line[start] == '#') break;
            std::size_t end = 0;
            if (line[start] == '"') {
                end = std::min(line.find('"', start + 1), line.size());
                cells.push_back({line.substr(start + 1, end - start - 1), lines.number(), start + 1});
                end = std::min(end + 1, line.size());
            } else {
                end = std::min(line.find_first_of(blanks, start), line.size());
                cells.push_back({line.substr(start, end - start), lines.number(), start + 1});
            }
            start = line.find_first_not_of(blanks, end);
        }
    }
    return cells;
}

// The first table of the file.
struct CgatsTable {
    std::map<std::string_view, Cell> keywords; // to the word after them on their line
    std::vector<Cell> fields, data;
    Cell data_begin;
    bool has_data = false, closed = false;
    bool matching = false; // a .cmf
};

CgatsTable read_table(const std::vector<Cell>& cells) {
    CgatsTable table;
    table.matching = !cells.empty() && cells.front().text == "CMF";
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string_view word = cells[i].text;
        if (word == "BEGIN_DATA_FORMAT") {
            for (++i; i < cells.size() && cells[i].text != "END_DATA_FORMAT"; ++i) table.fields.push_back(cells[i]);
        } else if (word == "BEGIN_DATA") {
            table.has_data = true;
            table.data_begin = cells[i];
            for (++i; i < cells.size() && cells[i].text != "END_DATA"; ++i) table.data.push_back(cells[i]);
            table.closed = i < cells.size();
            return table;
        } else if (i + 1 < cells.size() && cells[i + 1].line == cells[i].line) {
            table.keywords[word] = cells[i + 1]; // a repeated keyword: the last counts
            ++i;
        }
    }
    return table;
}

std::optional<double> keyword_number(SpectrumText& text, const CgatsTable& table, std::string_view name) {
    const auto found = table.keywords.find(name);
    if (found == table.keywords.end()) {
        text.error(fmt::format("there is no {}; allowed: {} and a number before BEGIN_DATA", name, name));
        return {};
    }
    return text.number(found->second);
}

// What the values are: wavelengths, the place of the spectral fields in a set, and the sets.
struct Layout {
    std::vector<double> nm;
    double norm = 1;
    std::size_t set_size = 0;
    std::vector<std::size_t> spectral, names; // fields of values, and of names
    std::size_t sets = 0;
};

std::optional<Layout> layout_of(SpectrumText& text, const CgatsTable& table) {
    if (!table.has_data) {
        text.error("there is no BEGIN_DATA; allowed: values between BEGIN_DATA and END_DATA");
        return {};
    }
    if (!table.closed) text.error(table.data_begin, "BEGIN_DATA has no END_DATA; allowed: both");
    Layout layout;
    const auto bands = keyword_number(text, table, "SPECTRAL_BANDS");
    const auto start = keyword_number(text, table, "SPECTRAL_START_NM");
    const auto end = keyword_number(text, table, "SPECTRAL_END_NM");
    if (table.keywords.contains("SPECTRAL_NORM"))
        layout.norm = keyword_number(text, table, "SPECTRAL_NORM").value_or(1);
    if (!(layout.norm > 0))
        text.error(table.keywords.at("SPECTRAL_NORM"),
                   fmt::format("SPECTRAL_NORM is {}; allowed: a number above 0", layout.norm));
    if (bands && !(*bands >= 2 && *bands <= 1e7 && *bands == std::floor(*bands))) {
        text.error(table.keywords.at("SPECTRAL_BANDS"),
                   fmt::format("SPECTRAL_BANDS is {}; allowed: a whole number, two or more", *bands));
        return {};
    }
    if (start && !(*start > 0))
        text.error(table.keywords.at("SPECTRAL_START_NM"),
                   fmt::format("SPECTRAL_START_NM is {}; allowed: nm, above 0", *start));
    if (start && end && !(*start < *end))
        text.error(table.keywords.at("SPECTRAL_END_NM"),
                   fmt::format("SPECTRAL_END_NM is {} and SPECTRAL_START_NM {}; allowed: an end above the start", *end,
                               *start));
    if (!bands || !start || !end || !text.errors.empty()) return {};

    const auto count = static_cast<std::size_t>(*bands);
    if (table.fields.empty()) { // values alone, one a band
        layout.set_size = count;
        for (std::size_t i = 0; i < count; ++i) layout.spectral.push_back(i);
    }
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
        const std::string_view field = table.fields[i].text;
        if (field.starts_with("SPEC_")) layout.spectral.push_back(i);
        if (field == "SAMPLE_NAME" || field == "SAMPLE_ID") layout.names.push_back(i);
        layout.set_size = table.fields.size();
    }
    if (layout.spectral.size() != count) {
        text.error(table.keywords.at("SPECTRAL_BANDS"),
                   fmt::format("SPECTRAL_BANDS is {} but there are {} fields SPEC_nnn; allowed: as many", count,
                               layout.spectral.size()));
        return {};
    }
    layout.sets = table.data.size() / layout.set_size;
    if (layout.sets == 0 || layout.sets * layout.set_size != table.data.size()) {
        text.error(table.data_begin,
                   fmt::format("{} values after BEGIN_DATA; allowed: a multiple of the {} of a set, one set or more",
                               table.data.size(), layout.set_size));
        return {};
    }
    for (const auto& [name, expected] :
         {std::pair{"NUMBER_OF_FIELDS", layout.set_size}, std::pair{"NUMBER_OF_SETS", layout.sets}})
        if (const auto found = table.keywords.find(name); found != table.keywords.end())
            if (const auto said = text.number(found->second); said && *said != static_cast<double>(expected))
                text.error(found->second,
                           fmt::format("{} is {} but there are {}; allowed: what is there", name, *said, expected));
    for (std::size_t i = 0; i < count; ++i)
        layout.nm.push_back(std::lerp(*start, *end, static_cast<double>(i) / static_cast<double>(count - 1)));
    return layout;
}

std::vector<std::string> set_names(const CgatsTable& table, const Layout& layout) {
    std::vector<std::string> names;
    for (std::size_t set = 0; set < layout.sets; ++set)
        if (!layout.names.empty())
            names.emplace_back(table.data[set * layout.set_size + layout.names.front()].text);
        else if (table.matching && layout.sets == 3)
            names.emplace_back(1, "XYZ"[set]);
        else
            names.push_back(fmt::format("{}", set + 1));
    return names;
}

std::optional<std::size_t> find_set(SpectrumText& text, const CgatsTable& table, const Layout& layout,
                                    const std::string& column) {
    if (column.empty()) return 0;
    for (std::size_t set = 0; set < layout.sets; ++set)
        for (const std::size_t field : layout.names)
            if (table.data[set * layout.set_size + field].text == column) return set;
    const std::vector<std::string> names = set_names(table, layout);
    for (std::size_t set = 0; set < names.size(); ++set)
        if (names[set] == column || fmt::format("{}", set + 1) == column) return set;
    text.error(fmt::format("there is no set \"{}\"; allowed: {}", column, fmt::join(names, ", ")));
    return {};
}

} // namespace

bool is_cgats(std::string_view text) {
    if (text.find("BEGIN_DATA") != std::string_view::npos) return true;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return false;
    for (const std::string_view mark : {"SPECT", "CMF", "CGATS", "CTI", "CCSS"})
        if (text.substr(first).starts_with(mark)) return true;
    return false;
}

std::expected<Spectrum, SpectrumErrors> read_cgats(SpectrumText text, const std::string& column) {
    const CgatsTable table = read_table(words(text.text));
    Spectrum spectrum;
    if (const auto layout = layout_of(text, table)) {
        spectrum.nm = layout->nm;
        if (const auto set = find_set(text, table, *layout, column))
            for (const std::size_t field : layout->spectral) {
                if (text.full()) break;
                if (const auto value = text.number(table.data[*set * layout->set_size + field]))
                    spectrum.value.push_back(*value / layout->norm);
            }
    }
    for (std::size_t i = 1; i < spectrum.nm.size() && text.errors.empty(); ++i)
        if (!(spectrum.nm[i] > spectrum.nm[i - 1]))
            text.error(fmt::format("{} bands are too many from {} to {} nm; allowed: wavelengths that increase",
                                   spectrum.nm.size(), spectrum.nm.front(), spectrum.nm.back()));
    for (const double value : spectrum.value)
        if (!std::isfinite(value) && text.errors.empty())
            text.error("a value divided by SPECTRAL_NORM is not finite; allowed: finite values");
    return text.finish(std::move(spectrum));
}

std::expected<std::vector<std::string>, SpectrumErrors> cgats_columns(SpectrumText text) {
    const CgatsTable table = read_table(words(text.text));
    const auto layout = layout_of(text, table);
    if (!layout) return std::unexpected(std::move(text.errors));
    return set_names(table, *layout);
}

} // namespace lueur
