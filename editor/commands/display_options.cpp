#include "editor/commands/display_options.h"

#include <algorithm>

#include "core/display/display_fields.h"
#include "core/display/image_file.h"
#include "editor/commands/option_text.h"

namespace lueur {

namespace {

std::optional<std::vector<double>> numbers_from_text(std::string_view text, char separator) {
    std::vector<double> numbers;
    while (true) {
        const auto end = text.find(separator);
        const auto number = number_from_text(text.substr(0, end));
        if (!number) return {};
        numbers.push_back(*number);
        if (end == std::string_view::npos) return numbers;
        text.remove_prefix(end + 1);
    }
}

bool all_in(const std::vector<double>& numbers, const AllowedNumber& allowed) {
    return std::ranges::all_of(numbers, [&](double value) { return allowed.contains(value); });
}

template <typename Enum, std::size_t N, typename Target>
void add_words(CLI::App& app, const std::string& name, const std::string& help, const std::array<Enum, N>& all,
               Target& target) {
    std::string words;
    for (const Enum value : all) words += (words.empty() ? "" : ", ") + to_string(value);
    add(app, name, "NAME", help + ": " + words, [name, words, all, &target](const std::string& text) {
        for (const Enum value : all)
            if (text == to_string(value)) {
                target = value;
                return;
            }
        refuse(name, text, "allowed: " + words);
    });
}

void read_max_display(RenderCommand& render, const std::string& text) {
    if (text == "auto") {
        render.max_display_rule = MaxDisplayRule::percentile;
    } else if (text == "lecture") {
        render.max_display_rule = MaxDisplayRule::lecture;
    } else if (const auto percentile =
                   text.starts_with('p') ? number_from_text(std::string_view(text).substr(1)) : std::nullopt;
               percentile && allowed_percentile.contains(*percentile)) {
        render.max_display_rule = MaxDisplayRule::percentile;
        render.percentile = *percentile;
    } else if (const auto value = number_from_text(text); value && allowed_max_display.contains(*value)) {
        render.max_display = *value;
    } else {
        refuse("--max-display", text,
               fmt::format("a number above 0 ({}), auto, lecture, or p1 to p100 is allowed", allowed_max_display.text));
    }
}

} // namespace

void add_display_options(CLI::App& app, RenderCommand& render) {
    add(app, "--max-display", "X|auto|lecture|pNN",
        "Luminance in cd/m2 (illuminance in lx with --quantity illuminance) shown as full white; auto: from the "
        "picture; "
        "pNN: so that NN % of it is not cut; lecture: the lighting engineers' rule, from lamps and floor; else as the "
        "scene says",
        [&render](const std::string& text) { read_max_display(render, text); });
    add_words(app, "--operator", "From the luminance of the scene to that of the display", all_tone_operators,
              render.tone_operator);
    add(app, "--adaptation", "X|auto",
        "Luminance in cd/m2 that the eye is adapted to in the scene, for tumblin_rushmeier; auto: the picture's "
        "geometric mean",
        [&render](const std::string& text) {
            const auto value = number_from_text(text);
            render.adaptation_auto = text == "auto";
            if (render.adaptation_auto) return;
            if (!value || !allowed_adaptation.contains(*value))
                refuse("--adaptation", text, fmt::format("auto or a number {} is allowed", allowed_adaptation.text));
            render.adaptation = *value;
        });
    add_words(app, "--clip", "What becomes of colours that the display cannot show", all_clip_rules, render.clip);
    add_words(app, "--curve", "From light to pixel value", all_transfer_curves, render.curve);
    add(app, "--gamma", "G|R,G,B",
        "Exponent of the gamma curve, 0.1 to 10, for all channels or each; takes --curve gamma",
        [&render](const std::string& text) {
            const auto values = numbers_from_text(text, ',');
            if (!values || (values->size() != 1 && values->size() != 3) || !all_in(*values, allowed_gamma))
                refuse("--gamma", text, "a number from 0.1 to 10 is allowed, or three like 2.2,2.2,2.4");
            render.gamma = values->size() == 1 ? glm::dvec3(values->front())
                                               : glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
        });
    std::string names;
    for (const auto& known : rgb_spaces) names += (names.empty() ? "" : ", ") + std::string(known.name);
    add(app, "--primaries", "NAME|x,y,...",
        "Primaries and white of the display: " + names + ", or x,y of red, green, blue and white",
        [&render, names](const std::string& text) {
            const auto space = parse_primaries(text);
            if (!space)
                refuse("--primaries", text,
                       "allowed: " + names +
                           ", or eight numbers xr,yr,xg,yg,xb,yb,xw,yw with the white inside the "
                           "triangle of the others");
            render.primaries = *space;
        });
    add(app, "--white-luminance", "X", "Luminance of the display's white in cd/m2, 1 to 1e5, for tumblin_rushmeier",
        [&render](const std::string& text) {
            const auto value = number_from_text(text);
            if (!value || !allowed_white_luminance.contains(*value))
                refuse("--white-luminance", text, fmt::format("a number {} is allowed", allowed_white_luminance.text));
            render.white_luminance = *value;
        });
    add(app, "--mark", "clipped|gamut",
        "Stripes over pixels that are brighter, or more saturated, than the display; clipped,gamut: both",
        [&render](const std::string& text) {
            render.mark_clipped = text == "clipped" || text == "clipped,gamut" || text == "gamut,clipped";
            render.mark_out_of_gamut = text == "gamut" || text == "clipped,gamut" || text == "gamut,clipped";
            if (!render.mark_clipped && !render.mark_out_of_gamut)
                refuse("--mark", text, "allowed: clipped, gamut, or clipped,gamut");
        });
}

void add_false_colour_options(CLI::App& app, RenderCommand& render) {
    FalseColourOverrides& colours = render.false_colour;
    add(app, "--false-colour", "LOW:HIGH|auto",
        "Show --quantity luminance or illuminance in false colours over this range in cd/m2 or lx; auto: that of the "
        "scene",
        [&colours](const std::string& text) {
            colours.on = true;
            colours.automatic = text == "auto";
            if (colours.automatic) return;
            const auto ends = numbers_from_text(text, ':');
            if (!ends || ends->size() != 2 || !all_in(*ends, allowed_scale_end) || !((*ends)[0] < (*ends)[1]))
                refuse("--false-colour", text,
                       fmt::format("auto or LOW:HIGH is allowed, {}, the lower first, like 10:1000",
                                   allowed_scale_end.text));
            colours.range = {(*ends)[0], (*ends)[1]};
        });
    add(app, "--scale", "log|linear", "Of the false colours", [&colours](const std::string& text) {
        if (text != "log" && text != "linear") refuse("--scale", text, "allowed: log, linear");
        colours.logarithmic = text == "log";
    });
    add(app, "--isolux", "X,Y,...|auto|none",
        "Contours over the false colours at these levels in lx (cd/m2 with luminance), at most 16; auto: at round "
        "numbers",
        [&colours](const std::string& text) {
            colours.no_isolines = text == "none";
            if (colours.no_isolines) return;
            const auto levels = text == "auto" ? std::vector<double>{} : numbers_from_text(text, ',');
            if (!levels || levels->size() > most_isolines || !all_in(*levels, allowed_scale_end))
                refuse("--isolux", text,
                       fmt::format("auto, none, or at most {} numbers {} are allowed, like 100,200,500", most_isolines,
                                   allowed_scale_end.text));
            colours.levels = *levels;
        });
}

void check_display_options(const CLI::App& app, const RenderCommand& render) {
    const auto given = [&](const char* name) { return app.count(name) > 0; };
    const auto refuse_all = [&](std::initializer_list<const char*> names, const std::string& why) {
        for (const char* name : names)
            if (given(name)) throw CLI::ValidationError(name, why);
    };
    const std::string file = render.output.filename().string();
    if (is_radiance_image_name(render.output))
        refuse_all({"--gamma", "--max-display", "--clip", "--curve", "--operator", "--adaptation", "--primaries",
                    "--white-luminance", "--mark", "--false-colour", "--scale", "--isolux", "--bits"},
                   fmt::format("does nothing in {}, which holds radiance; use it with .png, .jpg or .tif", file));
    if (render.bits == 16 && is_jpeg_name(render.output))
        throw CLI::ValidationError("--bits", fmt::format("16 is not possible in {}; use it with .png or .tif", file));
    if (render.gamma && render.curve == TransferCurve::srgb)
        throw CLI::ValidationError("--gamma", "does nothing with --curve srgb; use it with --curve gamma or alone");
    if (render.false_colour.on) {
        if (render.quantity == PictureQuantity::colour)
            throw CLI::ValidationError("--false-colour",
                                       "needs --quantity luminance, illuminance, colour_difference or error");
        refuse_all({"--gamma", "--max-display", "--clip", "--curve", "--operator", "--adaptation", "--primaries",
                    "--white-luminance", "--mark"},
                   "does nothing with --false-colour, which has a scale of its own");
    } else {
        refuse_all({"--scale", "--isolux"}, "does nothing without --false-colour");
    }
    if (render.quantity == PictureQuantity::colour_difference)
        refuse_all({"--scale", "--isolux"},
                   "does nothing with --quantity colour_difference, whose scale is the same for all");
    if (render.quantity == PictureQuantity::error)
        refuse_all({"--scale", "--isolux"}, "does nothing with --quantity error, whose scale is the same for all");
    if (render.quantity == PictureQuantity::illuminance && render.max_display_rule == MaxDisplayRule::lecture)
        throw CLI::ValidationError("--max-display",
                                   "lecture is a luminance; illuminance takes a number of lx, auto or pNN");
    if (render.tone_operator && *render.tone_operator != ToneOperator::tumblin_rushmeier)
        refuse_all({"--adaptation", "--white-luminance"}, "does nothing without --operator tumblin_rushmeier");
}

} // namespace lueur
