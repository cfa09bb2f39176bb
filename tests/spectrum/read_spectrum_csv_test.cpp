// Spectrum files as people write them, good and bad.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/spectrum/read_spectrum.h"

#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

class SpectrumCsv : public test::FolderTest {
protected:
    std::filesystem::path write(const std::string& text) const { return FolderTest::write("lamp.csv", text); }
    std::vector<std::string> errors_of(const std::string& text, const std::string& column = "") const {
        const auto read = read_spectrum_csv(write(text), column);
        return read ? std::vector<std::string>{} : read.error();
    }
    std::string at(const std::string& place) const { return (folder / "lamp.csv").string() + ":" + place + ": "; }
};

TEST_F(SpectrumCsv, ReadsANamedColumnOrTheFirst) {
    const auto file =
        write("# a comment\n\nwavelength_nm,white,red\n400, 0.343,0.040\n# inside too\n404,+4.45e-1,.046\n");
    const auto white = read_spectrum_csv(file, "");
    ASSERT_TRUE(white) << white.error().front();
    EXPECT_EQ(*white, (Spectrum{{400, 404}, {0.343, 0.445}}));
    const auto red = read_spectrum_csv(file, "red");
    ASSERT_TRUE(red) << red.error().front();
    EXPECT_EQ(*red, (Spectrum{{400, 404}, {0.040, 0.046}}));
}

TEST_F(SpectrumCsv, ReadsByteOrderMarkCrLfTabsAndNoLastNewline) {
    const auto read =
        read_spectrum_csv(write("\xEF\xBB\xBFwavelength_nm,\tpower\r\n400,1\r\n\r\n500 ,\t2 \r\n600,3"), "power");
    ASSERT_TRUE(read) << read.error().front();
    EXPECT_EQ(*read, (Spectrum{{400, 500, 600}, {1, 2, 3}}));
}

TEST_F(SpectrumCsv, TellsEveryErrorOfTheFileWithItsPlace) {
    const auto errors = errors_of("wavelength_nm,a,b\n"
                                  "400,x,1\n"      // not a number, column 5
                                  "410,nan,1\n"    // not finite
                                  "420, inf,1\n"   // not finite, column 6
                                  "430,1e999,1\n"  // out of range
                                  "425,1,1\n"      // goes back
                                  "425,1,1\n"      // repeats
                                  "-5,1,1\n"       // below zero
                                  "440,1\n"        // a cell is missing
                                  "450,,1\n"       // empty
                                  "460,1.5 2,1\n"  // two numbers
                                  "470,0x10,1\n"); // hexadecimal
    EXPECT_THAT(
        errors,
        ElementsAre(
            StartsWith(at("2:5") + "\"x\" is not a number; allowed: "), StartsWith(at("3:5") + "\"nan\" is not finite"),
            StartsWith(at("4:6") + "\"inf\" is not finite"), StartsWith(at("5:5") + "\"1e999\" is not finite"),
            StartsWith(at("6:1") + "wavelength 425 follows 430; allowed: "),
            StartsWith(at("7:1") + "wavelength 425 repeats 425; allowed: "),
            StartsWith(at("8:1") + "wavelength -5; allowed: "), StartsWith(at("9:5") + "2 cells; allowed: 3"),
            StartsWith(at("10:5") + "an empty cell; allowed: "), StartsWith(at("11:5") + "\"1.5 2\" is not a number"),
            StartsWith(at("12:5") + "\"0x10\" is not a number")));
}

TEST_F(SpectrumCsv, ReportsRowsBesideAMissingColumn) {
    EXPECT_THAT(errors_of("wavelength_nm,white,green\n400,1,2\nfive,1,2\n", "red"),
                ElementsAre(at("1:1") + "there is no column \"red\"; allowed: white, green",
                            StartsWith(at("3:1") + "\"five\"")));
}

TEST_F(SpectrumCsv, WantsItsHeader) {
    EXPECT_THAT(errors_of("400,1\n500,2\n"),
                ElementsAre(StartsWith(at("1:1") + "the first column is \"400\"; allowed: wavelength_nm")));
    EXPECT_THAT(errors_of("nm,power\n500,2\n"), ElementsAre(StartsWith(at("1:1") + "the first column is \"nm\"")));
    EXPECT_THAT(errors_of("wavelength_nm\n400\n500\n"), ElementsAre(HasSubstr("no column of values")));
    EXPECT_THAT(errors_of("wavelength_nm,a,a\n400,1,2\n500,1,2\n", "a"),
                ElementsAre(StartsWith(at("1:17") + "column \"a\" is there twice")));
}

TEST_F(SpectrumCsv, TellsFilesThatHoldNoSpectrum) {
    EXPECT_THAT(errors_of(""), ElementsAre(HasSubstr("lamp.csv: is empty; allowed: ")));
    EXPECT_THAT(errors_of("# only a comment\n\n"), ElementsAre(HasSubstr("is empty; allowed: ")));
    EXPECT_THAT(errors_of("wavelength_nm,a\n"), ElementsAre(HasSubstr("0 rows of numbers; allowed: two or more")));
    EXPECT_THAT(errors_of("wavelength_nm,a\n400,1\n"),
                ElementsAre(HasSubstr("1 rows of numbers; allowed: two or more")));
    EXPECT_THAT(errors_of(std::string("\x89PNG\r\n\0\0\0", 9)), ElementsAre(HasSubstr("is not UTF-8 text; allowed: ")));

    const auto missing = read_spectrum_csv(folder / "none.csv", "");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error(),
                ElementsAre(StartsWith((folder / "none.csv").string() + ": there is no such file; allowed: ")));
    const auto is_folder = read_spectrum_csv(folder, "");
    ASSERT_FALSE(is_folder);
    EXPECT_THAT(is_folder.error(), ElementsAre(StartsWith(folder.string() + ": is a folder; allowed: ")));
}

TEST_F(SpectrumCsv, StopsAfterAHundredErrorsAndSaysSo) {
    std::string text = "wavelength_nm,a\n";
    for (int i = 0; i < 5000; ++i) text += "x,y\n";
    const auto errors = errors_of(text);
    EXPECT_THAT(errors, SizeIs(::testing::Le(103)));
    EXPECT_THAT(errors.back(), EndsWith("further errors are not shown"));
}

} // namespace
} // namespace lueur
