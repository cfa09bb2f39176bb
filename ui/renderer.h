// Draws a snapshot with OpenGL 3.3 into a texture, in two passes: the mesh as linear radiance, then the display function over all pixels.
// A pass runs only when something it shows has changed, so a still picture costs nothing and a turn of gamma one pass over the pixels.
//
// Thread: the one that owns the current OpenGL context.
#pragma once

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

struct RenderParams {
    int width = 0, height = 0; // pixels
    int samples = 1;           // of a pixel: 1 or 4
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
    // Draws what is stale and returns the texture with the displayed picture, its first row the lowest.
    GLuint draw(const RenderParams& params);

    double mesh_seconds() const { return mesh_seconds_; } // the last time the mesh was drawn
    bool many_samples_are_cheap() const;                   // 4 a pixel fit into a frame while things move
    bool drew_mesh() const { return drew_mesh_; }         // in the last call of draw
    const Bounds& bounds() const { return bounds_; }

private:
    Renderer() = default;

    struct Batch { // elements that share a texture
        const TextureImage* image = nullptr;
        MaterialIndex material{};
        std::size_t first = 0, count = 0; // elements
    };
    struct Target {
        int width = 0, height = 0, samples = 0;
        GlTexture seen, depth, shown;
        GlFramebuffer mesh_pass, display_pass;
    };

    void upload_mesh(const Mesh& mesh, const Scene& scene);
    void upload_elements(const Mesh& mesh, const Scene& scene);
    void upload_field(const Field& field);
    void make_target(int width, int height, int samples);
    void draw_mesh(const RenderParams& params, double max_display);
    void draw_display(const RenderParams& params, double max_display);
    double largest_component_seen();

    std::map<unsigned, GlProgram> mesh_programs_; // by their variants, see renderer.cpp
    GlProgram display_one_, display_many_;
    GlVertexArray vertex_array_, no_vertices_;
    GlBuffer positions_, uvs_, objects_, reflected_, emitted_, unshot_, elements_, coarse_;
    GlTexture coarse_texture_;
    std::map<const TextureImage*, GlTexture> textures_;
    std::vector<Batch> batches_;
    std::vector<std::shared_ptr<const TextureImage>> surface_images_; // of the batches, one a surface
    std::vector<MaterialIndex> surface_materials_;
    Target targets_[2]; // of one sample and of many
    Target* target_ = nullptr;
    Bounds bounds_;

    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const Mesh> mesh_;
    std::shared_ptr<const Field> field_;
    std::uint32_t shooting_ = no_index;
    bool stale_ = true;
    std::optional<RenderParams> mesh_drawn_, display_drawn_;
    double drawn_max_display_ = 1, largest_seen_ = 0;
    double mesh_seconds_ = 0, seconds_of_one_ = 0, seconds_of_many_ = 0;
    bool drew_mesh_ = false;
};

} // namespace lueur
