R"glsl(
// Distances to the edges in pixels, for lines that neither fight with the surface nor thin out with distance
// (Baerentzen et al. 2006, "Single-pass wireframe rendering").
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

uniform vec2 viewport_size;

in Point {
    vec4 light;
#ifdef TEXTURED
    mat3 by_texel;
    vec2 uv;
#endif
} corner[];
out Point {
    vec4 light;
#ifdef TEXTURED
    mat3 by_texel;
    vec2 uv;
#endif
} point;
noperspective out vec3 edge_distance;

void main() {
    vec2 p[3];
    bool behind = false;
    for (int i = 0; i < 3; ++i) {
        behind = behind || gl_in[i].gl_Position.w <= 0.0;
        p[i] = 0.5 * viewport_size * gl_in[i].gl_Position.xy / max(gl_in[i].gl_Position.w, 1e-6);
    }
    vec2 a = p[2] - p[1], b = p[2] - p[0], c = p[1] - p[0];
    float area = abs(a.x * b.y - a.y * b.x);
    vec3 height = area / max(vec3(length(a), length(b), length(c)), vec3(1e-6));
    // Corners behind the eye have no place on the screen: no lines for that element.
    if (behind) height = vec3(1e6);
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        point.light = corner[i].light;
#ifdef TEXTURED
        point.by_texel = corner[i].by_texel;
        point.uv = corner[i].uv;
#endif
        edge_distance = behind ? vec3(1e6) : vec3(i == 0 ? height.x : 0.0, i == 1 ? height.y : 0.0, i == 2 ? height.z : 0.0);
        EmitVertex();
    }
    EndPrimitive();
}
)glsl"
