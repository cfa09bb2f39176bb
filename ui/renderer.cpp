#include "ui/renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <glm/gtc/type_ptr.hpp>

#include "core/spectrum/colour.h"
#include "core/view/picture.h"
#include "ui/swatch.h"
#include "ui/theme.h"

namespace lueur {
namespace {

constexpr const char* mesh_vertex_shader =
#include "ui/shaders/mesh.vert.glsl"
    ;
constexpr const char* mesh_geometry_shader =
#include "ui/shaders/mesh.geom.glsl"
    ;
constexpr const char* mesh_fragment_shader =
#include "ui/shaders/mesh.frag.glsl"
    ;
constexpr const char* screen_vertex_shader =
#include "ui/shaders/screen.vert.glsl"
    ;
constexpr const char* display_fragment_shader =
#include "ui/shaders/display.frag.glsl"
    ;

GLint place(GLuint program, const char* name) {
    return glGetUniformLocation(program, name);
}

glm::mat3 srgb_matrix() {
    return rgb_from_xyz(srgb);
}

// What the mesh pass shows; all else is the display pass's business.
bool same_mesh_pass(const RenderParams& a, const RenderParams& b) {
    const auto mesh_view = [](ViewMode view) { return view == ViewMode::luminance ? ViewMode::shaded : view; };
    return a.width == b.width && a.height == b.height && a.camera == b.camera &&
           mesh_view(a.view) == mesh_view(b.view) && a.selected == b.selected &&
           a.highlight_shooting == b.highlight_shooting && a.line_width == b.line_width;
}

// Variants of the mesh shaders: each a set of these.
enum Variant : unsigned { with_texture = 1, with_lines = 2, with_highlight = 4, of_unshot = 8 };

std::string defines_of(unsigned variant) {
    std::string text;
    if (variant & with_texture) text += "#define TEXTURED\n";
    if (variant & with_lines) text += "#define LINES\n";
    if (variant & with_highlight) text += "#define HIGHLIGHT\n";
    if (variant & of_unshot) text += "#define UNSHOT\n";
    return text;
}

constexpr std::array resolution_steps{1.0, 0.8, 0.65, 0.5}; // of the picture's edges

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

std::expected<std::unique_ptr<Renderer>, std::string> Renderer::make() {
    std::unique_ptr<Renderer> renderer(new Renderer);
    const auto build = [](GlProgram& program, const std::string& defines, const char* vertex, const char* geometry,
                          const char* fragment) -> std::string {
        auto made = make_program(defines, vertex, geometry, fragment);
        if (!made) return made.error();
        program = std::move(*made);
        return {};
    };
    std::string complaint;
    for (unsigned variant = 0; variant <= (of_unshot | with_highlight); ++variant) {
        if ((variant & of_unshot) && (variant & (with_texture | with_lines)))
            continue; // neither is shown with unshot light
        complaint += build(renderer->mesh_programs_[variant], defines_of(variant), mesh_vertex_shader,
                           variant & with_lines ? mesh_geometry_shader : "", mesh_fragment_shader);
    }
    for (unsigned variant = 0; variant < renderer->display_programs_.size(); ++variant) {
        std::string defines = variant & many_samples ? "#define SAMPLES 4\n" : "#define SAMPLES 1\n";
        if (variant & plain_colour) defines += "#define PLAIN\n";
        if (variant & with_outline) defines += "#define OUTLINE\n";
        complaint +=
            build(renderer->display_programs_[variant], defines, screen_vertex_shader, "", display_fragment_shader);
    }
    if (!complaint.empty()) return std::unexpected("a shader does not compile: " + complaint);

    auto& r = *renderer;
    r.vertex_array_ = new_vertex_array();
    r.no_vertices_ = new_vertex_array();
    for (GlBuffer* buffer :
         {&r.positions_, &r.uvs_, &r.objects_, &r.shades_.reflected, &r.shades_.emitted, &r.shades_.by_texel,
          &r.trichromatic_.reflected, &r.trichromatic_.emitted, &r.trichromatic_.by_texel, &r.unshot_, &r.illuminance_,
          &r.difference_, &r.error_, &r.elements_, &r.coarse_})
        *buffer = new_buffer();
    glBindVertexArray(r.vertex_array_);
    const auto attribute = [](GLuint index, GLuint buffer, GLint components) {
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
        glEnableVertexAttribArray(index);
    };
    attribute(0, r.positions_, 3);
    attribute(1, r.uvs_, 2);
    glBindBuffer(GL_ARRAY_BUFFER, r.objects_);
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, 0, nullptr);
    glEnableVertexAttribArray(2);
    attribute(5, r.unshot_, 1);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, r.elements_);
    glBindVertexArray(0);
    r.coarse_texture_ = new_texture();
    return renderer;
}

void Renderer::make_target(int width, int height, int samples) {
    target_ = &targets_[samples > 1 ? 1 : 0];
    if (target_->width == width && target_->height == height) return;
    *target_ = {};
    target_->width = width;
    target_->height = height;
    target_->samples = samples;
    const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    const auto attach = [&](GlTexture& texture, GLenum format, GLenum layout, GLenum type, GLenum point) {
        texture = new_texture();
        glBindTexture(kind, texture);
        if (samples > 1)
            glTexImage2DMultisample(kind, samples, format, width, height, GL_TRUE);
        else {
            glTexImage2D(kind, 0, static_cast<GLint>(format), width, height, 0, layout, type, nullptr);
            glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        }
        glFramebufferTexture2D(GL_FRAMEBUFFER, point, kind, texture, 0);
    };
    target_->mesh_pass = new_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target_->mesh_pass);
    attach(target_->seen, GL_RGBA32F, GL_RGBA, GL_FLOAT, GL_COLOR_ATTACHMENT0);
    attach(target_->depth, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, GL_DEPTH_ATTACHMENT);

    target_->display_pass = new_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, target_->display_pass);
    target_->shown = new_texture();
    glBindTexture(GL_TEXTURE_2D, target_->shown);
    // Its bytes in the order of a window's, for the fast path of ui/stretch.cpp.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_->shown, 0);
    stale_ = true;
}

Renderer::Picture Renderer::draw(const RenderParams& params) {
    drew_mesh_ = false;
    const bool many = params.still || many_samples_are_cheap();
    const double share = many ? 1.0 : resolution_steps[resolution_];
    make_target(std::max(8, static_cast<int>(std::lround(share * params.width))),
                std::max(8, static_cast<int>(std::lround(share * params.height))), many ? 4 : 1);
    const double start = seconds_now();
    bool drew = false;
    if (stale_ || !mesh_drawn_ || drawn_target_ != target_ || !same_mesh_pass(*mesh_drawn_, params)) {
        // Single precision holds what is seen divided by any of these; the display pass does the rest.
        drawn_max_display_ = std::clamp(params.display.max_display, 1e-3, 1e6);
        draw_mesh(params, drawn_max_display_);
        drawn_target_ = target_;
        mesh_drawn_ = params;
        display_drawn_.reset();
        drew = drew_mesh_ = true;
        stale_ = false;
        seen_radiance_.reset();
        shares_of_.reset();
    }
    if (!display_drawn_ || !(display_drawn_->display == params.display) || display_drawn_->view != params.view ||
        display_drawn_->unshot_top != params.unshot_top) {
        const bool whole = params.display.clip == ClipRule::scale_all && shows_colour(params.view);
        draw_display(params, whole ? std::max(1.0, largest_component(seen_radiance(), params.display)) : 1.0);
        display_drawn_ = params;
        drew = true;
    }
    if (drew) {
        glFinish(); // the time is worth having: it decides what the next frame gets
        draw_seconds_ = seconds_now() - start;
        if (drew_mesh_ && mesh_) {
            (many ? seconds_of_many_ : seconds_of_one_) = draw_seconds_;
            if (!many) adapt_resolution(draw_seconds_);
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return {target_->display_pass, target_->shown, target_->width, target_->height, target_->samples};
}

bool Renderer::many_samples_are_cheap() const {
    constexpr double budget = 0.012; // s of a frame
    return resolution_ == 0 && seconds_of_many_ > 0 &&
           std::min(seconds_of_many_, 4 * std::max(seconds_of_one_, 1e-4)) < budget;
}

// Moving pictures keep to their share of a frame of 40 ms, at the price of sharpness; a still one is drawn in full.
void Renderer::adapt_resolution(double seconds) {
    constexpr double too_long = 0.022, short_enough = 0.008; // s
    if (seconds > too_long && resolution_ + 1 < resolution_steps.size())
        ++resolution_;
    else if (seconds < short_enough && resolution_ > 0)
        --resolution_;
}

void Renderer::draw_mesh(const RenderParams& params, double max_display) {
    glBindFramebuffer(GL_FRAMEBUFFER, target_->mesh_pass);
    glViewport(0, 0, target_->width, target_->height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (!mesh_ || !scene_) return;
    if (target_->samples > 1) glEnable(GL_MULTISAMPLE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE); // walls are seen from their lit side only, so that one looks into a room from outside
    glCullFace(GL_BACK);
    glFrontFace(params.camera.mirrored ? GL_CW : GL_CCW);

    unsigned variant = 0;
    if (params.view == ViewMode::elements) variant |= with_lines;
    if (!shows_colour(params.view)) variant |= of_unshot;
    if (params.highlight_shooting && shooting_ != no_index) variant |= with_highlight;
    const double aspect = static_cast<double>(params.width) / params.height;
    const auto range = depth_range(params.camera, bounds_);
    const glm::mat4 clip = clip_from_world(params.camera, aspect, range.near_plane, range.far_plane);
    const double pixel = glm::radians(params.camera.vertical_fov_degrees) / target_->height; // rad
    choose_seen(clip, glm::vec3(params.camera.position), params.still ? 0.0f : static_cast<float>(0.5 * pixel));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_BUFFER, coarse_texture_);
    glActiveTexture(GL_TEXTURE0);

    glBindVertexArray(vertex_array_);
    // The scalar of the vertices, see mesh.vert.glsl.
    glBindBuffer(GL_ARRAY_BUFFER, params.view == ViewMode::illuminance  ? illuminance_
                                  : params.view == ViewMode::difference ? difference_
                                  : params.view == ViewMode::error      ? error_
                                                                        : unshot_);
    glVertexAttribPointer(5, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
    use_shades(shades_);
    if (params.view == ViewMode::side_by_side && field_->trichromatic) { // one picture, a half each
        const int left = target_->width / 2;
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, left, target_->height);
        draw_batches(params, variant, clip, max_display);
        use_shades(trichromatic_);
        glScissor(left, 0, target_->width - left, target_->height);
        draw_batches(params, variant, clip, max_display);
        glDisable(GL_SCISSOR_TEST);
    } else
        draw_batches(params, variant, clip, max_display);
    glBindVertexArray(0);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

void Renderer::use_shades(const ShadeBuffers& shades) {
    const auto attribute = [](GLuint index, GLuint buffer, GLsizei stride, std::size_t offset) {
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(offset));
    };
    attribute(3, shades.reflected, 0, 0);
    attribute(4, shades.emitted, 0, 0);
    for (GLuint index : {3u, 4u}) glEnableVertexAttribArray(index);
    for (GLuint column = 0; column < 3; ++column) {
        attribute(6 + column, shades.by_texel, sizeof(glm::mat3), column * sizeof(glm::vec3));
        // Without textures the buffer is empty, and nothing reads it.
        if (any_texture_)
            glEnableVertexAttribArray(6 + column);
        else
            glDisableVertexAttribArray(6 + column);
    }
}

void Renderer::draw_batches(const RenderParams& params, unsigned variant, const glm::mat4& clip, double max_display) {
    const auto use = [&](GLuint program) { // what is the same for all batches
        glUseProgram(program);
        glUniformMatrix4fv(place(program, "clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip));
        glUniform1ui(place(program, "selected_object"),
                     params.selected ? static_cast<GLuint>(*params.selected) : no_index);
        glUniformMatrix3fv(place(program, "rgb_from_xyz"), 1, GL_FALSE, glm::value_ptr(srgb_matrix()));
        glUniform1f(place(program, "scale"), static_cast<float>(1 / max_display));
        glUniform1ui(place(program, "highlighted"), shooting_);
        const glm::vec3 accent = decoded({colours::accent.x, colours::accent.y, colours::accent.z});
        glUniform3fv(place(program, "highlight_rgb"), 1, glm::value_ptr(accent));
        glUniform2f(place(program, "viewport_size"), static_cast<float>(target_->width),
                    static_cast<float>(target_->height));
        glUniform1f(place(program, "line_width"), params.line_width);
        glUniform1i(place(program, "texels"), 0);
        glUniform1i(place(program, "patches"), 1);
    };
    GLuint program = 0;
    for (const auto& batch : batches_) {
        if (batch.seen == 0) continue;
        const auto texture = batch.image && !(variant & of_unshot) ? textures_.find(batch.image) : textures_.end();
        const bool textured = texture != textures_.end();
        const GLuint wanted = mesh_programs_.at(textured ? variant | with_texture : variant);
        if (wanted != program) use(program = wanted);
        if (textured) glBindTexture(GL_TEXTURE_2D, texture->second);
        glUniform1i(place(program, "first_element"), static_cast<GLint>(batch.first_seen));
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * batch.seen), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(batch.first_seen * sizeof(glm::uvec3)));
    }
}

} // namespace lueur
