#include "ui/stretch.h"

namespace lueur {
namespace {

// As plain as can be, and the coordinate straight from a varying: llvmpipe knows this pattern and has a fast path for
// it, where the texture keeps its bytes in the order of the window's (GL_BGRA).
constexpr const char* vertex_shader = R"glsl(
out vec2 uv;
void main() { // one triangle over the whole viewport
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * uv - 1.0, 0, 1);
}
)glsl";
constexpr const char* fragment_shader = R"glsl(
in vec2 uv;
uniform sampler2D picture;
out vec4 colour;
void main() { colour = texture(picture, uv); }
)glsl";

} // namespace

std::expected<Stretch, std::string> Stretch::make() {
    auto program = make_program("", vertex_shader, "", fragment_shader);
    if (!program) return std::unexpected(program.error());
    Stretch stretch;
    stretch.program_ = std::move(*program);
    stretch.no_vertices_ = new_vertex_array();
    stretch.sampler_ = new_sampler();
    glSamplerParameteri(stretch.sampler_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(stretch.sampler_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(stretch.sampler_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(stretch.sampler_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return stretch;
}

void Stretch::draw(GLuint texture, const PixelBox& box, int framebuffer_height) const {
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBindSampler(0, sampler_);
    glViewport(box.left, framebuffer_height - box.bottom, box.right - box.left, box.bottom - box.top);
    glUseProgram(program_);
    glUniform1i(glGetUniformLocation(program_, "picture"), 0);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindSampler(0, 0);
}

} // namespace lueur
