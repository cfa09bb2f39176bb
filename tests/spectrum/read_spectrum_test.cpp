// .spd, .sp and .cmf as programs write them, good and bad, and damaged files of every kind.
#include "core/spectrum/read_spectrum.h"

#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/mutated.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SpectrumFiles : public test::FolderTest {
protected:
    Spectrum read(const std::string& name, const std::string& text, const std::string& column = "") const {
        auto spectrum = read_spectrum(write(name, text), column);
        if (spectrum) return std::move(*spectrum);
        for (const std::string& error : spectrum.error()) ADD_FAILURE() << error;
        return {};
    }
    std::string errors(const std::string& name, const std::string& text, const std::string& column = "") const {
        const auto spectrum = read_spectrum(write(name, text), column);
        return spectrum ? std::string() : fmt::format("{}", fmt::join(spectrum.error(), "\n"));
    }
};

// As colord and Argyll's spotread write it, with the numbers shortened.
const std::string argyll = "SPECT  \n\nDESCRIPTOR \"Argyll Spectral power/reflectance information\"\n"
                           "ORIGINATOR \"Argyll CMS\"\nKEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"4\"\n"
                           "KEYWORD \"SPECTRAL_START_NM\"\nSPECTRAL_START_NM \"380.000000\"\n"
                           "SPECTRAL_END_NM \"410.000000\"\nSPECTRAL_NORM \"100.000000\"\nNUMBER_OF_FIELDS 4\n"
                           "BEGIN_DATA_FORMAT\nSPEC_380 SPEC_390 SPEC_400 SPEC_410\nEND_DATA_FORMAT\n\n"
                           "NUMBER_OF_SETS 1\nBEGIN_DATA\n12.5 25 5e1 100\nEND_DATA\n";

TEST_F(SpectrumFiles, SpdIsPairsOfNumbers) {
    const Spectrum wanted{{400, 500.5, 600}, {0.1, 2, 0.03}};
    EXPECT_EQ(read("a.spd", "# lamp\n400 0.1\n500.5\t2 # here\n\n  600,3e-2\n"), wanted);
    EXPECT_EQ(read("a.spd", "\xEF\xBB\xBF"
                            "400;0.1\r\n500.5;2\r\n600;0.03"),
              wanted);
    EXPECT_EQ(read("a.dat", "400 0.1\n500.5 +2\n600 0.03\n"), wanted) << "whatever it is called";
    EXPECT_THAT(*spectrum_columns(folder / "a.spd"), ElementsAre(""));
    const auto bins = read_spectrum(folder / "a.spd", "", Interpolation::bin);
    ASSERT_TRUE(bins);
    EXPECT_EQ(bins->interpolation, Interpolation::bin);
}

TEST_F(SpectrumFiles, SpdTellsEveryErrorWithItsPlace) {
    const std::string all = errors("a.spd", "400 0.1\n390 1\n450 1\n500\n600 1 2\nnm x\n700 nan\n-3 1\n");
    for (const char* wanted :
         {"a.spd:2:1: wavelength 390 follows 400; allowed: ", "a.spd:4:1: 1 numbers in a line; allowed: two",
          "a.spd:5:7: 3 numbers in a line", "a.spd:6:1: \"nm\" is not a number", "a.spd:6:4: \"x\" is not a number",
          "a.spd:7:5: \"nan\" is not finite", "a.spd:8:1: wavelength -3; allowed: nm, above 0"})
        EXPECT_THAT(all, HasSubstr(wanted));
    EXPECT_THAT(errors("a.spd", "400 0.1\n400 1\n"), HasSubstr("a.spd:2:1: wavelength 400 repeats 400"));
    EXPECT_THAT(errors("a.spd", "400 1\n"), HasSubstr("1 rows of numbers; allowed: two or more"));
    EXPECT_THAT(errors("a.spd", "# only this\n"), HasSubstr("is empty; allowed: "));
    EXPECT_THAT(errors("a.spd", "400 1\n500 1\n", "red"), HasSubstr("there is no column \"red\"; allowed: none"));
    EXPECT_THAT(errors("a.spd", std::string("4\0", 2)), HasSubstr("is not UTF-8 text"));
    EXPECT_THAT(read_spectrum(folder / "no.spd", "").error(), ElementsAre(HasSubstr("there is no such file")));
    EXPECT_THAT(read_spectrum(folder, "").error(), ElementsAre(HasSubstr("is a folder")));
    EXPECT_THAT(read_spectrum("/dev/null", "").error(), ElementsAre(HasSubstr("is not a regular file")));
}

TEST_F(SpectrumFiles, SpOfArgyllIsDividedByItsNorm) {
    const Spectrum wanted{{380, 390, 400, 410}, {0.125, 0.25, 0.5, 1}};
    EXPECT_EQ(read("a.sp", argyll), wanted);
    EXPECT_EQ(read("a.spd", argyll), wanted) << "told apart by what is in it";
    EXPECT_EQ(read("a.sp", argyll, "1"), wanted);
    std::string windows = argyll;
    for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2) windows.insert(at, "\r");
    EXPECT_EQ(read("a.sp", windows), wanted);
    // Bands of 10/3 nm, as Argyll's high resolution has them: the names are rounded, the wavelengths are not.
    const Spectrum thirds = read("t.sp", "SPECT\nSPECTRAL_BANDS 4\nSPECTRAL_START_NM 380\nSPECTRAL_END_NM 390\n"
                                         "BEGIN_DATA\n1 2 3 4\nEND_DATA\n");
    ASSERT_EQ(thirds.nm.size(), 4u);
    EXPECT_NEAR(thirds.nm[1], 380 + 10.0 / 3, 1e-12);
    EXPECT_EQ(thirds.nm.back(), 390);
}

TEST_F(SpectrumFiles, CmfHoldsThreeSetsAndMeasurementsTheirNames) {
    const std::string head = "SPECTRAL_BANDS 2\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 500\n";
    const std::string cmf = "CMF\n" + head + "BEGIN_DATA\n1 2\n3 4\n5 6\nEND_DATA\n";
    EXPECT_EQ(read("x.cmf", cmf, "Y").value, (std::vector<double>{3, 4}));
    EXPECT_EQ(read("x.cmf", cmf, "3").value, (std::vector<double>{5, 6}));
    EXPECT_EQ(read("x.cmf", cmf).value, (std::vector<double>{1, 2}));
    EXPECT_THAT(*spectrum_columns(folder / "x.cmf"), ElementsAre("X", "Y", "Z"));
    EXPECT_THAT(errors("x.cmf", cmf, "W"), HasSubstr("there is no set \"W\"; allowed: X, Y, Z"));

    const std::string named =
        "CTI3\n" + head +
        "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_500 SAMPLE_NAME\nEND_DATA_FORMAT\nBEGIN_DATA\n"
        "1 0.1 0.2 \"light skin\"\n2 0.3 0.4 sky\nEND_DATA\n";
    EXPECT_EQ(read("n.sp", named, "sky").value, (std::vector<double>{0.3, 0.4}));
    EXPECT_EQ(read("n.sp", named, "light skin").value, (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(read("n.sp", named, "2").value, (std::vector<double>{0.3, 0.4}));
}

TEST_F(SpectrumFiles, SpErrorsNameWhatIsAllowed) {
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = argyll;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    const std::pair<std::string, std::string> cases[] = {
        {changed("SPECTRAL_BANDS \"4\"", "X 1"), "there is no SPECTRAL_BANDS; allowed: "},
        {changed("\"4\"", "\"1\""), "SPECTRAL_BANDS is 1; allowed: a whole number, two or more"},
        {changed("\"4\"", "\"3\""), "SPECTRAL_BANDS is 3 but there are 4 fields"},
        {changed("\"380.000000\"", "\"x\""), "a.sp:8:19: \"x\" is not a number"},
        {changed("\"380.000000\"", "\"500\""), "SPECTRAL_END_NM is 410 and SPECTRAL_START_NM 500; allowed: "},
        {changed("\"100.000000\"", "\"0\""), "SPECTRAL_NORM is 0; allowed: a number above 0"},
        {changed("12.5 25", "25"), "3 values after BEGIN_DATA; allowed: a multiple of the 4"},
        {changed("12.5", "nan"), "a.sp:18:1: \"nan\" is not finite"},
        {changed("NUMBER_OF_SETS 1", "NUMBER_OF_SETS 2"), "NUMBER_OF_SETS is 2 but there are 1"},
        {argyll.substr(0, argyll.rfind("END_DATA")), "BEGIN_DATA has no END_DATA"},
        {"SPECT\nSPECTRAL_BANDS 2\n", "there is no BEGIN_DATA; allowed: "},
    };
    for (const auto& [text, wanted] : cases) EXPECT_THAT(errors("a.sp", text), HasSubstr(wanted)) << text;
}

TEST_F(SpectrumFiles, TenThousandWavelengthsAreRead) {
    std::string spd, csv = "wavelength_nm,a,b\n", values;
    for (int i = 0; i < 10000; ++i) {
        spd += fmt::format("{} {}\n", 300 + 0.05 * i, i % 7);
        csv += fmt::format("{},{},0\n", 300 + 0.05 * i, i % 7);
        values += fmt::format("{} ", i % 7);
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(read("many.spd", spd).value[9999], 9999 % 7);
    EXPECT_EQ(read("many.csv", csv, "a").nm.size(), 10000u);
    EXPECT_EQ(read("many.sp", "SPECT\nSPECTRAL_BANDS 10000\nSPECTRAL_START_NM 300\nSPECTRAL_END_NM 800\nBEGIN_DATA\n" +
                                  values + "\nEND_DATA\n")
                  .value[9998],
              9998 % 7);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << "milliseconds, even unoptimised";
}

// Whatever bytes change, reading ends with a good spectrum or with errors that name the file.
TEST_F(SpectrumFiles, DamagedFilesAreReadOrRefused) {
    static const std::string likely = "0123456789-.e,\n nif\"#;ESA";
    const std::pair<const char*, std::string> files[] = {
        {"m.spd", "# a lamp\n400 0.1\n500 2\n600 0.3\n700 0.4\n"},
        {"m.csv", "# a lamp\nwavelength_nm,white,red\n400,0.1,2\n500,2,3\n600,0.3,4\n"},
        {"m.sp", argyll}};
    std::mt19937 random(20240502);
    for (const auto& [name, good] : files) {
        int accepted = 0, refused = 0;
        for (int round = 0; round < 1500; ++round) {
            const std::string text = test::mutated(good, likely, random);
            const auto file = write(name, text);
            const auto result = read_spectrum(file, random() % 2 ? "" : "red");
            if (result) {
                ++accepted;
                const auto made = make_spectrum(result->nm, result->value);
                EXPECT_TRUE(made) << made.error() << "\n" << text;
            } else {
                ++refused;
                ASSERT_FALSE(result.error().empty());
                for (const std::string& error : result.error()) EXPECT_TRUE(error.starts_with(file.string())) << error;
            }
            const auto columns = spectrum_columns(file);
            EXPECT_TRUE(columns ? !columns->empty() : !columns.error().empty());
        }
        EXPECT_GT(accepted, 50) << name;
        EXPECT_GT(refused, 50) << name;
    }
}

} // namespace
} // namespace lueur
