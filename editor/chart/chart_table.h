// A method chart as a CSV: a line for each look at a run, and one for how the run ended.
//
// Columns: solver, form_factors, oracle, level, element_scale, target_error_percent, samples (the budget); end
// (`milestone` for a look on the way), reason; seconds (of solving); rms_percent, rms_without_noise_percent,
// median_percent, p95_percent (relative_error.h, as is estimated_error_percent), rms_of_truth_percent (relative to the
// truth alone), points, missing (empty where the run ended without a figure); estimated_error_percent; elements, rays;
// reference_paths, reference_error_percent (the same in every line).
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "editor/chart/method_chart.h"

namespace lueur {

std::string chart_table(const MethodChart& chart);

// Errors: `NAME:LINE:COLUMN: what; what is allowed`, all of them.
std::expected<MethodChart, std::vector<std::string>> parse_chart_table(std::string_view text, const std::string& name);

// The chart that lies beside a scene (room.toml: room.chart.csv), or is shipped with it (readme/room.chart.csv of the
// assets for their own scenes). Empty: there is none.
std::filesystem::path chart_file_of(const std::filesystem::path& scene_file);

} // namespace lueur
