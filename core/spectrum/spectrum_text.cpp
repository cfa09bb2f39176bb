#include "core/spectrum/spectrum_text.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>

namespace lueur {

namespace {

constexpr std::size_t max_errors = 100;

} // namespace

void SpectrumText::error(const Cell& cell, const std::string& what) {
    errors.push_back(fmt::format("{}:{}:{}: {}", file, cell.line, cell.column, what));
}

void SpectrumText::error(const std::string& what) {
    errors.push_back(fmt::format("{}: {}", file, what));
}

bool SpectrumText::full() const {
    return errors.size() >= max_errors;
}

std::optional<double> SpectrumText::number(const Cell& cell) {
    constexpr std::string_view allowed_number = "allowed: a finite number such as 0.25 or 1e-3";
    if (cell.text.empty()) {
        error(cell, fmt::format("an empty cell; {}", allowed_number));
        return {};
    }
    const std::string_view digits = cell.text.starts_with('+') ? cell.text.substr(1) : cell.text;
    double value = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem == std::errc::result_out_of_range || (problem == std::errc() && !std::isfinite(value))) {
        error(cell, fmt::format("\"{}\" is not finite; {}", cell.text, allowed_number));
        return {};
    }
    if (problem != std::errc() || end != digits.data() + digits.size()) {
        error(cell, fmt::format("\"{}\" is not a number; {}", cell.text, allowed_number));
        return {};
    }
    return value;
}

std::optional<double> SpectrumText::wavelength(const Cell& cell) {
    const std::optional<double> nm = number(cell);
    if (!nm || *nm > 0) return nm;
    error(cell, fmt::format("wavelength {}; allowed: nm, above 0", *nm));
    return {};
}

void SpectrumText::append_wavelength(Spectrum& spectrum, const Cell& cell, double nm) {
    if (!spectrum.nm.empty() && nm <= spectrum.nm.back())
        error(cell, fmt::format("wavelength {} {} {}; allowed: wavelengths that increase from row to row", nm,
                                nm == spectrum.nm.back() ? "repeats" : "follows", spectrum.nm.back()));
    spectrum.nm.push_back(nm);
}

std::expected<Spectrum, SpectrumErrors> SpectrumText::finish(Spectrum spectrum) {
    if (errors.empty() && spectrum.nm.size() < 2)
        error(fmt::format("{} rows of numbers; allowed: two or more", spectrum.nm.size()));
    if (full()) error("further errors are not shown");
    if (!errors.empty()) return std::unexpected(std::move(errors));
    return spectrum;
}

std::expected<SpectrumText, SpectrumErrors> open_spectrum_text(const std::filesystem::path& file,
                                                               std::string_view allowed) {
    SpectrumText opened{.file = file.string(), .text = {}, .allowed = std::string(allowed), .errors = {}};
    const auto failed = [&](std::string_view what) {
        opened.error(fmt::format("{}; {}", what, allowed));
        return std::unexpected(std::move(opened.errors));
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) return failed("there is no such file");
    if (std::filesystem::is_directory(status)) return failed("is a folder");
    if (!std::filesystem::is_regular_file(status)) return failed("is not a regular file");
    std::ifstream stream(file, std::ios::binary);
    opened.text.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    if (!stream.good() && !stream.eof()) return failed("cannot be read");
    if (opened.text.starts_with("\xEF\xBB\xBF")) opened.text.erase(0, 3); // byte order mark of UTF-8
    if (opened.text.find('\0') != std::string::npos) return failed("is not UTF-8 text");
    return opened;
}

bool SpectrumLines::next(std::string_view& line) {
    if (start_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', start_), text_.size());
    line = text_.substr(start_, end - start_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    start_ = end + 1;
    ++number_;
    return true;
}

} // namespace lueur
