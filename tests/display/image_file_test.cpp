// Pictures and their metadata out to files and back; files that cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <sys/resource.h>

#include "core/display/image_file.h"
#include "core/display/replace_file.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const ImageMetadata some_metadata{
    {"lueur:max_display", "120.5"},
    {"lueur:clip", "keep_chromaticity"},
    {"lueur:empty", ""},
    {"lueur:equation", "x = y\\n = z = \\"},
    {"lueur:lines", "first\nsecond\n\tthird"},
    {"lueur:scene", "caf\xc3\xa9.toml"},
    {"lueur:with.dots_and-dashes", " leading and trailing "},
};

DisplayImage display_picture() {
    return {3, 2, {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}, {0, 0, 0}, {10, 20, 30}}};
}

class ImageFile : public test::FolderTest {
protected:
    std::expected<void, std::string> write_any(const std::string& name, const ImageMetadata& metadata) const {
        const RadianceImage radiance{3, 2, std::vector<glm::vec3>(6, glm::vec3(0.4f))};
        return is_radiance_image_name(name) ? write_radiance_image(folder / name, radiance, metadata)
                                            : write_display_image(folder / name, display_picture(), metadata);
    }
};

TEST_F(ImageFile, NamesSayTheKind) {
    for (const char* name : {"a.png", "a.jpg", "a.JPEG", "a.tif", "dir.exr/a.TIFF"}) {
        EXPECT_TRUE(is_display_image_name(name)) << name;
        EXPECT_FALSE(is_radiance_image_name(name)) << name;
    }
    for (const char* name : {"a.exr", "a.HDR"}) {
        EXPECT_TRUE(is_radiance_image_name(name)) << name;
        EXPECT_FALSE(is_display_image_name(name)) << name;
    }
    for (const char* name : {"a", "a.bmp", "png", ".png", ""}) {
        EXPECT_FALSE(is_display_image_name(name)) << name;
        EXPECT_FALSE(is_radiance_image_name(name)) << name;
    }
}

TEST_F(ImageFile, MetadataAreReadBackAsWritten) {
    for (const char* name : {"a.png", "a.jpg", "a.jpeg", "a.tif", "a.tiff", "a.exr"}) {
        const auto written = write_any(name, some_metadata);
        ASSERT_TRUE(written) << written.error();
        const auto read = read_image_metadata(folder / name);
        ASSERT_TRUE(read) << read.error();
        EXPECT_EQ(*read, some_metadata) << name;
        ASSERT_TRUE(write_any(name, {})) << name;
        EXPECT_THAT(*read_image_metadata(folder / name), IsEmpty()) << name;
    }
}

TEST_F(ImageFile, MetadataAreReadableText) {
    for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr"}) {
        ASSERT_TRUE(write_any(name, some_metadata));
        EXPECT_THAT(read(folder / name), AllOf(HasSubstr("lueur:max_display"), HasSubstr("120.5"))) << name;
    }
}

TEST_F(ImageFile, LosslessFilesKeepEveryPixel) {
    for (const char* name : {"a.png", "a.tif"}) {
        ASSERT_TRUE(write_display_image(folder / name, display_picture(), some_metadata));
        const auto back = read_texture(folder / name);
        ASSERT_TRUE(back) << back.error();
        ASSERT_EQ(back->width, 3);
        ASSERT_EQ(back->height, 2);
        for (std::size_t i = 0; i < 6; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(255 * srgb_encode(back->rgb[i][c]), display_picture().rgb[i][static_cast<std::size_t>(c)],
                            1e-3)
                    << name << i;
    }
}

TEST_F(ImageFile, SixteenBitsAreKept) {
    DeepDisplayImage deep{256, 1, {}};
    for (int i = 0; i < 256; ++i)
        deep.rgb.push_back({static_cast<std::uint16_t>(256 * i + 1), static_cast<std::uint16_t>(65535 - 255 * i),
                            static_cast<std::uint16_t>(i)});
    for (const char* name : {"a.png", "a.tif"}) {
        const auto written = write_display_image(folder / name, deep, some_metadata);
        ASSERT_TRUE(written) << written.error();
        EXPECT_EQ(*read_image_metadata(folder / name), some_metadata) << name;
        const auto back = read_texture(folder / name);
        ASSERT_TRUE(back) << back.error();
        for (std::size_t i = 0; i < 256; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(65535 * srgb_encode(back->rgb[i][c]), deep.rgb[i][static_cast<std::size_t>(c)], 0.2)
                    << name << i;
    }
    const auto jpeg = write_display_image(folder / "a.jpg", deep, {});
    ASSERT_FALSE(jpeg);
    EXPECT_THAT(jpeg.error(), AllOf(HasSubstr("8 bits"), HasSubstr("allowed: .png .tif")));
}

TEST_F(ImageFile, SpectralExrIsReadBackAndNamesItsChannelsAsPublished) {
    SpectralImage image{2, 3, {380, 512.5, 555, 1064.25}, {}};
    RadianceImage preview{2, 3, {}};
    for (std::size_t i = 0; i < 6; ++i)
        preview.xyz.push_back(glm::vec3(xyz_from_rgb(srgb) * Rgb(0.1 * static_cast<double>(i))));
    for (int b = 0; b < 4; ++b) {
        auto& plane = image.planes.emplace_back();
        for (int i = 0; i < 6; ++i) plane.push_back(static_cast<float>(100 * b + i) + 1e-7f);
    }
    const auto written = write_spectral_image(folder / "a.exr", image, preview, some_metadata);
    ASSERT_TRUE(written) << written.error();
    const auto back = read_spectral_image(folder / "a.exr");
    ASSERT_TRUE(back) << back.error();
    EXPECT_EQ(*back, image);
    EXPECT_EQ(*read_image_metadata(folder / "a.exr"), some_metadata);
    const std::string bytes = read(folder / "a.exr");
    for (const char* part : {"S0.380,0nm", "S0.512,5nm", "S0.555,0nm", "S0.1064,25nm", "spectralLayoutVersion", "1.0",
                             "emissiveUnits", "W.m^-2.sr^-1.nm^-1"})
        EXPECT_THAT(bytes, HasSubstr(part));
    // A program that knows nothing of spectra finds R, G and B.
    const auto seen = read_texture(folder / "a.exr");
    ASSERT_TRUE(seen) << seen.error();
    EXPECT_NEAR(seen->rgb[5].g, 0.5, 1e-6);
}

TEST_F(ImageFile, SpectralImagesThatAreNoneAreRefused) {
    const RadianceImage preview{1, 1, {glm::vec3(0)}};
    const auto refused = [&](const SpectralImage& image, const std::string& name, const std::string& what) {
        const auto written = write_spectral_image(folder / name, image, preview, {});
        ASSERT_FALSE(written) << what;
        EXPECT_THAT(written.error(), AllOf(HasSubstr(what), HasSubstr("; allowed: ")));
    };
    refused({1, 1, {500}, {{1.0f}}}, "a.png", "unknown kind of picture");
    refused({1, 1, {}, {}}, "a.exr", "0 wavelengths");
    refused({1, 1, {500, 500}, {{1.0f}, {1.0f}}}, "a.exr", "wavelength 2 is 500 nm");
    refused({1, 1, {-5}, {{1.0f}}}, "a.exr", "wavelength 1 is -5 nm");
    refused({1, 1, {500}, {{1.0f, 2.0f}}}, "a.exr", "plane 1 has 2 pixels");
    refused({1, 1, {500, 600}, {{1.0f}}}, "a.exr", "2 wavelengths with 1 planes");
    refused({2, 1, {500}, {{1.0f}}}, "a.exr", "2 x 1 with 1 pixels");
    EXPECT_THAT(entries(), IsEmpty());
    ASSERT_TRUE(write_radiance_image(folder / "plain.exr", preview, {}));
    EXPECT_THAT(read_spectral_image(folder / "plain.exr").error(), HasSubstr("has no spectral channels"));
}

TEST_F(ImageFile, JpegKeepsColourEdges) { // 4:4:4: red beside blue stays red beside blue
    DisplayImage stripes{16, 16, {}};
    for (int i = 0; i < 256; ++i)
        stripes.rgb.push_back(i % 2 == 0 ? std::array<std::uint8_t, 3>{200, 40, 40}
                                         : std::array<std::uint8_t, 3>{40, 40, 200});
    ASSERT_TRUE(write_display_image(folder / "a.jpg", stripes, {}));
    const auto back = read_texture(folder / "a.jpg");
    ASSERT_TRUE(back);
    for (std::size_t i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(255 * srgb_encode(back->rgb[i][c]), stripes.rgb[i][static_cast<std::size_t>(c)], 12) << i;
}

TEST_F(ImageFile, ExrHoldsLinearSrgbInCandela) {
    // Within 0..1, so that the texture reader, which takes float files as they are, can look at them.
    RadianceImage image{2, 1, {}};
    for (const Rgb& rgb : {Rgb(0.1, 0.2, 0.3), Rgb(1, 0.5, 0)})
        image.xyz.push_back(glm::vec3(xyz_from_rgb(srgb) * rgb));
    for (const char* name : {"a.exr", "a.hdr"}) {
        ASSERT_TRUE(write_radiance_image(folder / name, image, {}));
        const auto back = read_texture(folder / name);
        ASSERT_TRUE(back) << back.error();
        const double tolerance = std::string(name) == "a.exr" ? 1e-6 : 1.0 / 128; // RGBE has 8 bits
        EXPECT_LT(glm::distance(back->rgb[0], glm::vec3(0.1, 0.2, 0.3)), tolerance) << name;
        EXPECT_LT(glm::distance(back->rgb[1], glm::vec3(1, 0.5, 0)), tolerance) << name;
    }
    EXPECT_THAT(read(folder / "a.exr"),
                AllOf(HasSubstr("cd m^-2"), HasSubstr("whiteLuminance"), HasSubstr("chromaticities")));
}

TEST_F(ImageFile, WritingReplacesAndLeavesNothingBeside) {
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(write_any("a.png", some_metadata));
    EXPECT_THAT(entries(), ElementsAre("a.png"));
    const auto permissions = std::filesystem::status(folder / "a.png").permissions();
    EXPECT_NE(permissions & std::filesystem::perms::owner_read, std::filesystem::perms::none);
}

TEST_F(ImageFile, ALinkIsFollowed) {
    write("real.png", "old");
    std::filesystem::create_symlink(folder / "real.png", folder / "link.png");
    ASSERT_TRUE(write_any("link.png", some_metadata));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.png"));
    EXPECT_EQ(*read_image_metadata(folder / "real.png"), some_metadata);
}

TEST_F(ImageFile, RefusesWhatItCannotWrite) {
    const auto expect_fault = [&](const std::expected<void, std::string>& result, const std::string& file,
                                  const std::string& what) {
        ASSERT_FALSE(result) << file;
        EXPECT_THAT(result.error(), AllOf(StartsWith(file + ": "), HasSubstr(what), HasSubstr("; allowed: "),
                                          ::testing::Not(HasSubstr("\n"))));
    };
    const DisplayImage picture = display_picture();
    const auto path = [&](const std::string& name) { return (folder / name).string(); };
    expect_fault(write_display_image(path("a.bmp"), picture, {}), path("a.bmp"), "allowed: .png .jpg .jpeg .tif .tiff");
    expect_fault(write_display_image(path("a.exr"), picture, {}), path("a.exr"), "allowed: .png");
    expect_fault(write_radiance_image(path("a.png"), RadianceImage{1, 1, {glm::vec3(0)}}, {}), path("a.png"),
                 "allowed: .exr .hdr");
    expect_fault(write_display_image(path("a.png"), DisplayImage{}, {}), path("a.png"), "0 x 0");
    expect_fault(write_display_image(path("a.png"), DisplayImage{2, 2, {{1, 2, 3}}}, {}), path("a.png"),
                 "2 x 2 with 1 pixels");
    expect_fault(write_display_image(path("a.png"), picture, {{"max_display", "1"}}), path("a.png"),
                 "metadata key \"max_display\"");
    expect_fault(write_display_image(path("a.png"), picture, {{"lueur:", "1"}}), path("a.png"), "metadata key");
    expect_fault(write_display_image(path("a.png"), picture, {{"lueur:a b", "1"}}), path("a.png"), "metadata key");
    expect_fault(write_display_image(path("a.png"), picture, {{"lueur:" + std::string(61, 'k'), "1"}}), path("a.png"),
                 "metadata key");
    expect_fault(write_display_image(path("a.png"), picture, {{"lueur:a", std::string("\0", 1)}}), path("a.png"),
                 "control character");
    expect_fault(write_display_image(path("none/a.png"), picture, {}), path("none/a.png"), "there is no folder");
    std::filesystem::create_directory(folder / "folder.png");
    expect_fault(write_display_image(path("folder.png"), picture, {}), path("folder.png"), "is a folder");
    EXPECT_THAT(entries(), ElementsAre("folder.png")) << "nothing half-written stays";
    // Not even the superuser can make a file there.
    expect_fault(write_display_image("/proc/lueur.png", picture, {}), "/proc/lueur.png", "cannot be written");
}

TEST_F(ImageFile, AFullDiskLeavesTheOldFileAndNoOther) {
    write("a.png", "the old picture");
    DisplayImage noise{256, 256, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < 256 * 256; ++i) {
        state = state * 1664525u + 1013904223u;
        noise.rgb.push_back({static_cast<std::uint8_t>(state >> 24), static_cast<std::uint8_t>(state >> 16),
                             static_cast<std::uint8_t>(state >> 8)});
    }
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 20000; // bytes a file may have: stands for a disk that fills up
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto result = write_display_image(folder / "a.png", noise, {});
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, old_handler);
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error(), HasSubstr("cannot be written (File too large)"));
    EXPECT_THAT(entries(), ElementsAre("a.png"));
    EXPECT_EQ(read(folder / "a.png"), "the old picture");
}

TEST_F(ImageFile, MetadataOfWhatIsNoPictureAreAnError) {
    EXPECT_THAT(read_image_metadata(folder / "none.png").error(), HasSubstr("there is no such file"));
    EXPECT_THAT(read_image_metadata(write("t.png", "text")).error(), HasSubstr("is not a picture of a known kind"));
}

} // namespace
} // namespace lueur
