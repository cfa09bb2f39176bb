#include "editor/commands/form_factor_options.h"

#include <algorithm>

#include "core/scene/solver_words.h"
#include "core/transport/hemicube.h"
#include "editor/commands/option_text.h"

namespace lueur {

namespace {

constexpr const char* footer =
    R"(CASES.json: {"cases": [{"name", "polygon1": [[x,y,z],...], "polygon2": [...], "occluders": [[[x,y,z],...],...]}]}: planar convex
polygons, each facing the side from which its vertices run counter-clockwise; other keys are ignored.
OUT.json: a list of {"name","method","F12","standard_error","seconds","warning","cost"}, one entry a case and method.
standard_error is null where the method has none; for methods without chance it is a bound. F21 = F12 A1 / A2.
--failures: form_factor_failures.csv, form_factor_failures.svg and form_factor_aliasing.svg in the folder OUT, and the
table on the terminal.)";

std::string method_words() {
    return words_of(all_form_factor_methods) + ", all";
}

std::vector<FormFactorMethod> methods_from(const std::string& text) {
    std::vector<FormFactorMethod> methods;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string word = text.substr(at, end - at);
        at = end + 1;
        if (word == "all") {
            methods.insert(methods.end(), all_form_factor_methods.begin() + 1, all_form_factor_methods.end());
            continue;
        }
        const auto method = from_word(word, all_form_factor_methods);
        if (!method) refuse("--method", word, "allowed: " + method_words() + ", or some of them with commas between");
        methods.push_back(*method);
    }
    return methods;
}

} // namespace

void add_form_factor_command(CLI::App& app, FormFactorsCommand& command) {
    const auto add_file = [&](const std::string& name, const std::string& help, std::filesystem::path& target) {
        return add(app, name, "FILE", help, [name, &target](const std::string& text) {
            if (text.empty()) refuse(name, text, "a file name is needed");
            target = text;
        });
    };
    add_file("CASES", "Pairs of polygons with occluders, JSON", command.cases);
    add_file("-o,--output", "The form factors, JSON; with --failures a folder", command.output)->required();
    app.add_flag("--failures", command.failures,
                 "In the place of CASES: what each method makes of the cases that are hard for it");
    add(app, "--method", "NAME",
        "All (without auto), or: " + words_of(all_form_factor_methods) + "; with commas several",
        [&command](const std::string& text) { command.methods = methods_from(text); });
    add_integer(
        app, "--samples",
        "Sub-elements a patch of point_to_disk and area_sampled (16), pairs of points of monte_carlo (4096), item "
        "buffers of hemicube and hemisphere (16), elements or rays behind occluders of analytic (20000)",
        1, most_form_factor_samples, command.settings.samples);
    add_integer(app, "--resolution",
                "Pixels along an edge of the hemicube (128), square root of the rays of a hemisphere (64)", 1,
                most_hemicube_resolution, command.settings.resolution);
    add_choice(
        app, "--cells", "Cells of the hemisphere (equal)",
        Choices<HemisphereCells, 2>{{{{"equal", HemisphereCells::equal}, {"theta_phi", HemisphereCells::theta_phi}}}},
        command.settings.cells);
    add_integer(app, "--seed", "Seed of the random sequences, 0 to 4294967295 (1)", 0, 4294967295L,
                command.settings.seed);
    app.footer(footer);
}

void check_form_factor_command(const CLI::App& app, FormFactorsCommand& command) {
    if (command.failures) {
        for (const char* name : {"CASES", "--method"})
            if (app.count(name) > 0) throw CLI::ValidationError(name, "does nothing with --failures");
    } else if (command.cases.empty()) {
        throw CLI::ValidationError("CASES", "is needed, or --failures");
    }
}

} // namespace lueur
