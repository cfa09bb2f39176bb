R"glsl(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in uint object;
layout(location = 3) in vec3 reflected; // XYZ, cd m^-2
layout(location = 4) in vec3 emitted;
layout(location = 5) in float unshot;   // lm m^-2
#ifdef TEXTURED
layout(location = 6) in vec3 red_texel; // XYZ that a texel (1,0,0) reflects, (0,1,0) and (0,0,1)
layout(location = 7) in vec3 green_texel;
layout(location = 8) in vec3 blue_texel;
#endif

uniform mat4 clip_from_world;
uniform uint selected_object;
uniform mat3 rgb_from_xyz;
uniform float scale; // 1 / MAXDISPLAY

// As few numbers a corner as there can be: setting up small triangles is what a software renderer spends its time on. The matrix is
// linear, so it may as well be applied at the corners.
out Point {
    vec4 light; // linear sRGB / MAXDISPLAY (or the unshot exitance in red); alpha as mesh.frag.glsl says
#ifdef TEXTURED
    mat3 by_texel; // linear sRGB / MAXDISPLAY, to be multiplied by the texel; not in `light`
    vec2 uv;
#endif
} point;

void main() {
    gl_Position = clip_from_world * vec4(position, 1);
    float over = object == selected_object ? 3.0 : 1.0;
#if defined(UNSHOT)
    point.light = vec4(max(unshot, 0.0), 0.0, 0.0, over);
#elif defined(TEXTURED)
    point.light = vec4(rgb_from_xyz * emitted * scale, over);
    point.by_texel = rgb_from_xyz * mat3(red_texel, green_texel, blue_texel) * scale;
    point.uv = uv;
#else
    point.light = vec4(rgb_from_xyz * (reflected + emitted) * scale, over);
#endif
}
)glsl"
