// The display pass: the settings of core/display as numbers for the shader, and what is asked of the pixels that were
// seen.
#include <algorithm>
#include <cmath>

#include <glm/gtc/type_ptr.hpp>

#include "core/display/display_fields.h"
#include "core/display/false_colour.h"
#include "ui/renderer.h"
#include "ui/theme.h"

namespace lueur {

namespace {

struct Uniforms {
    GLuint program;
    GLint place(const char* name) const { return glGetUniformLocation(program, name); }
    void set(const char* name, float value) const { glUniform1f(place(name), value); }
    void set(const char* name, double value) const { glUniform1f(place(name), static_cast<float>(value)); }
    void set(const char* name, int value) const { glUniform1i(place(name), value); }
    void set(const char* name, bool value) const { glUniform1i(place(name), value ? 1 : 0); }
    void set(const char* name, const glm::dvec3& value) const {
        const glm::vec3 v(value);
        glUniform3fv(place(name), 1, glm::value_ptr(v));
    }
    void set(const char* name, const glm::dmat3& value) const {
        const glm::mat3 m(value);
        glUniformMatrix3fv(place(name), 1, GL_FALSE, glm::value_ptr(m));
    }
};

int number_of(ClipRule rule) {
    switch (rule) {
    case ClipRule::clamp:
    case ClipRule::scale_all:
        return 0;
    case ClipRule::keep_chromaticity:
        return 1;
    case ClipRule::desaturate:
        return 2;
    }
    return 0;
}

void set_tone(const Uniforms& uniforms, const ToneCurve& tone) {
    switch (tone.tone_operator) {
    case ToneOperator::linear:
        uniforms.set("tone_operator", 0);
        break;
    case ToneOperator::tumblin_rushmeier:
        uniforms.set("tone_operator", 1);
        uniforms.set("tone", glm::dvec3(tone.log2_scale, tone.exponent, tone.ambient));
        break;
    case ToneOperator::filmic:
        uniforms.set("tone_operator", 2);
        uniforms.set("tone", glm::dvec3(tone.exposure, tone.white, tone.divisor));
        break;
    }
}

void set_scale(const Uniforms& uniforms, const FalseColourSettings& scale) {
    const auto end = [&](double value) { return scale.logarithmic ? std::log(value) : value; };
    uniforms.set("log_scale", scale.logarithmic);
    uniforms.set("scale_low", end(scale.low));
    uniforms.set("scale_high", end(scale.high));
    std::vector<float> levels;
    for (const double level : isoline_levels(scale)) levels.push_back(static_cast<float>(level));
    levels.resize(std::min(levels.size(), most_isolines));
    uniforms.set("level_count", static_cast<int>(levels.size()));
    if (!levels.empty()) glUniform1fv(uniforms.place("levels"), static_cast<GLsizei>(levels.size()), levels.data());
}

} // namespace

FalseColourSettings unshot_scale(float top) {
    FalseColourSettings scale;
    scale.high = static_cast<double>(std::max(top, 1e-3f));
    scale.low = scale.high * 1e-5;
    scale.isolines = false;
    return scale;
}

unsigned Renderer::display_variant(const RenderParams& params) const {
    const DisplaySettings& display = params.display;
    const bool colour = params.view != ViewMode::luminance && shows_colour(params.view);
    const bool plain =
        colour && display.tone_operator == ToneOperator::linear && !display.mark_clipped && !display.mark_out_of_gamut;
    return (target_->samples > 1 ? many_samples : 0u) | (plain ? plain_colour : 0u) |
           (params.selected ? with_outline : 0u);
}

void Renderer::draw_display(const RenderParams& params, double divisor) {
    glBindFramebuffer(GL_FRAMEBUFFER, target_->display_pass);
    glViewport(0, 0, target_->width, target_->height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    const Uniforms uniforms{display_programs_[display_variant(params)]};
    glUseProgram(uniforms.program);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target_->samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, target_->seen);
    uniforms.set("seen", 0);

    const DisplayFunction function = make_display_function(params.display);
    // The mesh pass has divided by its own MAXDISPLAY; the function's matrix has this one's in it.
    uniforms.set("display_from_seen", function.rgb_from_xyz * params.display.max_display * xyz_from_rgb(srgb));
    uniforms.set("rescale", drawn_max_display_ / params.display.max_display);
    uniforms.set("divisor", divisor);
    uniforms.set("luminance_weights", function.luminance_weights);
    set_tone(uniforms, function.tone);
    uniforms.set("clip_rule", number_of(function.clip));
    uniforms.set("srgb_curve", function.curve == TransferCurve::srgb);
    uniforms.set("gamma", function.gamma);
    uniforms.set("mark_clipped", params.display.mark_clipped);
    uniforms.set("mark_out_of_gamut", params.display.mark_out_of_gamut);

    switch (params.view) {
    case ViewMode::shaded:
    case ViewMode::elements:
    case ViewMode::side_by_side:
        uniforms.set("quantity", 0);
        break;
    case ViewMode::unshot:
        uniforms.set("quantity", 1);
        set_scale(uniforms, unshot_scale(params.unshot_top));
        break;
    case ViewMode::difference:
        uniforms.set("quantity", 1);
        set_scale(uniforms, colour_difference_scale());
        break;
    case ViewMode::error:
        uniforms.set("quantity", 1);
        set_scale(uniforms, error_scale());
        break;
    case ViewMode::illuminance:
        uniforms.set("quantity", 1);
        set_scale(uniforms, params.display.illuminance_scale);
        break;
    case ViewMode::luminance: {
        uniforms.set("quantity", 2);
        const glm::dmat3 to_xyz = xyz_from_rgb(srgb);
        uniforms.set("quantity_scale", drawn_max_display_ * glm::dvec3(to_xyz[0].y, to_xyz[1].y, to_xyz[2].y));
        set_scale(uniforms, params.display.luminance_scale);
        break;
    }
    }
    uniforms.set("isoline_width", isoline_width * static_cast<double>(params.line_width));
    uniforms.set("backdrop", glm::dvec3(colours::backdrop.x, colours::backdrop.y, colours::backdrop.z));
    uniforms.set("line_colour", glm::dvec3(0.95));
    uniforms.set("outline_colour", glm::dvec3(colours::accent.x, colours::accent.y, colours::accent.z));
    uniforms.set("outline_width", std::max(1, static_cast<int>(std::lround(params.line_width))));
    uniforms.set("height", target_->height);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

// The pixels of the last mesh pass as a scene-referred picture; where nothing is seen there is none. Read once a mesh
// pass, and only when somebody asks.
const RadianceImage& Renderer::seen_radiance() {
    if (seen_radiance_) return *seen_radiance_;
    GlFramebuffer resolved = new_framebuffer();
    GlTexture texture;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->mesh_pass);
    if (target_->samples > 1) {
        texture = new_texture();
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, target_->width, target_->height, 0, GL_RGBA, GL_FLOAT, nullptr);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
        glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        glBlitFramebuffer(0, 0, target_->width, target_->height, 0, 0, target_->width, target_->height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved);
    }
    std::vector<glm::vec4> pixels(static_cast<std::size_t>(target_->width) * static_cast<std::size_t>(target_->height));
    glReadPixels(0, 0, target_->width, target_->height, GL_RGBA, GL_FLOAT, pixels.data());
    const glm::mat3 to_xyz(xyz_from_rgb(srgb) * drawn_max_display_);
    RadianceImage image;
    image.xyz.reserve(pixels.size());
    for (const glm::vec4& pixel : pixels)
        if (pixel.a > 0.5f) image.xyz.push_back(to_xyz * glm::vec3(pixel));
    image.width = static_cast<int>(image.xyz.size());
    image.height = 1;
    return seen_radiance_.emplace(std::move(image));
}

DisplayShares Renderer::shares(const DisplaySettings& display) {
    if (!mesh_drawn_ || !shows_colour(mesh_drawn_->view)) return {};
    if (shares_of_ && *shares_of_ == display) return shares_;
    // A quarter of the pixels knows the shares to a tenth of a percent.
    const RadianceImage& all = seen_radiance();
    RadianceImage some;
    for (std::size_t i = 0; i < all.xyz.size(); i += 4) some.xyz.push_back(all.xyz[i]);
    some.width = static_cast<int>(some.xyz.size());
    some.height = 1;
    shares_ = display_shares(some, display);
    shares_of_ = display;
    return shares_;
}

} // namespace lueur
