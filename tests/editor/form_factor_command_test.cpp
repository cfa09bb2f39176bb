// `lueur form-factors` from file to file, and what it says of files that are wrong.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/scene/solver_words.h"
#include "editor/commands/command_line.h"
#include "editor/commands/form_factor_cases.h"
#include "editor/commands/form_factor_failures.h"
#include "editor/commands/json_place.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Howell C-11 and C-14: opposed unit squares, 1 apart, half hidden or not; squares with a common edge.
constexpr const char* good_cases = R"({"header": {"units": "any"}, "cases": [
 {"name": "opposed", "polygon1": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "polygon2": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]], "F12": 7},
 {"polygon1": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "polygon2": [[0,0,0],[0,1,0],[0,1,1],[0,0,1]], "occluders": []},
 {"name": "hidden", "polygon1": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "polygon2": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]],
  "occluders": [[[0,0,0.5],[1,0,0.5],[1,1,0.5],[0,1,0.5]]]}
]})";

TEST(FormFactorCommand, GivesOneEntryACaseAndMethod) {
    const test::TemporaryFolder folder;
    const auto cases = folder.path() / "cases.json", output = folder.path() / "out.json";
    std::ofstream(cases) << good_cases;
    FormFactorsCommand command;
    command.cases = cases;
    command.output = output;
    command.settings.resolution = 32;
    EXPECT_EQ(run(command), 0);
    const auto entries = nlohmann::json::parse(test::text_of(output));
    ASSERT_EQ(entries.size(), 3 * (all_form_factor_methods.size() - 1));
    const double exact[] = {0.19982489569838738, 0.20004377607540316, 0};
    const char* names[] = {"opposed", "case 2", "hidden"};
    for (std::size_t n = 0; n < entries.size(); ++n) {
        const auto& entry = entries[n];
        const std::size_t one = n / (all_form_factor_methods.size() - 1);
        EXPECT_EQ(entry["name"], names[one]);
        EXPECT_EQ(entry["method"], to_string(all_form_factor_methods[1 + n % (all_form_factor_methods.size() - 1)]));
        EXPECT_TRUE(entry["warning"].is_string());
        EXPECT_GE(entry["seconds"].get<double>(), 0);
        if (entry["method"] == "analytic") {
            EXPECT_NEAR(entry["F12"].get<double>(), exact[one], 1e-12);
        }
        EXPECT_LE(std::abs(entry["F12"].get<double>() - exact[one]), 3 * entry["standard_error"].get<double>() + 1e-15);
    }
}

TEST(FormFactorCommand, OneSampleHasNoError) {
    const test::TemporaryFolder folder;
    const auto cases = folder.path() / "cases.json", output = folder.path() / "out.json";
    std::ofstream(cases) << good_cases;
    FormFactorsCommand command;
    command.cases = cases;
    command.output = output;
    command.methods = {FormFactorMethod::hemicube, FormFactorMethod::automatic};
    command.settings.samples = 1;
    EXPECT_EQ(run(command), 0);
    const auto entries = nlohmann::json::parse(test::text_of(output));
    ASSERT_EQ(entries.size(), 6u);
    EXPECT_TRUE(entries[0]["standard_error"].is_null());
    EXPECT_EQ(entries[1]["method"], "auto");
    EXPECT_EQ(entries[1]["chosen"], "analytic");
}

TEST(FormFactorCommand, TellsAllMistakesOfAFileWithTheirPlaces) {
    const auto errors = [](std::string_view text) {
        const auto cases = parse_form_factor_cases(text, "a.json");
        return cases ? std::vector<std::string>() : cases.error();
    };
    EXPECT_THAT(errors(good_cases), ElementsAre());
    EXPECT_THAT(errors("{\"cases\": [\n  {\"name\": }"), ElementsAre(StartsWith("a.json:2:12: is not JSON here; ")));
    EXPECT_THAT(errors(""), ElementsAre(StartsWith("a.json:1:1: is not JSON here; ")));
    EXPECT_THAT(errors("[]"), ElementsAre(StartsWith("a.json:1:1: there is no list \"cases\"; ")));
    EXPECT_THAT(errors("{\"cases\": 3}"), ElementsAre(StartsWith("a.json:1:11: there is no list \"cases\"; ")));
    EXPECT_THAT(errors("{\"cases\": [{\"name\": \"\\ud800\"}]}").size(), 1);
    EXPECT_THAT(errors("{\"cases\": [{\"polygon1\": [[1e999,0,0]]}]}").size(), 1);
    EXPECT_THAT(errors(R"({"a \" ] } quote": [1, {"cases": [5]}],
 "cases": [
  {"name": "a", "polygon1": [[0,0,0],[1,0,0],[1,1,0.5],[0,1,0]], "polygon2": [[0,0],[1,0,0]]},
  {"name": 5, "polygon1": [[0,0,0],[1,0,0],[1,1,0]],
   "occluders": [[[0,0,0],[1,0,0],[2,0,0]]]},
  7
 ]
})"),
                ElementsAre(AllOf(StartsWith("a.json:3:29: polygon1 "), HasSubstr("not planar")),
                            AllOf(StartsWith("a.json:3:79: point 1 of polygon2 "), HasSubstr("three numbers")),
                            StartsWith("a.json:4:12: name "), StartsWith("a.json:4:3: the case has no polygon2; "),
                            AllOf(StartsWith("a.json:5:18: occluder 1 "), HasSubstr("no area")),
                            StartsWith("a.json:6:3: a case is not an object; ")));
}

TEST(FormFactorCommand, MistakesLeaveNothingBehind) {
    const test::TemporaryFolder folder;
    FormFactorsCommand command;
    command.cases = folder.path() / "bad.json";
    command.output = folder.path() / "out.json";
    std::ofstream(command.cases) << "{\"cases\": [{}]}";
    EXPECT_EQ(run(command), 2);
    command.cases = folder.path() / "missing.json";
    EXPECT_EQ(run(command), 2);
    EXPECT_FALSE(std::filesystem::exists(command.output));
    command.failures = true; // into a folder that is not there
    EXPECT_EQ(run(command), 2);
}

TEST(FormFactorCommand, OptionsMeanWhatTheySay) {
    const auto parse = [](std::vector<const char*> words) {
        words.insert(words.begin(), {"lueur", "form-factors"});
        return parse_command_line(static_cast<int>(words.size()), words.data());
    };
    const CommandLine line = parse({"a.json", "-o", "b.json", "--method", "hemicube,auto", "--samples", "9",
                                    "--resolution", "31", "--cells", "theta_phi", "--seed", "4"});
    const auto* command = std::get_if<FormFactorsCommand>(&line);
    ASSERT_NE(command, nullptr);
    EXPECT_THAT(command->methods, ElementsAre(FormFactorMethod::hemicube, FormFactorMethod::automatic));
    EXPECT_EQ(command->settings.samples, 9);
    EXPECT_EQ(command->settings.resolution, 31);
    EXPECT_EQ(command->settings.cells, HemisphereCells::theta_phi);
    EXPECT_EQ(command->settings.seed, 4u);
    for (const auto& words : std::vector<std::vector<const char*>>{{"a.json"},
                                                                   {"-o", "b.json"},
                                                                   {"a.json", "-o", "b.json", "--method", "guess"},
                                                                   {"a.json", "-o", "b.json", "--samples", "0"},
                                                                   {"a.json", "--failures", "-o", "."}}) {
        const CommandLine bad = parse(words);
        const auto* stop = std::get_if<ExitNow>(&bad);
        ASSERT_NE(stop, nullptr);
        EXPECT_EQ(stop->code, 2);
    }
}

// What the failure table calls true: the pairs have known answers where one is known.
TEST(FormFactorFailures, TheTruthIsTrue) {
    double at_ninety = 0, at_millimetres = -1, behind = -1;
    for (const FormFactorCase& one : hard_form_factor_cases()) {
        const TrueFormFactor exact = true_form_factor(one, nullptr);
        EXPECT_GE(exact.value, 0) << one.name;
        EXPECT_LE(exact.value, 1) << one.name;
        EXPECT_LE(exact.bound, 2e-5 * exact.value) << one.name;
        EXPECT_EQ(exact.value > 0, one.name != "behind the plane") << one.name;
        if (one.name == "common edge, 90 degrees") at_ninety = exact.value;
        if (one.name.starts_with("millimetres")) at_millimetres = exact.value;
        if (one.name == "behind the plane") behind = exact.value;
        const FormFactorEstimate automatic =
            form_factor(one.polygon1, one.polygon2, {one.occluders, nullptr}, FormFactorMethod::automatic, {});
        EXPECT_EQ(automatic.warning, "") << one.name;
        EXPECT_NEAR(automatic.value, exact.value, 1e-4 * exact.value) << one.name;
    }
    EXPECT_NEAR(at_ninety, 0.20004377607540316, 1e-12); // Howell C-14
    EXPECT_NEAR(at_millimetres, at_ninety, 1e-12);
    EXPECT_EQ(behind, 0);
}

} // namespace
} // namespace lueur
