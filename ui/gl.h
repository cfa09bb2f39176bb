// The few OpenGL 3.3 things the renderer needs, with owners.
#pragma once

#include <epoxy/gl.h>

#include <expected>
#include <string>
#include <string_view>
#include <utility>

namespace lueur {

// One OpenGL name, freed with its owner. `Free` is a function of this file.
template <void (*Free)(GLuint)>
class GlName {
public:
    GlName() = default;
    explicit GlName(GLuint name)
        : name_(name) {}
    GlName(GlName&& other) noexcept
        : name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlName() {
        if (name_) Free(name_);
    }
    operator GLuint() const { return name_; }

private:
    GLuint name_ = 0;
};

void free_texture(GLuint name);
void free_buffer(GLuint name);
void free_framebuffer(GLuint name);
void free_vertex_array(GLuint name);
void free_program(GLuint name);
void free_sampler(GLuint name);
using GlTexture = GlName<free_texture>;
using GlBuffer = GlName<free_buffer>;
using GlFramebuffer = GlName<free_framebuffer>;
using GlVertexArray = GlName<free_vertex_array>;
using GlProgram = GlName<free_program>;
using GlSampler = GlName<free_sampler>;

GlTexture new_texture();
GlBuffer new_buffer();
GlFramebuffer new_framebuffer();
GlVertexArray new_vertex_array();
GlSampler new_sampler();

// `defines`: lines put after #version 330 core. An empty geometry shader is none. The error is the compiler's own text.
std::expected<GlProgram, std::string> make_program(std::string_view defines, std::string_view vertex,
                                                   std::string_view geometry, std::string_view fragment);

// Gives a buffer new contents.
template <typename Vector>
void fill(GLenum target, GLuint buffer, const Vector& values, GLenum usage) {
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(values[0])), values.data(), usage);
}

} // namespace lueur
