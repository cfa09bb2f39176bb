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
    double value = 0, shadow_variance = 0;
    std::uint64_t cost = 0;
};

ElementSum disk_sum(const PolygonPair& pair, int count) {
    ElementSum sum;
    const auto shooters = sub_elements(pair.to, count);
    for (const SubElement& i : sub_elements(pair.from, count)) {
        double all = 0, seen = 0;
        for (const SubElement& j : shooters) {
            ++sum.cost;
            const double disk = j.area * disk_kernel(pair, i.centre, j.centre, j.area);
            all += disk;
            if (disk > 0 && is_visible(pair, i.centre, j.centre)) seen += disk;
        }
        const double weight = i.area / pair.from.area;
        sum.value += weight * seen;
        if (pair.may_be_occluded() && all > 0)
            sum.shadow_variance +=
                weight * weight * all * all * share_variance(seen / all, static_cast<double>(shooters.size()));
    }
    return sum;
}

ElementSum lambert_elements(const PolygonPair& pair, int count) {
    ElementSum sum;
    const auto targets = sub_elements(pair.to, count);
    for (const SubElement& i : sub_elements(pair.from, count)) {
        ++sum.cost;
        const double whole = std::max(0.0, lambert_sum(i.centre, pair.from.normal, pair.to.corners).value);
        const double weight = i.area / pair.from.area;
        double share = 1;
        if (pair.may_be_occluded() && whole > 0) {
            double all = 0, seen = 0;
            for (const SubElement& j : targets) {
                ++sum.cost;
                const double disk = j.area * disk_kernel(pair, i.centre, j.centre, j.area);
                all += disk;
                if (disk > 0 && is_visible(pair, i.centre, j.centre)) seen += disk;
            }
            share = all > 0 ? seen / all : 1;
            sum.shadow_variance +=
                weight * weight * whole * whole * share_variance(share, static_cast<double>(targets.size()));
        }
        sum.value += weight * whole * share;
    }
    return sum;
}

// Against a quarter of the sub-elements: where the error falls at least as the square root of their size does, that
// difference and the shadows' uncertainty are more than a third of it.
template <typename Sum>
MethodEstimate with_coarser(int count, const Sum& sum) {
    const ElementSum fine = sum(count);
    if (count < 4) return {fine.value, -1, fine.cost};
    const ElementSum coarse = sum(count / 4);
    const double difference = fine.value - coarse.value;
    return {fine.value, std::sqrt(difference * difference + fine.shadow_variance) + 1e-15, fine.cost + coarse.cost};
}

} // namespace

// F = 1/A_i sum_q dA_i^q sum_p dA_j^p cos cos / (pi r^2 + dA_j^p) h: Wallace, Elmquist & Haines 1989, eq. 5, averaged
// over sub-elements of i. Exact for a disk on the axis; off by the shape of the element where r^2 < dA_j / pi.
MethodEstimate point_to_disk(const PolygonPair& pair, const FormFactorSettings& settings) {
    return with_coarser(settings.samples, [&](int count) { return disk_sum(pair, count); });
}

// F = 1/A_i sum_q F_dAi,j dA_i^q with Lambert's exact F_dAi,j.
MethodEstimate area_sampled(const PolygonPair& pair, const FormFactorSettings& settings) {
    return with_coarser(settings.samples, [&](int count) { return lambert_elements(pair, count); });
}

// The lecture's pseudo code, with 1/n and with each cosine tested, and without its + A_j/n below the fraction: that
// only hides by a bias of 1/n that patches with a common edge have no finite variance.
MethodEstimate monte_carlo(const PolygonPair& pair, const FormFactorSettings& settings) {
    RandomStream random(settings.seed, 0);
    double sum = 0, squares = 0, most = 0;
    for (int k = 0; k < settings.samples; ++k) {
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
    return {mean, std::sqrt(variance / n) + 2 * most / n, static_cast<std::uint64_t>(settings.samples)};
}

MethodEstimate analytic(const PolygonPair& pair, const FormFactorSettings& settings) {
    if (!pair.occluders.world && pair.occluders.polygons.size() <= most_exact_occluders &&
        !pair.occluders.polygons.empty()) {
        const ExactFormFactor exact = occluded_form_factor(pair.from, pair.to, pair.occluders.polygons, 1e-6,
                                                           static_cast<std::uint64_t>(settings.samples));
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
