// Line-by-line text files (.obj, .mtl): words with their columns, a backslash joins lines, numbers are checked.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lueur {

struct Word {
    std::string_view text;
    std::uint32_t line, column; // 1-based
};

class TextLines {
public:
    explicit TextLines(std::string_view text)
        : text_(text) {
        if (text_.starts_with("\xef\xbb\xbf")) position_ = line_start_ = 3; // UTF-8 byte order mark
    }

    // The words of the next line that has any; a word that starts with # ends it. False at the end.
    bool next(std::vector<Word>& words);

private:
    std::string_view text_;
    std::size_t position_ = 0, line_start_ = 0;
    std::uint32_t line_ = 1;
};

// From the start of `words[first]` to the end of the line, spaces inside kept: names of materials and files.
std::string rest_of_line(const std::vector<Word>& words, std::size_t first);

// Names as UTF-8, which a saved scene must be: bytes that are not are taken as Latin-1.
std::string utf8_name(std::string name);

// A whole word as a number, "+1.5" and "nan" included; nothing where it is none.
std::optional<double> number_from(std::string_view word);
std::optional<std::int64_t> integer_from(std::string_view word);

} // namespace lueur
