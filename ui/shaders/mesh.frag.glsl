R"glsl(
// Writes what is seen, undisplayed: linear sRGB / MAXDISPLAY (or the unshot exitance), and in alpha what the display pass draws over it:
// 0 nothing there; 1 + 0.9 * line strength; 2 more where the object is selected. RGB and not XYZ, because half floats would lose a
// dark red beside a bright blue in the matrix.
in Point {
    vec3 reflected;
    vec3 emitted;
    vec2 uv;
    float unshot;
    flat float selected;
} point;
#ifdef LINES
noperspective in vec3 edge_distance;
uniform float line_width; // pixels
#endif

uniform mat3 rgb_from_xyz;
uniform bool textured;
uniform sampler2D texels;   // linear RGB reflectance
uniform vec3 mean_rgb;      // that the solution was made with
uniform float scale;        // 1 / MAXDISPLAY
uniform bool show_unshot;
uniform bool highlight;
uniform uint highlighted;   // coarse element
uniform vec3 highlight_rgb;
uniform usamplerBuffer coarse_elements; // of each element, in drawing order
uniform int first_element;

out vec4 seen;

void main() {
    vec3 reflected = rgb_from_xyz * point.reflected;
    if (textured)
        reflected *= mix(vec3(1), texture(texels, point.uv).rgb / max(mean_rgb, vec3(1e-6)), greaterThan(mean_rgb, vec3(1e-6)));
    vec3 value = (reflected + rgb_from_xyz * point.emitted) * scale;
    if (show_unshot) value = vec3(max(point.unshot, 0.0), 0.0, 0.0);
    if (highlight && texelFetch(coarse_elements, first_element + gl_PrimitiveID).r == highlighted)
        value = show_unshot ? vec3(-1.0, 0.0, 0.0) : mix(value, highlight_rgb, 0.75);

    float over = 1.0 + 2.0 * point.selected;
#ifdef LINES
    float nearest = min(edge_distance.x, min(edge_distance.y, edge_distance.z));
    over += 0.9 * (1.0 - smoothstep(0.5 * line_width - 0.5, 0.5 * line_width + 0.5, nearest));
#endif
    vec3 size = abs(value);
    value *= min(1.0, 60000.0 / max(max(size.r, size.g), max(size.b, 1.0))); // half floats end at 65504
    seen = vec4(value, over);
}
)glsl"
