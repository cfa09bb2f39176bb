// Draws a snapshot with OpenGL 3.3 into a texture, in two passes: the mesh as linear radiance, then the display
// function over all pixels. A pass runs only when something it shows has changed, so a still picture costs nothing and
// a turn of gamma one pass over the pixels.
//
// Thread: the one that owns the current OpenGL context.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/display/display.h"
#include "editor/snapshot.h"
#include "ui/gl.h"
#include "ui/navigation.h"
#include "ui/ui_state.h"

namespace lueur {

// Views of the mesh pass that hold colours; the others hold one quantity.
constexpr bool shows_colour(ViewMode view) {
    return view == ViewMode::shaded || view == ViewMode::elements || view == ViewMode::luminance ||
           view == ViewMode::side_by_side;
}
FalseColourSettings unshot_scale(float top); // five decades below `top`, lm m^-2

struct RenderParams {
    int width = 0, height = 0; // pixels
    bool still = true;         // nothing moves: worth four samples a pixel. Else as much as fits into a frame
    Camera camera;
    DisplaySettings display;
    ViewMode view = ViewMode::shaded;
    std::optional<ObjectIndex> selected;
    bool highlight_shooting = false;
    float unshot_top = 1; // lm m^-2
    float line_width = 1; // pixels
};

class Renderer {
public:
    static std::expected<std::unique_ptr<Renderer>, std::string> make();

    // Uploads what is new in the snapshot. An empty mesh pointer draws the backdrop.
    void set_snapshot(const Snapshot& snapshot);
    // Draws what is stale. The picture is then in the framebuffer returned, its first row the lowest; it may have fewer
    // pixels than were asked for while things move, and is to be stretched.
    struct Picture {
        GLuint framebuffer = 0, texture = 0;
        int width = 0, height = 0;
        int samples = 1;
    };
    Picture draw(const RenderParams& params);

    double draw_seconds() const { return draw_seconds_; } // of the last call of draw that drew
    bool drew_mesh() const { return drew_mesh_; }         // in the last call of draw
    const Bounds& bounds() const { return bounds_; }
    // Shares of what is seen that the marks would mark; 0 while no colour is shown.
    DisplayShares shares(const DisplaySettings& display);

private:
    Renderer() = default;

    static constexpr std::size_t elements_a_block = 64; // that are looked at as one when choosing what is seen

    struct Batch { // elements that share a texture
        const TextureImage* image = nullptr;
        MaterialIndex material{};
        std::size_t first = 0, count = 0;     // elements
        std::size_t first_seen = 0, seen = 0; // of those that may be seen from the camera, see choose_seen
    };
    struct Target {
        int width = 0, height = 0, samples = 0;
        GlTexture seen, depth, shown;
        GlFramebuffer mesh_pass, display_pass;
    };

    void upload_mesh(const Mesh& mesh, const Scene& scene);
    void upload_elements(const Mesh& mesh, const Scene& scene);
    void upload_field(const Field& field);
    void choose_seen(const glm::mat4& clip_from_world, glm::vec3 eye, float smallest); // smallest: an edge's angle, rad
    void make_target(int width, int height, int samples);
    void draw_mesh(const RenderParams& params, double max_display);
    // Variants of the display shader: each a set of these.
    enum DisplayVariant : unsigned { many_samples = 1, plain_colour = 2, with_outline = 4 };
    void draw_display(const RenderParams& params, double divisor); // ui/renderer_display.cpp, as all below
    unsigned display_variant(const RenderParams& params) const;
    const RadianceImage& seen_radiance();
    bool many_samples_are_cheap() const;
    void adapt_resolution(double seconds);

    std::map<unsigned, GlProgram> mesh_programs_; // by their variants, see renderer.cpp
    std::array<GlProgram, 8> display_programs_;   // by theirs: DisplayVariant
    GlVertexArray vertex_array_, no_vertices_;
    struct ShadeBuffers {
        GlBuffer reflected, emitted, by_texel;
    };
    void use_shades(const ShadeBuffers& shades);
    void draw_batches(const RenderParams& params, unsigned variant, const glm::mat4& clip, double max_display);

    GlBuffer positions_, uvs_, objects_, unshot_, illuminance_, difference_, error_, elements_, coarse_;
    ShadeBuffers shades_, trichromatic_; // the second is used when the two are compared
    GlTexture coarse_texture_;
    std::map<const TextureImage*, GlTexture> textures_;
    std::vector<Batch> batches_;
    // In drawing order: the elements, their patches, their planes (normal, offset), and spheres around each 64 of them
    // (centre, radius).
    std::vector<glm::uvec3> ordered_elements_;
    std::vector<std::uint32_t> ordered_patches_;
    std::vector<glm::vec4> planes_, spheres_;
    std::vector<std::shared_ptr<const TextureImage>> surface_images_; // of the batches, one a surface
    std::vector<MaterialIndex> surface_materials_;
    Target targets_[2]; // of one sample and of many
    Target* target_ = nullptr;
    const Target* drawn_target_ = nullptr; // that holds the last mesh pass
    Bounds bounds_;

    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const Mesh> mesh_;
    std::shared_ptr<const Field> field_;
    std::uint32_t shooting_ = no_index;
    bool stale_ = true, any_texture_ = false;
    std::optional<RenderParams> mesh_drawn_, display_drawn_;
    double drawn_max_display_ = 1;
    std::optional<RadianceImage> seen_radiance_; // of the last mesh pass, once asked for
    std::optional<DisplaySettings> shares_of_;   // the settings that shares_ is of
    DisplayShares shares_;
    double draw_seconds_ = 0, seconds_of_one_ = 0, seconds_of_many_ = 0;
    std::size_t resolution_ = 0; // of moving pictures, an index into the steps in renderer.cpp
    bool drew_mesh_ = false;
};

} // namespace lueur
