// Panels without a window: an ImGui of 1280 x 800 whose widgets say where they are (ui/layout_log.h).
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "editor/document.h"
#include "ui/theme.h"
#include "ui/ui_state.h"

namespace lueur::test {

class PanelFixture : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        layout_file_ = std::filesystem::temp_directory_path() /
                       ("lueur-" + std::string(test->test_suite_name()) + std::to_string(getpid()) + ".json");
        setenv("LUEUR_UI_LAYOUT", layout_file_.c_str(), 1);
        ImGui::CreateContext();
        auto& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280, 800};
        io.DeltaTime = 1.0f / 60;
        for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
        apply_theme(1);
        std::string complaint;
        fonts_ = load_fonts(1, complaint);
        state_ = std::make_unique<UiState>();
        state_->fonts = fonts_;
    }
    void TearDown() override {
        state_.reset();
        ImGui::DestroyContext();
        unsetenv("LUEUR_UI_LAYOUT");
        std::filesystem::remove(layout_file_);
    }

    template <typename Draw>
    void draw_frame(const Draw& draw, float height = 780) { // in a box as wide as the window's column
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({348, height});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
        draw();
        ImGui::End();
        ImGui::Render();
        state_->layout_log.end_frame();
    }
    nlohmann::json widgets() const { // name -> left, top, right, bottom, as of the last frame
        std::ifstream stream(layout_file_);
        return nlohmann::json::parse(stream).at("widgets");
    }
    std::array<float, 4> box_of(const std::string& name) const {
        return widgets().at(name).get<std::array<float, 4>>();
    }

    std::filesystem::path layout_file_;
    Fonts fonts_;
    std::unique_ptr<UiState> state_;
    Document document_;
};

} // namespace lueur::test
