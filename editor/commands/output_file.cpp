#include "editor/commands/output_file.h"

#include <cerrno>
#include <cstring>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "core/display/replace_file.h"

namespace lueur {

std::expected<void, std::string> check_writable(const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    const auto fault = [&](const std::string& what) {
        return std::unexpected(fmt::format("{}: {}; allowed: a file name in an existing folder that may be written to",
                                           file.string(), what));
    };
    std::error_code error;
    const auto folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (fs::is_directory(file, error)) return fault("is a folder");
    if (fs::exists(file, error) && !fs::is_regular_file(file, error)) return fault("is not a regular file");
    if (!fs::is_directory(folder, error)) return fault(fmt::format("there is no folder {}", folder.string()));
    if (access(folder.c_str(), W_OK) != 0) return fault(fmt::format("cannot be written ({})", std::strerror(errno)));
    return {};
}

std::expected<void, std::string> write_text(const std::filesystem::path& file, const std::string& text) {
    if (auto possible = check_writable(file); !possible) return possible;
    return replace_file(file, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

} // namespace lueur
