#include "core/scene/mtl_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/scene/files.h"
#include "core/scene/text_lines.h"

namespace lueur {

namespace {

struct MtlReader {
    std::string file;
    Diagnostics& diagnostics;
    std::vector<MtlMaterial> materials;
    std::set<std::string> names;

    void error(const Word& at, std::string_view what) { diagnostics.error(file, {at.line, at.column}, what); }
    void warning(const Word& at, std::string_view what) { diagnostics.warning(file, {at.line, at.column}, what); }

    // "Kd r g b"; "Kd r" is grey.
    std::optional<Rgb> colour(const std::vector<Word>& words, double high, std::string_view allowed) {
        const std::size_t count = words.size() - 1;
        if (count >= 1 && (words[1].text == "spectral" || words[1].text == "xyz")) {
            error(words[1], fmt::format("{} {} is not supported; three numbers {} are allowed", words[0].text,
                                        words[1].text, allowed));
            return {};
        }
        if (count != 1 && count != 3) {
            error(words[0], fmt::format("{} has {} numbers; 3 (or 1 for grey) are allowed", words[0].text, count));
            return {};
        }
        Rgb rgb{0};
        bool good = true;
        for (std::size_t i = 0; i < count; ++i) {
            const auto number = number_from(words[i + 1].text);
            if (!number)
                error(words[i + 1], fmt::format("\"{}\" is not a number; {} is allowed", words[i + 1].text, allowed));
            else if (!(std::isfinite(*number) && *number >= 0 && *number <= high))
                error(words[i + 1],
                      fmt::format("{} {} is out of range; {} is allowed", words[0].text, words[i + 1].text, allowed));
            else {
                rgb[static_cast<int>(i)] = *number;
                continue;
            }
            good = false;
        }
        if (count == 1) rgb = Rgb(rgb.r);
        return good ? std::optional(rgb) : std::nullopt;
    }

    // "map_Kd -s 1 1 1 picture of the sea.png": options come first, the file name is the rest.
    void map(const std::vector<Word>& words) {
        static const std::map<std::string, int, std::less<>> most_arguments{
            {"-blendu", 1},  {"-blendv", 1}, {"-bm", 1}, {"-boost", 1}, {"-cc", 1}, {"-clamp", 1},
            {"-imfchan", 1}, {"-mm", 2},     {"-o", 3},  {"-s", 3},     {"-t", 3},  {"-texres", 1}};
        std::size_t i = 1;
        while (i < words.size()) {
            const auto option = most_arguments.find(words[i].text);
            if (option == most_arguments.end()) break;
            const std::size_t start = i++;
            for (int taken = 0; taken < option->second && i < words.size(); ++taken, ++i)
                if (option->second != 1 && !number_from(words[i].text))
                    break; // -s, -o, -t may have one or two numbers only
            warning(words[start], fmt::format("{} of a texture is left out", words[start].text));
        }
        if (i >= words.size()) {
            error(words[0], "map_Kd names no file; a picture's path is allowed");
            return;
        }
        materials.back().map_kd = rest_of_line(words, i);
        std::replace(materials.back().map_kd.begin(), materials.back().map_kd.end(), '\\', '/');
        materials.back().map_kd_place = {words[i].line, words[i].column};
    }

    void read(std::string_view text) {
        TextLines lines(text);
        std::vector<Word> words;
        while (lines.next(words)) {
            const std::string_view key = words[0].text;
            if (key == "newmtl") {
                const std::string name = utf8_name(rest_of_line(words, 1));
                if (name.empty()) error(words[0], "newmtl has no name; a name is needed");
                if (!names.insert(name).second)
                    error(words[0], fmt::format("material \"{}\" is there twice; one of each name is allowed", name));
                materials.push_back({name, {}, Rgb(0), {}, {}});
                continue;
            }
            const bool known = key == "Kd" || key == "Ke" || key == "map_Kd" || key == "d" || key == "Tr";
            if (!known) continue;
            if (materials.empty()) {
                error(words[0], fmt::format("{} stands before any newmtl; newmtl NAME is needed first", key));
                materials.push_back({});
            }
            if (key == "Kd") {
                if (const auto rgb = colour(words, 1, "0..1")) materials.back().kd = *rgb;
            } else if (key == "Ke") {
                if (const auto rgb = colour(words, 1e12, "0 or more")) materials.back().ke = *rgb;
            } else if (key == "map_Kd") {
                map(words);
            } else if (words.size() > 1) {
                const double opaque = key == "d" ? 1 : 0;
                if (number_from(words.back().text).value_or(opaque) != opaque)
                    warning(words[0], fmt::format("material \"{}\" is transparent; it is taken as opaque",
                                                  materials.back().name));
            }
        }
    }
};

} // namespace

std::optional<std::vector<MtlMaterial>> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics) {
    const auto text = read_bytes(file);
    if (!text) return {};
    MtlReader reader{file.string(), diagnostics, {}, {}};
    reader.read(*text);
    return std::move(reader.materials);
}

} // namespace lueur
