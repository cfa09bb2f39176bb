#include "ui/spectrum_editor.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>
#include <imgui.h>

#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/overload.h"
#include "core/spectrum/read_spectrum.h"
#include "ui/spectrum_picker.h"
#include "ui/spectrum_plot.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

enum class Form { flat, blackbody, daylight, library, lines, drawn, mixture, colour, file, grey };

struct FormWords {
    Form form;
    const char *name, *tip;
};
constexpr std::array light_forms{
    FormWords{Form::library, "Library", "Measured lamps and CIE illuminants"},
    FormWords{Form::blackbody, "Black body", "A glowing body by its temperature: Planck's law"},
    FormWords{Form::daylight, "Daylight", "CIE daylight by its correlated colour temperature"},
    FormWords{Form::flat, "Flat", "Equal energy at every wavelength (CIE illuminant E)"},
    FormWords{Form::lines, "Lines", "Single lines: lasers, discharges"},
    FormWords{Form::drawn, "Drawn", "A curve of points, set by hand"},
    FormWords{Form::mixture, "Mixture", "Two lights shining together: the sum of their spectra"},
    FormWords{Form::colour, "Colour", "Linear sRGB: only the colour is known"},
    FormWords{Form::file, "File", "Measured values from a .csv, .spd, .sp or .cmf file"}};
struct FormOf {
    Form operator()(const Flat&) const { return Form::flat; }
    Form operator()(const Rgb&) const { return Form::colour; }
    Form operator()(const SpectrumFile&) const { return Form::file; }
    Form operator()(const LibrarySpectrum&) const { return Form::library; }
    Form operator()(const Blackbody&) const { return Form::blackbody; }
    Form operator()(const Daylight&) const { return Form::daylight; }
    Form operator()(const Lines&) const { return Form::lines; }
    Form operator()(const Drawn&) const { return Form::drawn; }
    Form operator()(const Mix&) const { return Form::mixture; }
    Form operator()(double) const { return Form::grey; }
};

// A list of forms; the one that was chosen, once. `allowed` leaves some out.
template <typename Allowed>
std::optional<Form> form_combo(UiState& state, const char* id, std::span<const FormWords> forms, Form current,
                               Allowed allowed) {
    const auto now = std::ranges::find(forms, current, &FormWords::form);
    std::optional<Form> chosen;
    const bool open = ImGui::BeginCombo(fmt::format("##{}", id).c_str(), now == forms.end() ? "" : now->name,
                                        ImGuiComboFlags_HeightLarge);
    state.layout_log.widget(id);
    if (!open) return {};
    for (const FormWords& words : forms) {
        if (!allowed(words.form)) continue;
        // Another file can always be asked for.
        if (ImGui::Selectable(words.name, words.form == current) && (words.form != current || words.form == Form::file))
            chosen = words.form;
        state.layout_log.widget(fmt::format("{}:{}", id, words.name));
        tooltip(state, words.tip);
    }
    ImGui::EndCombo();
    return chosen;
}

double kelvin_near(const EmissionSpectrum& light) {
    if (const auto* body = std::get_if<Blackbody>(&light)) return body->kelvin;
    if (const auto* day = std::get_if<Daylight>(&light)) return day->kelvin;
    const auto spectrum = spectrum_of(light);
    const auto near = spectrum ? colour_temperature(xyz_from_spectrum(*spectrum)) : std::nullopt;
    return near ? std::round(near->kelvin) : 3000;
}

// The same light, as near as the other form can come to it.
SimpleEmission changed_to(UiState& state, Form form, const EmissionSpectrum& light) {
    switch (form) {
    case Form::blackbody:
        return Blackbody{std::clamp(kelvin_near(light), 1000.0, 25000.0)};
    case Form::daylight:
        return Daylight{std::clamp(kelvin_near(light), 4000.0, 25000.0)};
    case Form::library:
        if (auto a = from_library(state, LibraryKind::light, "LED-B3")) return std::move(*a);
        return Blackbody{2856};
    case Form::lines:
        return Lines{{SpectralLine{}}};
    case Form::drawn:
        return Drawn{points_near(curve_of(light).nm.empty() ? curve_of(Flat{}) : curve_of(light), CurveKind::light)};
    case Form::flat:
    case Form::mixture:
    case Form::colour:
    case Form::file:
    case Form::grey:
        break;
    }
    return Flat{};
}

std::optional<double> temperature(UiState& state, double kelvin, double lowest, const char* tip) {
    row_label(state, "Temperature", tip);
    const bool moved = log_slider("##kelvin", kelvin, lowest, 25000, "%.0f K");
    state.layout_log.widget("kelvin");
    return moved ? std::optional(std::clamp(kelvin, lowest, 25000.0)) : std::nullopt;
}

struct LinePreset {
    const char* name;
    std::array<SpectralLine, 2> lines;
    std::size_t count;
};
constexpr LinePreset line_presets[] = {
    {"Sodium D (589.0 and 589.6 nm)", {SpectralLine{588.995, 0.1, 2}, SpectralLine{589.592, 0.1, 1}}, 2},
    {"Helium-neon laser (632.8 nm)", {SpectralLine{632.8, 0.1, 1}, {}}, 1},
    {"Green laser (532 nm)", {SpectralLine{532, 0.1, 1}, {}}, 1},
    {"Three laser primaries' blue (467 nm)", {SpectralLine{467, 0.1, 1}, {}}, 1}};

std::optional<Lines> lines_controls(UiState& state, const Lines& current) {
    Lines lines = current;
    bool changed = false;
    row_label(state, "Lines",
              "Wavelength, width and power of each, relative to the others. Drag, or double-click to type.");
    ImGui::PushFont(state.fonts.small);
    const float gap = 4 * state.scale, button = ImGui::GetFrameHeight(), start = ImGui::GetCursorPosX();
    const float width = std::floor((ImGui::GetContentRegionAvail().x - button - 3 * gap) / 3);
    for (int column = 0; column < 3; ++column) {
        if (column > 0) ImGui::SameLine(start + static_cast<float>(column) * (width + gap));
        static constexpr const char* names[] = {"nm", "width, nm", "power"};
        ImGui::TextColored(colours::dim, "%s", names[column]);
    }
    ImGui::PopFont();
    std::optional<std::size_t> gone;
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        SpectralLine& line = lines.lines[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::SetCursorPosX(start);
        const auto drag = [&](const char* id, double& value, float speed, double low, double high) {
            ImGui::SetNextItemWidth(width);
            changed |= ImGui::DragScalar(id, ImGuiDataType_Double, &value, speed, &low, &high, "%.6g",
                                         ImGuiSliderFlags_AlwaysClamp);
            state.layout_log.widget(fmt::format("line:{}{}", i, id));
            ImGui::SameLine(0, gap);
        };
        drag("##nm", line.nm, 0.2f, 300, 830);
        drag("##width", line.width, 0.02f, 0.01, 100);
        drag("##power", line.power, 0.01f, 0, 1e6);
        ImGui::BeginDisabled(lines.lines.size() < 2);
        if (ImGui::Button("×", {button, 0})) gone = i;
        ImGui::EndDisabled();
        tooltip(state, "Take this line away");
        ImGui::PopID();
    }
    ImGui::SetCursorPosX(start);
    if (ImGui::Button("Add a line", {width * 1.5f + gap, 0})) {
        const double last = lines.lines.empty() ? 500 : lines.lines.back().nm;
        lines.lines.push_back({last < 760 ? last + 20 : 450, 1, 1});
        changed = true;
    }
    state.layout_log.widget("add_line");
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##presets", "Known lines")) {
        for (const LinePreset& preset : line_presets)
            if (ImGui::Selectable(preset.name)) {
                lines.lines.assign(preset.lines.begin(), preset.lines.begin() + static_cast<long>(preset.count));
                changed = true;
            }
        ImGui::EndCombo();
    }
    if (gone) {
        lines.lines.erase(lines.lines.begin() + static_cast<long>(*gone));
        changed = true;
    }
    const bool dark = std::ranges::none_of(lines.lines, [](const SpectralLine& line) { return line.power > 0; });
    return changed && !dark ? std::optional(lines) : std::nullopt;
}

// Where a file's spectrum came from, its columns, how its values are meant.
std::optional<SpectrumFile> file_controls(UiState& state, const Scene& scene, const SpectrumFile& file, bool& another) {
    row_label(state, "From");
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5f});
    another = ImGui::Button((file.path + "##file").c_str(), {-1, 0});
    ImGui::PopStyleVar();
    state.layout_log.widget("spectrum_file");
    tooltip(state, (file.path + "\nPress to choose another file.").c_str());

    std::string column = file.column;
    Interpolation interpolation = file.spectrum.interpolation;
    row_label(state, "Column", "Which of the file's spectra");
    const std::filesystem::path full = scene.folder / file.path;
    if (ImGui::BeginCombo("##column", column.empty() ? "the first" : column.c_str())) {
        if (ImGui::IsWindowAppearing() || state.spectra.columns_file != full) {
            state.spectra.columns = spectrum_columns(full).value_or(std::vector<std::string>{});
            state.spectra.columns_file = full;
        }
        for (const std::string& name : state.spectra.columns)
            if (ImGui::Selectable(name.empty() ? "the only one" : name.c_str(), name == column)) column = name;
        if (state.spectra.columns.empty()) ImGui::TextDisabled("The file cannot be read any more.");
        ImGui::EndCombo();
    }
    state.layout_log.widget("spectrum_column");
    row_label(state, "Values are",
              "Linear: samples with straight lines between them. Bins: means over the band around "
              "each wavelength, as a spectrometer gives them.");
    int kind = interpolation == Interpolation::bin ? 1 : 0;
    if (segmented(state, "interpolation", {{"Linear", ""}, {"Bins", ""}}, kind))
        interpolation = kind == 1 ? Interpolation::bin : Interpolation::linear;
    SpectrumFile changed = file;
    changed.spectrum.interpolation = interpolation;
    if (column != file.column) {
        auto read = read_spectrum(full, column, interpolation);
        if (!read) {
            state.messages.add(Severity::error, read.error().front(), ImGui::GetTime());
            return {};
        }
        changed.column = column;
        changed.spectrum = std::move(*read);
    }
    return changed == file ? std::nullopt : std::optional(changed);
}

struct SlotParams {
    const Scene& scene;
    const char* id;    // of this light
    const char* label; // in front of its form
    bool in_mixture;
};

// A light of one curve: what form it has, and that form's own controls. Sets `ask` where a file or a mixture is wanted.
std::optional<SimpleEmission> simple_controls(UiState& state, const SlotParams& params, const SimpleEmission& light,
                                              std::optional<Form>& ask) {
    std::optional<SimpleEmission> changed;
    ImGui::PushID(params.id);
    row_label(state, params.label);
    const Form current = std::visit(FormOf{}, light);
    const auto allowed = [&](Form form) {
        return !params.in_mixture || form == current ||
               (form != Form::mixture && form != Form::colour && form != Form::file);
    };
    if (const auto form = form_combo(state, params.id, light_forms, current, allowed)) {
        if (*form == Form::file || *form == Form::mixture || *form == Form::colour)
            ask = form;
        else
            changed = changed_to(state, *form, emission(light));
    }
    const auto use = [&](auto value) {
        if (value) changed = std::move(*value);
    };
    std::visit(
        Overload{[](const Flat&) {},
                 [&](const Blackbody& body) {
                     if (const auto kelvin =
                             temperature(state, body.kelvin, 1000,
                                         "Candle 1900 K, incandescent 2700 K, halogen 3200 K. Ctrl-click to type."))
                         changed = Blackbody{*kelvin};
                 },
                 [&](const Daylight& day) {
                     if (const auto kelvin = temperature(state, day.kelvin, 4000,
                                                         "Noon sun 5500 K, D65 6504 K, overcast 7000 K, blue sky "
                                                         "10000 K and more. Ctrl-click to type."))
                         changed = Daylight{*kelvin};
                 },
                 [&](const LibrarySpectrum& library) {
                     row_label(state, "Lamp");
                     use(library_button(state, "lamp", LibraryKind::light, library.name));
                 },
                 [&](const Lines& lines) { use(lines_controls(state, lines)); },
                 [&](const Drawn& drawn) {
                     if (auto curve = curve_editor(state, "##drawn", drawn.spectrum, CurveKind::light))
                         changed = Drawn{std::move(*curve)};
                 },
                 [&](const SpectrumFile& file) {
                     bool another = false;
                     use(file_controls(state, params.scene, file, another));
                     if (another && !params.in_mixture) ask = Form::file;
                 }},
        light);
    ImGui::PopID();
    return changed;
}

std::optional<Mix> mixture_controls(UiState& state, const Scene& scene, const Mix& mix) {
    std::optional<Mix> changed;
    for (std::size_t i = 0; i < 2; ++i) {
        std::optional<Form> ask;
        const SlotParams slot{scene, i == 0 ? "first_light" : "second_light", i == 0 ? "First light" : "Second light",
                              true};
        if (auto light = simple_controls(state, slot, mix.lights[i], ask)) {
            changed = mix;
            changed->lights[i] = std::move(*light);
        }
    }
    row_label(state, "Share", "Of the luminous flux, that the second light gives.");
    auto percent = static_cast<float>(100 * mix.share);
    if (ImGui::SliderFloat("##share", &percent, 0, 100, "%.0f %% of the second", ImGuiSliderFlags_AlwaysClamp)) {
        changed = changed.value_or(mix);
        changed->share = std::clamp(std::round(static_cast<double>(percent) * 10) / 1000, 0.0, 1.0);
    }
    state.layout_log.widget("mixture_share");
    return changed;
}

std::optional<Rgb> colour_controls(UiState& state, const Rgb& rgb) {
    row_label(state, "Colour", "Only its proportions count in lm and W.");
    const double size = std::max({rgb.r, rgb.g, rgb.b, 1e-12});
    auto shown = encoded(rgb / size);
    if (!ImGui::ColorEdit3("##colour", &shown.x, ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_PickerHueWheel))
        return {};
    const Rgb colour = decoded(shown) * size;
    return std::max({colour.r, colour.g, colour.b}) > 0 ? std::optional(colour) : std::nullopt;
}

std::optional<EmissionSpectrum> other_form(UiState& state, Form form, LuminaireIndex index,
                                           const EmissionSpectrum& light) {
    switch (form) {
    case Form::file:
        state.file_request = FileRequest{FilePurpose::emission_spectrum, {}, index, {}};
        return {};
    case Form::colour:
        return linear_rgb(light);
    case Form::mixture: {
        const SimpleEmission own = simple_emission(light).value_or(Flat{});
        SimpleEmission second = Blackbody{2700};
        if (auto lamp = from_library(state, LibraryKind::light, "LED-B5")) second = std::move(*lamp);
        return Mix{{own, std::move(second)}, 0.5};
    }
    case Form::flat:
    case Form::blackbody:
    case Form::daylight:
    case Form::library:
    case Form::lines:
    case Form::drawn:
    case Form::grey:
        break;
    }
    return emission(changed_to(state, form, light));
}

template <typename Value>
std::optional<Value> draw_on(UiState& state, const Spectrum& curve, CurveKind kind) {
    if (curve.nm.empty()) return {};
    const bool pressed = ImGui::Button("Draw on this curve", {-1, 0});
    state.layout_log.widget("draw_curve");
    tooltip(state, "Makes it a curve of a few points that can be dragged.");
    return pressed ? std::optional<Value>(Drawn{points_near(curve, kind)}) : std::nullopt;
}

} // namespace

std::optional<EmissionSpectrum> emission_editor(UiState& state, const Scene& scene, LuminaireIndex index) {
    const EmissionSpectrum& light = scene.luminaires[at(index)].spectrum;
    std::optional<EmissionSpectrum> changed;
    std::optional<Form> ask;
    if (const auto simple = simple_emission(light)) {
        if (const auto one = simple_controls(state, {scene, "spectrum_form", "Spectrum", false}, *simple, ask))
            changed = emission(*one);
    } else {
        row_label(state, "Spectrum");
        ask = form_combo(state, "spectrum_form", light_forms, std::visit(FormOf{}, light), [](Form) { return true; });
        if (const auto* mix = std::get_if<Mix>(&light))
            if (auto both = mixture_controls(state, scene, *mix)) changed = std::move(*both);
        if (const auto* rgb = std::get_if<Rgb>(&light))
            if (const auto colour = colour_controls(state, *rgb)) changed = *colour;
    }
    if (ask)
        if (auto other = other_form(state, *ask, index, light)) changed = std::move(*other);
    if (!std::holds_alternative<Drawn>(light)) {
        const Spectrum curve = curve_of(light);
        spectrum_plot(state, "##curve", curve, CurveKind::light);
        if (auto drawn = draw_on<EmissionSpectrum>(state, curve, CurveKind::light)) changed = std::move(*drawn);
    }
    return changed;
}

std::optional<Reflectance> reflectance_editor(UiState& state, const Scene& scene, MaterialIndex index) {
    const Reflectance& paint = scene.materials[at(index)].reflectance;
    std::optional<Reflectance> changed;
    const auto ask_file = [&] { state.file_request = FileRequest{FilePurpose::reflectance_spectrum, index, {}, {}}; };
    static constexpr Form forms[] = {Form::grey, Form::colour, Form::library, Form::drawn, Form::file};
    const auto now = std::ranges::find(forms, std::visit(FormOf{}, paint));
    auto kind = static_cast<int>(now - std::begin(forms));
    ImGui::SetNextItemWidth(-1);
    if (segmented(state, "reflectance_kind",
                  {{"Grey", "One number at every wavelength"},
                   {"Colour", "Linear sRGB, made a smooth spectrum between 0 and 1"},
                   {"Library", "Measured paints"},
                   {"Drawn", "A curve of points, set by hand"},
                   {"File", "Measured values from a .csv, .spd, .sp or .cmf file"}},
                  kind)) {
        const Form form = forms[kind];
        if (form == Form::grey) changed = std::clamp(luminous_reflectance(paint), 0.0, 1.0);
        if (form == Form::colour) changed = Reflectance(glm::clamp(linear_rgb(paint), 0.0, 1.0));
        if (form == Form::drawn) changed = Drawn{points_near(curve_of(paint), CurveKind::reflectance)};
        if (form == Form::file) ask_file();
        if (form == Form::library)
            if (auto neutral = from_library(state, LibraryKind::reflectance, "ColorChecker neutral 5"))
                changed = std::move(*neutral);
    }
    if (const auto* library = std::get_if<LibrarySpectrum>(&paint)) {
        row_label(state, "Paint");
        if (auto chosen = library_button(state, "paint", LibraryKind::reflectance, library->name))
            changed = std::move(*chosen);
    } else if (const auto* file = std::get_if<SpectrumFile>(&paint)) {
        bool another = false;
        if (auto other = file_controls(state, scene, *file, another)) changed = std::move(*other);
        if (another) ask_file();
    } else if (const auto* drawn = std::get_if<Drawn>(&paint)) {
        if (auto curve = curve_editor(state, "##drawn", drawn->spectrum, CurveKind::reflectance))
            changed = Drawn{std::move(*curve)};
    }
    return changed;
}

std::optional<Reflectance> reflectance_plot(UiState& state, const Reflectance& paint) {
    if (std::holds_alternative<Drawn>(paint)) return {};
    const Spectrum curve = curve_of(paint);
    spectrum_plot(state, "##curve", curve, CurveKind::reflectance);
    return draw_on<Reflectance>(state, curve, CurveKind::reflectance);
}

} // namespace lueur
