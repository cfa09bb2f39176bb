// Records of a CSV text with the place of every field (RFC 4180).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lueur {

struct CsvField {
    std::string text;                 // without quotes
    std::size_t line = 1, column = 1; // where it begins; column counts characters (UTF-8), both from 1
};

struct CsvFault {
    std::string what;
    std::size_t line = 1, column = 1;
};

struct CsvRecord {
    std::string_view raw; // as written, without its line end
    std::vector<CsvField> fields;
    std::optional<CsvFault> fault; // the fields are not to be trusted
};

// Views into `text`. Empty lines at the end are left out; an empty line elsewhere is a record of one empty field. An
// unterminated quote takes the rest of the text.
std::vector<CsvRecord> parse_csv(std::string_view text);

} // namespace lueur
