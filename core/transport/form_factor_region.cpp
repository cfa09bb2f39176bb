// Where each method of form factors is to be trusted.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/transport/form_factor_methods.h"

namespace lueur {

namespace {

double element_size(const PlanarPolygon& polygon, int count) {
    double most = 0;
    const int few = std::min(count, 256); // of more, all are alike
    for (const SubElement& element : sub_elements(polygon, few)) most = std::max(most, element.size);
    return most * std::sqrt(double(few) / count);
}

double narrowest(const PolygonPair& pair) {
    double least = std::numeric_limits<double>::max();
    for (const PlanarPolygon& occluder : pair.occluders.polygons) least = std::min(least, width(occluder));
    return least;
}

// Seen from the middle of `from`: the lesser angular width of `to`, foreshortened, about; rad.
double angular_width(const PlanarPolygon& from, const PlanarPolygon& to) {
    const glm::dvec3 d = centre(to) - centre(from);
    const double r = glm::length(d), facing = std::abs(glm::dot(d, to.normal)) / r, across = width(to),
                 along = to.area / across;
    return std::min({across, along, std::max(across * facing, to.area * facing / along)}) / r;
}

// The pixels of a hemicube are 2 / resolution at distance 1, the cells of a hemisphere as large on average.
double pixel_width(FormFactorMethod method, int resolution) {
    return (method == FormFactorMethod::hemicube ? 2 : std::sqrt(2 * std::numbers::pi)) / resolution;
}

constexpr double pixels_enough = 2; // across what is seen

std::string near_elements(const PolygonPair& pair, int count, double apart, bool of_both) {
    const double size = of_both ? std::max(element_size(pair.from, count), element_size(pair.to, count))
                                : element_size(pair.from, count);
    if (apart >= size) return {};
    const int enough =
        apart > 0 ? static_cast<int>(std::min(1e6, std::ceil(count * size * size / (apart * apart)))) : 0;
    const std::string what = apart <= 1e-9 * size
                                 ? std::string("the patches touch")
                                 : fmt::format("the patches are {:.2g} of a sub-element apart", apart / size);
    if (enough > 0 && enough <= 4096) return fmt::format("{}: {} samples or analytic are needed", what, enough);
    return what + ": analytic is needed";
}

std::string below_pixels(const PolygonPair& pair, double pixel, int needed_resolution_at) {
    const double seen = angular_width(pair.from, pair.to);
    if (seen >= pixels_enough * pixel) return {};
    const double enough = std::ceil(needed_resolution_at * pixels_enough * pixel / seen);
    if (enough > 4096)
        return fmt::format("the patch is {:.2g} pixels wide and may be missed: analytic is needed", seen / pixel);
    return fmt::format("the patch is {:.2g} pixels wide and may be missed: resolution {:.0f} is needed", seen / pixel,
                       enough);
}

} // namespace

bool is_below_pixels(const PlanarPolygon& from, const PlanarPolygon& to, FormFactorMethod method, int resolution) {
    return angular_width(from, to) < pixels_enough * pixel_width(method, resolution);
}

std::string region_warning(const PolygonPair& pair, FormFactorMethod method, const FormFactorSettings& settings) {
    if (!pair.faces()) return {};
    const double apart = distance(pair.from, pair.to);
    const double size = std::max(radius(pair.from), radius(pair.to));
    const auto thin = [&](double spacing, const char* what) {
        const double bar = narrowest(pair);
        if (bar >= spacing) return std::string();
        return fmt::format("an occluder is {:.2g} of the distance between {} wide: its shadow is noise", bar / spacing,
                           what);
    };
    const auto first_of = [](std::string one, std::string other) { return one.empty() ? other : one; };
    switch (method) {
    case FormFactorMethod::automatic:
        return {};
    case FormFactorMethod::analytic:
        if (pair.occluders.polygons.size() <= most_exact_occluders) return {};
        return thin(2 * size / std::sqrt(settings.samples), "shadow rays");
    case FormFactorMethod::point_to_disk:
        return first_of(near_elements(pair, settings.samples, apart, true),
                        thin(2 * size / settings.samples, "shadow rays"));
    case FormFactorMethod::area_sampled:
        return first_of(near_elements(pair, settings.samples, apart, false),
                        thin(2 * size / settings.samples, "shadow rays"));
    case FormFactorMethod::monte_carlo: {
        // The largest that one pair of points can add to the sum.
        const double share = pair.to.area / (std::numbers::pi * settings.samples);
        if (apart * apart * 0.1 * std::min(1.0, pair.to.area / pair.from.area) < share)
            return apart <= 1e-9 * size
                       ? "the patches touch: the variance is infinite; analytic is needed"
                       : "the patches are so near that one pair of points may outweigh all others: analytic is needed";
        return thin(2 * size / std::sqrt(settings.samples), "shadow rays");
    }
    case FormFactorMethod::hemicube:
    case FormFactorMethod::hemisphere: {
        const double pixel = pixel_width(method, settings.resolution);
        return first_of(first_of(near_elements(pair, settings.samples, apart, false),
                                 below_pixels(pair, pixel, settings.resolution)),
                        thin(pixel * glm::length(centre(pair.to) - centre(pair.from)) / 2, "pixels"));
    }
    }
    return {};
}

} // namespace lueur
