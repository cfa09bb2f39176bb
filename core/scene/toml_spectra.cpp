#include "core/scene/toml_spectra.h"

#include "core/scene/files.h"
#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/read_spectrum.h"

namespace lueur {

namespace {

constexpr std::string_view light_forms =
    "\"flat\", { file = \"lamp.csv\" }, { library = \"FL11\" }, { blackbody = 2700 }, { daylight = 6504 }, "
    "{ lines = [{ nm = 589.3 }] } or { points = [[400, 0], [700, 1]] }";

Rgb rgb_from(const std::vector<double>& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

} // namespace

// { file = "...", column = "...", interpolation = "bin" }
std::optional<SpectrumFile> TomlSpectra::from_file(const toml::table& node, const std::string& what) {
    TomlTable table(file_, node, what);
    const auto path = table.text("file");
    SpectrumFile spectrum;
    if (const toml::node* column = table.find("column"))
        spectrum.column = read_text(file_, *column, "column").value_or("");
    const auto interpolation =
        table.choice<Interpolation>("interpolation", {{"linear", Interpolation::linear}, {"bin", Interpolation::bin}});
    table.finish();
    if (!path) return {};
    const Place place = place_of(*node.get("file"));
    spectrum.path = *path;
    const std::filesystem::path full = folder_ / *path;
    if (const auto why = why_unreadable(full)) {
        file_.diagnostics.error(file_.name, place, fmt::format("spectrum file \"{}\" {}", *path, *why));
        return {};
    }
    auto read = read_spectrum(full, spectrum.column, interpolation.value_or(Interpolation::linear));
    if (!read) {
        file_.diagnostics.error(file_.name, place, fmt::format("spectrum file \"{}\" has errors:", *path));
        for (std::string& line : read.error()) file_.diagnostics.errors.push_back(std::move(line));
        return {};
    }
    spectrum.spectrum = std::move(*read);
    return spectrum;
}

bool TomlSpectra::list_library(const toml::node& node) {
    if (library_) return true;
    auto listed = list_spectrum_library(library_folder_);
    if (!listed) {
        file_.error(node, fmt::format("the library \"{}\" has errors:", library_folder_.string()));
        for (std::string& line : listed.error()) file_.diagnostics.errors.push_back(std::move(line));
        return false;
    }
    library_ = std::move(*listed);
    return true;
}

// { library = "FL11" }
std::optional<LibrarySpectrum> TomlSpectra::from_library(const toml::table& node, const std::string& what,
                                                         LibraryKind kind) {
    TomlTable table(file_, node, what);
    const auto name = table.text("library");
    table.finish();
    const toml::node& place = *node.get("library");
    if (!name || !list_library(place)) return {};
    const LibraryEntry* entry = find_entry(*library_, kind, *name);
    if (!entry) {
        std::vector<std::string> names;
        for (const LibraryEntry& one : library_->entries)
            if (library_->groups[one.group].kind == kind) names.push_back(one.name);
        const char* kind_word = kind == LibraryKind::light ? "light" : "reflectance";
        if (names.empty())
            file_.error(place, fmt::format("library = \"{}\": there is no library of {}s here; {{ file = \"...\" }} is "
                                           "allowed",
                                           *name, kind_word));
        else
            file_.error(place, fmt::format("library = \"{}\" is not a {} of the library; {}", *name, kind_word,
                                           allowed_words(*name, names)));
        return {};
    }
    auto read = read_library_spectrum(*library_, *entry);
    if (!read) {
        file_.error(place, fmt::format("library = \"{}\" has errors:", *name));
        for (std::string& line : read.error()) file_.diagnostics.errors.push_back(std::move(line));
        return {};
    }
    return LibrarySpectrum{*name, std::move(*read)};
}

// { points = [[nm, value], ...] }
std::optional<Drawn> TomlSpectra::from_points(const toml::table& node, const std::string& what) {
    TomlTable table(file_, node, what);
    const toml::node* points = table.find("points");
    table.finish();
    const toml::array* array = points->as_array();
    if (!array || array->size() < 2) {
        file_.error(*points, "points is not a list of two or more [nm, value]; [[400, 0], [700, 1]] is allowed");
        return {};
    }
    Spectrum spectrum;
    bool good = true;
    for (const toml::node& element : *array) {
        const auto pair = read_numbers(file_, element, 2, {-1e12, 1e12, true, "-1e12..1e12"}, "a point");
        if (!pair) {
            good = false;
            continue;
        }
        const double nm = (*pair)[0];
        if (nm <= 0 || (!spectrum.nm.empty() && nm <= spectrum.nm.back())) {
            file_.error(element,
                        nm <= 0 ? fmt::format("wavelength {}; nm above 0 is allowed", nm)
                                : fmt::format("wavelength {} {} {}; wavelengths that increase are allowed", nm,
                                              nm == spectrum.nm.back() ? "repeats" : "follows", spectrum.nm.back()));
            good = false;
            continue;
        }
        spectrum.nm.push_back(nm);
        spectrum.value.push_back((*pair)[1]);
    }
    if (!good) return {};
    return Drawn{std::move(spectrum)};
}

// { lines = [{ nm = 589.3, width = 1, power = 1 }, ...] }
std::optional<Lines> TomlSpectra::lines(const toml::table& node) {
    TomlTable table(file_, node, "spectrum");
    const toml::node* list = table.find("lines");
    table.finish();
    const toml::array* array = list->as_array();
    if (!array || array->empty()) {
        file_.error(*list, "lines is not a list of one or more { nm = 589.3, width = 1, power = 1 }");
        return {};
    }
    Lines all;
    for (const toml::node& element : *array) {
        const toml::table* inner = element.as_table();
        if (!inner) {
            file_.error(element, "a line is not { nm = 589.3, width = 1, power = 1 }");
            continue;
        }
        TomlTable one(file_, *inner, "a line");
        SpectralLine line;
        one.require("nm", "its wavelength is needed");
        const auto nm = one.number("nm", {1, 1e6, true, "1..1e6 nm"});
        const auto width = inner->contains("width") ? one.number("width", {1e-3, 1000, true, "0.001..1000 nm"})
                                                    : std::optional(line.width);
        const auto power =
            inner->contains("power") ? one.number("power", {0, 1e12, true, "0..1e12"}) : std::optional(line.power);
        one.find("width");
        one.find("power");
        one.finish();
        if (nm && width && power) all.lines.push_back({*nm, *width, *power});
    }
    if (all.lines.size() != array->size()) return {};
    return all;
}

std::optional<double> TomlSpectra::kelvin(const toml::table& node, std::string_view key, double lowest) {
    TomlTable table(file_, node, "spectrum");
    const auto read = table.number(key, {lowest, 25000, true, fmt::format("{}..25000 K", lowest)});
    table.finish();
    return read;
}

std::optional<SimpleEmission> TomlSpectra::simple(const toml::node& node) {
    if (const auto* word = node.as_string()) {
        if (word->get() == "flat") return Flat{};
        file_.error(node, fmt::format("spectrum = \"{}\" is not known; {} is allowed", word->get(), light_forms));
        return {};
    }
    const auto wrapped = [](auto read) {
        return read ? std::optional<SimpleEmission>(std::move(*read)) : std::nullopt;
    };
    if (const toml::table* table = node.as_table()) {
        if (table->contains("file")) return wrapped(from_file(*table, "spectrum"));
        if (table->contains("library")) return wrapped(from_library(*table, "spectrum", LibraryKind::light));
        if (table->contains("points")) return wrapped(from_points(*table, "spectrum"));
        if (table->contains("lines")) return wrapped(lines(*table));
        if (table->contains("blackbody")) {
            const auto read = kelvin(*table, "blackbody", 1000);
            return read ? std::optional<SimpleEmission>(Blackbody{*read}) : std::nullopt;
        }
        if (table->contains("daylight")) {
            const auto read = kelvin(*table, "daylight", least_daylight_temperature);
            return read ? std::optional<SimpleEmission>(Daylight{*read}) : std::nullopt;
        }
    }
    file_.error(node, fmt::format("spectrum is in no known form; {} is allowed", light_forms));
    return {};
}

// { mix = [A, B], share = 0.5 }
std::optional<Mix> TomlSpectra::mix(const toml::table& node) {
    TomlTable table(file_, node, "spectrum");
    const toml::node* list = table.find("mix");
    const auto share = node.contains("share") ? table.number("share", {0, 1, true, "0..1"}) : std::optional(0.5);
    table.find("share");
    table.finish();
    const toml::array* array = list->as_array();
    if (!array || array->size() != 2) {
        file_.error(*list, fmt::format("mix is not a list of two lights; each {}", light_forms));
        return {};
    }
    auto first = simple(*array->get(0)), second = simple(*array->get(1));
    if (!first || !second || !share) return {};
    return Mix{{std::move(*first), std::move(*second)}, *share};
}

std::optional<EmissionSpectrum> TomlSpectra::emission(const toml::node& node) {
    std::optional<EmissionSpectrum> read;
    const toml::table* table = node.as_table();
    if (node.is_array()) {
        if (const auto rgb = read_numbers(file_, node, 3, {0, 1e12, true, "0..1e12"}, "spectrum"))
            read = rgb_from(*rgb);
    } else if (table && table->contains("mix")) {
        if (auto both = mix(*table)) read = std::move(*both);
    } else if (const auto one = simple(node)) {
        read = lueur::emission(*one);
    }
    if (!read) return {};
    const std::vector<std::string> faults = faults_of(*read);
    for (const std::string& fault : faults) file_.error(node, fault);
    return faults.empty() ? std::move(read) : std::nullopt;
}

std::optional<Reflectance> TomlSpectra::reflectance(const toml::node& node) {
    std::optional<Reflectance> read;
    const toml::table* table = node.as_table();
    const auto keep = [&](auto spectrum) {
        if (spectrum) read = std::move(*spectrum);
    };
    const NumberRange unit_interval{0, 1, true, "0..1"};
    if (node.is_array()) {
        if (const auto rgb = read_numbers(file_, node, 3, unit_interval, "reflectance")) read = rgb_from(*rgb);
    } else if (node.is_number()) {
        if (const auto number = read_number(file_, node, unit_interval, "reflectance")) read = *number;
    } else if (table && table->contains("file")) {
        keep(from_file(*table, "reflectance"));
    } else if (table && table->contains("library")) {
        keep(from_library(*table, "reflectance", LibraryKind::reflectance));
    } else if (table && table->contains("points")) {
        keep(from_points(*table, "reflectance"));
    } else {
        file_.error(node,
                    "reflectance is none of a number 0..1, [r, g, b], { file = \"paints.csv\", column = \"red\" }, "
                    "{ library = \"ColorChecker red\" }, { points = [[400, 0.1], [700, 0.8]] }");
    }
    if (!read) return {};
    const std::vector<std::string> faults = faults_of(*read);
    for (const std::string& fault : faults) file_.error(node, fault);
    return faults.empty() ? std::move(read) : std::nullopt;
}

} // namespace lueur
