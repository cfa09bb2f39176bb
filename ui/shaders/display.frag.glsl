R"glsl(
// From what was seen to what a monitor is sent: the same function as core/display/display.cpp, and what is drawn over it.
// Each sample of a pixel is displayed by itself and the results are averaged, so that the edge of a lamp is smooth although the lamp is
// hundreds of times brighter than white.
#if SAMPLES > 1
uniform sampler2DMS seen;
#else
uniform sampler2D seen;
#endif
uniform float rescale; // MAXDISPLAY of the mesh pass / MAXDISPLAY now
uniform int clip_rule; // 0 clamp or scale_all, 1 keep_chromaticity, 2 desaturate
uniform bool srgb_curve;
uniform float gamma;
uniform vec3 luminance_weights; // of linear sRGB
uniform bool show_unshot;
uniform float log_low, log_high; // log10 of the false-colour scale's ends
uniform vec3 backdrop;
uniform vec3 line_colour;
uniform vec3 outline_colour;
uniform bool outline;
uniform int outline_width; // pixels

out vec4 shown;

vec4 fetch(ivec2 pixel, int sample_index) { return texelFetch(seen, pixel, sample_index); }

vec3 clipped(vec3 rgb) {
    if (clip_rule == 1) {
        vec3 positive = max(rgb, 0.0);
        return positive / max(max(1.0, positive.r), max(positive.g, positive.b));
    }
    if (clip_rule == 2) {
        float grey = dot(luminance_weights, rgb);
        if (grey >= 1.0) return vec3(1);
        if (grey <= 0.0) return vec3(0);
        float share = 1.0;
        for (int c = 0; c < 3; ++c) {
            if (rgb[c] > 1.0) share = min(share, (1.0 - grey) / (rgb[c] - grey));
            if (rgb[c] < 0.0) share = min(share, grey / (grey - rgb[c]));
        }
        rgb = vec3(grey) + share * (rgb - vec3(grey));
    }
    return clamp(rgb, 0.0, 1.0);
}

float encoded(float linear) {
    if (srgb_curve) return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
    return linear <= 0.0 ? 0.0 : pow(linear, 1.0 / gamma);
}

vec3 displayed(vec3 rgb) {
    if (any(isnan(rgb)) || any(isinf(rgb))) return vec3(0);
    vec3 c = clipped(rgb);
    return vec3(encoded(c.r), encoded(c.g), encoded(c.b));
}

// ui/false_colour.cpp has the same polynomial for the legend.
vec3 false_colour(float t) {
    const vec3 c0 = vec3(0.2777, 0.0054, 0.3341), c1 = vec3(0.1051, 1.4046, 1.3846), c2 = vec3(-0.3309, 0.2148, 0.0951),
               c3 = vec3(-4.6342, -5.7991, -19.3324), c4 = vec3(6.2283, 14.1799, 56.6906), c5 = vec3(4.7764, -13.7451, -65.3530),
               c6 = vec3(-5.4355, 4.6459, 26.3124);
    return clamp(c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6))))), 0.0, 1.0);
}

vec3 colour_of(vec4 value) {
    if (value.a < 0.5) return backdrop;
    float over = value.a > 2.95 ? value.a - 3.0 : value.a - 1.0;
    vec3 colour;
    if (show_unshot) {
        if (value.r < -0.5) colour = vec3(1); // the patch that shoots
        else {
            float decade = log(max(value.r, 1e-12)) / log(10.0);
            colour = false_colour(clamp((decade - log_low) / (log_high - log_low), 0.0, 1.0));
        }
    } else colour = displayed(value.rgb * rescale);
    if (over > 0.004) colour = mix(colour, dot(colour, vec3(0.3, 0.6, 0.1)) > 0.75 ? vec3(0) : line_colour, min(over, 1.0) * 0.45);
    return colour;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 first = fetch(pixel, 0);
    vec3 colour = colour_of(first);
#if SAMPLES > 1
    vec4 values[SAMPLES];
    bool same = true;
    for (int s = 1; s < SAMPLES; ++s) {
        values[s] = fetch(pixel, s);
        same = same && values[s] == first;
    }
    if (!same) {
        for (int s = 1; s < SAMPLES; ++s) colour += colour_of(values[s]);
        colour /= float(SAMPLES);
    }
#endif
    if (outline) {
        bool inside = first.a > 2.95;
        float strength = 0.0;
        ivec2 last = textureSize(seen
#if SAMPLES <= 1
                                 , 0
#endif
                                 ) - 1;
        for (int dy = -outline_width; dy <= outline_width; ++dy)
            for (int dx = -outline_width; dx <= outline_width; ++dx) {
                vec4 near = fetch(clamp(pixel + ivec2(dx, dy), ivec2(0), last), 0);
                if ((near.a > 2.95) != inside) strength = max(strength, 1.0 - 0.5 * (length(vec2(dx, dy)) - 1.0) / float(outline_width));
            }
        colour = mix(colour, outline_colour, clamp(strength, 0.0, 1.0) * (inside ? 0.55 : 0.95));
    }
    shown = vec4(floor(255.0 * clamp(colour, 0.0, 1.0) + 0.5) / 255.0, 1.0); // rounded as the file writer rounds
}
)glsl"
