R"glsl(
void main() { // one triangle over the whole screen
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * corner - 1.0, 0, 1);
}
)glsl"
