#include "editor/commands/form_factor_cases.h"

#include <nlohmann/json.hpp>

#include "editor/commands/json_place.h"

namespace lueur {

namespace {

using nlohmann::json;
using Steps = std::vector<JsonStep>;

class CaseReader {
public:
    CaseReader(std::string_view text, const std::string& file)
        : text_(text)
        , file_(file) {}

    Diagnostics diagnostics;

    void error(const Steps& steps, std::string_view what) { diagnostics.error(file_, place_of(text_, steps), what); }

    PlanarPolygon polygon(const json& value, Steps steps, const std::string& name) {
        std::vector<glm::dvec3> corners;
        bool good = value.is_array();
        if (!good) error(steps, name + " is not a list; a list of points [x, y, z] is allowed");
        for (std::size_t k = 0; good && k < value.size(); ++k) {
            const json& point = value[k];
            good = point.is_array() && point.size() == 3 && point[0].is_number() && point[1].is_number() &&
                   point[2].is_number();
            if (!good) {
                steps.emplace_back(k);
                error(steps,
                      fmt::format("point {} of {} is not a point; three numbers [x, y, z] are allowed", k + 1, name));
            } else {
                corners.push_back({point[0].get<double>(), point[1].get<double>(), point[2].get<double>()});
            }
        }
        if (!good) return {};
        auto made = make_planar_polygon(std::move(corners));
        if (!made) {
            error(steps, name + " " + made.error());
            return {};
        }
        return *made;
    }

    FormFactorCase one(const json& value, std::size_t n) {
        const Steps here{std::string("cases"), n};
        FormFactorCase result{fmt::format("case {}", n + 1), {}, {}, {}};
        if (!value.is_object()) {
            error(here, "a case is not an object; {\"name\", \"polygon1\", \"polygon2\", \"occluders\"} is allowed");
            return result;
        }
        const auto inside = [&](const std::string& name) {
            Steps steps = here;
            steps.emplace_back(name);
            return steps;
        };
        if (const auto name = value.find("name"); name != value.end()) {
            if (name->is_string())
                result.name = name->get<std::string>();
            else
                error(inside("name"), "name is not a text; a text is allowed");
        }
        for (const auto& [name, target] :
             {std::pair{"polygon1", &result.polygon1}, std::pair{"polygon2", &result.polygon2}}) {
            const auto found = value.find(name);
            if (found == value.end())
                error(here, fmt::format("the case has no {}; a list of points [x, y, z] is needed", name));
            else
                *target = polygon(*found, inside(name), name);
        }
        const auto occluders = value.find("occluders");
        if (occluders == value.end()) return result;
        if (!occluders->is_array()) {
            error(inside("occluders"), "occluders is not a list; a list of polygons is allowed");
            return result;
        }
        for (std::size_t k = 0; k < occluders->size(); ++k) {
            Steps steps = inside("occluders");
            steps.emplace_back(k);
            result.occluders.push_back(polygon((*occluders)[k], std::move(steps), fmt::format("occluder {}", k + 1)));
        }
        return result;
    }

private:
    std::string_view text_;
    const std::string& file_;
};

} // namespace

std::expected<std::vector<FormFactorCase>, std::vector<std::string>> parse_form_factor_cases(std::string_view text,
                                                                                             const std::string& file) {
    CaseReader reader(text, file);
    std::vector<FormFactorCase> cases;
    try {
        const json root = json::parse(text);
        const auto list = root.is_object() ? root.find("cases") : root.end();
        if (!root.is_object() || list == root.end() || !list->is_array())
            reader.error({std::string("cases")}, "there is no list \"cases\"; {\"cases\": [...]} is allowed");
        else
            for (std::size_t n = 0; n < list->size(); ++n) cases.push_back(reader.one((*list)[n], n));
    } catch (const json::parse_error& fault) {
        reader.diagnostics.error(file, place_at(text, fault.byte ? fault.byte - 1 : 0),
                                 "is not JSON here; a JSON file with a list \"cases\" is allowed");
    } catch (const json::exception&) { // a number that no double holds
        reader.diagnostics.error(file, {}, "has a number out of range; numbers to 1e308 are allowed");
    }
    if (!reader.diagnostics.errors.empty()) return std::unexpected(reader.diagnostics.errors);
    return cases;
}

} // namespace lueur
