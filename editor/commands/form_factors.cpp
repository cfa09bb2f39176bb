// `lueur form-factors`: every method on pairs of polygons with occluders.
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/scene/files.h"
#include "core/scene/solver_words.h"
#include "editor/commands/batch_session.h"
#include "editor/commands/form_factor_cases.h"
#include "editor/commands/form_factor_failures.h"
#include "editor/commands/output_file.h"

namespace lueur {

namespace {

int of_cases(const FormFactorsCommand& command, BatchSession& session) {
    const auto place = check_writable(command.output);
    if (!place) session.error(place.error());
    const auto text = read_bytes(command.cases);
    if (!text) {
        session.error(command.cases.string() + ": " + text.error());
        return exit_mistake;
    }
    const auto cases = parse_form_factor_cases(*text, command.cases.string());
    if (!cases)
        for (const auto& fault : cases.error()) session.error(fault);
    if (!place || !cases) return exit_mistake;

    std::vector<FormFactorMethod> methods = command.methods;
    if (methods.empty()) methods.assign(all_form_factor_methods.begin() + 1, all_form_factor_methods.end());
    FormFactorSettings settings = command.settings;
    settings.cancel = &session.cancel();
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    std::size_t done = 0, warned = 0;
    for (const FormFactorCase& one : *cases)
        for (const FormFactorMethod method : methods) {
            session.bar().show("form factors", double(done++) / double(cases->size() * methods.size()),
                               fmt::format("{} of {}", to_string(method), one.name));
            const FormFactorEstimate found =
                form_factor(one.polygon1, one.polygon2, {one.occluders, nullptr}, method, settings);
            if (session.cancel()) return exit_interrupted;
            nlohmann::ordered_json entry{{"name", one.name}, {"method", to_string(method)}, {"F12", found.value}};
            if (found.standard_error < 0)
                entry["standard_error"] = nullptr;
            else
                entry["standard_error"] = found.standard_error;
            entry["seconds"] = found.seconds;
            entry["warning"] = found.warning;
            entry["cost"] = found.cost;
            if (method == FormFactorMethod::automatic) entry["chosen"] = to_string(found.method);
            warned += !found.warning.empty();
            entries.push_back(std::move(entry));
        }
    const auto written = write_text(
        command.output, entries.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    if (!written) return session.failed(written.error());
    session.bar().wipe();
    fmt::print("{}: {} cases, {} form factors, {} with a warning\n", command.output.string(), cases->size(),
               entries.size(), warned);
    return exit_done;
}

} // namespace

int run(const FormFactorsCommand& command) {
    return run_batch("form-factors", command.batch, [&](BatchSession& session) {
        return command.failures ? write_form_factor_failures(command, session) : of_cases(command, session);
    });
}

} // namespace lueur
