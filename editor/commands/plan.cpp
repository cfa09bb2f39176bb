// `lueur plan`: how many wavelengths a scene needs, and why, and how much memory. Nothing is solved.
#include <chrono>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/scene/scene_file.h"
#include "core/scene/spectral_content.h"
#include "core/solve/channel_field.h"
#include "core/solve/form_factor_matrix.h"
#include "core/solve/memory_plan.h"
#include "core/spectrum/wavelengths_plan.h"
#include "editor/commands/batch_session.h"
#include "editor/commands/output_file.h"

namespace lueur {

namespace {

struct LampPrediction {
    std::string luminaires; // whose spectrum it is
    ColourPrediction prediction;
};

struct RulePrediction {
    std::string rule;
    int channels = 0, lanes = 0;
    ColourPrediction prediction;
};

struct ScenePlan {
    std::size_t triangles = 0, surfaces = 0, luminaires = 0;
    SpectralContent content;
    WavelengthsPlan plan;
    double seconds = 0;
    MemoryPlan memory;
    std::vector<LampPrediction> lamps;
    std::vector<RulePrediction> rules; // the chosen one first
};

constexpr const char* fixed_rules[] = {"meyer:4", "gauss:10", "uniform:31", "uniform:81", "rgb"};

// Solver rows hold whole vector registers: what a sweep reads and adds up.
int lanes_of(int channels) {
    return ChannelField(0, channels).stride;
}

std::string luminaires_with(const Scene& scene, const Spectrum& spectrum) {
    std::string names;
    std::size_t more = 0;
    for (const Luminaire& luminaire : scene.luminaires) {
        if (spectrum_of(luminaire) != spectrum) continue;
        if (names.empty())
            names = luminaire.name;
        else
            ++more;
    }
    return more > 0 ? fmt::format("{} and {} more", names, more) : names;
}

ScenePlan plan_scene(const Scene& scene) {
    ScenePlan plan;
    plan.triangles = scene.geometry->triangles.size();
    plan.surfaces = scene.geometry->surfaces.size();
    plan.luminaires = scene.luminaires.size();
    plan.content = spectral_content(scene);
    const auto start = std::chrono::steady_clock::now();
    plan.plan = plan_wavelengths(scene.solve.wavelengths, plan.content, scene.solve.colour_error);
    plan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    plan.memory = plan_memory(scene, plan.plan.wavelengths.size());
    for (const Spectrum& light : plan.content.lights)
        plan.lamps.push_back({luminaires_with(scene, light),
                              predict_difference(plan.plan.wavelengths, {{light}, plan.content.reflectances})});
    const auto add_rule = [&](const std::string& rule, const Wavelengths& wavelengths,
                              const ColourPrediction& prediction) {
        plan.rules.push_back({rule, wavelengths.size(), lanes_of(wavelengths.size()), prediction});
    };
    const std::string asked = to_string(scene.solve.wavelengths), used = to_string(plan.plan.wavelengths.spec);
    add_rule(asked == used ? asked : fmt::format("{} ({})", asked, used), plan.plan.wavelengths, plan.plan.prediction);
    const SpectralContent lit = with_a_light(plan.content);
    for (const char* rule : fixed_rules) {
        if (rule == asked) continue;
        const Wavelengths wavelengths = make_wavelengths(parse_wavelengths(rule).value(), lit);
        add_rule(rule, wavelengths, predict_difference(wavelengths, lit));
    }
    return plan;
}

std::string wavelength_list(const Wavelengths& wavelengths) {
    const std::size_t count = static_cast<std::size_t>(wavelengths.folded() ? wavelengths.samples : wavelengths.size());
    std::string list;
    for (std::size_t k = 0; k < count; ++k) {
        if (k > 0) list += k % 16 == 0 ? "\n             " : " ";
        list += fmt::format("{:.0f}", wavelengths.nm[k]);
    }
    return list;
}

double relative_cost(const RulePrediction& rule, int channels) {
    return double(rule.lanes) / lanes_of(channels);
}

std::string plan_text(const ScenePlan& plan, const std::filesystem::path& file) {
    const Wavelengths& wavelengths = plan.plan.wavelengths;
    std::string text =
        fmt::format("{}: {} triangles, {} surfaces, {} luminaires with {} different spectra, {} different "
                    "reflectances\n",
                    file.string(), plan.triangles, plan.surfaces, plan.luminaires, plan.content.lights.size(),
                    plan.content.reflectances.size());
    text += fmt::format("channels     {} ({} with padding)\n", wavelengths.size(), lanes_of(wavelengths.size()));
    text += fmt::format("wavelengths  {} nm\n", wavelength_list(wavelengths));
    text += fmt::format("why          {}\n", plan.plan.reason);
    text += fmt::format("planned in   {:.1f} ms\n", 1e3 * plan.seconds);
    const MemoryPlan& m = plan.memory;
    text +=
        fmt::format("mesh         about {} vertices, {} elements; light is computed at {} of them and where it bends\n",
                    m.vertices, m.elements, m.samples);
    text += fmt::format(
        "memory       about {}: program {}, scene {}, mesh {}, world of the rays {}, direct light {}, rows {}, "
        "fields {}\n",
        bytes_text(m.peak()), bytes_text(m.program), bytes_text(m.scene), bytes_text(m.mesh), bytes_text(m.world),
        bytes_text(m.direct), bytes_text(m.rows), bytes_text(m.fields));
    if (plan.content.lights.empty()) text += "No luminaire emits: equal energy is taken in their place.\n";

    std::size_t width = std::string_view("lamp spectrum of").size();
    for (const LampPrediction& lamp : plan.lamps) width = std::max(width, lamp.luminaires.size());
    if (!plan.lamps.empty()) text += fmt::format("\n{:<{}}  mean dE  worst dE\n", "lamp spectrum of", width);
    for (const LampPrediction& lamp : plan.lamps)
        text += fmt::format("{:<{}}  {:7.2f}  {:8.2f}\n", lamp.luminaires, width, lamp.prediction.mean,
                            lamp.prediction.worst);

    width = 4;
    for (const RulePrediction& rule : plan.rules) width = std::max(width, rule.rule.size());
    text += fmt::format("\n{:<{}}  channels  padded  sweep: of uniform:31  of uniform:81  mean dE  worst dE\n", "rule",
                        width);
    for (const RulePrediction& rule : plan.rules)
        text += fmt::format("{:<{}}  {:8}  {:6}  {:18.0f} %  {:11.0f} %  {:7.2f}  {:8.2f}\n", rule.rule, width,
                            rule.channels, rule.lanes, 100 * relative_cost(rule, 31), 100 * relative_cost(rule, 81),
                            rule.prediction.mean, rule.prediction.worst);
    return text;
}

std::string plan_json(const ScenePlan& plan, const PlanCommand& command, const SolveSettings& settings) {
    using Json = nlohmann::ordered_json;
    const auto prediction = [](Json& json, const ColourPrediction& of) {
        json["mean_de2000"] = of.mean;
        json["worst_de2000"] = of.worst;
    };
    Json report;
    report["version"] = LUEUR_VERSION;
    report["command"] = "plan";
    report["scene"] = command.batch.scene.string();
    report["triangles"] = plan.triangles;
    report["surfaces"] = plan.surfaces;
    report["luminaires"] = plan.luminaires;
    report["lamp_spectra"] = plan.content.lights.size();
    report["reflectances"] = plan.content.reflectances.size();
    report["asked"] = to_string(settings.wavelengths);
    report["colour_error"] = settings.colour_error;
    report["planning_seconds"] = plan.seconds;
    report["wavelengths"] = to_string(plan.plan.wavelengths.spec);
    report["reason"] = plan.plan.reason;
    report["channel_nm"] = plan.plan.wavelengths.nm;
    prediction(report, plan.plan.prediction);
    const MemoryPlan& memory = plan.memory;
    report["memory_bytes"] =
        Json{{"peak", memory.peak()}, {"program", memory.program}, {"scene", memory.scene}, {"mesh", memory.mesh},
             {"world", memory.world}, {"direct", memory.direct},   {"rows", memory.rows},   {"fields", memory.fields}};
    report["vertices"] = memory.vertices;
    report["elements"] = memory.elements;
    report["samples"] = memory.samples;
    report["lamps"] = Json::array();
    for (const LampPrediction& lamp : plan.lamps) {
        Json one{{"luminaires", lamp.luminaires}};
        prediction(one, lamp.prediction);
        report["lamps"].push_back(std::move(one));
    }
    report["rules"] = Json::array();
    for (const RulePrediction& rule : plan.rules) {
        Json one{{"rule", rule.rule}, {"channels", rule.channels}, {"padded_channels", rule.lanes}};
        one["sweep_of_uniform_31"] = relative_cost(rule, 31);
        one["sweep_of_uniform_81"] = relative_cost(rule, 81);
        prediction(one, rule.prediction);
        report["rules"].push_back(std::move(one));
    }
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; // names of files need not be UTF-8
}

int plan(const PlanCommand& command, BatchSession& session) {
    const auto scene = session.load();
    if (!scene) return exit_mistake;
    const auto faults = check(*scene);
    for (const auto& fault : faults) session.error(command.batch.scene.string() + ": " + fault);
    if (!faults.empty()) return exit_mistake;
    const ScenePlan planned = plan_scene(*scene);
    if (!command.batch.report.empty())
        if (const auto written = write_text(command.batch.report, plan_json(planned, command, scene->solve)); !written)
            return session.failed(written.error());
    fmt::print("{}", plan_text(planned, command.batch.scene));
    return exit_done;
}

} // namespace

int run(const PlanCommand& command) {
    return run_batch("plan", command.batch, [&](BatchSession& session) { return plan(command, session); });
}

} // namespace lueur
