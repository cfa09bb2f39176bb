// Every spectrum that comes with the program: it reads, it is physical, and the CIE's have the CIE's colours.
#include "core/spectrum/spectrum_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "tests/support/source_folder.h"

namespace lueur {
namespace {

SpectrumLibrary library() {
    auto listed = list_spectrum_library(test::source_folder() / "assets/spectra");
    if (listed) return std::move(*listed);
    for (const std::string& error : listed.error()) ADD_FAILURE() << error;
    return {};
}

TEST(SpectrumLibrary, EveryFileReadsAndIsPhysical) {
    const SpectrumLibrary all = library();
    int lights = 0, reflectances = 0;
    for (const LibraryEntry& entry : all.entries) {
        const LibraryGroup& group = all.groups.at(entry.group);
        EXPECT_FALSE(group.source.empty()) << group.file << " says no source";
        const auto read = read_library_spectrum(all, entry);
        ASSERT_TRUE(read) << entry.name << ": " << read.error().front();
        const auto made = make_spectrum(read->nm, read->value);
        EXPECT_TRUE(made) << entry.name << ": " << made.error();
        for (const double value : read->value) EXPECT_GE(value, 0) << entry.name;
        EXPECT_LE(read->nm.front(), 400) << entry.name;
        EXPECT_GE(read->nm.back(), 700) << entry.name;
        switch (group.kind) {
        case LibraryKind::light:
            ++lights;
            EXPECT_GT(xyz_from_spectrum(*read).y, 0) << entry.name;
            break;
        case LibraryKind::reflectance:
            ++reflectances;
            for (const double value : read->value) EXPECT_LE(value, 1) << entry.name;
            break;
        }
    }
    // 7 standard, 27 FL, 5 HP, 9 LED, 56 measured lamps and Cornell's; 24 patches and Cornell's three.
    EXPECT_EQ(lights, 7 + 27 + 5 + 9 + 56 + 1);
    EXPECT_EQ(reflectances, 24 + 3);
}

// CIE 015:2018, tables of illuminants: chromaticities printed to four digits, summed over the 5 nm samples.
TEST(SpectrumLibrary, TheCiesIlluminantsHaveTheCiesColours) {
    struct {
        const char* name;
        double x, y;
    } const published[] = {
        {"A", .4476, .4074},       {"C", .3101, .3162},        {"D50", .3457, .3585},    {"D55", .3324, .3474},
        {"D65", .3127, .3290},     {"D75", .2990, .3149},      {"E", .3333, .3333},      {"FL1", .3131, .3371},
        {"FL2", .3721, .3751},     {"FL3", .4091, .3941},      {"FL4", .4402, .4031},    {"FL5", .3138, .3452},
        {"FL6", .3779, .3882},     {"FL7", .3129, .3292},      {"FL8", .3458, .3586},    {"FL9", .3741, .3727},
        {"FL10", .3458, .3588},    {"FL11", .3805, .3769},     {"FL12", .4370, .4042},   {"FL3.1", .4407, .4033},
        {"FL3.2", .3808, .3734},   {"FL3.3", .3153, .3439},    {"FL3.4", .4429, .4043},  {"FL3.5", .3749, .3672},
        {"FL3.6", .3488, .3600},   {"FL3.7", .4384, .4045},    {"FL3.8", .3820, .3832},  {"FL3.9", .3499, .3591},
        {"FL3.10", .3455, .3560},  {"FL3.11", .3245, .3434},   {"FL3.12", .4377, .4037}, {"FL3.13", .3830, .3724},
        {"FL3.14", .3447, .3609},  {"FL3.15", .3127, .3288},   {"HP1", .5330, .4150},    {"HP2", .4778, .4158},
        {"HP3", .4302, .4075},     {"HP4", .3812, .3797},      {"HP5", .3776, .3713},    {"LED-B1", .4560, .4078},
        {"LED-B2", .4357, .4012},  {"LED-B3", .3756, .3723},   {"LED-B4", .3422, .3502}, {"LED-B5", .3118, .3236},
        {"LED-BH1", .4474, .4066}, {"LED-RGB1", .4557, .4211}, {"LED-V1", .4548, .4044}, {"LED-V2", .3781, .3775}};
    const SpectrumLibrary all = library();
    for (const auto& one : published) {
        const LibraryEntry* entry = find_entry(all, LibraryKind::light, one.name);
        ASSERT_TRUE(entry) << one.name;
        const auto spectrum = read_library_spectrum(all, *entry);
        ASSERT_TRUE(spectrum);
        Xyz sum(0);
        for (std::size_t i = 0; i < spectrum->nm.size(); ++i)
            sum += spectrum->value[i] * observer_xyz(static_cast<int>(spectrum->nm[i]));
        const Chromaticity colour = chromaticity(sum);
        EXPECT_NEAR(colour.x, one.x, 6e-5) << one.name; // half of the last digit, and the table's own rounding
        EXPECT_NEAR(colour.y, one.y, 6e-5) << one.name;
    }
}

TEST(SpectrumLibrary, PatchesAreThePatches) { // Ohta's and Cornell's figures at 550 nm
    const SpectrumLibrary all = library();
    const auto at_550 = [&](const char* name) {
        const LibraryEntry* entry = find_entry(all, LibraryKind::reflectance, name);
        return entry ? value_at(*read_library_spectrum(all, *entry), 550, Outside::constant) : -1;
    };
    EXPECT_NEAR(at_550("ColorChecker white 9.5"), 0.886, 1e-12);
    EXPECT_NEAR(at_550("ColorChecker neutral 5"), 0.203, 1e-12);
    EXPECT_NEAR(at_550("ColorChecker black 2"), 0.034, 1e-12);
    EXPECT_NEAR(at_550("Cornell white"), (0.748 + 0.728) / 2, 1e-12);
    EXPECT_FALSE(find_entry(all, LibraryKind::light, "ColorChecker red")) << "a paint is no light";
    EXPECT_FALSE(find_entry(all, LibraryKind::light, "FL99"));
}

TEST(SpectrumLibrary, TellsNamesThatAreThereTwiceAndFilesThatCannotBeRead) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "lueur_library";
    std::filesystem::create_directories(folder);
    const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
    write("a.csv", "# library: First\r\n# prefix: my \r\nwavelength_nm,lamp\r\n400,1\r\n500,1\r\n");
    write("not of it.csv", "# nothing\nnonsense\n");
    const auto good = list_spectrum_library(folder);
    ASSERT_TRUE(good);
    ASSERT_EQ(good->entries.size(), 1u);
    EXPECT_EQ(good->entries[0].name, "my lamp");
    EXPECT_EQ(good->groups[0].name, "First");
    write("b.csv", "# library: Second\nwavelength_nm,my lamp\n400,1\n500,1\n");
    write("c.csv", "# library: Third\nnm,x\n");
    const auto bad = list_spectrum_library(folder);
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error(),
                ::testing::ElementsAre(::testing::HasSubstr("b.csv: \"my lamp\" is in the library already"),
                                       ::testing::HasSubstr("c.csv:2:1: the first column is \"nm\"")));
    std::filesystem::remove_all(folder);
    EXPECT_TRUE(list_spectrum_library(folder)->entries.empty()) << "a folder that is not there";
}

} // namespace
} // namespace lueur
