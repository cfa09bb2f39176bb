// Form factors by points on both patches: sub-elements, disks, random pairs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/form_factor_exact.h"
#include "core/transport/form_factor_methods.h"

namespace lueur {

namespace {

using std::numbers::pi;

// cos cos / (pi r^2 + disk), the cosines above 0 one by one: the product of two negative ones is positive too.
double disk_kernel(const PolygonPair& pair, glm::dvec3 x, glm::dvec3 y, double disk) {
    const glm::dvec3 d = y - x;
    const double from = glm::dot(d, pair.from.normal), to = -glm::dot(d, pair.to.normal), r2 = glm::dot(d, d);
    if (!(from > 0) || !(to > 0)) return 0;
    return from * to / (r2 * (pi * r2 + disk));
}

// How much the sampled share k of n may be off, all or nothing included (Agresti & Coull 1998).
double share_variance(double share, double n) {
    const double p = (share * n + 0.5) / (n + 1);
    return p * (1 - p) / n;
}

struct ElementSum {
    double value = 0, error = 0;
    std::uint64_t cost = 0;
    // Of each sub-element of i, for the uncertainty of the shadows.
    struct Part {
        double whole, share, targets; // weight F without occluders, visible share, how many points it was taken from
    };
    std::vector<Part> parts;
};

// A shadow's edge goes through sub-elements of j (its share is a sample) and lies between those of i (the shares are).
// The rays of a regular grid meet an occluder together or not at all: the former do not average out over i.
double shadow_error(const ElementSum& sum) {
    double whole = 0, seen = 0, along = 0, between = 0;
    for (const auto& part : sum.parts) {
        whole += part.whole;
        seen += part.whole * part.share;
    }
    if (!(whole > 0)) return 0;
    for (const auto& part : sum.parts) {
        const double deviation = part.whole * (part.share - seen / whole);
        along += part.whole * std::sqrt(share_variance(part.share, part.targets));
        between += deviation * deviation;
    }
    return std::sqrt(along * along + between);
}

MethodEstimate estimate_of(const PolygonPair& pair, const ElementSum& sum) {
    const double shadows = pair.may_be_occluded() ? shadow_error(sum) : 0;
    return {sum.value, sum.error + shadows + 1e-15, sum.cost};
}

// Where elements of i are larger than the patches are apart, one of them more or less beside j is a step of all that it
// can see of j; i as a whole sees no more than all that j sees.
double element_step(const PolygonPair& pair, const std::vector<SubElement>& elements) {
    double size = 0;
    for (const SubElement& element : elements) size = std::max(size, element.size);
    const double apart = distance(pair.from, pair.to);
    if (!(apart < size)) return 0;
    const double most = std::min(1.0, pair.to.area / (pi * std::max(apart * apart, 1e-300)));
    return (1 - apart / size) * std::min(most / static_cast<double>(elements.size()), pair.to.area / pair.from.area);
}

} // namespace

// F = 1/A_i sum_q dA_i^q sum_p dA_j^p cos cos / (pi r^2 + dA_j^p) h: Wallace, Elmquist & Haines 1989, eq. 5, averaged
// over sub-elements of i. Exact for a disk on the axis. Its error is told by Lambert's formula at the same points, and
// between them by the size of the elements.
MethodEstimate point_to_disk(const PolygonPair& pair, const FormFactorSettings& settings) {
    ElementSum sum;
    const auto receivers = sub_elements(pair.from, settings.samples),
               shooters = sub_elements(pair.to, settings.samples);
    for (const SubElement& i : receivers) {
        if (settings.is_cancelled()) break;
        double all = 0, seen = 0, between = 0;
        for (const SubElement& j : shooters) {
            ++sum.cost;
            const double disk = j.area * disk_kernel(pair, i.centre, j.centre, j.area);
            const glm::dvec3 d = j.centre - i.centre;
            all += disk;
            between += disk * std::min(1.0, i.size * i.size / (2 * pi * glm::dot(d, d)));
            if (disk > 0 && is_visible(pair, i.centre, j.centre)) seen += disk;
        }
        const double weight = i.area / pair.from.area;
        const double exact = std::max(0.0, lambert_sum(i.centre, pair.from.normal, pair.to.corners).value);
        sum.value += weight * seen;
        sum.error += weight * (between + std::abs(all - exact));
        sum.parts.push_back({weight * all, all > 0 ? seen / all : 1, static_cast<double>(shooters.size())});
    }
    sum.error = std::max(sum.error, element_step(pair, receivers));
    return estimate_of(pair, sum);
}

// F = 1/A_i sum_q F_dAi,j dA_i^q with Lambert's exact F_dAi,j. The error from its values at the corners of each
// sub-element: the rule of the middle and that of the corners err to opposite sides.
MethodEstimate area_sampled(const PolygonPair& pair, const FormFactorSettings& settings) {
    ElementSum sum;
    const auto receivers = sub_elements(pair.from, settings.samples), targets = sub_elements(pair.to, settings.samples);
    const auto lambert = [&](glm::dvec3 point) {
        ++sum.cost;
        return std::clamp(lambert_sum(point, pair.from.normal, pair.to.corners).value, 0.0, 1.0);
    };
    for (const SubElement& i : receivers) {
        if (settings.is_cancelled()) break;
        const double middle = lambert(i.centre), weight = i.area / pair.from.area;
        double corners = 0;
        for (const glm::dvec3& corner : i.corners) corners += lambert(corner);
        sum.error += weight * std::abs(corners / static_cast<double>(i.corners.size()) - middle);
        double share = 1;
        if (pair.may_be_occluded() && middle > 0) {
            double all = 0, seen = 0;
            for (const SubElement& j : targets) {
                ++sum.cost;
                const double disk = j.area * disk_kernel(pair, i.centre, j.centre, j.area);
                all += disk;
                if (disk > 0 && is_visible(pair, i.centre, j.centre)) seen += disk;
            }
            share = all > 0 ? seen / all : 1;
        }
        sum.value += weight * middle * share;
        sum.parts.push_back({weight * middle, share, static_cast<double>(targets.size())});
    }
    sum.error = std::max(sum.error, element_step(pair, receivers));
    return estimate_of(pair, sum);
}

// The lecture's pseudo code, with 1/n and with each cosine tested, and without its + A_j/n below the fraction: that
// only hides by a bias of 1/n that patches with a common edge have no finite variance.
MethodEstimate monte_carlo(const PolygonPair& pair, const FormFactorSettings& settings) {
    RandomStream random(settings.seed, 0);
    double sum = 0, squares = 0, most = 0;
    for (int k = 0; k < settings.samples; ++k) {
        if (k % 4096 == 0 && settings.is_cancelled()) break;
        const glm::dvec3 x = polygon_point(pair.from, random.next2()), y = polygon_point(pair.to, random.next2());
        double f = pair.to.area * disk_kernel(pair, x, y, 0);
        if (f > 0 && !is_visible(pair, x, y)) f = 0;
        sum += f;
        squares += f * f;
        most = std::max(most, f);
    }
    const double n = settings.samples, mean = sum / n;
    const double variance = n > 1 ? std::max(0.0, squares - n * mean * mean) / (n - 1) : 0;
    if (n < 2) return {mean, -1, 1};
    // Near a common edge f exceeds K with a probability as K^(-3/2): what lies beyond the largest of n is twice that
    // one's share, and no variance of the sample knows of it. Where f is bounded it is small.
    double beyond = 2 * most / n;
    // And what no pair has found yet: the most that one can add, of all that j can send to i.
    if (const double apart = distance(pair.from, pair.to); apart > 0)
        beyond = std::max(beyond, std::min(pair.to.area / (pi * apart * apart * n), pair.to.area / pair.from.area));
    return {mean, std::sqrt(variance / n) + beyond, static_cast<std::uint64_t>(settings.samples)};
}

MethodEstimate analytic(const PolygonPair& pair, const FormFactorSettings& settings) {
    if (!pair.occluders.world && pair.occluders.polygons.size() <= most_exact_occluders &&
        !pair.occluders.polygons.empty()) {
        const ExactFormFactor exact =
            occluded_form_factor(pair.from, pair.to, pair.occluders.polygons, 1e-6,
                                 static_cast<std::uint64_t>(settings.samples), settings.cancel);
        return {exact.value, exact.bound, exact.evaluations};
    }
    const ExactFormFactor exact = exact_form_factor(pair.from, pair.to);
    MethodEstimate result{exact.value, exact.bound, exact.evaluations};
    if (!pair.may_be_occluded() || !(exact.value > 0)) return result;
    // The visible share, weighted as the pairs of points count: independent sets of an additive recurrence in four
    // dimensions (Roberts 2018). The disk below keeps pairs at a common edge from outweighing all others.
    const int sets = settings.samples >= 16 ? 4 : 1, each = std::max(1, settings.samples / sets);
    const double disk = pair.to.area / each;
    double all = 0, seen = 0;
    std::vector<double> shares;
    for (int set = 0; set < sets; ++set) {
        RandomStream random(settings.seed, static_cast<std::uint64_t>(set));
        const glm::dvec4 offset(random.next2(), random.next2());
        double set_all = 0, set_seen = 0;
        for (int k = 0; k < each; ++k) {
            if (k % 4096 == 0 && settings.is_cancelled()) break;
            constexpr double g = 1.0 / 1.1673039782614187;
            const glm::dvec4 p = offset + (k + 0.5) * glm::dvec4(g, g * g, g * g * g, g * g * g * g);
            const glm::dvec4 u = p - glm::floor(p);
            const glm::dvec3 x = polygon_point(pair.from, {u.x, u.y}), y = polygon_point(pair.to, {u.z, u.w});
            const double f = disk_kernel(pair, x, y, disk);
            set_all += f;
            if (f > 0 && is_visible(pair, x, y)) set_seen += f;
        }
        result.cost += static_cast<std::uint64_t>(each);
        all += set_all;
        seen += set_seen;
        shares.push_back(set_all > 0 ? set_seen / set_all : 1);
    }
    const double share = all > 0 ? seen / all : 1;
    result.value *= share;
    if (sets == 1) {
        result.error = -1;
        return result;
    }
    double spread = 0;
    for (const double one : shares) spread += (one - share) * (one - share);
    result.error += exact.value * (std::sqrt(spread / (sets * (sets - 1))) + 1.0 / (sets * each));
    return result;
}

} // namespace lueur
