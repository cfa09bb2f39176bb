// The built program in a window on a virtual screen, worked by hand: xdotool presses real buttons at the places that
// the program names in its layout file (LUEUR_UI_LAYOUT).
#pragma once

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/e2e/virtual_screen.h"

namespace lueur::test {

struct Box {
    double x0, y0, x1, y1;
    double x(double share = 0.5) const { return x0 + share * (x1 - x0); }
    double y(double share = 0.5) const { return y0 + share * (y1 - y0); }
};

class Program {
public:
    Program(const VirtualScreen& screen, const std::vector<std::string>& arguments)
        : screen_(screen)
        , folder_(std::filesystem::temp_directory_path() / fmt::format("lueur-e2e-{}", getpid())) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        process_ = fork();
        if (process_ == 0) {
            if (chdir(folder_.c_str()) != 0) _exit(126);
            setenv("LUEUR_UI_LAYOUT", (folder_ / "layout.json").c_str(), 1);
            setenv("LUEUR_FRAME_LOG", (folder_ / "frames").c_str(), 1);
            setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
            unsetenv("XDG_PICTURES_DIR");
            unsetenv("LUEUR_SCALE");
            std::vector<char*> words{const_cast<char*>(LUEUR_PROGRAM)};
            for (const auto& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
            words.push_back(nullptr);
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            execv(LUEUR_PROGRAM, words.data());
            _exit(127);
        }
    }
    ~Program() {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
        }
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    const std::filesystem::path& folder() const { return folder_; }

    nlohmann::json layout() const {
        std::ifstream stream(folder_ / "layout.json");
        auto json = nlohmann::json::parse(stream, nullptr, false);
        return json.is_object() ? json : nlohmann::json::object();
    }
    bool wait(const std::function<bool(const nlohmann::json&)>& until, double seconds = 60) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end) {
            if (const auto json = layout(); json.contains("widgets") && until(json)) return true;
            rest(0.05);
        }
        return false;
    }
    // Solved, and drawn with many samples a pixel.
    bool wait_still() const {
        rest(0.3); // what was just pressed has been seen
        const auto still = [](const nlohmann::json& json) {
            return json["settled"] == true && json["refined"] == true;
        };
        if (!wait(still)) return false;
        rest(0.4);
        return wait(still);
    }
    bool has(const std::string& widget) const {
        const auto json = layout();
        return json.contains("widgets") && json["widgets"].contains(widget);
    }
    Box box(const std::string& widget) const {
        if (!wait([&](const nlohmann::json& json) { return json["widgets"].contains(widget); }, 20)) {
            ADD_FAILURE() << "no widget is called " << widget;
            return {0, 0, 0, 0};
        }
        const auto json = layout();
        const auto values = json["widgets"][widget].get<std::vector<double>>();
        return {values[0], values[1], values[2], values[3]};
    }

    void hand(const std::string& actions) const { // words of xdotool
        if (std::system(("xdotool " + actions + " > /dev/null 2>&1").c_str()) != 0)
            ADD_FAILURE() << "xdotool " << actions;
        rest(0.05);
    }
    // The next action waits until the program has seen this one: a busy machine may take a second for a frame.
    void move(double x, double y) const {
        hand(fmt::format("mousemove {:.0f} {:.0f}", x, y));
        const auto seen = [&](const nlohmann::json& json) {
            return std::abs(json["mouse"][0].get<double>() - std::round(x)) <= 1 &&
                   std::abs(json["mouse"][1].get<double>() - std::round(y)) <= 1;
        };
        if (!wait(seen, 20)) ADD_FAILURE() << "the pointer at " << x << "," << y << " was not seen";
    }
    void press(bool down) const {
        hand(down ? "mousedown 1" : "mouseup 1");
        if (!wait([&](const nlohmann::json& json) { return json["mouse"][2] == (down ? 1 : 0); }, 20))
            ADD_FAILURE() << "the button was not seen " << (down ? "down" : "up");
    }
    void click(double x, double y) const {
        move(x, y);
        press(true);
        press(false);
        rest(0.15);
    }
    void click(const std::string& widget) const {
        const auto place = box(widget);
        click(place.x(), place.y());
    }
    void drag(const std::string& widget, double from, double to) const {
        const auto place = box(widget);
        move(place.x(from), place.y());
        press(true);
        for (int i = 1; i <= 5; ++i) move(place.x(from + (to - from) * i / 5), place.y());
        press(false);
        rest(0.15);
    }
    // Out of the way, where nothing lights up under the pointer.
    void rest_hand() const {
        const auto viewport = box("viewport");
        move(viewport.x0 + 4, viewport.y0 + 4);
    }
    Pixels screen() const { return screen_.pixels(); }

    double processor_seconds() const { // spent so far, all threads
        std::ifstream stream(fmt::format("/proc/{}/stat", process_));
        std::string text((std::istreambuf_iterator<char>(stream)), {});
        std::istringstream fields(text.substr(text.rfind(')') + 2));
        std::string word;
        double user = 0, system = 0;
        for (int field = 3; field <= 15 && fields >> word; ++field) {
            if (field == 14) user = std::stod(word);
            if (field == 15) system = std::stod(word);
        }
        return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
    }
    // Exit status, or -1 when it has not ended in time.
    int wait_end(double seconds) {
        for (double waited = 0; waited < seconds; waited += 0.05) {
            int status = 0;
            if (waitpid(process_, &status, WNOHANG) == process_) {
                process_ = 0;
                return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
            }
            rest(0.05);
        }
        return -1;
    }
    static void rest(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

private:
    const VirtualScreen& screen_;
    std::filesystem::path folder_;
    pid_t process_ = 0;
};

} // namespace lueur::test
