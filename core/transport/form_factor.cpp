#include "core/transport/form_factor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/transport/form_factor_exact.h"
#include "core/transport/form_factor_methods.h"

namespace lueur {

namespace {

// Opaque where the segment goes through it between its ends.
bool blocks(const PlanarPolygon& polygon, glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 d = to - from;
    const double across = glm::dot(polygon.normal, d), away = glm::dot(polygon.normal, polygon.corners[0] - from);
    if (across == 0) return false;
    const double t = away / across;
    if (!(t > 1e-12) || !(t < 1 - 1e-12)) return false;
    const std::size_t n = polygon.corners.size();
    const double side = across > 0 ? 1 : -1;
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 plane =
            glm::cross(polygon.corners[k] - from, polygon.corners[(k + 1) % n] - polygon.corners[k]);
        if (side * glm::dot(plane, d) < 0) return false;
    }
    return true;
}

// A ray of the scene starts a little in front of the one surface and ends a little in front of the other.
bool is_visible_in(const World& world, glm::dvec3 from, glm::dvec3 from_normal, glm::dvec3 to, glm::dvec3 to_normal) {
    const auto lift = static_cast<double>(world.epsilon());
    const glm::dvec3 start = from + lift * from_normal, direction = to + lift * to_normal - start;
    return !world.occluded({glm::vec3(start), glm::vec3(direction), 0, 1});
}

// Whether the boxes meet.
bool meet(const glm::dvec3& low, const glm::dvec3& high, const PlanarPolygon& polygon) {
    glm::dvec3 l(std::numeric_limits<double>::max()), h(-l);
    for (const glm::dvec3& p : polygon.corners) l = glm::min(l, p), h = glm::max(h, p);
    return glm::all(glm::lessThanEqual(low, h)) && glm::all(glm::lessThanEqual(l, high));
}

MethodEstimate by_method(const PolygonPair& pair, FormFactorMethod method, const FormFactorSettings& settings) {
    switch (method) {
    case FormFactorMethod::automatic: // chosen before
    case FormFactorMethod::analytic:
        return analytic(pair, settings);
    case FormFactorMethod::point_to_disk:
        return point_to_disk(pair, settings);
    case FormFactorMethod::area_sampled:
        return area_sampled(pair, settings);
    case FormFactorMethod::monte_carlo:
        return monte_carlo(pair, settings);
    case FormFactorMethod::hemicube:
        return hemicube(pair, settings);
    case FormFactorMethod::hemisphere:
        return hemisphere(pair, settings);
    }
    return {};
}

FormFactorMethod chosen_for(const PolygonPair& pair) {
    if (!pair.occluders.world && pair.occluders.polygons.size() <= most_exact_occluders)
        return FormFactorMethod::analytic;
    // Shadow rays are needed anyway; from a few elements they are enough where these are small for the distance.
    FormFactorSettings settings;
    settings.samples = 4;
    return region_warning(pair, FormFactorMethod::area_sampled, settings).empty() ? FormFactorMethod::area_sampled
                                                                                  : FormFactorMethod::analytic;
}

} // namespace

bool is_visible(const PolygonPair& pair, glm::dvec3 on_from, glm::dvec3 on_to) {
    for (const PlanarPolygon& polygon : pair.occluders.polygons)
        if (blocks(polygon, on_from, on_to)) return false;
    return !pair.occluders.world ||
           is_visible_in(*pair.occluders.world, on_from, pair.from.normal, on_to, pair.to.normal);
}

PolygonPair facing_pair(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders) {
    PolygonPair pair{in_front_of(from, to), in_front_of(to, from), 0, {{}, occluders.world}};
    if (!pair.faces()) return pair;
    pair.share = pair.from.area / from.area;
    glm::dvec3 low = pair.from.corners[0], high = low;
    for (const PlanarPolygon* polygon : {&pair.from, &pair.to})
        for (const glm::dvec3& p : polygon->corners) low = glm::min(low, p), high = glm::max(high, p);
    for (const PlanarPolygon& occluder : occluders.polygons) {
        if (!meet(low, high, occluder)) continue;
        // Only what lies in front of both, and not in the plane of one, hides anything.
        if (in_front_of(in_front_of(occluder, pair.from), pair.to).area > 0)
            pair.occluders.polygons.push_back(occluder);
    }
    return pair;
}

FormFactorSettings complete(FormFactorMethod method, FormFactorSettings settings) {
    int samples = 1;
    switch (method) {
    case FormFactorMethod::automatic:
    case FormFactorMethod::analytic:
        samples = 20000; // elements of the quadrature behind occluders, or shadow rays
        break;
    case FormFactorMethod::point_to_disk:
    case FormFactorMethod::area_sampled:
    case FormFactorMethod::hemicube:
    case FormFactorMethod::hemisphere:
        samples = 16;
        break;
    case FormFactorMethod::monte_carlo:
        samples = 4096;
        break;
    }
    if (settings.samples <= 0) settings.samples = samples;
    if (settings.resolution <= 0) settings.resolution = method == FormFactorMethod::hemicube ? 128 : 64;
    return settings;
}

FormFactorMethod chosen_method(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders) {
    return chosen_for(facing_pair(from, to, occluders));
}

FormFactorEstimate form_factor(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders,
                               FormFactorMethod method, const FormFactorSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    FormFactorEstimate result;
    const PolygonPair pair = facing_pair(from, to, occluders);
    result.method = method == FormFactorMethod::automatic ? chosen_for(pair) : method;
    if (pair.faces()) {
        const FormFactorSettings completed = complete(result.method, settings);
        const MethodEstimate found = by_method(pair, result.method, completed);
        result.value = std::isfinite(found.value) ? pair.share * found.value : 0;
        result.standard_error = found.error < 0 ? -1 : pair.share * found.error;
        result.cost = found.cost;
        result.warning = region_warning(pair, result.method, completed);
        if (result.warning.empty() && result.method == FormFactorMethod::analytic && !pair.may_be_occluded() &&
            result.standard_error > 1e-6 * result.value)
            result.warning = "so flat or so far apart that rounding leaves less than six digits";
        if (result.warning.empty() && result.value <= 0 && result.standard_error > 0)
            result.warning = fmt::format("nothing was seen of the patch: up to {:.1g} is possible", result.standard_error);
        else if (result.warning.empty() && result.standard_error > 0.2 * result.value)
            result.warning =
                fmt::format("its own error estimate is {:.0f} % of the value: more samples or analytic are needed",
                            100 * result.standard_error / result.value);
    } else {
        result.standard_error = 0; // exactly 0: one is behind the other, or both lie in one plane
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace lueur
