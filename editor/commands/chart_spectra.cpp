// `lueur chart --of spectra`: colour difference against the number of channels and against solve time.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <map>
#include <ranges>

#include <fmt/format.h>

#include "core/scene/scene_file.h"
#include "core/spectrum/spectrum_library.h"
#include "core/spectrum/wavelengths_plan.h"
#include "editor/asset_path.h"
#include "editor/commands/chart_commands.h"
#include "editor/commands/output_file.h"
#include "editor/commands/svg_chart.h"

namespace lueur {

namespace {

constexpr double colour_target = 0.5; // the default of [solve] colour_error

struct ChartLight {
    std::string name;
    Spectrum spectrum;
};
struct LightGroup {
    const char* name;
    std::vector<const char*> lights; // of the library, or the laser
};
constexpr const char* laser_name = "633 nm line";
const LightGroup light_groups[] = {
    {"smooth light: A, D65", {"A", "D65"}},
    {"mixed: white LED (LED-B3)", {"LED-B3"}},
    {"spiky: FL11, sodium HP1, 633 nm line", {"FL11", "HP1", laser_name}},
};

struct RuleCurve {
    const char* name;
    WavelengthRule rule;
    std::vector<int> counts; // for auto none: its own targets
};
const RuleCurve rule_curves[] = {
    {"folded", WavelengthRule::folded, {2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16}},
    {"uniform", WavelengthRule::uniform, {4, 6, 8, 10, 13, 16, 21, 31, 41, 81}},
    {"gauss", WavelengthRule::gauss, {3, 4, 5, 6, 8, 10, 14, 20}},
    {"meyer", WavelengthRule::meyer, {4, 6, 10}},
    {"rgb", WavelengthRule::rgb, {3}},
    {"auto", WavelengthRule::automatic, {0}},
};

struct Figure { // of one rule and number under one light
    std::size_t group = 0, curve = 0;
    std::string light;
    WavelengthsSpec used;
    int asked = 0; // the rule's number; 0: auto
    int channels = 0;
    ColourPrediction difference;
};

struct Library {
    std::vector<Spectrum> patches;
    std::vector<std::vector<ChartLight>> groups; // as light_groups
};

std::expected<Library, SpectrumErrors> read_library() {
    const auto listed = list_spectrum_library(asset_path("spectra"));
    if (!listed) return std::unexpected(listed.error());
    Library library;
    for (const LibraryEntry& entry : listed->entries) {
        if (listed->groups[entry.group].name != "ColorChecker") continue;
        auto patch = read_library_spectrum(*listed, entry);
        if (!patch) return std::unexpected(patch.error());
        library.patches.push_back(std::move(*patch));
    }
    if (library.patches.empty())
        return std::unexpected(SpectrumErrors{asset_path("spectra").string() + ": there is no group ColorChecker"});
    for (const LightGroup& group : light_groups) {
        auto& lights = library.groups.emplace_back();
        for (const char* name : group.lights) {
            if (name == laser_name) {
                lights.push_back({name, {{632.5, 633, 633.5}, {0, 1, 0}}});
                continue;
            }
            const LibraryEntry* entry = find_entry(*listed, LibraryKind::light, name);
            if (!entry)
                return std::unexpected(
                    SpectrumErrors{fmt::format("{}: there is no light \"{}\"", asset_path("spectra").string(), name)});
            auto light = read_library_spectrum(*listed, *entry);
            if (!light) return std::unexpected(light.error());
            lights.push_back({name, std::move(*light)});
        }
    }
    return library;
}

std::vector<Figure> colour_figures(const Library& library, BatchSession& session) {
    std::vector<Figure> figures;
    std::size_t done = 0, all = 0;
    for (const auto& group : library.groups)
        for (const RuleCurve& curve : rule_curves) all += group.size() * curve.counts.size();
    for (std::size_t g = 0; g < library.groups.size(); ++g)
        for (const ChartLight& light : library.groups[g]) {
            const SpectralContent content{{light.spectrum}, library.patches};
            for (std::size_t c = 0; c < std::size(rule_curves); ++c)
                for (const int count : rule_curves[c].counts) {
                    if (session.cancel()) return {};
                    session.bar().show("colours", double(done++) / double(all),
                                       fmt::format("{} under {}", rule_curves[c].name, light.name));
                    const WavelengthsPlan plan = plan_wavelengths({rule_curves[c].rule, count}, content, colour_target);
                    figures.push_back(
                        {g, c, light.name, plan.wavelengths.spec, count, plan.wavelengths.size(), plan.prediction});
                }
        }
    return figures;
}

// Seconds that a settled scene takes to be solved again from black, on its kept rays, in these channels.
std::expected<double, int> solve_seconds(Solution& solution, const WavelengthsSpec& spec, BatchSession& session) {
    Scene scene = *solution.scene();
    scene.solve.wavelengths = spec;
    const auto shared = std::make_shared<const Scene>(std::move(scene));
    solution.update(shared, SolveFrom::reflectance); // plans: that is not what is timed
    const auto start = std::chrono::steady_clock::now();
    solution.update(shared, SolveFrom::black);
    const BatchSolveResult solved = solve_batch(solution, {}, session.cancel());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (solved.end == SolveEnd::cancelled) return std::unexpected(exit_interrupted);
    if (solved.end == SolveEnd::failed)
        return std::unexpected(session.failed(fmt::format("{}: {}", to_string(spec), solution.status().message)));
    return seconds;
}

using Times = std::map<std::string, double>; // by the rule in words

// The best of several rounds over all rules, for a machine has other things to do now and then.
std::expected<Times, int> solve_times(const std::vector<Figure>& figures, Solution& solution, BatchSession& session) {
    constexpr int rounds = 10;
    std::map<std::string, WavelengthsSpec> rules;
    for (const Figure& figure : figures) rules[to_string(figure.used)] = figure.used;
    Times times;
    std::size_t done = 0;
    for (int round = 0; round < rounds; ++round)
        for (const auto& [name, spec] : rules) {
            session.bar().show("solving", double(done++) / double(rounds * rules.size()), name);
            const auto seconds = solve_seconds(solution, spec, session);
            if (!seconds) return std::unexpected(seconds.error());
            const auto [time, first] = times.try_emplace(name, *seconds);
            if (!first) time->second = std::min(time->second, *seconds);
        }
    return times;
}

// Mean of the means and worst of the worst over the lights of a group, rule by rule, number by number.
struct Summary {
    double x = 0;
    ColourPrediction difference;
    int lights = 0;
};

Chart chart_of(const std::vector<Figure>& figures, const Times& times, const std::string& scene) {
    Chart chart;
    chart.title = "Colour difference of the ColorChecker after up to three bounces";
    chart.note =
        fmt::format("Full lines: mean CIEDE2000; dashed, and open marks: the worst. Dotted: 0.5, the target of auto. "
                    "Below: solve time of {}, from black on kept rays.",
                    scene);
    for (std::size_t c = 0; c < std::size(rule_curves); ++c)
        chart.series.push_back({rule_curves[c].name, static_cast<int>(c), rule_curves[c].counts.size() == 1});
    chart.columns = std::size(light_groups);
    double fastest = std::numeric_limits<double>::infinity(), slowest = 0;
    for (const auto& [rule, seconds] : times) {
        fastest = std::min(fastest, 1e3 * seconds);
        slowest = std::max(slowest, 1e3 * seconds);
    }
    const ChartAxis channels{"channels", 2, 100}, milliseconds{"solve time, ms", 0.9 * fastest, 1.1 * slowest},
        difference{"CIEDE2000", 0.003, 100};
    for (const bool against_time : {false, true})
        for (std::size_t g = 0; g < std::size(light_groups); ++g) {
            ChartPanel panel{
                light_groups[g].name, against_time ? milliseconds : channels, difference, {}, colour_target};
            for (std::size_t c = 0; c < std::size(rule_curves); ++c) {
                std::map<int, Summary> summaries;
                for (const Figure& figure : figures) {
                    if (figure.group != g || figure.curve != c) continue;
                    Summary& summary = summaries[figure.asked];
                    summary.x += against_time ? 1e3 * times.at(to_string(figure.used)) : figure.channels;
                    summary.difference.mean += figure.difference.mean;
                    summary.difference.worst = std::max(summary.difference.worst, figure.difference.worst);
                    ++summary.lights;
                }
                ChartCurve mean{c, {}, false}, worst{c, {}, true};
                for (const auto& [asked, summary] : summaries) {
                    mean.points.emplace_back(summary.x / summary.lights, summary.difference.mean / summary.lights);
                    worst.points.emplace_back(summary.x / summary.lights, summary.difference.worst);
                }
                panel.curves.push_back(std::move(worst));
                panel.curves.push_back(std::move(mean));
            }
            chart.panels.push_back(std::move(panel));
        }
    return chart;
}

std::string csv_text(const std::vector<Figure>& figures, const Times& times) {
    std::string text = "lights,light,rule,wavelengths,channels,mean_de2000,worst_de2000,solve_seconds\n";
    for (const Figure& figure : figures)
        text += fmt::format("\"{}\",{},{},{},{},{:.5g},{:.5g},{:.4g}\n", light_groups[figure.group].name, figure.light,
                            rule_curves[figure.curve].name, to_string(figure.used), figure.channels,
                            figure.difference.mean, figure.difference.worst, times.at(to_string(figure.used)));
    return text;
}

} // namespace

int chart_spectra(const ChartCommand& command, BatchSession& session) {
    const auto scene = chart_scene(command, session);
    const auto library = read_library();
    if (!library)
        for (const auto& fault : library.error()) session.error(fault);
    if (!scene || !library) return exit_mistake;

    std::vector<Figure> figures;
    session.timed("colours", [&] { figures = colour_figures(*library, session); });
    if (session.cancel()) return exit_interrupted;

    scene->solve.solver = SolverKind::gathering; // it keeps its rays: channels are all that differs
    scene->solve.compare_trichromatic = false;
    Solution solution(scene);
    if (const auto solved = session.solve(solution, false); !solved) return solved.error();
    std::expected<Times, int> times;
    session.timed("solving again", [&] { times = solve_times(figures, solution, session); });
    if (!times) return times.error();

    const std::string name = scene->name.empty() ? command.batch.scene.filename().string() : scene->name;
    if (const auto written = write_text(command.output, svg_text(chart_of(figures, *times, name))); !written)
        return session.failed(written.error());
    if (!command.csv.empty())
        if (const auto written = write_text(command.csv, csv_text(figures, *times)); !written)
            return session.failed(written.error());
    session.bar().wipe();
    fmt::print(
        "{}: {} rules and numbers under {} lights; solving takes {:.1f} to {:.1f} ms\n", command.output.string(),
        times->size(),
        std::size(light_groups[0].lights) + std::size(light_groups[1].lights) + std::size(light_groups[2].lights),
        1e3 * std::ranges::min(*times | std::views::values), 1e3 * std::ranges::max(*times | std::views::values));
    return session.finish(solution);
}

} // namespace lueur
