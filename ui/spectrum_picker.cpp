#include "ui/spectrum_picker.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "editor/asset_path.h"
#include "ui/spectrum_plot.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

void list(SpectrumShelf& shelf) {
    if (shelf.library) return;
    auto listed = list_spectrum_library(asset_path("spectra"));
    shelf.library = listed ? std::move(*listed) : SpectrumLibrary{};
    if (!listed) shelf.errors = listed.error();
}

ShelfSpectrum described(Spectrum spectrum, LibraryKind kind) {
    ShelfSpectrum shown;
    switch (kind) {
    case LibraryKind::light: {
        shown.colour = encoded(linear_rgb(EmissionSpectrum(LibrarySpectrum{{}, spectrum})));
        if (const auto near = colour_temperature(xyz_from_spectrum(spectrum)))
            shown.note = fmt::format("{:.0f} K", near->kelvin);
        break;
    }
    case LibraryKind::reflectance: {
        const Reflectance paint = LibrarySpectrum{{}, spectrum};
        shown.colour = encoded(linear_rgb(paint));
        shown.note = fmt::format("{:.1f} %", 100 * luminous_reflectance(paint));
        break;
    }
    }
    shown.spectrum = std::move(spectrum);
    return shown;
}

const ShelfSpectrum& shelf_spectrum(SpectrumShelf& shelf, std::size_t index) {
    const auto found = shelf.spectra.find(index);
    if (found != shelf.spectra.end()) return found->second;
    const LibraryEntry& entry = shelf.library->entries[index];
    auto read = read_library_spectrum(*shelf.library, entry);
    if (!read) shelf.errors.insert(shelf.errors.end(), read.error().begin(), read.error().end());
    return shelf.spectra
        .emplace(index, read ? described(std::move(*read), shelf.library->groups[entry.group].kind) : ShelfSpectrum{})
        .first->second;
}

bool holds(const std::string& text, const std::string& part) {
    return part.empty() || !std::ranges::search(
                                text, part, {}, [](unsigned char c) { return std::tolower(c); },
                                [](unsigned char c) { return std::tolower(c); })
                                .empty();
}

CurveKind curve_kind(LibraryKind kind) {
    return kind == LibraryKind::light ? CurveKind::light : CurveKind::reflectance;
}

// A row of the tree: curve, name, colour.
bool entry_row(UiState& state, std::size_t index, bool current) {
    SpectrumShelf& shelf = state.spectra;
    const LibraryEntry& entry = shelf.library->entries[index];
    const LibraryGroup& group = shelf.library->groups[entry.group];
    const float scale = state.scale, height = 28 * scale;
    ImGui::PushID(static_cast<int>(index));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::Selectable("##entry", current, 0, {0, height});
    state.layout_log.widget("library:" + entry.name);
    if (ImGui::IsItemVisible()) {
        const ShelfSpectrum& shown = shelf_spectrum(shelf, index);
        auto& draw = *ImGui::GetWindowDrawList();
        const float right = ImGui::GetItemRectMax().x, wide = 72 * scale;
        spectrum_thumbnail(draw, {corner.x + 3 * scale, corner.y + 3 * scale},
                           {corner.x + wide, corner.y + height - 3 * scale}, shown.spectrum, curve_kind(group.kind));
        const float text_y = corner.y + 0.5f * (height - ImGui::GetTextLineHeight());
        const float note_x = right - 28 * scale - ImGui::CalcTextSize(shown.note.c_str()).x;
        ImGui::PushClipRect(corner, {note_x - 6 * scale, corner.y + height}, true);
        draw.AddText({corner.x + wide + 9 * scale, text_y}, packed(current ? colours::accent : colours::text),
                     entry.name.c_str());
        ImGui::PopClipRect();
        draw.AddText({note_x, text_y}, packed(colours::dim), shown.note.c_str());
        const ImU32 colour = packed({shown.colour.x, shown.colour.y, shown.colour.z, 1});
        const ImVec2 middle{right - 13 * scale, corner.y + 0.5f * height};
        const float half = 7 * scale;
        if (group.kind == LibraryKind::light)
            draw.AddCircleFilled(middle, half, colour);
        else
            draw.AddRectFilled({middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}, colour,
                               2 * scale);
    }
    tooltip(state, (entry.name + "\n" + group.source).c_str());
    ImGui::PopID();
    return pressed;
}

std::optional<LibrarySpectrum> tree(UiState& state, LibraryKind kind, const std::string& current, bool opened) {
    SpectrumShelf& shelf = state.spectra;
    const SpectrumLibrary& library = *shelf.library;
    std::optional<LibrarySpectrum> chosen;
    bool any = false;
    for (std::size_t g = 0; g < library.groups.size(); ++g) {
        const LibraryGroup& group = library.groups[g];
        if (group.kind != kind) continue;
        std::vector<std::size_t> shown;
        bool has_current = false;
        for (std::size_t i = 0; i < library.entries.size(); ++i) {
            const LibraryEntry& entry = library.entries[i];
            if (entry.group != g) continue;
            has_current = has_current || entry.name == current;
            if (holds(entry.name, shelf.filter) || holds(group.name, shelf.filter)) shown.push_back(i);
        }
        if (shown.empty()) continue;
        any = true;
        ImGui::PushID(static_cast<int>(g));
        if (!shelf.filter.empty())
            ImGui::SetNextItemOpen(true);
        else if (opened)
            ImGui::SetNextItemOpen(has_current || (current.empty() && group.name.starts_with("CIE standard")) ||
                                   kind == LibraryKind::reflectance);
        const bool open =
            ImGui::TreeNodeEx("##group", ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen, "%s",
                              group.name.c_str());
        state.layout_log.widget("library_group:" + group.name);
        const auto count = std::to_string(shown.size());
        ImGui::GetWindowDrawList()->AddText(
            {ImGui::GetItemRectMax().x - ImGui::CalcTextSize(count.c_str()).x - 8 * state.scale,
             ImGui::GetItemRectMin().y + 1},
            packed(colours::dim), count.c_str());
        if (open) {
            ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * state.scale, 1 * state.scale});
            for (const std::size_t i : shown)
                if (entry_row(state, i, library.entries[i].name == current))
                    if (const Spectrum& spectrum = shelf_spectrum(shelf, i).spectrum; !spectrum.nm.empty())
                        chosen = LibrarySpectrum{library.entries[i].name, spectrum};
            ImGui::PopStyleVar();
        }
        ImGui::PopID();
    }
    if (!any)
        ImGui::TextDisabled("%s", shelf.filter.empty() ? "The library is empty: the program's folder assets/spectra "
                                                         "is not there."
                                                       : "Nothing of that name.");
    for (const std::string& error : shelf.errors) ImGui::TextColored(colours::error, "%s", error.c_str());
    return chosen;
}

} // namespace

std::optional<LibrarySpectrum> from_library(UiState& state, LibraryKind kind, const std::string& name) {
    list(state.spectra);
    const LibraryEntry* entry = find_entry(*state.spectra.library, kind, name);
    if (!entry) return {};
    const auto index = static_cast<std::size_t>(entry - state.spectra.library->entries.data());
    const Spectrum& spectrum = shelf_spectrum(state.spectra, index).spectrum;
    if (spectrum.nm.empty()) return {};
    return LibrarySpectrum{name, spectrum};
}

std::optional<LibrarySpectrum> library_button(UiState& state, const char* id, LibraryKind kind,
                                              const std::string& current) {
    const float scale = state.scale, width = ImGui::CalcItemWidth();
    ImGui::PushID(id);
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5f});
    const bool pressed = ImGui::Button((current.empty() ? "Choose..." : current + "##current").c_str(), {width, 0});
    ImGui::PopStyleVar();
    state.layout_log.widget(std::string("library_button:") + id);
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float middle = 0.5f * (low.y + high.y);
    ImGui::GetWindowDrawList()->AddTriangleFilled({high.x - 16 * scale, middle - 2.5f * scale},
                                                  {high.x - 8 * scale, middle - 2.5f * scale},
                                                  {high.x - 12 * scale, middle + 3 * scale}, packed(colours::dim));
    if (pressed) {
        list(state.spectra);
        state.spectra.filter.clear();
        ImGui::OpenPopup("##library");
    }
    std::optional<LibrarySpectrum> chosen;
    const float wide = 372 * scale;
    ImGui::SetNextWindowSize({wide, 420 * scale});
    ImGui::SetNextWindowPos({high.x - wide, high.y + 3 * scale}, ImGuiCond_Appearing);
    if (ImGui::BeginPopup("##library")) {
        const bool opened = ImGui::IsWindowAppearing();
        if (opened) ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(-1);
        ImGui::InputTextWithHint("##search", kind == LibraryKind::light ? "Search lights" : "Search paints",
                                 &state.spectra.filter);
        state.layout_log.widget("library_search");
        ImGui::BeginChild("##tree");
        chosen = tree(state, kind, current, opened);
        ImGui::EndChild();
        if (chosen || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return chosen;
}

} // namespace lueur
