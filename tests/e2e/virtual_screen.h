// A screen that nobody looks at: Xvfb on a display number of its own choosing, whose pixels can be read.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <csignal>
#include <cstdio>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lueur::test {

struct Pixels { // row-major from the top left
    int width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 3>> rgb;
    const std::array<std::uint8_t, 3>& at(int x, int y) const {
        return rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

class VirtualScreen {
public:
    // Sets DISPLAY and asks for Mesa's software renderer in this process and those it starts.
    VirtualScreen(int width, int height) {
        folder_ = std::filesystem::temp_directory_path() / ("lueur-screen-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            const auto number = std::to_string(ends[1]),
                       size = std::to_string(width) + "x" + std::to_string(height) + "x24";
            const auto log = (folder_ / "log").string();
            prctl(PR_SET_PDEATHSIG, SIGTERM); // a test that crashes leaves no screen behind
            if (!std::freopen(log.c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout)) _exit(126);
            execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", size.c_str(), "-nolisten", "tcp",
                   "-fbdir", folder_.c_str(), static_cast<char*>(nullptr));
            _exit(127);
        }
        close(ends[1]);
        std::string display;
        for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) display += c;
        close(ends[0]);
        if (display.empty()) throw std::runtime_error("Xvfb did not start; Debian package xvfb");
        setenv("DISPLAY", (":" + display).c_str(), 1);
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        unsetenv("WAYLAND_DISPLAY");
    }
    ~VirtualScreen() {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;

    // The screen as it is now. Xvfb keeps it in a file in the X window dump format (X11/XWDFile.h).
    Pixels pixels() const {
        std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
        const auto byte = [&](std::size_t i) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(i)));
        };
        const auto field = [&](std::size_t n) { // the header's 32-bit fields are big-endian
            return byte(4 * n) << 24 | byte(4 * n + 1) << 16 | byte(4 * n + 2) << 8 | byte(4 * n + 3);
        };
        const std::size_t header = field(0), colours = field(19), stride = field(12);
        Pixels result{static_cast<int>(field(4)), static_cast<int>(field(5)), {}};
        const std::size_t first = header + 12 * colours;
        for (std::size_t y = 0; y < static_cast<std::size_t>(result.height); ++y)
            for (std::size_t x = 0; x < static_cast<std::size_t>(result.width); ++x) {
                const auto at = first + y * stride + 4 * x; // blue, green, red, nothing
                result.rgb.push_back({static_cast<std::uint8_t>(byte(at + 2)), static_cast<std::uint8_t>(byte(at + 1)),
                                      static_cast<std::uint8_t>(byte(at))});
            }
        return result;
    }

private:
    pid_t process_ = 0;
    std::filesystem::path folder_;
};

} // namespace lueur::test
