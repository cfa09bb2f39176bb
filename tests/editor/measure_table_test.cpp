// The CSV of points: what is read, what is refused and where, and that what others wrote in it stays.
#include "editor/commands/measure_table.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lueur {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

MeasureTable parsed(const std::string& text, UpAxis up = UpAxis::y) {
    auto table = parse_measure_table(text, "p.csv", up);
    EXPECT_TRUE(table.has_value()) << (table ? "" : table.error().front());
    return table.value_or(MeasureTable{});
}
std::vector<std::string> faults_of(const std::string& text) {
    const auto table = parse_measure_table(text, "p.csv", UpAxis::y);
    return table ? std::vector<std::string>{} : table.error();
}
void expect_vector(const glm::dvec3& v, double x, double y, double z) {
    EXPECT_DOUBLE_EQ(v.x, x);
    EXPECT_DOUBLE_EQ(v.y, y);
    EXPECT_DOUBLE_EQ(v.z, z);
}
const std::string header = "x,y,z,nx,ny,nz\n";

TEST(MeasureTable, ReadsColumnsInAnyOrderAmongOthers) {
    const auto table = parsed("name,nz,ny,nx,z,y,x\ndesk,0,1,0,3,2,1\n\"lamp, left\",0,-1,0, 6 ,+5,4e0");
    ASSERT_EQ(table.points.size(), 2u);
    expect_vector(table.points[0].position, 1, 2, 3);
    expect_vector(table.points[0].normal, 0, 1, 0);
    expect_vector(table.points[1].position, 4, 5, 6);
    expect_vector(table.points[1].normal, 0, -1, 0);
    EXPECT_THAT(table.rows, ElementsAre("desk,0,1,0,3,2,1", "\"lamp, left\",0,-1,0, 6 ,+5,4e0"));
}

// Z up: file (x, y, z) is world (x, z, -y), normals too.
TEST(MeasureTable, TurnsPointsOfAZUpFile) {
    const auto table = parsed(header + "1,2,3,0,0,1\n", UpAxis::z);
    expect_vector(table.points.at(0).position, 1, 3, -2);
    expect_vector(table.points.at(0).normal, 0, 1, 0);
}

TEST(MeasureTable, MakesNormalsUnitWithinAThousandth) {
    const auto table = parsed(header + "0,0,0,0,0.9995,0\n0,0,0,0.5774,0.5774,0.5773\n");
    EXPECT_DOUBLE_EQ(glm::length(table.points.at(0).normal), 1);
    EXPECT_DOUBLE_EQ(glm::length(table.points.at(1).normal), 1);
    EXPECT_THAT(faults_of(header + "0,0,0,0,0.99,0\n"),
                ElementsAre(StartsWith("p.csv:2:7: the normal has the length 0.99;")));
    EXPECT_THAT(faults_of(header + "0,0,0,0,0,0\n"),
                ElementsAre(StartsWith("p.csv:2:7: the normal has the length 0;")));
    EXPECT_THAT(faults_of(header + "0,0,0,1e300,1e300,0\n"),
                ElementsAre(StartsWith("p.csv:2:7: the normal has the length")));
}

TEST(MeasureTable, AHeaderAloneIsATableOfNoPoints) {
    EXPECT_EQ(parsed(header).points.size(), 0u);
    EXPECT_EQ(parsed("x,y,z,nx,ny,nz").points.size(), 0u);
}

struct FaultCase {
    const char* text;
    std::vector<std::string> starts; // one a fault
};

TEST(MeasureTable, TellsEveryFaultWithItsPlace) {
    const FaultCase cases[] = {
        {"", {"p.csv:1:1: the file is empty"}},
        {"\n\n", {"p.csv:1:1: the file is empty"}},
        {"x,y,z\n1,2,3\n", {"p.csv:1:1: the header lacks nx, ny, nz;"}},
        {"x,y,z,nx,ny,nz,x\n", {"p.csv:1:16: a second column x;"}},
        {"x,y,z,nx,ny,nz,illuminance_lx\n", {"p.csv:1:16: a column illuminance_lx is there already;"}},
        {"x,y,z,nx,ny,nz\n1,2,3,0,1\n", {"p.csv:2:1: 5 fields; the header has 6"}},
        {"x,y,z,nx,ny,nz\n1,2,3,0,1,0,7\n", {"p.csv:2:1: 7 fields; the header has 6"}},
        {"x,y,z,nx,ny,nz\n\n1,2,3,0,1,0\n", {"p.csv:2:1: an empty line;"}},
        {"x,y,z,nx,ny,nz\n1,two,3,0,1,0\n", {"p.csv:2:3: y is 'two';"}},
        {"x,y,z,nx,ny,nz\n1,2m,3,0,1,0\n", {"p.csv:2:3: y is '2m';"}},
        {"x,y,z,nx,ny,nz\n1,,3,0,1,0\n", {"p.csv:2:3: y is '';"}},
        {"x,y,z,nx,ny,nz\n1,nan,inf,0,1,0\n", {"p.csv:2:3: y is 'nan';", "p.csv:2:7: z is 'inf';"}},
        {"x,y,z,nx,ny,nz\n1e999,2,3,0,1,0\n", {"p.csv:2:1: x is '1e999';"}},
        {"x,y,z,nx,ny,nz\n0x10,2,3,0,1,0\n", {"p.csv:2:1: x is '0x10';"}},
        {"x,y,z,nx,ny,nz\n1,2,3,0,1,0\na,b,3,0,1,0\n1,2,3,0,9,0\n",
         {"p.csv:3:1: x is 'a';", "p.csv:3:3: y is 'b';", "p.csv:4:7: the normal has the length 9;"}},
        {"n,x,y,z,nx,ny,nz\n\xC3\xA9t\xC3\xA9,one,2,3,0,1,0\n",
         {"p.csv:2:5: x is 'one';"}}, // columns count characters, not bytes
        {"n,x,y,z,nx,ny,nz\n\"two\nlines\",bad,2,3,0,1,0\n",
         {"p.csv:3:8: x is 'bad';"}}, // and lines those inside quotes
        {"n,x,y,z,nx,ny,nz\n\"open,1,2,3,0,1,0\n", {"p.csv:2:1: the quote that begins here does not end;"}},
        {"n,x,y,z,nx,ny,nz\n\"a\"b,1,2,3,0,1,0\n", {"p.csv:2:4: text after a closing quote;"}},
        {"n,x,y,z,nx,ny,nz\na\"b,1,2,3,0,1,0\n", {"p.csv:2:2: a quote inside a field without quotes;"}},
    };
    for (const auto& [text, starts] : cases) {
        const auto faults = faults_of(text);
        ASSERT_EQ(faults.size(), starts.size()) << text << (faults.empty() ? "" : faults.front());
        for (std::size_t i = 0; i < starts.size(); ++i) EXPECT_THAT(faults[i], StartsWith(starts[i])) << text;
    }
}

Irradiance lux(double value) {
    return {{0.25, 0.5, 0.75}, value, value / 100, 0.5};
}

TEST(CompletedTable, KeepsWhatWasThereAndAddsBehind) {
    const auto table = parsed("name,x,y,z,nx,ny,nz\n\"a \"\"desk\"\", left\",1.0,2.00,3,0,1,0\n");
    EXPECT_EQ(completed_table(table, {lux(412.5)}, false),
              "name,x,y,z,nx,ny,nz,illuminance_lx,irradiance_w_m2,standard_error_percent\n"
              "\"a \"\"desk\"\", left\",1.0,2.00,3,0,1,0,412.5,4.125,0.5\n");
}

TEST(CompletedTable, HasTheThreeChannelsWithRgb) {
    const auto table = parsed(header + "1,2,3,0,1,0\n");
    EXPECT_EQ(
        completed_table(table, {lux(100)}, true),
        "x,y,z,nx,ny,nz,illuminance_lx,irradiance_w_m2,standard_error_percent,irradiance_r,irradiance_g,irradiance_b\n"
        "1,2,3,0,1,0,100,1,0.5,0.25,0.5,0.75\n");
}

TEST(CompletedTable, KeepsLineEndsAndTheByteOrderMark) {
    const auto table = parsed("\xEF\xBB\xBFx,y,z,nx,ny,nz\r\n1,2,3,0,1,0\r\n\r\n");
    EXPECT_EQ(completed_table(table, {lux(100)}, false), "\xEF\xBB\xBFx,y,z,nx,ny,nz,illuminance_lx,irradiance_w_m2,"
                                                         "standard_error_percent\r\n1,2,3,0,1,0,100,1,0.5\r\n");
}

TEST(CompletedTable, SaysNanWhereNothingCouldBeRead) {
    const double nan_value = std::numeric_limits<double>::quiet_NaN();
    const auto table = parsed(header + "1,2,3,0,1,0\n");
    EXPECT_THAT(completed_table(table, {{{}, nan_value, nan_value, nan_value}}, false),
                HasSubstr("1,2,3,0,1,0,nan,nan,nan\n"));
}

} // namespace
} // namespace lueur
