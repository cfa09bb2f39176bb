#include "core/spectrum/read_spectrum.h"

#include <algorithm>
#include <cctype>

#include "core/spectrum/spectrum_text.h"

namespace lueur {

namespace {

constexpr std::string_view allowed_file =
    "allowed: a .csv with a header wavelength_nm,NAME,..., an .spd of two numbers "
    "a line, or an .sp or .cmf of Argyll CMS";

bool is_csv(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension == ".csv";
}

std::expected<Spectrum, SpectrumErrors> read_linear(const std::filesystem::path& file, const std::string& column) {
    if (is_csv(file)) return read_spectrum_csv(file, column);
    auto text = open_spectrum_text(file, allowed_file);
    if (!text) return std::unexpected(std::move(text.error()));
    if (is_cgats(text->text)) return read_cgats(std::move(*text), column);
    return read_pairs(std::move(*text), column);
}

} // namespace

std::expected<Spectrum, SpectrumErrors> read_spectrum(const std::filesystem::path& file, const std::string& column,
                                                      Interpolation interpolation) {
    auto spectrum = read_linear(file, column);
    if (spectrum) spectrum->interpolation = interpolation;
    return spectrum;
}

std::expected<std::vector<std::string>, SpectrumErrors> spectrum_columns(const std::filesystem::path& file) {
    if (is_csv(file)) return csv_columns(file);
    auto text = open_spectrum_text(file, allowed_file);
    if (!text) return std::unexpected(std::move(text.error()));
    if (is_cgats(text->text)) return cgats_columns(std::move(*text));
    return std::vector<std::string>{""};
}

std::vector<std::string> spectrum_extensions() {
    return {".csv", ".spd", ".sp", ".cmf"};
}

} // namespace lueur
