#include "editor/commands/csv.h"

namespace lueur {

namespace {

class Reader {
public:
    explicit Reader(std::string_view text)
        : text_(text) {}

    bool done() const { return at_ == text_.size(); }

    CsvRecord record() {
        CsvRecord record;
        const std::size_t first = at_;
        for (;;) {
            record.fields.push_back(field(record.fault));
            if (done() || text_[at_] != ',') break;
            advance();
        }
        std::size_t last = at_;
        if (!done()) { // at the line feed
            if (last > first && text_[last - 1] == '\r') --last;
            advance();
        }
        record.raw = text_.substr(first, last - first);
        return record;
    }

private:
    char advance() {
        const char c = text_[at_++];
        if (c == '\n') {
            ++line_;
            column_ = 1;
        } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) { // not inside a UTF-8 character
            ++column_;
        }
        return c;
    }

    bool at_line_end() const { return text_[at_] == '\n' || text_.substr(at_).starts_with("\r\n"); }

    CsvField field(std::optional<CsvFault>& fault) {
        CsvField result{{}, line_, column_};
        const bool quoted = !done() && text_[at_] == '"';
        if (quoted) {
            advance();
            for (;;) {
                if (done()) {
                    if (!fault)
                        fault = CsvFault{"the quote that begins here does not end; close it with \"", result.line,
                                         result.column};
                    return result;
                }
                const char c = advance();
                if (c != '"') {
                    result.text += c;
                } else if (!done() && text_[at_] == '"') {
                    result.text += advance();
                } else {
                    break;
                }
            }
        }
        while (!done() && text_[at_] != ',' && !at_line_end()) {
            if (quoted && !fault)
                fault = CsvFault{"text after a closing quote; a quote inside quotes is written \"\"", line_, column_};
            if (text_[at_] == '"' && !fault)
                fault = CsvFault{"a quote inside a field without quotes; quote the whole field and write \"\"", line_,
                                 column_};
            result.text += advance();
        }
        if (!done() && text_[at_] == '\r') advance();
        return result;
    }

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1, column_ = 1;
};

} // namespace

std::vector<CsvRecord> parse_csv(std::string_view text) {
    std::vector<CsvRecord> records;
    Reader reader(text);
    while (!reader.done()) records.push_back(reader.record());
    while (!records.empty() && records.back().raw.empty()) records.pop_back();
    return records;
}

} // namespace lueur
