R"glsl(
// Writes what is seen, undisplayed: linear sRGB / MAXDISPLAY (or the unshot exitance), and in alpha what the display pass draws over it:
// 0 nothing there; 1 + 0.9 * line strength; 2 more where the object is selected.
in Point {
    vec4 light;
#ifdef TEXTURED
    mat3 by_texel;
    vec2 uv;
#endif
} point;
#ifdef LINES
noperspective in vec3 edge_distance;
uniform float line_width; // pixels
#endif
#ifdef TEXTURED
uniform sampler2D texels; // linear RGB reflectance
#endif
#ifdef HIGHLIGHT
uniform uint highlighted;   // coarse patch
uniform vec3 highlight_rgb;
uniform usamplerBuffer patches; // of each element, in drawing order
uniform int first_element;
#endif

out vec4 seen;

void main() {
    seen = point.light;
#ifdef TEXTURED
    seen.rgb += point.by_texel * texture(texels, point.uv).rgb;
#endif
#ifdef HIGHLIGHT
    if (texelFetch(patches, first_element + gl_PrimitiveID).r == highlighted)
#ifdef UNSHOT
        seen.r = -1.0; // the display pass shows it white
#else
        seen.rgb = mix(seen.rgb, highlight_rgb, 0.75);
#endif
#endif
#ifdef LINES
    float nearest = min(edge_distance.x, min(edge_distance.y, edge_distance.z));
    seen.a += 0.9 * (1.0 - smoothstep(0.5 * line_width - 0.5, 0.5 * line_width + 0.5, nearest));
#endif
}
)glsl"
