R"glsl(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in uint object;
layout(location = 3) in vec3 reflected; // XYZ, cd m^-2
layout(location = 4) in vec3 emitted;
layout(location = 5) in float unshot;   // lm m^-2

uniform mat4 clip_from_world;
uniform uint selected_object;

out Point {
    vec3 reflected;
    vec3 emitted;
    vec2 uv;
    float unshot;
    flat float selected;
} point;

void main() {
    gl_Position = clip_from_world * vec4(position, 1);
    point.reflected = reflected;
    point.emitted = emitted;
    point.uv = uv;
    point.unshot = unshot;
    point.selected = object == selected_object ? 1.0 : 0.0;
}
)glsl"
