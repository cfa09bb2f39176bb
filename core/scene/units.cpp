#include "core/scene/units.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace lueur {

namespace {

// Metres as a fraction of whole numbers: 278 mm is read as 278 / 1000, the double nearest to 0.278, just as a file in
// metres would have it, which 278 * 0.001 is not. Foot and inch are the international ones (1959).
struct Fraction {
    double numerator, denominator;
};

Fraction metre_fraction(LengthUnit unit) {
    switch (unit) {
    case LengthUnit::metre:
        return {1, 1};
    case LengthUnit::centimetre:
        return {1, 100};
    case LengthUnit::millimetre:
        return {1, 1000};
    case LengthUnit::foot:
        return {3048, 10000};
    case LengthUnit::inch:
        return {254, 10000};
    }
    return {1, 1};
}

double unrounded_length(double metres, LengthUnit unit) {
    const Fraction fraction = metre_fraction(unit);
    return metres * fraction.denominator / fraction.numerator;
}

// The shortest decimal that is read as exactly these metres, if there is one.
std::optional<double> shortest_length(double metres, LengthUnit unit) {
    const double nearest = unrounded_length(metres, unit);
    for (int digits = 1; digits <= 17; ++digits) {
        char text[40];
        const auto [end, error] =
            std::to_chars(text, text + sizeof text, nearest, std::chars_format::scientific, digits - 1);
        double candidate = nearest;
        std::from_chars(text, end, candidate);
        if (metres_from_length(candidate, unit) == metres) return candidate;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double candidate : {std::nextafter(nearest, infinity), std::nextafter(nearest, -infinity)})
        if (metres_from_length(candidate, unit) == metres) return candidate;
    return {};
}

} // namespace

double metres_per(LengthUnit unit) {
    const Fraction fraction = metre_fraction(unit);
    return fraction.numerator / fraction.denominator;
}

double metres_from_length(double length, LengthUnit unit) {
    const Fraction fraction = metre_fraction(unit);
    return length * fraction.numerator / fraction.denominator;
}

double length_from_metres(double metres, LengthUnit unit) {
    const double nearest = unrounded_length(metres, unit);
    if (unit == LengthUnit::metre || !std::isfinite(nearest)) return nearest;
    if (const auto exact = shortest_length(metres, unit)) return *exact;
    // Feet and inches do not reach every number of metres: the neighbour that they reach stands for it, from the first
    // save on.
    return shortest_length(metres_from_length(nearest, unit), unit).value_or(nearest);
}

glm::dvec3 world_from_file(const glm::dvec3& point, LengthUnit unit, UpAxis up) {
    const glm::dvec3 p{metres_from_length(point.x, unit), metres_from_length(point.y, unit),
                       metres_from_length(point.z, unit)};
    switch (up) {
    case UpAxis::y:
        return p;
    case UpAxis::z:
        return {p.x, p.z, -p.y};
    }
    return p;
}

glm::dvec3 file_from_world(const glm::dvec3& point, LengthUnit unit, UpAxis up) {
    const glm::dvec3 p{length_from_metres(point.x, unit), length_from_metres(point.y, unit),
                       length_from_metres(point.z, unit)};
    switch (up) {
    case UpAxis::y:
        return p;
    case UpAxis::z:
        return {p.x, -p.z, p.y};
    }
    return p;
}

std::string to_string(LengthUnit unit) {
    switch (unit) {
    case LengthUnit::metre:
        return "metre";
    case LengthUnit::centimetre:
        return "centimetre";
    case LengthUnit::millimetre:
        return "millimetre";
    case LengthUnit::foot:
        return "foot";
    case LengthUnit::inch:
        return "inch";
    }
    return {};
}

std::string to_string(UpAxis up) {
    switch (up) {
    case UpAxis::y:
        return "y";
    case UpAxis::z:
        return "z";
    }
    return {};
}

} // namespace lueur
