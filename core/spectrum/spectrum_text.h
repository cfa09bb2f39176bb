// What the readers of spectrum files share: the text, checked numbers, and the errors with their places.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/spectrum/read_spectrum.h"

namespace lueur {

// A word of a file with its place, both counted from 1.
struct Cell {
    std::string_view text;
    std::size_t line = 0, column = 0;
};

struct SpectrumText {
    std::string file; // as the user gave it
    std::string text;
    std::string allowed; // "allowed: a text file, ...", for what is no such file at all
    SpectrumErrors errors;

    void error(const Cell& cell, const std::string& what);
    void error(const std::string& what); // of the file as a whole
    bool full() const;                   // a file of another kind must not drown the reader

    // Each gives nothing after having told the error.
    std::optional<double> number(const Cell& cell);
    std::optional<double> wavelength(const Cell& cell);

    // Appends the wavelength and tells when it does not increase.
    void append_wavelength(Spectrum& spectrum, const Cell& cell, double nm);

    // The spectrum, or all errors. Fewer than two rows are an error too.
    std::expected<Spectrum, SpectrumErrors> finish(Spectrum spectrum);
};

// Opens a file; a byte order mark is left out, so that columns count what is seen.
std::expected<SpectrumText, SpectrumErrors> open_spectrum_text(const std::filesystem::path& file,
                                                               std::string_view allowed);

// Line by line, without LF or CR LF.
class SpectrumLines {
public:
    explicit SpectrumLines(std::string_view text)
        : text_(text) {}
    bool next(std::string_view& line);
    std::size_t number() const { return number_; } // of the line that next() gave

private:
    std::string_view text_;
    std::size_t start_ = 0, number_ = 0;
};

// The readers of each format.
std::expected<std::vector<std::string>, SpectrumErrors> csv_columns(const std::filesystem::path& file);
bool is_cgats(std::string_view text);
std::expected<Spectrum, SpectrumErrors> read_cgats(SpectrumText text, const std::string& column);
std::expected<std::vector<std::string>, SpectrumErrors> cgats_columns(SpectrumText text);
std::expected<Spectrum, SpectrumErrors> read_pairs(SpectrumText text, const std::string& column);

} // namespace lueur
