// Charts as SVG: whole documents, every point where its axes say.
#include "editor/commands/svg_chart.h"

#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lueur {
namespace {

using testing::HasSubstr;
using testing::Not;

Chart small_chart() {
    Chart chart{"error & time", "a < b", {{"jacobi", 0, false}, {"auto", 3, true}}, {}, 1};
    chart.panels.push_back({"panel",
                            {"ms", 1, 100},
                            {"%", 0.1, 10},
                            {{0, {{1, 10}, {10, 1}, {100, 0.1}}, false}, {1, {{10, 1e-9}}, false}},
                            0.5});
    return chart;
}

std::vector<glm::dvec2> circles(const std::string& svg) {
    std::vector<glm::dvec2> centres;
    const std::regex circle("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
    for (std::sregex_iterator i(svg.begin(), svg.end(), circle), end; i != end; ++i)
        centres.emplace_back(std::stod((*i)[1]), std::stod((*i)[2]));
    return centres;
}

TEST(SvgChart, PutsPointsOnLogarithmicAxes) {
    const auto points = circles(svg_text(small_chart()));
    ASSERT_EQ(points.size(), 3u);
    // Three points a decade apart from corner to corner: evenly spaced, downhill on the page.
    EXPECT_NEAR(points[1].x, (points[0].x + points[2].x) / 2, 0.1);
    EXPECT_NEAR(points[1].y, (points[0].y + points[2].y) / 2, 0.1);
    EXPECT_GT(points[2].x - points[0].x, 200);
    EXPECT_GT(points[2].y - points[0].y, 150);
}

TEST(SvgChart, NamesAtTheEndsOfCurvesKeepApart) {
    EXPECT_THAT(spread_out(std::vector<double>{10, 11, 12, 50}, 5, 0, 100), testing::ElementsAre(10, 15, 20, 50));
    EXPECT_THAT(spread_out(std::vector<double>{90, 95, 99}, 5, 0, 100), testing::ElementsAre(90, 95, 100));
    EXPECT_THAT(spread_out(std::vector<double>{98, 99, 99}, 5, 0, 100), testing::ElementsAre(90, 95, 100));
    EXPECT_TRUE(spread_out({}, 5, 0, 100).empty());
    // In a chart: two curves that end at one place, a name each, no legend.
    Chart chart = small_chart();
    chart.names_width = 100;
    chart.series[1].marks_only = false;
    chart.panels[0].curves[1].points = {{1, 5}, {100, 0.1}};
    const std::string svg = svg_text(chart);
    const std::regex name("y=\"([0-9.]+)\"[^>]*>(jacobi|auto)<");
    std::vector<double> heights;
    for (std::sregex_iterator i(svg.begin(), svg.end(), name), end; i != end; ++i)
        heights.push_back(std::stod((*i)[1]));
    ASSERT_EQ(heights.size(), 2u);
    EXPECT_GE(std::abs(heights[0] - heights[1]), 14);
}

TEST(SvgChart, MarksTheFrontAndWhatFailed) {
    Chart chart = small_chart();
    const std::string before = svg_text(chart);
    chart.panels[0].front = {{1, 10}, {10, 1}};
    chart.panels[0].failures = {{0, 10}};
    chart.remarks = {"\u00d7 refused \u2013 jacobi", std::string(300, 'x') + " " + std::string(300, 'y')};
    const std::string svg = svg_text(chart);
    EXPECT_THAT(svg, HasSubstr("stroke=\"#f3df9b\""));
    EXPECT_THAT(svg, HasSubstr("\u00d7 refused \u2013 jacobi"));
    EXPECT_THAT(svg, HasSubstr("m-4 -4l8 8m-8 0l8 -8"));
    EXPECT_THAT(svg, Not(HasSubstr(std::string(300, 'x') + " "))) << "a long remark is cut between words";
    const auto height = [](const std::string& text) {
        std::smatch found;
        std::regex_search(text, found, std::regex("height=\"([0-9]+)\""));
        return std::stod(found[1]);
    };
    EXPECT_NEAR(height(svg) - height(before), 3 * 16, 1);
}

TEST(SvgChart, DrawsWhatIsOutsideOnTheEdge) {
    Chart inside = small_chart(), outside = small_chart();
    inside.panels[0].curves[0].points = {{1, 0.1}, {100, 10}};
    outside.panels[0].curves[0].points = {{0.001, 1e-9}, {1e6, 1e9}};
    EXPECT_EQ(circles(svg_text(inside)), circles(svg_text(outside)));
}

TEST(SvgChart, IsWellFormedAndNamesItsCurves) {
    const std::string svg = svg_text(small_chart());
    EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_THAT(svg, HasSubstr("error &amp; time"));
    EXPECT_THAT(svg, HasSubstr("a &lt; b"));
    for (const char* name : {">jacobi<", ">auto<", ">ms<", ">%<", ">panel<"}) EXPECT_THAT(svg, HasSubstr(name));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    // Nothing is left open.
    std::size_t open = 0;
    for (const char* element : {"<svg", "<text", "<title"})
        for (std::size_t at = svg.find(element); at != std::string::npos; at = svg.find(element, at + 1)) ++open;
    std::size_t closed = 0;
    for (std::size_t at = svg.find("</"); at != std::string::npos; at = svg.find("</", at + 1)) ++closed;
    EXPECT_EQ(open, closed);
}

TEST(SvgChart, WithoutPanelsOrCurvesIsStillADocument) {
    EXPECT_TRUE(svg_text({}).ends_with("</svg>\n"));
    Chart empty = small_chart();
    empty.panels[0].curves.clear();
    EXPECT_TRUE(circles(svg_text(empty)).empty());
}

} // namespace
} // namespace lueur
