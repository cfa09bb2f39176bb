#include "core/display/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/display/metadata_text.h"
#include "core/display/png_check.h"
#include "core/display/replace_file.h"

namespace lueur {

namespace {

constexpr std::string_view readable = "allowed: a .png, .jpg, .tif, .exr, .hdr, .bmp or .tga picture";
constexpr std::int64_t max_pixels = std::int64_t{1} << 26; // 8192 x 8192: what a broken header may make us allocate

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

// OpenImageIO's name of the format to write; empty when there is none.
std::string_view writable_format(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == ".png") return "png";
    if (extension == ".jpg" || extension == ".jpeg") return "jpeg";
    if (extension == ".tif" || extension == ".tiff") return "tiff";
    if (extension == ".exr") return "openexr";
    if (extension == ".hdr") return "hdr";
    return "";
}

// A file is what its first bytes say, whatever its name; only Targa has no mark of its own.
std::string_view format_of_bytes(std::string_view bytes, const std::string& name) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
    if (bytes.starts_with("\xFF\xD8\xFF"sv)) return "jpeg";
    if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
        bytes.starts_with("MM\0+"sv))
        return "tiff";
    if (bytes.starts_with("\x76\x2F\x31\x01"sv)) return "openexr";
    if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) return "hdr";
    if (bytes.starts_with("BM"sv)) return "bmp";
    if (extension_of(name) == ".tga") return "targa";
    return "";
}

std::string one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
    return text.empty() ? "no reason known" : text;
}

std::expected<std::vector<unsigned char>, std::string> read_bytes(const std::filesystem::path& file) {
    const auto fault = [&](std::string_view what) {
        return std::unexpected(fmt::format("{}: {}; {}", file.string(), what, readable));
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) return fault("there is no such file");
    if (std::filesystem::is_directory(status)) return fault("is a folder");
    if (!std::filesystem::is_regular_file(status)) return fault("is not a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return fault("cannot be read");
    std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (bytes.empty()) return fault("is empty");
    return bytes;
}

// An opened picture in memory. The bytes outlive it.
struct Reader {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> input; // destroyed before the memory it reads
    OIIO::ImageSpec spec;
};

std::expected<Reader, std::string> open_bytes(std::span<const unsigned char> bytes, const std::string& name) {
    const auto fault = [&](const std::string& what) {
        return std::unexpected(fmt::format("{}: {}; {}", name, what, readable));
    };
    const std::string_view format = format_of_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
    if (format.empty()) return fault("is not a picture of a known kind");
    if (format == "png" && !is_whole_png(bytes)) return fault("is broken (cut short, or a checksum is wrong)");
    Reader reader;
    reader.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    reader.input = OIIO::ImageInput::create(OIIO::string_view(format.data(), format.size()));
    if (!reader.input) {
        return fault(fmt::format("no reader of {} pictures ({})", format, one_line(OIIO::geterror())));
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // colours as stored, not darkened by an alpha that we drop
    reader.input->set_ioproxy(reader.memory.get());
    if (!reader.input->open(name, reader.spec, config))
        return fault(fmt::format("is broken ({})", one_line(reader.input->geterror())));
    return reader;
}

// Encodes in memory and puts the bytes in place, so that a full disk is noticed and no half file is seen.
std::expected<void, std::string> write_image(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
                                             OIIO::TypeDesc type, const void* pixels) {
    const std::string_view format = writable_format(file);
    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create(OIIO::string_view(format.data(), format.size()));
    if (!output)
        return std::unexpected(fmt::format("{}: no writer of {} pictures ({}); allowed: .png .jpg .tif .exr .hdr",
                                           file.string(), format, one_line(OIIO::geterror())));
    output->set_ioproxy(&memory);
    if (!output->open(file.string(), spec) || !output->write_image(type, pixels) || !output->close())
        return std::unexpected(fmt::format("{}: cannot be encoded ({}); allowed: a picture that {} can hold",
                                           file.string(), one_line(output->geterror()), format));
    return replace_file(file, memory.buffer());
}

// What is wrong before anything is encoded.
std::expected<void, std::string> check_picture(const std::filesystem::path& file, int width, int height,
                                               std::size_t pixels, const ImageMetadata& metadata, bool name_is_right,
                                               std::string_view allowed_names) {
    if (!name_is_right)
        return std::unexpected(fmt::format("{}: unknown kind of picture \"{}\"; allowed: {}", file.string(),
                                           file.extension().string(), allowed_names));
    if (width <= 0 || height <= 0 || pixels != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        return std::unexpected(
            fmt::format("{}: a picture of {} x {} with {} pixels; allowed: one pixel or more, as many as its size says",
                        file.string(), width, height, pixels));
    if (const auto fault = metadata_fault(metadata))
        return std::unexpected(fmt::format("{}: {}", file.string(), *fault));
    return {};
}

// The curve of a picture that the display's settings in its metadata say was made for an sRGB monitor; other pictures
// are sent to their own monitor as they are, and say nothing.
bool is_srgb(const ImageMetadata& metadata) {
    const auto says = [&](const char* key, std::string_view what) {
        const auto found = metadata.find(key);
        return found == metadata.end() || found->second == what;
    };
    return says("lueur:curve", "srgb") && says("lueur:primaries", "srgb");
}

template <typename Image>
std::expected<void, std::string> write_codes(const std::filesystem::path& file, const Image& image,
                                             const ImageMetadata& metadata, OIIO::TypeDesc type) {
    const auto checked = check_picture(file, image.width, image.height, image.rgb.size(), metadata,
                                       is_display_image_name(file), ".png .jpg .jpeg .tif .tiff");
    if (!checked) return checked;
    OIIO::ImageSpec spec(image.width, image.height, 3, type);
    // Not for TIFF: it makes an EXIF directory, and OpenImageIO before 2.5 cannot write one to memory (its pull request
    // 4300).
    if (writable_format(file) != "tiff" && is_srgb(metadata)) spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", "Lueur " LUEUR_VERSION);
    if (writable_format(file) == "png") {
        for (const auto& [key, value] : metadata) spec.attribute(key, value);
    } else {
        if (!metadata.empty()) spec.attribute("ImageDescription", text_from_metadata(metadata));
    }
    if (writable_format(file) == "jpeg") {
        spec.attribute("Compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    return write_image(file, spec, type, image.rgb.data());
}

// 500 -> "S0.500,0nm".
std::string spectral_channel_name(double nm) {
    std::string digits = fmt::format("{}", nm);
    if (digits.find('.') == std::string::npos) digits += ".0";
    std::ranges::replace(digits, '.', ',');
    return "S0." + digits + "nm";
}

std::optional<double> wavelength_of_channel(std::string name) {
    if (!name.starts_with("S0.") || !name.ends_with("nm")) return {};
    name = name.substr(3, name.size() - 5);
    std::ranges::replace(name, ',', '.');
    double nm = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), nm);
    if (error != std::errc() || end != name.data() + name.size() || !(nm > 0)) return {};
    return nm;
}

// 16 bit sRGB code -> linear; an 8 bit code c is 257 c.
const std::vector<float>& srgb_decode_table() {
    static const std::vector<float> table = [] {
        std::vector<float> linear;
        for (int code = 0; code <= 65535; ++code) linear.push_back(static_cast<float>(srgb_decode(code / 65535.0)));
        return linear;
    }();
    return table;
}

// The exponent that a picture says its codes were made with, 1 for linear; 0: sRGB, which is also what no word means.
double tagged_gamma(const OIIO::ImageSpec& spec) {
    const std::string space(spec.get_string_attribute("oiio:ColorSpace"));
    if (space == "linear" || space == "Linear") return 1;
    if (!space.starts_with("Gamma")) return 0; // "Gamma2.2" or "GammaCorrected2.2", by the version
    const double gamma = static_cast<double>(spec.get_float_attribute("oiio:Gamma", 0));
    return gamma >= 0.1 && gamma <= 10 ? gamma : 0;
}

std::expected<TextureImage, std::string> decode_texture(std::span<const unsigned char> bytes, const std::string& name) {
    auto reader = open_bytes(bytes, name);
    if (!reader) return std::unexpected(reader.error());
    const OIIO::ImageSpec& spec = reader->spec;
    const auto fault = [&](const std::string& what) {
        return std::unexpected(fmt::format("{}: {}; {}", name, what, readable));
    };
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) return fault("has no pixels");
    if (static_cast<std::int64_t>(spec.width) * spec.height > max_pixels)
        return fault(
            fmt::format("is {} x {}, too large a texture; at most {} pixels", spec.width, spec.height, max_pixels));

    const int channels = spec.nchannels >= 3 ? 3 : 1; // one is grey; two are grey and alpha
    const std::size_t count = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    TextureImage texture{spec.width, spec.height, std::vector<glm::vec3>(count)};
    const auto fill = [&](const auto& linear) { // linear(i): value i of the interleaved picture
        for (std::size_t i = 0; i < count; ++i)
            texture.rgb[i] =
                channels == 1 ? glm::vec3(linear(i)) : glm::vec3(linear(3 * i), linear(3 * i + 1), linear(3 * i + 2));
    };
    const std::size_t values = count * static_cast<std::size_t>(channels);
    const auto read = [&](OIIO::TypeDesc type, void* into) {
        return reader->input->read_image(0, 0, 0, channels, type, into) && !reader->input->has_error();
    };
    if (spec.format.is_floating_point()) {
        std::vector<float> linear(values);
        if (!read(OIIO::TypeDesc::FLOAT, linear.data()))
            return fault(fmt::format("is broken ({})", one_line(reader->input->geterror())));
        constexpr float slack = 1e-3f; // of filtering and half precision
        const auto wrong = std::ranges::find_if(linear, [](float v) { return !(v >= -slack && v <= 1 + slack); });
        if (wrong != linear.end())
            return std::unexpected(
                fmt::format("{}: holds the value {}; allowed: a texture is a reflectance, 0 to 1", name, *wrong));
        fill([&](std::size_t i) { return std::clamp(linear[i], 0.0f, 1.0f); });
    } else {
        std::vector<std::uint16_t> codes(values);
        if (!read(OIIO::TypeDesc::UINT16, codes.data()))
            return fault(fmt::format("is broken ({})", one_line(reader->input->geterror())));
        const double gamma = tagged_gamma(spec);
        if (gamma > 0)
            fill([&](std::size_t i) { return static_cast<float>(std::pow(codes[i] / 65535.0, gamma)); });
        else
            fill([&](std::size_t i) { return srgb_decode_table()[codes[i]]; });
    }
    return texture;
}

} // namespace

bool is_radiance_image_name(const std::filesystem::path& file) {
    const std::string_view format = writable_format(file);
    return format == "openexr" || format == "hdr";
}

bool is_display_image_name(const std::filesystem::path& file) {
    return !writable_format(file).empty() && !is_radiance_image_name(file);
}

bool is_jpeg_name(const std::filesystem::path& file) {
    return writable_format(file) == "jpeg";
}

std::expected<void, std::string> write_display_image(const std::filesystem::path& file, const DisplayImage& image,
                                                     const ImageMetadata& metadata) {
    return write_codes(file, image, metadata, OIIO::TypeDesc::UINT8);
}

std::expected<void, std::string> write_display_image(const std::filesystem::path& file, const DeepDisplayImage& image,
                                                     const ImageMetadata& metadata) {
    if (is_jpeg_name(file))
        return std::unexpected(
            fmt::format("{}: a JPEG holds 8 bits a channel; allowed: .png .tif for 16 bits", file.string()));
    return write_codes(file, image, metadata, OIIO::TypeDesc::UINT16);
}

std::expected<void, std::string> write_radiance_image(const std::filesystem::path& file, const RadianceImage& image,
                                                      const ImageMetadata& metadata) {
    const auto checked = check_picture(file, image.width, image.height, image.xyz.size(), metadata,
                                       is_radiance_image_name(file), ".exr .hdr");
    if (!checked) return checked;
    const glm::dmat3 rgb_from = rgb_from_xyz(srgb);
    std::vector<glm::vec3> rgb;
    rgb.reserve(image.xyz.size());
    for (const glm::vec3& xyz : image.xyz) rgb.push_back(glm::vec3(rgb_from * Xyz(xyz)));

    OIIO::ImageSpec spec(image.width, image.height, 3,
                         OIIO::TypeDesc::FLOAT); // a lamp of 1e6 cd m^-2 is too bright for half
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("Software", "Lueur " LUEUR_VERSION);
    if (writable_format(file) == "openexr") {
        spec.attribute("compression", "zip");
        // The text repeats the attributes below for viewers that show nothing else, and keeps empty values, which
        // attributes lose.
        spec.attribute("ImageDescription", "Radiance as linear sRGB (IEC 61966-2-1 primaries), in cd m^-2\n" +
                                               text_from_metadata(metadata));
        const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
        spec.attribute("whiteLuminance", 1.0f); // cd m^-2 of RGB (1,1,1)
        for (const auto& [key, value] : metadata) spec.attribute(key, value);
    }
    return write_image(file, spec, OIIO::TypeDesc::FLOAT, rgb.data());
}

std::expected<void, std::string> write_spectral_image(const std::filesystem::path& file, const SpectralImage& image,
                                                      const RadianceImage& preview, const ImageMetadata& metadata) {
    const std::size_t count = preview.xyz.size(), bands = image.nm.size();
    const auto checked =
        check_picture(file, image.width, image.height, count, metadata, writable_format(file) == "openexr", ".exr");
    if (!checked) return checked;
    const auto fault = [&](const std::string& what) {
        return std::unexpected(
            fmt::format("{}: {}; allowed: one plane of {} x {} pixels for each of one or more rising "
                        "wavelengths above 0 nm",
                        file.string(), what, image.width, image.height));
    };
    if (bands == 0 || image.planes.size() != bands)
        return fault(fmt::format("{} wavelengths with {} planes", bands, image.planes.size()));
    for (std::size_t b = 0; b < bands; ++b) {
        if (!std::isfinite(image.nm[b]) || image.nm[b] <= (b == 0 ? 0 : image.nm[b - 1]))
            return fault(fmt::format("wavelength {} is {} nm", b + 1, image.nm[b]));
        if (image.planes[b].size() != count)
            return fault(fmt::format("plane {} has {} pixels", b + 1, image.planes[b].size()));
    }
    const std::size_t channels = 3 + bands;
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(channels), OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B"};
    for (const double nm : image.nm) spec.channelnames.push_back(spectral_channel_name(nm));
    spec.attribute("compression", "zip");
    spec.attribute("Software", "Lueur " LUEUR_VERSION);
    spec.attribute("spectralLayoutVersion", "1.0");
    spec.attribute("emissiveUnits", "W.m^-2.sr^-1.nm^-1");
    spec.attribute("ImageDescription",
                   "Spectral radiance, one channel a wavelength; R, G, B: linear sRGB in cd m^-2\n" +
                       text_from_metadata(metadata));
    for (const auto& [key, value] : metadata) spec.attribute(key, value);

    const glm::dmat3 rgb_from = rgb_from_xyz(srgb);
    std::vector<float> values;
    values.reserve(count * channels);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 rgb(rgb_from * Xyz(preview.xyz[i]));
        values.insert(values.end(), {rgb.r, rgb.g, rgb.b});
        for (const auto& plane : image.planes) values.push_back(plane[i]);
    }
    return write_image(file, spec, OIIO::TypeDesc::FLOAT, values.data());
}

std::expected<SpectralImage, std::string> read_spectral_image(const std::filesystem::path& file) {
    const auto bytes = read_bytes(file);
    if (!bytes) return std::unexpected(bytes.error());
    auto reader = open_bytes(*bytes, file.string());
    if (!reader) return std::unexpected(reader.error());
    const OIIO::ImageSpec& spec = reader->spec;
    std::map<double, int> channels; // nm -> index
    for (int c = 0; c < spec.nchannels; ++c)
        if (const auto nm = wavelength_of_channel(spec.channelnames[static_cast<std::size_t>(c)])) channels[*nm] = c;
    const auto size = static_cast<std::int64_t>(spec.width) * spec.height;
    if (channels.empty() || size <= 0 || size * spec.nchannels > 8 * max_pixels)
        return std::unexpected(fmt::format("{}: has no spectral channels, or too many pixels; allowed: an EXR with "
                                           "channels S0.NNN,Nnm",
                                           file.string()));
    const std::size_t count = static_cast<std::size_t>(size), stride = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> values(count * stride);
    if (!reader->input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        return std::unexpected(fmt::format("{}: is broken ({})", file.string(), one_line(reader->input->geterror())));
    SpectralImage image{spec.width, spec.height, {}, {}};
    for (const auto& [nm, channel] : channels) {
        image.nm.push_back(nm);
        auto& plane = image.planes.emplace_back(count);
        for (std::size_t i = 0; i < count; ++i) plane[i] = values[i * stride + static_cast<std::size_t>(channel)];
    }
    return image;
}

std::expected<ImageMetadata, std::string> read_image_metadata(const std::filesystem::path& file) {
    const auto bytes = read_bytes(file);
    if (!bytes) return std::unexpected(bytes.error());
    const auto reader = open_bytes(*bytes, file.string());
    if (!reader) return std::unexpected(reader.error());
    ImageMetadata metadata = metadata_from_text(std::string(reader->spec.get_string_attribute("ImageDescription")));
    for (const OIIO::ParamValue& attribute : reader->spec.extra_attribs) {
        const std::string key = attribute.name().string();
        if (key.starts_with(metadata_prefix) && attribute.type() == OIIO::TypeDesc::STRING)
            metadata[key] = attribute.get_string();
    }
    return metadata;
}

std::expected<TextureImage, std::string> read_texture(const std::filesystem::path& file) {
    const auto bytes = read_bytes(file);
    if (!bytes) return std::unexpected(bytes.error());
    return decode_texture(*bytes, file.string());
}

std::expected<TextureImage, std::string> read_texture_memory(std::span<const std::byte> encoded,
                                                             const std::string& name) {
    if (encoded.empty()) return std::unexpected(fmt::format("{}: is empty; {}", name, readable));
    return decode_texture({reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size()}, name);
}

} // namespace lueur
