#include "core/display/metadata_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace lueur {

namespace {

constexpr std::string_view separator = " = ";
constexpr std::size_t max_key = 60; // PNG allows 79 bytes with the prefix

std::string escaped(std::string_view value) {
    std::string text;
    for (const char c : value) {
        if (c == '\\')
            text += "\\\\";
        else if (c == '\n')
            text += "\\n";
        else
            text += c;
    }
    return text;
}

std::string unescaped(std::string_view text) {
    std::string value;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size())
            value += text[++i] == 'n' ? '\n' : text[i];
        else
            value += text[i];
    }
    return value;
}

bool is_key_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '-';
}

} // namespace

std::string text_from_metadata(const ImageMetadata& metadata) {
    std::string text;
    for (const auto& [key, value] : metadata) text += fmt::format("{}{}{}\n", key, separator, escaped(value));
    return text;
}

ImageMetadata metadata_from_text(std::string_view text) {
    ImageMetadata metadata;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        const std::size_t middle = line.find(separator);
        if (line.starts_with(metadata_prefix) && middle != std::string_view::npos)
            metadata[std::string(line.substr(0, middle))] = unescaped(line.substr(middle + separator.size()));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return metadata;
}

std::optional<std::string> metadata_fault(const ImageMetadata& metadata) {
    for (const auto& [key, value] : metadata) {
        const std::string_view name =
            key.starts_with(metadata_prefix) ? std::string_view(key).substr(metadata_prefix.size()) : "";
        if (name.empty() || name.size() > max_key || !std::ranges::all_of(name, is_key_character))
            return fmt::format("metadata key \"{}\"; allowed: {} and then up to {} letters, digits, '_', '.' and '-'",
                               key, metadata_prefix, max_key);
        if (std::ranges::any_of(value, [](unsigned char c) { return (c < 32 && c != '\n' && c != '\t') || c == 127; }))
            return fmt::format("metadata {} holds a control character; allowed: text", key);
    }
    return std::nullopt;
}

} // namespace lueur
