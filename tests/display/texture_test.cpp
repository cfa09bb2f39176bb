// Textures of each kind, good and broken.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/display/image_file.h"
#include "tests/display/png_bytes.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using namespace std::string_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Texture : public test::FolderTest {
protected:
    static void expect_texels(const std::expected<TextureImage, std::string>& texture, int width, int height,
                              const std::vector<Rgb>& encoded) { // sRGB codes 0..1
        ASSERT_TRUE(texture) << texture.error();
        EXPECT_EQ(texture->width, width);
        EXPECT_EQ(texture->height, height);
        ASSERT_EQ(texture->rgb.size(), encoded.size());
        for (std::size_t i = 0; i < encoded.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(texture->rgb[i][c], srgb_decode(encoded[i][c]), 1e-6) << i << "," << c;
    }
    // One line, which begins with the file and ends with what is allowed.
    static void expect_refused(const std::expected<TextureImage, std::string>& texture, const std::string& file,
                               const std::string& what) {
        ASSERT_FALSE(texture) << file;
        EXPECT_THAT(texture.error(),
                    AllOf(StartsWith(file + ": "), HasSubstr(what), HasSubstr("; allowed: "), Not(HasSubstr("\n"))));
    }
    // A reflectance as an .exr: what the writer makes of XYZ.
    std::filesystem::path write_exr(const std::vector<Rgb>& linear) const {
        RadianceImage image{static_cast<int>(linear.size()), 1, {}};
        for (const Rgb& rgb : linear) image.xyz.push_back(glm::vec3(xyz_from_rgb(srgb) * rgb));
        EXPECT_TRUE(write_radiance_image(folder / "linear.exr", image, {}));
        return folder / "linear.exr";
    }
};

TEST_F(Texture, EightBitRgbIsDecodedFromSrgbTopLeftFirst) {
    const auto file = write("t.png", png_bytes(2, 2, 8, PngColour::rgb,
                                               "\xff\x00\x00"
                                               "\x00\xff\x00"
                                               "\x00\x00\xff"
                                               "\x80\x40\x20"s));
    expect_texels(read_texture(file), 2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {128 / 255.0, 64 / 255.0, 32 / 255.0}});
}

TEST_F(Texture, SixteenBitRgbKeepsItsPrecision) {
    const auto file = write("t.png", png_bytes(1, 1, 16, PngColour::rgb, "\x12\x34\xab\xcd\xff\xff"s));
    expect_texels(read_texture(file), 1, 1, {{0x1234 / 65535.0, 0xabcd / 65535.0, 1}});
}

TEST_F(Texture, GreyBecomesThreeEqualChannels) {
    expect_texels(read_texture(write("8.png", png_bytes(2, 1, 8, PngColour::grey, "\x00\x80"s))), 2, 1,
                  {Rgb(0), Rgb(128 / 255.0)});
    expect_texels(read_texture(write("16.png", png_bytes(1, 1, 16, PngColour::grey, "\x40\x00"s))), 1, 1,
                  {Rgb(0x4000 / 65535.0)});
    expect_texels(read_texture(write("1.png", png_bytes(8, 1, 1, PngColour::grey, "\xa0"s))), 8, 1,
                  {Rgb(1), Rgb(0), Rgb(1), Rgb(0), Rgb(0), Rgb(0), Rgb(0), Rgb(0)});
}

TEST_F(Texture, PalettesAreExpanded) {
    const auto file = write(
        "t.png", png_bytes(3, 1, 8, PngColour::palette, "\x02\x00\x01"s, "\xff\x00\x00\x00\xff\x00\x40\x50\x60"s));
    expect_texels(read_texture(file), 3, 1, {{64 / 255.0, 80 / 255.0, 96 / 255.0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_F(Texture, AlphaIsDroppedAndDarkensNothing) {
    const auto rgba = write("rgba.png", png_bytes(2, 1, 8, PngColour::rgb_alpha, "\xff\x80\x40\x00\xff\x80\x40\x80"s));
    expect_texels(read_texture(rgba), 2, 1, {{1, 128 / 255.0, 64 / 255.0}, {1, 128 / 255.0, 64 / 255.0}});
    const auto grey = write("ga.png", png_bytes(2, 1, 8, PngColour::grey_alpha, "\x80\x00\x80\xff"s));
    expect_texels(read_texture(grey), 2, 1, {Rgb(128 / 255.0), Rgb(128 / 255.0)});
}

// gAMA holds 100000 / exponent; sRGB its rendering intent (ISO/IEC 15948, 11.3.3).
TEST_F(Texture, TheTaggedColourSpaceIsFollowed) {
    const auto texel = [&](const std::string& chunks, std::uint8_t bits) {
        const std::string code = bits == 16 ? "\x80\x80"s : "\x80"s; // 128/255 either way
        const auto texture = read_texture(write("t.png", png_bytes(1, 1, bits, PngColour::grey, code, {}, chunks)));
        EXPECT_TRUE(texture) << texture.error();
        return texture ? static_cast<double>(texture->rgb[0].g) : -1;
    };
    const auto gamma = [](std::uint32_t value) {
        return png_chunk("gAMA", {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
                                  static_cast<char>(value >> 8), static_cast<char>(value)});
    };
    const double code = 128 / 255.0;
    for (const std::uint8_t bits : {std::uint8_t{8}, std::uint8_t{16}}) {
        EXPECT_NEAR(texel("", bits), srgb_decode(code), 1e-6) << "no word is sRGB";
        EXPECT_NEAR(texel(png_chunk("sRGB", "\0"s), bits), srgb_decode(code), 1e-6);
        EXPECT_NEAR(texel(gamma(45455) + png_chunk("sRGB", "\0"s), bits), srgb_decode(code), 1e-6)
            << "sRGB goes before gAMA";
        EXPECT_NEAR(texel(gamma(100000), bits), code, 1e-6) << "linear";
        EXPECT_NEAR(texel(gamma(45455), bits), std::pow(code, 2.2), 1e-6);
        EXPECT_NEAR(texel(gamma(55556), bits), std::pow(code, 1.8), 1e-6);
        EXPECT_NEAR(texel(gamma(1), bits), srgb_decode(code), 1e-6) << "an exponent of 100000 is no curve";
    }
}

TEST_F(Texture, FewBitsAreSpreadOverTheWholeRange) {
    expect_texels(read_texture(write("2.png", png_bytes(4, 1, 2, PngColour::grey, "\x1b"s))), 4, 1,
                  {Rgb(0), Rgb(1 / 3.0), Rgb(2 / 3.0), Rgb(1)});
    expect_texels(read_texture(write("4.png", png_bytes(2, 1, 4, PngColour::grey, "\x0f"s))), 2, 1, {Rgb(0), Rgb(1)});
    expect_texels(
        read_texture(write("p.png", png_bytes(2, 1, 1, PngColour::palette, "\x40"s, "\x10\x20\x30\xff\x00\x80"s))), 2,
        1, {{16 / 255.0, 32 / 255.0, 48 / 255.0}, {1, 0, 128 / 255.0}});
}

TEST_F(Texture, JpegAndTiffAreRead) {
    const DisplayImage grey{8, 8, std::vector<std::array<std::uint8_t, 3>>(64, {128, 128, 128})};
    for (const char* name : {"t.jpg", "t.tif"}) {
        ASSERT_TRUE(write_display_image(folder / name, grey, {}));
        const auto texture = read_texture(folder / name);
        ASSERT_TRUE(texture) << texture.error();
        ASSERT_EQ(texture->rgb.size(), 64u);
        for (const glm::vec3& texel : texture->rgb) EXPECT_NEAR(texel.g, srgb_decode(128 / 255.0), 0.005);
    }
}

TEST_F(Texture, FloatFilesAreLinear) {
    const auto texture = read_texture(write_exr({{0.25, 0.5, 0.75}, {0, 1, 0.125}}));
    ASSERT_TRUE(texture) << texture.error();
    EXPECT_LT(glm::distance(texture->rgb[0], glm::vec3(0.25, 0.5, 0.75)), 1e-6);
    EXPECT_LT(glm::distance(texture->rgb[1], glm::vec3(0, 1, 0.125)), 1e-6);
    for (const glm::vec3& texel : texture->rgb)
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(texel[c] >= 0 && texel[c] <= 1);
}

TEST_F(Texture, FloatFilesThatAreNoReflectanceAreTold) {
    expect_refused(read_texture(write_exr({Rgb(0.5), {1, 1.5, 1}})), (folder / "linear.exr").string(),
                   "holds the value 1.5");
    expect_refused(read_texture(write_exr({{0.5, -0.5, 0.5}})), (folder / "linear.exr").string(),
                   "holds the value -0.5");
    expect_refused(read_texture(write_exr({Rgb(std::numeric_limits<double>::quiet_NaN())})),
                   (folder / "linear.exr").string(), "nan");
}

TEST_F(Texture, IsKnownByItsBytesWhateverItsName) {
    const std::string png = png_bytes(1, 1, 8, PngColour::grey, "\x80"s);
    expect_texels(read_texture(write("really_a.jpg", png)), 1, 1, {Rgb(128 / 255.0)});
    expect_texels(read_texture(write("no_name_at_all", png)), 1, 1, {Rgb(128 / 255.0)});
}

TEST_F(Texture, FromMemoryIsTheSameAsFromAFile) {
    const std::string png = png_bytes(2, 1, 8, PngColour::rgb, "\x10\x20\x30\x40\x50\x60"s);
    const auto from_file = read_texture(write("t.png", png));
    const auto from_memory = read_texture_memory(std::as_bytes(std::span(png)), "*0");
    ASSERT_TRUE(from_file);
    ASSERT_TRUE(from_memory) << from_memory.error();
    EXPECT_EQ(*from_file, *from_memory);

    ASSERT_TRUE(write_display_image(folder / "t.jpg", DisplayImage{1, 1, {{200, 100, 50}}}, {}));
    const std::string jpeg = read(folder / "t.jpg");
    const auto jpeg_memory = read_texture_memory(std::as_bytes(std::span(jpeg)), "*1");
    ASSERT_TRUE(jpeg_memory) << jpeg_memory.error();
    EXPECT_EQ(*read_texture(folder / "t.jpg"), *jpeg_memory);

    expect_refused(read_texture_memory({}, "*2"), "*2", "is empty");
    expect_refused(read_texture_memory(std::as_bytes(std::span(png)).first(40), "*3"), "*3", "is broken");
    const std::string text = "hello";
    expect_refused(read_texture_memory(std::as_bytes(std::span(text)), "*4"), "*4", "not a picture");
}

TEST_F(Texture, WhatIsNoPictureIsToldInOneLine) {
    expect_refused(read_texture(folder / "none.png"), (folder / "none.png").string(), "there is no such file");
    expect_refused(read_texture(folder), folder.string(), "is a folder");
    expect_refused(read_texture("/dev/zero"), "/dev/zero", "is not a file");
    const auto empty = write("empty.png", "");
    expect_refused(read_texture(empty), empty.string(), "is empty");
    const auto text = write("text.png", "not a picture at all");
    expect_refused(read_texture(text), text.string(), "is not a picture of a known kind");
    const auto wrong_kind = write("picture.null", "null");
    expect_refused(read_texture(wrong_kind), wrong_kind.string(), "is not a picture of a known kind");
}

TEST_F(Texture, TruncatedFilesAreToldWhateverTheirKind) {
    DisplayImage noise{64, 64, {}};
    RadianceImage radiance{64, 64, {}};
    std::uint32_t state = 1;
    for (int i = 0; i < 64 * 64; ++i) {
        state = state * 1664525u + 1013904223u;
        noise.rgb.push_back({static_cast<std::uint8_t>(state >> 24), static_cast<std::uint8_t>(state >> 16),
                             static_cast<std::uint8_t>(state >> 8)});
        radiance.xyz.push_back(glm::vec3(xyz_from_rgb(srgb) * Rgb(static_cast<double>(state >> 8) / (1 << 24))));
    }
    for (const char* name : {"t.png", "t.jpg", "t.tif", "t.exr", "t.hdr"}) {
        const auto file = folder / name;
        const auto written = is_radiance_image_name(file) ? write_radiance_image(file, radiance, {})
                                                          : write_display_image(file, noise, {});
        ASSERT_TRUE(written) << written.error();
        const std::string whole = read(file);
        ASSERT_TRUE(read_texture(file)) << name;
        for (const double share : {0.02, 0.3, 0.7}) {
            const std::string part =
                whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
            const auto cut = read_texture(write("cut_"s + name, part));
            ASSERT_FALSE(cut) << name << " cut at " << share;
            EXPECT_THAT(cut.error(), AllOf(StartsWith((folder / ("cut_"s + name)).string()), Not(HasSubstr("\n"))));
        }
    }
}

TEST_F(Texture, AFlippedBitOfAPngIsTold) {
    const std::string png = png_bytes(2, 1, 8, PngColour::rgb, "\x10\x20\x30\x40\x50\x60"s);
    for (std::size_t i = 0; i < png.size(); ++i) {
        std::string flipped = png;
        flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
        EXPECT_FALSE(read_texture_memory(std::as_bytes(std::span(flipped)), "*0")) << "byte " << i;
    }
}

TEST_F(Texture, AHeaderThatPromisesTooMuchAllocatesNothing) {
    const auto huge = write("huge.png", png_bytes(60000, 60000, 8, PngColour::grey, std::string(60000, 'x')));
    expect_refused(read_texture(huge), huge.string(), "too large a texture");
}

} // namespace
} // namespace lueur
