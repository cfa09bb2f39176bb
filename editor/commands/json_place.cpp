#include "editor/commands/json_place.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace lueur {

namespace {

// Walks text that is known to be JSON: no value is checked, only its end is found.
class Walker {
public:
    explicit Walker(std::string_view text)
        : text_(text) {
        if (text_.starts_with("\xef\xbb\xbf")) at = 3; // UTF-8 byte order mark
        blanks();
    }

    std::size_t at = 0;

    bool enter(const JsonStep& step) {
        const bool object = peek() == '{';
        if (object != std::holds_alternative<std::string>(step)) return false;
        if (!object && peek() != '[') return false;
        const std::size_t start = at;
        std::size_t index = 0, found = text_.size();
        ++at;
        blanks();
        while (at < text_.size() && peek() != '}' && peek() != ']') {
            bool here;
            if (object) {
                const std::size_t from = at;
                skip();
                const auto name = nlohmann::json::parse(text_.substr(from, at - from), nullptr, false);
                here = name.is_string() && name.get<std::string>() == std::get<std::string>(step);
                blanks();
                ++at; // :
                blanks();
            } else {
                here = index++ == std::get<std::size_t>(step);
            }
            if (here) found = at; // of two members of one name the last counts
            skip();
            blanks();
            if (peek() == ',') ++at;
            blanks();
        }
        at = found < text_.size() ? found : start;
        return found < text_.size();
    }

private:
    char peek() const { return at < text_.size() ? text_[at] : '\0'; }
    void blanks() { at = std::min(text_.find_first_not_of(" \t\r\n", at), text_.size()); }
    void skip() { // a value
        std::size_t depth = 0;
        do {
            const char c = peek();
            if (c == '"') {
                for (++at; at < text_.size() && text_[at] != '"'; ++at) at += text_[at] == '\\';
                ++at;
            } else if (c == '{' || c == '[') {
                ++depth;
                ++at;
            } else if (c == '}' || c == ']') {
                --depth;
                ++at;
            } else if (c == ',' || c == ':') {
                ++at;
            } else {
                at = std::min(text_.find_first_of(",:]} \t\r\n", at), text_.size());
            }
            if (depth > 0) blanks();
        } while (depth > 0 && at < text_.size());
    }

    std::string_view text_;
};

} // namespace

Place place_at(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const std::size_t last = before.rfind('\n');
    return {static_cast<std::uint32_t>(1 + std::ranges::count(before, '\n')),
            static_cast<std::uint32_t>(before.size() - (last == before.npos ? 0 : last + 1) + 1)};
}

Place place_of(std::string_view text, const std::vector<JsonStep>& steps) {
    Walker walker(text);
    for (const JsonStep& step : steps)
        if (!walker.enter(step)) break;
    return place_at(text, walker.at);
}

} // namespace lueur
