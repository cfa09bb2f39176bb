#include "core/scene/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <nlohmann/json.hpp>

namespace lueur {

namespace {

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

} // namespace

std::optional<GltfJson> read_gltf_json(const std::string& bytes, const std::string& file, Diagnostics& diagnostics) {
    const auto error = [&](std::string_view what) {
        diagnostics.error(file, {}, what);
        return std::nullopt;
    };
    std::string_view text = bytes;
    if (text.empty()) return error("is empty; a glTF 2.0 file is allowed");
    const bool binary = text.starts_with("glTF");
    if (binary) { // glTF 2.0, 4.4: header of 12 bytes, then chunks: length, type, data; the first is JSON
        if (text.size() < 20) return error("is cut off in its header; a whole .glb is allowed");
        if (little_endian(text, 4) != 2)
            return error(fmt::format("is binary glTF of version {}; version 2 is allowed", little_endian(text, 4)));
        if (little_endian(text, 8) > text.size())
            return error(fmt::format("is cut off: {} bytes of {}", text.size(), little_endian(text, 8)));
        const std::size_t length = little_endian(text, 12);
        if (text.substr(16, 4) != "JSON" || length > text.size() - 20)
            return error("does not start with a JSON chunk; a whole .glb is allowed");
        text = text.substr(20, length);
    }
    GltfJson result;
    try {
        const nlohmann::json root = nlohmann::json::parse(text);
        if (!root.is_object()) return error("is not a JSON object; a glTF 2.0 file is allowed");
        const auto materials = root.find("materials");
        if (materials != root.end() && materials->is_array())
            for (const nlohmann::json& material : *materials) {
                const nlohmann::json strength =
                    material.is_object()
                        ? material.value(nlohmann::json::json_pointer(
                                             "/extensions/KHR_materials_emissive_strength/emissiveStrength"),
                                         nlohmann::json(1.0))
                        : nlohmann::json(1.0);
                result.emissive_strength.push_back(strength.is_number() ? strength.get<double>() : std::nan(""));
            }
        const auto cameras = root.find("cameras");
        if (cameras != root.end() && cameras->is_array())
            for (const nlohmann::json& camera : *cameras) {
                const nlohmann::json fov =
                    camera.is_object()
                        ? camera.value(nlohmann::json::json_pointer("/perspective/yfov"), nlohmann::json(0.0))
                        : nlohmann::json(0.0);
                result.vertical_fov.push_back(fov.is_number() ? fov.get<double>() : 0);
            }
    } catch (const nlohmann::json::parse_error& fault) {
        const std::string_view before =
            text.substr(0, std::min<std::size_t>(fault.byte ? fault.byte - 1 : 0, text.size()));
        const auto line = static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
        const std::size_t last = before.rfind('\n');
        const auto column = static_cast<std::uint32_t>(before.size() - (last == before.npos ? 0 : last + 1) + 1);
        diagnostics.error(file, binary ? Place{} : Place{line, column}, "is not JSON here; a glTF 2.0 file is allowed");
        return {};
    } catch (const nlohmann::json::exception& fault) {
        return error(fmt::format("{}; a glTF 2.0 file is allowed", fault.what()));
    }
    return result;
}

} // namespace lueur
