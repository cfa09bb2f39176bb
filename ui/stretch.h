// Stretches a texture over a box of the present framebuffer with linear filtering: what glBlitFramebuffer does, which a
// software renderer takes twice as long for.
//
// Thread: the one that owns the current OpenGL context.
#pragma once

#include <expected>
#include <string>

#include "ui/damage.h"
#include "ui/gl.h"

namespace lueur {

class Stretch {
public:
    static std::expected<Stretch, std::string> make();
    // `box` in a framebuffer of the height given; its scissor holds. Changes the viewport.
    void draw(GLuint texture, const PixelBox& box, int framebuffer_height) const;

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlSampler sampler_;
};

} // namespace lueur
