#include "core/display/replace_file.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <random>
#include <system_error>

namespace lueur {

std::expected<void, std::string> replace_file(const std::filesystem::path& file, std::span<const unsigned char> bytes) {
    namespace fs = std::filesystem;
    const auto fault = [&](const std::string& what) {
        return std::unexpected(fmt::format("{}: {}; allowed: a file name in an existing folder that may be written to",
                                           file.string(), what));
    };
    std::error_code error;
    if (fs::is_directory(file, error)) return fault("is a folder");
    // A link is followed, so that the file it names is replaced and the link stays.
    fs::path target = file;
    if (fs::is_symlink(file, error)) {
        target = fs::weakly_canonical(file, error);
        if (error) return fault(error.message());
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) return fault(fmt::format("there is no folder {}", folder.string()));

    std::random_device random; // two programs may write the same picture at once
    const fs::path beside = folder / fmt::format(".{}.{:08x}.tmp", target.filename().string(), random());
    errno = 0;
    bool written = false;
    {
        std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        stream.close();
        written = stream.good();
    }
    if (!written) {
        const std::string reason = errno != 0 ? std::strerror(errno) : "no reason known";
        fs::remove(beside, error);
        return fault(fmt::format("cannot be written ({})", reason));
    }
    fs::rename(beside, target, error);
    if (error) {
        const std::string reason = error.message();
        fs::remove(beside, error);
        return fault(fmt::format("cannot be put in its place ({})", reason));
    }
    return {};
}

} // namespace lueur
