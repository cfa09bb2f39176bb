#include "editor/chart/chart_table.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/scene/solver_words.h"
#include "editor/asset_path.h"
#include "editor/commands/csv.h"
#include "editor/commands/number_text.h"

namespace lueur {

namespace {

enum Column : std::size_t {
    solver,
    form_factors,
    oracle,
    level,
    element_scale,
    target_error,
    samples,
    end,
    reason,
    seconds,
    rms,
    rms_without_noise,
    median,
    p95,
    rms_of_truth,
    points,
    missing,
    estimated_error,
    elements,
    rays,
    reference_paths,
    reference_error,
    columns,
};
constexpr std::array<const char*, columns> names{"solver",
                                                 "form_factors",
                                                 "oracle",
                                                 "level",
                                                 "element_scale",
                                                 "target_error_percent",
                                                 "samples",
                                                 "end",
                                                 "reason",
                                                 "seconds",
                                                 "rms_percent",
                                                 "rms_without_noise_percent",
                                                 "median_percent",
                                                 "p95_percent",
                                                 "rms_of_truth_percent",
                                                 "points",
                                                 "missing",
                                                 "estimated_error_percent",
                                                 "elements",
                                                 "rays",
                                                 "reference_paths",
                                                 "reference_error_percent"};
constexpr const char* milestone = "milestone";

std::string quoted(const std::string& text) {
    std::string safe = "\"";
    for (const char c : text) {
        if (c == '"') safe += '"';
        safe += c == '\n' ? ' ' : c;
    }
    return safe + '"';
}

std::string line_of(const MethodChart& chart, const ChartRun& run, const ChartPoint* point, bool last) {
    const auto percent = [](double share) { return fmt::format("{:.5g}", 100 * share); };
    std::array<std::string, columns> line;
    line[solver] = to_string(run.method.solver);
    line[form_factors] = to_string(run.method.form_factors);
    line[oracle] = has_oracle(run.method.solver) ? to_string(run.method.oracle) : "";
    line[level] = fmt::format("{}", run.level);
    line[element_scale] = fmt::format("{:g}", run.budget.element_scale);
    line[target_error] = percent(run.budget.target_error);
    line[samples] = fmt::format("{}", run.budget.samples);
    line[end] = last ? to_string(run.end) : milestone;
    if (last && !run.reason.empty()) line[reason] = quoted(run.reason);
    line[seconds] = fmt::format("{:.5g}", point ? point->seconds : run.seconds);
    if (point) {
        line[rms] = percent(point->error.rms);
        line[rms_without_noise] = percent(point->error.rms_without_noise);
        line[median] = percent(point->error.median);
        line[p95] = percent(point->error.percentile95);
        line[rms_of_truth] = percent(point->error.rms_of_truth);
        line[points] = fmt::format("{}", point->error.counted);
        line[missing] = fmt::format("{}", point->error.missing);
        line[estimated_error] = percent(point->estimated_error);
    }
    if (last) {
        line[elements] = fmt::format("{}", run.elements);
        line[rays] = fmt::format("{}", run.rays);
    }
    line[reference_paths] = fmt::format("{}", chart.reference_paths);
    line[reference_error] = percent(chart.reference_error);
    return fmt::format("{}\n", fmt::join(line, ","));
}

class TableReader {
public:
    explicit TableReader(const std::string& name)
        : name_(name) {}

    std::expected<MethodChart, std::vector<std::string>> read(std::string_view text) {
        const auto records = parse_csv(text);
        const std::string header = fmt::format("{}", fmt::join(names, ","));
        if (records.empty() || records[0].raw != header)
            return std::unexpected(std::vector{
                fmt::format("{}:1:1: this is no chart of methods; the first line must be \"{}\"", name_, header)});
        for (std::size_t i = 1; i < records.size() && faults_.size() < 20; ++i) read_record(records[i], i + 1);
        if (!faults_.empty()) return std::unexpected(std::move(faults_));
        for (const ChartRun& run : chart_.runs) {
            chart_.seconds += run.seconds;
            for (const ChartPoint& point : run.points)
                chart_.points = std::max(chart_.points, point.error.counted + point.error.missing);
        }
        return std::move(chart_);
    }

private:
    void fault(const CsvField& field, const std::string& what) {
        faults_.push_back(fmt::format("{}:{}:{}: {}", name_, field.line, field.column, what));
    }
    double number(const CsvRecord& record, Column column, double low = 0) {
        const CsvField& field = record.fields[column];
        const auto value = number_from_text(field.text);
        if (value && *value >= low) return *value;
        fault(field, fmt::format("{} is \"{}\"; a number of {} or more is allowed", names[column], field.text, low));
        return low;
    }
    template <typename Enum, std::size_t N>
    Enum word(const CsvRecord& record, Column column, const std::array<Enum, N>& all) {
        const CsvField& field = record.fields[column];
        if (const auto value = from_word(field.text, all)) return *value;
        fault(field, fmt::format("{} is \"{}\"; allowed: {}", names[column], field.text, words_of(all)));
        return all[0];
    }

    void read_record(const CsvRecord& record, std::size_t line) {
        if (record.fault) {
            faults_.push_back(
                fmt::format("{}:{}:{}: {}", name_, record.fault->line, record.fault->column, record.fault->what));
            return;
        }
        if (record.fields.size() != columns) {
            faults_.push_back(fmt::format("{}:{}:1: {} columns; {} are needed", name_, line, record.fields.size(),
                                          static_cast<std::size_t>(columns)));
            return;
        }
        ChartMethod method{word(record, solver, all_solvers), word(record, form_factors, all_form_factor_methods), {}};
        method.oracle = has_oracle(method.solver) ? word(record, oracle, all_oracles) : ChartMethod{}.oracle;
        const ChartBudget budget{number(record, element_scale), 0.01 * number(record, target_error),
                                 static_cast<int>(number(record, samples))};
        const auto run_level = static_cast<std::size_t>(number(record, level));
        if (finished_ || !(chart_.runs.back().method == method) || chart_.runs.back().level != run_level) {
            chart_.runs.emplace_back();
            chart_.runs.back().method = method;
            chart_.runs.back().level = run_level;
            chart_.runs.back().budget = budget;
        }
        ChartRun& run = chart_.runs.back();
        finished_ = record.fields[end].text != milestone;
        const double time = number(record, seconds);
        if (!record.fields[rms].text.empty()) {
            ChartPoint& point = run.points.emplace_back();
            point.seconds = time;
            point.estimated_error = 0.01 * number(record, estimated_error);
            point.error.rms = 0.01 * number(record, rms);
            point.error.rms_without_noise = 0.01 * number(record, rms_without_noise);
            point.error.median = 0.01 * number(record, median);
            point.error.percentile95 = 0.01 * number(record, p95);
            point.error.rms_of_truth = 0.01 * number(record, rms_of_truth);
            point.error.counted = static_cast<int>(number(record, points));
            point.error.missing = static_cast<int>(number(record, missing));
            point.error.reference_error = 0.01 * number(record, reference_error);
            point.error.resolution = resolution_of(point.error.reference_error, point.error.counted);
        }
        if (finished_) {
            run.end = word(record, end, all_run_ends);
            run.reason = record.fields[reason].text;
            run.seconds = time;
            run.elements = static_cast<std::uint32_t>(number(record, elements));
            run.rays = static_cast<std::uint64_t>(number(record, rays));
        }
        chart_.reference_paths = static_cast<int>(number(record, reference_paths));
        chart_.reference_error = 0.01 * number(record, reference_error);
    }

    const std::string& name_;
    std::vector<std::string> faults_;
    MethodChart chart_;
    bool finished_ = true; // the last run has been read to its end
};

} // namespace

std::string chart_table(const MethodChart& chart) {
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (const ChartRun& run : chart.runs) {
        // The end of a run that settled is its last look; of any other it stands in a line of its own.
        const bool looked = run.end == RunEnd::settled && !run.points.empty();
        for (const ChartPoint& point : run.points)
            text += line_of(chart, run, &point, looked && &point == &run.points.back());
        if (!looked) text += line_of(chart, run, nullptr, true);
    }
    return text;
}

std::expected<MethodChart, std::vector<std::string>> parse_chart_table(std::string_view text, const std::string& name) {
    return TableReader(name).read(text);
}

std::filesystem::path chart_file_of(const std::filesystem::path& scene_file) {
    if (scene_file.empty()) return {};
    const std::string name = scene_file.stem().string() + ".chart.csv";
    std::error_code error;
    const auto beside = scene_file.parent_path() / name;
    if (std::filesystem::exists(beside, error)) return beside;
    const auto shipped = asset_path(std::filesystem::path("readme") / name);
    if (std::filesystem::equivalent(scene_file, asset_path(scene_file.filename()), error) && !error &&
        std::filesystem::exists(shipped, error))
        return shipped;
    return {};
}

} // namespace lueur
