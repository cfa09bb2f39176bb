#include "ui/gl.h"

#include <array>
#include <vector>

namespace lueur {

void free_texture(GLuint name) {
    glDeleteTextures(1, &name);
}
void free_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
void free_framebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
void free_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
void free_program(GLuint name) {
    glDeleteProgram(name);
}
void free_sampler(GLuint name) {
    glDeleteSamplers(1, &name);
}

GlTexture new_texture() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return GlTexture(name);
}
GlBuffer new_buffer() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return GlBuffer(name);
}
GlFramebuffer new_framebuffer() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return GlFramebuffer(name);
}
GlVertexArray new_vertex_array() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return GlVertexArray(name);
}
GlSampler new_sampler() {
    GLuint name = 0;
    glGenSamplers(1, &name);
    return GlSampler(name);
}

namespace {

std::expected<GLuint, std::string> compile(GLenum kind, std::string_view defines, std::string_view source) {
    const std::string text = "#version 330 core\n" + std::string(defines) + "#line 1\n" + std::string(source);
    const char* pointer = text.c_str();
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &pointer, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    std::array<char, 4096> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    glDeleteShader(shader);
    return std::unexpected(std::string(log.data()));
}

} // namespace

std::expected<GlProgram, std::string> make_program(std::string_view defines, std::string_view vertex,
                                                   std::string_view geometry, std::string_view fragment) {
    GlProgram program(glCreateProgram());
    std::vector<GLuint> shaders;
    std::string complaint;
    const auto add = [&](GLenum kind, std::string_view source) {
        if (source.empty()) return;
        if (auto shader = compile(kind, defines, source)) {
            glAttachShader(program, *shader);
            shaders.push_back(*shader);
        } else {
            complaint += shader.error();
        }
    };
    add(GL_VERTEX_SHADER, vertex);
    add(GL_GEOMETRY_SHADER, geometry);
    add(GL_FRAGMENT_SHADER, fragment);
    if (complaint.empty()) glLinkProgram(program);
    for (const GLuint shader : shaders) glDeleteShader(shader);
    if (!complaint.empty()) return std::unexpected(complaint);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return program;
    std::array<char, 4096> log{};
    glGetProgramInfoLog(program, log.size(), nullptr, log.data());
    return std::unexpected(std::string(log.data()));
}

} // namespace lueur
