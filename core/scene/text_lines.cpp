#include "core/scene/text_lines.h"

namespace lueur {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == '\0';
}

template <typename Number>
std::optional<Number> parsed(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
        if constexpr (std::is_floating_point_v<Number>)
            return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0 : 1e308 * 10;
    }
    if (error != std::errc{} || end != word.data() + word.size()) return {};
    return number;
}

} // namespace

bool TextLines::next(std::vector<Word>& words) {
    words.clear();
    bool comment = false;
    while (position_ < text_.size()) {
        const char c = text_[position_];
        if (c == '\n') {
            const bool joined = !comment && !words.empty() && words.back().text == "\\";
            if (joined) words.pop_back();
            ++position_;
            ++line_;
            line_start_ = position_;
            comment = false;
            if (!joined && !words.empty()) return true;
            continue;
        }
        if (comment || is_space(c)) {
            ++position_;
            continue;
        }
        if (c == '#') {
            comment = true;
            continue;
        }
        std::size_t end = position_;
        while (end < text_.size() && text_[end] != '\n' && !is_space(text_[end])) ++end;
        // "f 1 2 3\" without a space before the backslash
        std::size_t last = end;
        if (last - position_ > 1 && text_[last - 1] == '\\' &&
            (end == text_.size() || text_[end] == '\n' || text_[end] == '\r'))
            --last;
        words.push_back({text_.substr(position_, last - position_), line_,
                         static_cast<std::uint32_t>(position_ - line_start_ + 1)});
        position_ = last;
    }
    if (!words.empty() && words.back().text == "\\") words.pop_back(); // nothing is left to join
    return !words.empty();
}

std::string rest_of_line(const std::vector<Word>& words, std::size_t first) {
    if (first >= words.size()) return {};
    const char* begin = words[first].text.data();
    const char* end = words.back().text.data() + words.back().text.size();
    return {begin, end};
}

std::string utf8_name(std::string name) {
    const auto byte = [&](std::size_t i) { return i < name.size() ? static_cast<unsigned char>(name[i]) : 0u; };
    for (std::size_t i = 0; i < name.size();) { // RFC 3629, section 4
        const unsigned first = byte(i);
        const std::size_t length = first < 0x80                    ? 1
                                   : first >= 0xc2 && first < 0xe0 ? 2
                                   : first >= 0xe0 && first < 0xf0 ? 3
                                   : first >= 0xf0 && first < 0xf5 ? 4
                                                                   : 0;
        bool good = length > 0;
        for (std::size_t k = 1; k < length; ++k) good = good && (byte(i + k) & 0xc0u) == 0x80u;
        const unsigned second = byte(i + 1);
        if (first == 0xe0 && second < 0xa0) good = false; // overlong
        if (first == 0xed && second > 0x9f) good = false; // surrogates
        if (first == 0xf0 && second < 0x90) good = false;
        if (first == 0xf4 && second > 0x8f) good = false;
        if (good) {
            i += length;
            continue;
        }
        std::string latin;
        for (const char letter : name) {
            const auto code = static_cast<unsigned char>(letter);
            if (code < 0x80)
                latin += letter;
            else
                latin += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
        }
        return latin;
    }
    return name;
}

std::optional<double> number_from(std::string_view word) {
    return parsed<double>(word);
}
std::optional<std::int64_t> integer_from(std::string_view word) {
    return parsed<std::int64_t>(word);
}

} // namespace lueur
