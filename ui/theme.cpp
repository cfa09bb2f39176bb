#include "ui/theme.h"

#include <array>
#include <filesystem>

namespace lueur {
namespace {

// Latin, Greek and Cyrillic letters for names in files; superscripts, arrows and relations for units and figures.
constexpr std::array<ImWchar, 21> glyph_ranges{0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x045f, 0x2000,
                                               0x2027, 0x2070, 0x209c, 0x2190, 0x2193, 0x2212, 0x2212,
                                               0x2248, 0x2248, 0x2260, 0x2265, 0x25b2, 0x25bc, 0};

ImFont* load(const char* name, float pixels) {
    static constexpr std::array folders{"/usr/share/fonts/opentype/inter/", "/usr/share/fonts/truetype/inter/",
                                        "/usr/local/share/fonts/"};
    for (const auto* folder : folders) {
        const auto file = std::string(folder) + name;
        std::error_code error;
        if (!std::filesystem::exists(file, error)) continue;
        ImFontConfig config;
        config.OversampleH = 2;
        config.OversampleV = 1;
        config.PixelSnapH = false;
        return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), pixels, &config, glyph_ranges.data());
    }
    return nullptr;
}

} // namespace

Fonts load_fonts(float scale, std::string& complaint) {
    auto& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    Fonts fonts;
    fonts.regular = load("Inter-Regular.otf", 15 * scale);
    fonts.heading = load("Inter-SemiBold.otf", 15 * scale);
    fonts.small = load("Inter-Regular.otf", 12.5f * scale);
    if (!fonts.regular || !fonts.heading || !fonts.small) {
        complaint = "The Inter font is not installed (Debian package fonts-inter); a plain one is used in its place.";
        atlas.Clear();
        ImFontConfig config;
        config.SizePixels = 14 * scale;
        fonts.regular = fonts.heading = fonts.small = atlas.AddFontDefault(&config);
    }
    atlas.Build();
    return fonts;
}

void apply_theme(float scale) {
    auto& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 7;
    style.WindowRounding = 6; // of dialogs: the fixed windows draw no ground
    style.ChildRounding = 4;
    style.FrameRounding = 4;
    style.PopupRounding = 6;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 4;
    style.TabRounding = 4;
    style.WindowBorderSize = 1;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.WindowTitleAlign = {0, 0.5f};
    style.ColorButtonPosition = ImGuiDir_Left;
    style.ScaleAllSizes(scale);

    using namespace colours;
    const auto with_alpha = [](ImVec4 colour, float alpha) { return ImVec4(colour.x, colour.y, colour.z, alpha); };
    const auto grey = [](float value, float alpha = 1) { return ImVec4(value, value, value, alpha); };
    auto* c = style.Colors;
    c[ImGuiCol_Text] = text;
    c[ImGuiCol_TextDisabled] = dim;
    c[ImGuiCol_WindowBg] = raised;
    c[ImGuiCol_ChildBg] = grey(0, 0);
    c[ImGuiCol_PopupBg] = grey(0.17f, 0.98f);
    c[ImGuiCol_Border] = line;
    c[ImGuiCol_FrameBg] = frame;
    c[ImGuiCol_FrameBgHovered] = grey(0.275f);
    c[ImGuiCol_FrameBgActive] = grey(0.310f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.20f);
    c[ImGuiCol_MenuBarBg] = grey(0.125f);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.32f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.40f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.48f);
    c[ImGuiCol_CheckMark] = accent;
    c[ImGuiCol_SliderGrab] = with_alpha(accent, 0.80f);
    c[ImGuiCol_SliderGrabActive] = accent;
    c[ImGuiCol_Button] = grey(0.255f);
    c[ImGuiCol_ButtonHovered] = grey(0.315f);
    c[ImGuiCol_ButtonActive] = grey(0.370f);
    c[ImGuiCol_Header] = grey(0.245f);
    c[ImGuiCol_HeaderHovered] = grey(0.285f);
    c[ImGuiCol_HeaderActive] = grey(0.320f);
    c[ImGuiCol_Separator] = line;
    c[ImGuiCol_SeparatorHovered] = with_alpha(accent, 0.6f);
    c[ImGuiCol_SeparatorActive] = accent;
    c[ImGuiCol_ResizeGrip] = c[ImGuiCol_ResizeGripHovered] = c[ImGuiCol_ResizeGripActive] = grey(0, 0);
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = grey(0.150f);
    c[ImGuiCol_TabHovered] = grey(0.285f);
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = grey(0.245f);
    c[ImGuiCol_PlotLines] = accent;
    c[ImGuiCol_TextSelectedBg] = with_alpha(accent, 0.35f);
    c[ImGuiCol_DragDropTarget] = accent;
    c[ImGuiCol_NavHighlight] = accent;
    c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.55f);
    c[ImGuiCol_TableBorderLight] = line;
}

} // namespace lueur
