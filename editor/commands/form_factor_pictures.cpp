#include "editor/commands/form_factor_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "editor/commands/form_factor_failures.h"
#include "editor/commands/svg_chart.h"

namespace lueur {

namespace {

constexpr FormFactorMethod methods[] = {FormFactorMethod::analytic,     FormFactorMethod::point_to_disk,
                                        FormFactorMethod::area_sampled, FormFactorMethod::monte_carlo,
                                        FormFactorMethod::hemicube,     FormFactorMethod::hemisphere};
constexpr double floor_error = 1e-6, ceiling_error = 3;

std::vector<double> decades(double low, double high, int each) {
    std::vector<double> values;
    const int count = static_cast<int>(std::lround(std::log10(high / low) * each));
    for (int k = 0; k <= count; ++k) values.push_back(low * std::pow(high / low, double(k) / count));
    return values;
}

struct Family {
    const char* title;
    ChartAxis x;
    std::vector<double> values;
    FormFactorCase (*pair)(double);
};

FormFactorCase hinged(double degrees) {
    return hinged_squares(degrees, 1);
}

std::vector<Family> families() {
    std::vector<double> angles{1, 3, 5};
    for (double angle = 10; angle < 180; angle += 10) angles.push_back(angle);
    angles.insert(angles.end(), {175, 177, 179});
    return {
        {"Opposed squares: near and far", {"distance / size", 1e-3, 1e5}, decades(1e-3, 1e5, 2), opposed_squares},
        {"Squares with a common edge", {"angle between them, degrees", 0, 180, true}, angles, hinged},
        {"A small patch above a square", {"size, m, 1 m away", 1e-4, 1}, decades(1e-4, 1, 4), small_above},
        {"Elongated, 1 m wide and 1 m apart", {"length, m", 1, 1000}, decades(1, 1000, 4), opposed_strips},
        {"A bar between opposed squares", {"width of the bar, m of 1 m", 1e-4, 1}, decades(1e-4, 0.7, 4), behind_bar}};
}

std::vector<ChartSeries> series_of_methods() {
    std::vector<ChartSeries> series;
    int colour = 0;
    for (const FormFactorMethod method : methods) series.push_back({to_string(method), colour++});
    return series;
}

std::optional<std::string> failures_svg(const FormFactorSettings& settings, BatchSession& session) {
    Chart chart;
    chart.title = "Form factors: relative error of each method";
    chart.note =
        "Curves of analytic are its stated bound: the others are measured against it. What lies below the axis is "
        "drawn on its edge.";
    chart.series = series_of_methods();
    chart.columns = 3;
    const auto all = families();
    for (std::size_t f = 0; f < all.size(); ++f) {
        const Family& family = all[f];
        ChartPanel panel;
        panel.title = family.title;
        panel.x = family.x;
        panel.y = {"relative error", floor_error, ceiling_error};
        panel.curves.resize(std::size(methods));
        for (std::size_t m = 0; m < std::size(methods); ++m) panel.curves[m].series = m;
        for (std::size_t k = 0; k < family.values.size(); ++k) {
            session.bar().show("pictures",
                               (double(f) + double(k) / double(family.values.size())) / double(all.size() + 1),
                               family.title);
            const FormFactorCase one = family.pair(family.values[k]);
            const TrueFormFactor exact = true_form_factor(one, settings.cancel);
            for (std::size_t m = 0; m < std::size(methods); ++m) {
                const FormFactorEstimate found =
                    form_factor(one.polygon1, one.polygon2, {one.occluders, nullptr}, methods[m], settings);
                if (session.cancel()) return {};
                const double off = methods[m] == FormFactorMethod::analytic ? found.standard_error
                                                                            : std::abs(found.value - exact.value);
                if (exact.value > 0)
                    panel.curves[m].points.push_back(
                        {family.values[k], std::clamp(off / exact.value, floor_error, ceiling_error)});
            }
        }
        chart.panels.push_back(std::move(panel));
    }
    return svg_text(chart);
}

// One item buffer, as the lecture places it: in the middle of a patch that is small for the distance.
std::optional<std::string> aliasing_svg(const FormFactorSettings& given, BatchSession& session) {
    constexpr int resolution = 64; // hemicube pixels are 1/32 m where the patch moves
    constexpr double pixel = 2.0 / resolution;
    Chart chart;
    chart.title = "One item buffer while a patch moves along: form factor found / true";
    chart.note =
        "A square 1 m above an element, under a hemicube of 64 x 64 pixels on top and hemispheres of 4096 rays.";
    chart.columns = 3;
    struct Look {
        const char* name;
        FormFactorMethod method;
        HemisphereCells cells;
    };
    constexpr Look looks[] = {{"hemicube", FormFactorMethod::hemicube, HemisphereCells::equal},
                              {"hemisphere theta_phi", FormFactorMethod::hemisphere, HemisphereCells::theta_phi},
                              {"hemisphere equal", FormFactorMethod::hemisphere, HemisphereCells::equal}};
    for (std::size_t l = 0; l < std::size(looks); ++l) chart.series.push_back({looks[l].name, static_cast<int>(l) + 1});
    const PlanarPolygon element = rectangle_above(0, 0, 0, 1e-3, 1e-3);
    FormFactorCase one{"", *make_planar_polygon({element.corners.rbegin(), element.corners.rend()}), {}, {}};
    for (const double size : {0.5, 1.5, 4.0}) {
        ChartPanel panel;
        panel.title = fmt::format("{:g} pixels wide", size);
        panel.x = {"moved by, pixels", 0, 4, true};
        panel.y = {"form factor / true", 0, size < 1 ? 5.0 : 2.5, true};
        panel.level = 1;
        panel.curves.resize(std::size(looks));
        for (int k = 0; k <= 120; ++k) {
            session.bar().show("pictures", 0.9, "aliasing");
            const double moved = k / 30.0;
            one.polygon2 = rectangle_above((moved + 3.1) * pixel, 2.3 * pixel, 1, size * pixel, size * pixel);
            const TrueFormFactor exact = true_form_factor(one, given.cancel);
            for (std::size_t l = 0; l < std::size(looks); ++l) {
                FormFactorSettings settings = given;
                settings.samples = 1;
                settings.resolution = resolution;
                settings.cells = looks[l].cells;
                const FormFactorEstimate found = form_factor(one.polygon1, one.polygon2, {}, looks[l].method, settings);
                if (session.cancel()) return {};
                panel.curves[l].series = l;
                panel.curves[l].points.push_back({moved, found.value / exact.value});
            }
        }
        chart.panels.push_back(std::move(panel));
    }
    return svg_text(chart);
}

} // namespace

std::optional<FormFactorPictures> form_factor_pictures(const FormFactorSettings& settings, BatchSession& session) {
    auto failures = failures_svg(settings, session);
    if (!failures) return {};
    auto aliasing = aliasing_svg(settings, session);
    if (!aliasing) return {};
    return FormFactorPictures{std::move(*failures), std::move(*aliasing)};
}

} // namespace lueur
