#include "editor/commands/form_factor_failures.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/transport/form_factor_exact.h"
#include "editor/commands/form_factor_pictures.h"
#include "editor/commands/output_file.h"

namespace lueur {

namespace {

PlanarPolygon polygon(std::vector<glm::dvec3> corners) {
    return make_planar_polygon(std::move(corners)).value();
}

std::string csv_text(std::string_view text) { // a CSV field
    return text.find_first_of(",\"") == text.npos ? std::string(text) : fmt::format("\"{}\"", text);
}

PlanarPolygon floor_rectangle(double across, double along) {
    return polygon({{0, 0, 0}, {across, 0, 0}, {across, along, 0}, {0, along, 0}});
}
PlanarPolygon floor_square(double size) {
    return floor_rectangle(size, size);
}

} // namespace

PlanarPolygon rectangle_above(double x, double y, double height, double across, double along) {
    return polygon({{x, y, height}, {x, y + along, height}, {x + across, y + along, height}, {x + across, y, height}});
}

FormFactorCase opposed_squares(double distance) {
    return {"", floor_square(1), rectangle_above(0, 0, distance, 1, 1), {}};
}

FormFactorCase hinged_squares(double degrees, double size) {
    const double angle = degrees * std::numbers::pi / 180, c = size * std::cos(angle), s = size * std::sin(angle);
    return {"", floor_square(size), polygon({{0, 0, 0}, {0, size, 0}, {c, size, s}, {c, 0, s}}), {}};
}

FormFactorCase opposed_strips(double length) {
    return {"", floor_rectangle(length, 1), rectangle_above(0, 0, 1, length, 1), {}};
}

FormFactorCase behind_bar(double bar) {
    FormFactorCase one = opposed_squares(1);
    one.occluders.push_back(rectangle_above(0.5 - bar / 2, 0, 0.5, bar, 1));
    return one;
}

FormFactorCase small_above(double size) {
    return {"", floor_square(1), rectangle_above(0.5 - size / 2, 0.5 - size / 2, 1, size, size), {}};
}

std::vector<FormFactorCase> hard_form_factor_cases() {
    std::vector<FormFactorCase> cases;
    const auto add = [&](const char* name, FormFactorCase one) {
        one.name = name;
        cases.push_back(std::move(one));
    };
    add("opposed squares, 1 apart (easy)", opposed_squares(1));
    add("common edge, 90 degrees", hinged_squares(90, 1));
    add("common edge, 15 degrees", hinged_squares(15, 1));
    add("common edge, 179 degrees (nearly coplanar)", hinged_squares(179, 1));
    add("common edge, 179.99 degrees", hinged_squares(179.99, 1));
    const FormFactorCase flat = hinged_squares(179.9, 1);
    FormFactorCase apart = flat;
    for (glm::dvec3& p : apart.polygon2.corners) p.x -= 1;
    add("nearly coplanar, 1 apart", apart);
    add("common corner only", {"", floor_square(1), polygon({{0, 0, 0}, {0, 0, 1}, {0, -1, 1}, {0, -1, 0}}), {}});
    add("opposed squares, 0.01 apart", opposed_squares(0.01));
    add("opposed squares, 0.0001 apart", opposed_squares(0.0001));
    add("small: 10 mm seen from 1 m", small_above(0.01));
    add("small: 1 mm seen from 1 m", small_above(0.001));
    add("elongated 100 : 1, 1 apart", opposed_strips(100));
    add("elongated 1000 : 1, 0.1 apart", {"", floor_rectangle(10, 0.01), rectangle_above(0, 0, 0.1, 10, 0.01), {}});
    add("grazing: at 89 degrees from the normal",
        {"", floor_square(1), polygon({{-57, 0, 0}, {-57, 1, 0}, {-57, 1, 2}, {-57, 0, 2}}), {}});
    add("thin bar, 1 mm of 1 m", behind_bar(0.001));
    add("thin bar, 20 mm of 1 m", behind_bar(0.02));
    FormFactorCase slit = opposed_squares(1);
    slit.occluders = {rectangle_above(0, 0, 0.5, 0.495, 1), rectangle_above(0.505, 0, 0.5, 0.495, 1)};
    add("slit, 10 mm of 1 m", slit);
    add("distance 10,000 sizes", opposed_squares(1e4));
    add("distance 1,000,000 sizes", opposed_squares(1e6));
    add("partly behind each other's plane",
        {"", floor_square(1), polygon({{1.4, 0, 0.9}, {1.4, 1, 0.9}, {0.8, 1, -0.3}, {0.8, 0, -0.3}}), {}});
    add("behind the plane", {"", floor_square(1), rectangle_above(0, 0, -1, 1, 1), {}});
    add("millimetres: 1 mm squares, common edge", hinged_squares(90, 1e-3));
    add("kilometres: 1 km squares, common edge", hinged_squares(90, 1e3));
    FormFactorCase tiny{"", floor_square(1000), rectangle_above(500, 500, 1, 1, 1), {}};
    add("areas 1,000,000 : 1, 1 m apart", tiny);
    std::swap(tiny.polygon1, tiny.polygon2);
    add("areas 1 : 1,000,000, 1 m apart", tiny);
    return cases;
}

TrueFormFactor true_form_factor(const FormFactorCase& one, const std::atomic<bool>* cancel) {
    const ExactFormFactor exact =
        one.occluders.empty() ? exact_form_factor(one.polygon1, one.polygon2)
                              : occluded_form_factor(one.polygon1, one.polygon2, one.occluders, 1e-7, 300000, cancel);
    return {exact.value, exact.bound};
}

int write_form_factor_failures(const FormFactorsCommand& command, BatchSession& session) {
    const std::filesystem::path& folder = command.output;
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error)) {
        session.error(
            fmt::format("{}: is not a folder; allowed: an existing folder that may be written to", folder.string()));
        return exit_mistake;
    }
    FormFactorSettings settings = command.settings;
    settings.cancel = &session.cancel();
    const auto cases = hard_form_factor_cases();
    std::string csv = "case,method,true,value,error_percent,bound_percent,cost,milliseconds,warning\n";
    std::string table = fmt::format("{:<48}{:>12}", "relative error (analytic: its bound), * warned", "true F");
    for (const FormFactorMethod method : all_form_factor_methods) table += fmt::format("{:>16}", to_string(method));
    table += '\n';
    for (std::size_t n = 0; n < cases.size(); ++n) {
        const FormFactorCase& one = cases[n];
        const TrueFormFactor exact = true_form_factor(one, settings.cancel);
        const double unit = exact.value > 0 ? exact.value : 1;
        table += fmt::format("{:<48}{:>12.5g}", one.name, exact.value);
        for (const FormFactorMethod method : all_form_factor_methods) {
            session.bar().show("hard cases", double(n) / double(cases.size()), one.name);
            const FormFactorEstimate found =
                form_factor(one.polygon1, one.polygon2, {one.occluders, nullptr}, method, settings);
            if (session.cancel()) return exit_interrupted;
            const double off = std::abs(found.value - exact.value) / unit;
            csv += fmt::format("{},{},{:.12g},{:.12g},{:.3g},{},{},{:.3g},{}\n", csv_text(one.name), to_string(method),
                               exact.value, found.value, 100 * off,
                               found.standard_error < 0 ? "" : fmt::format("{:.3g}", 100 * found.standard_error / unit),
                               found.cost, 1e3 * found.seconds, csv_text(found.warning));
            // The truth is its own value: what is left to tell is how far it may be off.
            const bool itself = found.method == FormFactorMethod::analytic;
            table += fmt::format("{:>15.2g}{}", itself ? std::max(off, found.standard_error / unit) : off,
                                 found.warning.empty() ? ' ' : '*');
        }
        table += '\n';
    }
    const auto pictures = form_factor_pictures(settings, session);
    if (!pictures) return exit_interrupted;
    for (const auto& [name, text] : {std::pair<const char*, const std::string&>{"form_factor_failures.csv", csv},
                                     {"form_factor_failures.svg", pictures->failures},
                                     {"form_factor_aliasing.svg", pictures->aliasing}})
        if (const auto written = write_text(folder / name, text); !written) return session.failed(written.error());
    session.bar().wipe();
    fmt::print("{}", table);
    return exit_done;
}

} // namespace lueur
