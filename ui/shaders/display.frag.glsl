R"glsl(
// From what was seen to what a monitor is sent: the same function as core/display (display.cpp, tone_operator.cpp, clip.cpp,
// false_colour.cpp), and what is drawn over it. Each sample of a pixel is displayed by itself and the results are averaged, so that the
// edge of a lamp is smooth although the lamp is hundreds of times brighter than white.
#if SAMPLES > 1
uniform sampler2DMS seen;
#else
uniform sampler2D seen;
#endif
uniform mat3 display_from_seen; // linear sRGB -> linear RGB of the display
uniform float rescale;          // MAXDISPLAY of the mesh pass / MAXDISPLAY now
uniform float divisor;          // of scale_all
uniform vec3 luminance_weights; // of the display's primaries
uniform vec3 tone;              // tumblin_rushmeier: log2_scale, exponent, ambient; filmic: exposure, white, divisor
uniform int clip_rule;          // 0 clamp or scale_all, 1 keep_chromaticity, 2 desaturate
uniform bool srgb_curve;
uniform vec3 gamma;

// A software renderer computes both sides of every branch: what a picture does not need is known when its program is compiled.
#ifdef PLAIN
const int tone_operator = 0, quantity = 0;
const bool mark_clipped = false, mark_out_of_gamut = false;
#else
uniform int tone_operator;   // 0 linear, 1 tumblin_rushmeier, 2 filmic
uniform int quantity;        // 0 colour; false colour of 1 red (a scalar, as the unshot exitance), 2 the luminance of colour
uniform bool mark_clipped, mark_out_of_gamut;
#endif
#ifdef OUTLINE
const bool outline = true;
#else
const bool outline = false;
#endif

uniform vec3 quantity_scale; // 2: weights of linear sRGB / MAXDISPLAY of the mesh pass -> cd m^-2
uniform bool log_scale;
uniform float scale_low, scale_high; // of the false colours, their logarithms where log_scale
uniform float levels[16];            // of the contours
uniform int level_count;
uniform float isoline_width; // pixels

uniform vec3 backdrop;
uniform vec3 line_colour;
uniform vec3 outline_colour;
uniform int outline_width; // pixels
uniform int height;        // of the picture, pixels

out vec4 shown;

vec4 fetch(ivec2 pixel, int sample_index) { return texelFetch(seen, pixel, sample_index); }

ivec2 last_pixel() {
    return textureSize(seen
#if SAMPLES <= 1
                       , 0
#endif
                       ) - 1;
}

bool is_finite(vec3 v) { return !(any(isnan(v)) || any(isinf(v))); }

const float largest = 1e36, least_luminance = 1e-36;

float hable_curve(float x) {
    const float a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
    return x * (a * (1.0 - e / f) * x + b * (c - e / f)) / (x * (a * x + b) + d * f);
}

float shown_luminance(float y) {
    if (tone_operator == 1) return max(exp2(clamp(tone.x + tone.y * log2(y), -100.0, 100.0)) - tone.z, 0.0);
    return hable_curve(tone.x * min(y, tone.y)) / tone.z;
}

vec3 toned(vec3 rgb) {
    if (tone_operator == 0) return rgb;
    float y = dot(luminance_weights, rgb);
    if (!(y > 0.0)) return vec3(0);
    y = max(y, least_luminance);
    return rgb * (shown_luminance(y) / y);
}

vec3 linear_display_rgb(vec3 rgb) {
    if (!is_finite(rgb)) return vec3(0);
    float limit = min(largest / rescale, 3e38);
    rgb = display_from_seen * (clamp(rgb, -limit, limit) * rescale);
    return toned(clamp(rgb, -largest, largest)) / divisor;
}

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

float encoded(float linear, float exponent) {
    if (srgb_curve) return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
    return linear <= 0.0 ? 0.0 : pow(linear, 1.0 / exponent);
}

bool on_stripe(int distance) { return (distance / 4) % 2 == 0; }

vec3 marked(vec3 colour, vec3 linear, ivec2 pixel) {
    ivec2 from_top = ivec2(pixel.x, height - 1 - pixel.y);
    float most = max(linear.r, max(linear.g, linear.b)), least = min(linear.r, min(linear.g, linear.b));
    if (mark_clipped && most > 1.0001 && on_stripe(from_top.x + from_top.y)) return vec3(1.0, 0.1, 0.15);
    if (mark_out_of_gamut && most > 0.0 && least < -1e-4 * most && on_stripe(from_top.x - from_top.y + (1 << 20)))
        return vec3(0.1, 0.85, 1.0);
    return colour;
}

vec3 displayed(vec3 rgb, ivec2 pixel) {
    vec3 linear = linear_display_rgb(rgb);
    vec3 c = clipped(linear);
    return marked(vec3(encoded(c.r, gamma.r), encoded(c.g, gamma.g), encoded(c.b, gamma.b)), linear, pixel);
}

vec3 false_colour(float t) {
    const vec3 c0 = vec3(0.2777, 0.0054, 0.3341), c1 = vec3(0.1051, 1.4046, 1.3846), c2 = vec3(-0.3309, 0.2148, 0.0951),
               c3 = vec3(-4.6342, -5.7991, -19.3324), c4 = vec3(6.2283, 14.1799, 56.6906), c5 = vec3(4.7764, -13.7451, -65.3530),
               c6 = vec3(-5.4355, 4.6459, 26.3124);
    return clamp(c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6))))), 0.0, 1.0);
}

float scalar(vec4 value) { // 0: nothing there
    if (value.a < 0.5) return 0.0;
    float s = quantity == 2 ? dot(quantity_scale, value.rgb) : value.r;
    return isnan(s) || isinf(s) ? 0.0 : s;
}

vec3 scale_colour(float s) {
    float place = log_scale ? (log(max(s, 1e-30)) - scale_low) / (scale_high - scale_low) : (s - scale_low) / (scale_high - scale_low);
    return false_colour(clamp(place, 0.0, 1.0));
}

vec3 colour_of(vec4 value, ivec2 pixel) {
    if (value.a < 0.5) return backdrop;
    float over = value.a > 2.95 ? value.a - 3.0 : value.a - 1.0;
    vec3 colour;
    if (quantity == 0) colour = displayed(value.rgb, pixel);
    else if (quantity == 1 && value.r < -0.5) colour = vec3(1); // the patch that shoots
    else colour = scale_colour(scalar(value));
    if (over > 0.004) colour = mix(colour, dot(colour, vec3(0.3, 0.6, 0.1)) > 0.75 ? vec3(0) : line_colour, min(over, 1.0) * 0.45);
    return colour;
}

// The smaller of the differences to both neighbours that are there.
float slope(float before, float here, float after) {
    bool first = before > 0.0, second = after > 0.0;
    float a = abs(here - before), b = abs(after - here);
    return first && second ? min(a, b) : first ? a : second ? b : 0.0;
}

float isoline_strength(ivec2 pixel, float here) {
    if (!(here > 0.0)) return 0.0;
    ivec2 last = last_pixel();
    float left = pixel.x > 0 ? scalar(fetch(pixel + ivec2(-1, 0), 0)) : 0.0, right = pixel.x < last.x ? scalar(fetch(pixel + ivec2(1, 0), 0)) : 0.0;
    float below = pixel.y > 0 ? scalar(fetch(pixel + ivec2(0, -1), 0)) : 0.0, above = pixel.y < last.y ? scalar(fetch(pixel + ivec2(0, 1), 0)) : 0.0;
    float gradient = length(vec2(slope(left, here, right), slope(above, here, below)));
    float strength = 0.0;
    for (int i = 0; i < level_count; ++i) {
        float pixels = abs(here - levels[i]) / max(gradient, 1e-5 * levels[i]);
        strength = max(strength, clamp(0.5 * isoline_width + 0.5 - pixels, 0.0, 1.0));
    }
    return strength;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 first = fetch(pixel, 0);
    vec3 colour = colour_of(first, pixel);
#if SAMPLES > 1
    vec4 values[SAMPLES];
    bool same = true;
    for (int s = 1; s < SAMPLES; ++s) {
        values[s] = fetch(pixel, s);
        same = same && values[s] == first;
    }
    if (!same) {
        for (int s = 1; s < SAMPLES; ++s) colour += colour_of(values[s], pixel);
        colour /= float(SAMPLES);
    }
#endif
    if (quantity != 0 && level_count > 0) {
        float strength = isoline_strength(pixel, scalar(first));
        if (strength > 0.0) colour = mix(colour, vec3(dot(colour, vec3(0.2126, 0.7152, 0.0722)) > 0.5 ? 0.0 : 1.0), strength);
    }
    if (outline) {
        bool inside = first.a > 2.95;
        float strength = 0.0;
        ivec2 last = last_pixel();
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
