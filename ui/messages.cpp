#include "ui/messages.h"

#include <algorithm>
#include <imgui.h>

#include "ui/theme.h"

namespace lueur {
namespace {

ImVec4 colour(Severity severity) {
    switch (severity) {
    case Severity::note:
        return colours::text;
    case Severity::warning:
        return colours::warning;
    case Severity::error:
        return colours::error;
    }
    return colours::text;
}

} // namespace

void Messages::add(Severity severity, std::string text, double now) {
    // The same thing said again is shown again, not listed again.
    if (!all.empty() && all.back().text == text && all.back().severity == severity) all.pop_back();
    all.push_back({severity, std::move(text), now});
}

double display_seconds(Severity severity) {
    switch (severity) {
    case Severity::note:
        return 5;
    case Severity::warning:
        return 9;
    case Severity::error:
        return 14;
    }
    return 5;
}

std::optional<double> draw_notes(const Messages& messages, double now, float right, float bottom, float scale) {
    const int most = 4;
    constexpr double fade = 0.4; // s
    int shown = 0;
    std::optional<double> next;
    for (auto message = messages.all.rbegin(); message != messages.all.rend() && shown < most; ++message) {
        const double left = message->time + display_seconds(message->severity) - now;
        if (left <= 0) continue;
        const double change = left > fade ? left - fade : 0.03;
        next = std::min(next.value_or(change), change);
        const float alpha = static_cast<float>(std::clamp(left / fade, 0.0, 1.0));
        ImGui::SetNextWindowPos({right - 14 * scale, bottom - 14 * scale}, ImGuiCond_Always, {1, 1});
        ImGui::SetNextWindowBgAlpha(0.93f * alpha);
        ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * scale);
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.19f, 0.19f, 0.19f, 1));
        ImGui::Begin(("##note" + std::to_string(shown)).c_str(), nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs);
        const auto corner = ImGui::GetWindowPos();
        ImGui::GetWindowDrawList()->AddRectFilled(
            corner, {corner.x + 3 * scale, corner.y + ImGui::GetWindowHeight()},
            ImGui::GetColorU32(message->severity == Severity::note ? colours::accent : colour(message->severity)));
        ImGui::PushTextWrapPos(440 * scale);
        ImGui::TextUnformatted(message->text.c_str());
        ImGui::PopTextWrapPos();
        bottom = corner.y + 6 * scale;
        ImGui::End();
        ImGui::PopStyleColor();
        ImGui::PopStyleVar(2);
        ++shown;
    }
    return next;
}

void draw_log(const Messages& messages, bool& open, float scale) {
    if (!open) return;
    ImGui::SetNextWindowSize({620 * scale, 320 * scale}, ImGuiCond_Appearing);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (ImGui::Begin("Messages", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
        if (ImGui::Button("Copy all")) {
            std::string text;
            for (const auto& message : messages.all) text += message.text + "\n";
            ImGui::SetClipboardText(text.c_str());
        }
        ImGui::Separator();
        ImGui::BeginChild("##list");
        if (messages.all.empty()) ImGui::TextDisabled("Nothing so far.");
        for (const auto& message : messages.all) {
            ImGui::TextDisabled("%7.1f s", message.time);
            ImGui::SameLine();
            ImGui::PushStyleColor(ImGuiCol_Text, colour(message.severity));
            ImGui::TextWrapped("%s", message.text.c_str());
            ImGui::PopStyleColor();
        }
        ImGui::EndChild();
    }
    ImGui::End();
}

} // namespace lueur
