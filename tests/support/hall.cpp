#include "tests/support/hall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

namespace lueur::test {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;
constexpr glm::vec3 hall_size(40, 6, 20); // m
constexpr float lamp_height = 5.4f;

struct Paint {
    const char* name;
    glm::vec3 reflectance; // linear sRGB
};
constexpr Paint paints[] = {
    {"plaster", {0.78f, 0.77f, 0.73f}},    {"ceiling", {0.85f, 0.85f, 0.85f}},
    {"parquet", {0.42f, 0.29f, 0.18f}},    {"stone", {0.66f, 0.63f, 0.57f}},
    {"oak", {0.45f, 0.30f, 0.17f}},        {"beech", {0.62f, 0.48f, 0.32f}},
    {"leather", {0.32f, 0.08f, 0.05f}},    {"glaze", {0.12f, 0.25f, 0.45f}},
    {"marble", {0.75f, 0.74f, 0.72f}},     {"bronze", {0.24f, 0.17f, 0.09f}},
    {"red cloth", {0.42f, 0.07f, 0.06f}},  {"green cloth", {0.10f, 0.28f, 0.13f}},
    {"blue cloth", {0.10f, 0.15f, 0.35f}}, {"ochre cloth", {0.55f, 0.38f, 0.12f}},
    {"ivory", {0.72f, 0.67f, 0.55f}},      {"housing", {0.70f, 0.70f, 0.70f}},
};
enum PaintIndex {
    plaster,
    ceiling,
    parquet,
    stone,
    oak,
    beech,
    leather,
    glaze,
    marble,
    bronze,
    first_cloth,
    cloths = 5,
    housing = first_cloth + cloths
};

struct Part {
    std::string name;
    int paint = 0;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::uvec3> triangles;
};

struct Placing {
    glm::vec3 at{0};
    float turn = 0; // about y, radians
    glm::vec3 point(glm::vec3 p) const { return at + vector(p); }
    glm::vec3 vector(glm::vec3 p) const {
        const float c = std::cos(turn), s = std::sin(turn);
        return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    }
};

float random_unit(std::uint32_t n) {
    n = (n ^ 61u) ^ (n >> 16), n *= 9u, n ^= n >> 4, n *= 0x27d4eb2du, n ^= n >> 15;
    return float(n >> 8) * 0x1p-24f;
}

void add_face(Part& part, const Placing& placing, std::array<glm::vec3, 4> corners) {
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const glm::vec3& c : corners) {
        part.positions.push_back(placing.point(c));
        part.normals.push_back(placing.vector(normal));
    }
    part.triangles.push_back({first, first + 1, first + 2});
    part.triangles.push_back({first, first + 2, first + 3});
}

// The six faces of a box, outwards; bottom: with the face that looks down.
void add_box(Part& part, const Placing& placing, glm::vec3 a, glm::vec3 b, bool bottom = true) {
    add_face(part, placing, {{{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}}});
    if (bottom) add_face(part, placing, {{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}});
    add_face(part, placing, {{{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}});
    add_face(part, placing, {{{b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}}});
    add_face(part, placing, {{{b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}}});
    add_face(part, placing, {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}});
}

// A smooth surface through p(u, v), u and v in 0..1, u going round; the front is where u runs to the right and v up.
void add_smooth(Part& part, const Placing& placing, int nu, int nv, bool closed_v,
                const std::function<glm::vec3(float, float)>& p) {
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    const int rows = closed_v ? nv : nv + 1;
    constexpr float step = 1e-3f;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < nu; ++i) {
            const float u = float(i) / float(nu), v = float(j) / float(nv);
            const float inside = closed_v ? v : std::clamp(v, 2 * step, 1 - 2 * step); // off the poles
            part.positions.push_back(placing.point(p(u, v)));
            part.normals.push_back(placing.vector(glm::normalize(
                glm::cross(p(u + step, inside) - p(u - step, inside), p(u, inside + step) - p(u, inside - step)))));
        }
    const auto index = [&](int i, int j) { return first + static_cast<std::uint32_t>((j % rows) * nu + i % nu); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 &pa = part.positions[a], &pb = part.positions[b], &pc = part.positions[c];
        if (glm::length(glm::cross(pb - pa, pc - pa)) > 1e-9f) part.triangles.push_back({a, b, c}); // none at a pole
    };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            add(index(i, j), index(i + 1, j), index(i + 1, j + 1));
            add(index(i, j), index(i + 1, j + 1), index(i, j + 1));
        }
}

// (radius, y) from the bottom up; a smooth curve through them, closed where the radius is 0.
void add_lathe(Part& part, const Placing& placing, int around, int up, const std::vector<glm::vec2>& profile,
               const std::function<float(float, float)>& swell = {}) {
    const auto at = [&](float v) { // Catmull and Rom
        const float x = std::clamp(v, 0.0f, 1.0f) * float(profile.size() - 1);
        const int last = static_cast<int>(profile.size()) - 1, k = std::min(static_cast<int>(x), last - 1);
        const float t = x - float(k);
        const glm::vec2 a = profile[static_cast<std::size_t>(std::max(k - 1, 0))],
                        b = profile[static_cast<std::size_t>(k)], c = profile[static_cast<std::size_t>(k + 1)],
                        d = profile[static_cast<std::size_t>(std::min(k + 2, last))];
        const glm::vec2 curve = 0.5f * (2.0f * b + t * (c - a) + t * t * (2.0f * a - 5.0f * b + 4.0f * c - d) +
                                        t * t * t * (3.0f * b - a - 3.0f * c + d));
        return glm::vec2(std::max(0.0f, curve.x), curve.y);
    };
    add_smooth(part, placing, around, up, false, [&](float u, float v) {
        const glm::vec2 r = at(v);
        const float radius = r.x * (swell ? swell(u, v) : 1);
        return glm::vec3(radius * std::cos(tau * u), r.y, -radius * std::sin(tau * u));
    });
}

// A block with rounded edges: |x/a|^n + |y/b|^n + |z/c|^n = 1, bent by `bend`.
void add_rounded(Part& part, const Placing& placing, int around, int up, glm::vec3 half, float power,
                 const std::function<glm::vec3(glm::vec3)>& bend) {
    const auto corner = [&](float x) { return std::copysign(std::pow(std::abs(x), 2 / power), x); };
    add_smooth(part, placing, around, up, false, [&](float u, float v) {
        const float latitude = (v - 0.5f) * tau / 2, longitude = tau * u;
        const float ring = corner(std::cos(latitude));
        return bend(half * glm::vec3(ring * corner(std::cos(longitude)), corner(std::sin(latitude)),
                                     -ring * corner(std::sin(longitude))));
    });
}

struct Hall {
    float detail; // segments of a round thing, over the fewest
    float plenty; // 0..1: of the places for furniture, so many are taken
    std::vector<Part> parts{};

    int segments(float fewest, int least = 4) const {
        return std::max(least, static_cast<int>(std::lround(fewest * detail)));
    }
    Part& part(std::string name, int paint) {
        parts.push_back({std::move(name), paint, {}, {}, {}});
        return parts.back();
    }
    bool taken(int k, int of) const { return std::fmod(0.61803399f * float(k), 1.0f) < plenty || k == 0 || of <= 2; }

    void room() {
        const glm::vec3 s = hall_size;
        add_face(part("floor", parquet), {}, {{{0, 0, 0}, {0, 0, s.z}, {s.x, 0, s.z}, {s.x, 0, 0}}});
        add_face(part("ceiling", ceiling), {}, {{{0, s.y, 0}, {s.x, s.y, 0}, {s.x, s.y, s.z}, {0, s.y, s.z}}});
        add_face(part("west wall", plaster), {}, {{{0, 0, 0}, {0, s.y, 0}, {0, s.y, s.z}, {0, 0, s.z}}});
        add_face(part("east wall", plaster), {}, {{{s.x, 0, 0}, {s.x, 0, s.z}, {s.x, s.y, s.z}, {s.x, s.y, 0}}});
        add_face(part("north wall", plaster), {}, {{{0, 0, 0}, {s.x, 0, 0}, {s.x, s.y, 0}, {0, s.y, 0}}});
        add_face(part("south wall", plaster), {}, {{{0, 0, s.z}, {0, s.y, s.z}, {s.x, s.y, s.z}, {s.x, 0, s.z}}});
    }
    void lamps(int along, int across) {
        for (int i = 0; i < along; ++i)
            for (int k = 0; k < across; ++k) {
                const Placing place{{hall_size.x * (float(i) + 0.5f) / float(along), lamp_height,
                                     hall_size.z * (float(k) + 0.5f) / float(across)},
                                    0};
                const std::string number = fmt::format("{}", i * across + k + 1);
                add_box(part("housing " + number, housing), place, {-0.6f, 0, -0.15f}, {0.6f, 0.08f, 0.15f}, false);
                add_face(part("lamp " + number, housing), place,
                         {{{-0.6f, 0, -0.15f}, {0.6f, 0, -0.15f}, {0.6f, 0, 0.15f}, {-0.6f, 0, 0.15f}}});
            }
    }
    void column(const Placing& place, const std::string& name) {
        add_box(part(name + " plinth", stone), place, {-0.45f, 0.001f, -0.45f}, {0.45f, 0.25f, 0.45f});
        add_lathe(part(name, stone), place, segments(10, 8), segments(5),
                  {{0, 0.251f},
                   {0.36f, 0.252f},
                   {0.42f, 0.33f},
                   {0.33f, 0.42f},
                   {0.32f, 1.5f},
                   {0.31f, 3},
                   {0.29f, 4.2f},
                   {0.28f, 4.8f},
                   {0.34f, 4.9f},
                   {0.40f, 5.0f},
                   {0, 5.001f}},
                  [](float u, float v) { return v > 0.3f && v < 0.75f ? 1 + 0.02f * std::cos(20 * tau * u) : 1; });
        add_box(part(name + " abacus", stone), place, {-0.42f, 5.002f, -0.42f}, {0.42f, 5.2f, 0.42f});
    }
    // The round spine and the top of a book that stands from `low` to `top`.
    void add_book(Part& part, const Placing& place, float x, float w, float low, float top) const {
        const int around = std::max(1, static_cast<int>(std::lround(0.8f * detail))), up = std::max(1, around / 2);
        const auto curve = [&](float u) { return 0.22f + 0.25f * w * (1 - (2 * u - 1) * (2 * u - 1)); };
        const auto first = static_cast<std::uint32_t>(part.positions.size());
        for (int j = 0; j <= up; ++j)
            for (int i = 0; i <= around; ++i) {
                const float u = float(i) / float(around);
                part.positions.push_back(place.point({x + w * u, low + (top - low) * float(j) / float(up), curve(u)}));
                part.normals.push_back(place.vector(glm::normalize(glm::vec3(2 * u - 1, 0, 1))));
            }
        const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (around + 1) + i); };
        for (int j = 0; j < up; ++j)
            for (int i = 0; i < around; ++i) {
                part.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                part.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        for (int i = 0; i < around; ++i) {
            const float a = float(i) / float(around), b = float(i + 1) / float(around);
            add_face(part, place,
                     {{{x + w * a, top, 0.02f},
                       {x + w * a, top, curve(a)},
                       {x + w * b, top, curve(b)},
                       {x + w * b, top, 0.02f}}});
        }
    }
    void bookcase(const Placing& place, const std::string& name, std::uint32_t seed) {
        constexpr float width = 2.4f, depth = 0.32f, height = 2.3f, board = 0.03f;
        constexpr int shelves = 6;
        Part& frame = part(name, oak);
        add_box(frame, place, {-width / 2, 0.001f, 0}, {width / 2, height, 0.02f});
        for (const float x : {-width / 2, width / 2 - board})
            add_box(frame, place, {x, 0.001f, 0.021f}, {x + board, height, depth});
        std::array<Part, cloths> books;
        const float thick = std::clamp(0.12f / detail, 0.03f, 0.2f);
        for (int s = 0; s <= shelves; ++s) {
            const float y = 0.06f + float(s) * (height - 0.1f) / shelves;
            add_box(frame, place, {-width / 2 + board + 0.001f, y, 0.021f},
                    {width / 2 - board - 0.001f, y + board, depth});
            if (s == shelves) break;
            // Books that stand close: their outline is one surface, spines, tops and the steps between them.
            float x = -width / 2 + board + 0.01f, before = y + board;
            for (std::uint32_t b = 0;; ++b) {
                const std::uint32_t r = seed * 7919u + std::uint32_t(s) * 613u + b;
                const float w = thick * (0.7f + 0.7f * random_unit(r));
                const bool last = x + w > width / 2 - board - 0.01f, none = last || random_unit(r + 1234u) < 0.06f;
                const float top = y + board + (none ? 0 : 0.2f + 0.11f * random_unit(r + 7777u));
                Part& book = books[std::min<std::size_t>(
                    cloths - 1, static_cast<std::size_t>(random_unit(r + 99u) * float(cloths)))];
                if (top != before) {
                    const float low = std::min(top, before), up = std::max(top, before);
                    if (top > before)
                        add_face(book, place, {{{x, low, 0.02f}, {x, low, 0.22f}, {x, up, 0.22f}, {x, up, 0.02f}}});
                    else
                        add_face(book, place, {{{x, low, 0.22f}, {x, low, 0.02f}, {x, up, 0.02f}, {x, up, 0.22f}}});
                }
                if (last) break;
                if (!none) add_book(book, place, x, w, y + board, top);
                before = top, x += w;
            }
        }
        for (std::size_t c = 0; c < cloths; ++c)
            if (!books[c].triangles.empty()) {
                books[c].name = fmt::format("{} books {}", name, c + 1);
                books[c].paint = first_cloth + static_cast<int>(c);
                parts.push_back(std::move(books[c]));
            }
    }
    void leg(Part& part, const Placing& place, float x, float z, float radius, float height) {
        const Placing at{place.point({x, 0, z}), place.turn};
        add_lathe(part, at, segments(4), segments(2, 3),
                  {{0, 0.001f},
                   {radius, 0.002f},
                   {0.7f * radius, 0.12f * height},
                   {1.1f * radius, 0.5f * height},
                   {0.8f * radius, 0.85f * height},
                   {1.2f * radius, 0.998f * height},
                   {0, height}});
    }
    void table(const Placing& place, const std::string& name) {
        add_box(part(name, oak), place, {-1.1f, 0.71f, -0.5f}, {1.1f, 0.75f, 0.5f});
        Part& legs = part(name + " legs", oak);
        for (const float x : {-0.95f, 0.95f})
            for (const float z : {-0.38f, 0.38f}) leg(legs, place, x, z, 0.035f, 0.7f);
    }
    void chair(const Placing& place, const std::string& name) {
        add_rounded(part(name + " seat", leather), place, segments(5), segments(2.5f), {0.22f, 0.025f, 0.21f}, 4,
                    [](glm::vec3 p) { return p + glm::vec3(0, 0.46f - 0.15f * (0.05f - p.x * p.x), 0); });
        add_rounded(
            part(name + " back", beech), place, segments(5), segments(2.5f), {0.21f, 0.2f, 0.015f}, 4,
            [](glm::vec3 p) { return glm::vec3(p.x, 0.78f + p.y, 0.20f + p.z - 0.8f * p.x * p.x + 0.15f * p.y); });
        Part& legs = part(name + " legs", beech);
        for (const float x : {-0.17f, 0.17f})
            for (const float z : {-0.16f, 0.16f}) leg(legs, place, x, z, 0.018f, 0.42f);
    }
    void on_table(const Placing& place, const std::string& name, int kind) {
        switch (kind % 3) {
        case 0: // a vase
            add_lathe(part(name + " vase", glaze), place, segments(5), segments(4),
                      {{0, 0},
                       {0.05f, 0.001f},
                       {0.09f, 0.1f},
                       {0.10f, 0.17f},
                       {0.05f, 0.26f},
                       {0.055f, 0.3f},
                       {0.045f, 0.299f},
                       {0.04f, 0.26f},
                       {0.08f, 0.17f},
                       {0, 0.03f}});
            break;
        case 1: // a globe on its foot
            add_lathe(part(name + " foot", bronze), place, segments(4), segments(2, 3),
                      {{0, 0}, {0.09f, 0.001f}, {0.03f, 0.03f}, {0.015f, 0.08f}, {0, 0.09f}});
            add_smooth(part(name + " globe", glaze), place, segments(5), segments(3), false, [](float u, float v) {
                const float latitude = (v - 0.5f) * tau / 2;
                return glm::vec3(0, 0.242f, 0) + 0.15f * glm::vec3(std::cos(latitude) * std::cos(tau * u),
                                                                   std::sin(latitude),
                                                                   -std::cos(latitude) * std::sin(tau * u));
            });
            break;
        default: // books that lie
            for (int b = 0; b < 3; ++b) {
                const Placing turned{place.at, place.turn + 0.3f * float(b)};
                add_box(part(fmt::format("{} book {}", name, b + 1), first_cloth + (kind + b) % cloths), turned,
                        {-0.09f, 0.042f * float(b) + 0.001f, -0.13f}, {0.09f, 0.042f * float(b) + 0.04f, 0.13f});
            }
        }
    }
    void sculpture(const Placing& place, const std::string& name, int kind) {
        add_box(part(name + " pedestal", stone), place, {-0.3f, 0.001f, -0.3f}, {0.3f, 1, 0.3f});
        const int p = 2 + kind % 2, q = 3 + kind % 3 * 2;
        add_smooth(part(name, kind % 2 ? bronze : marble), place, segments(24, 24), segments(4, 5), true,
                   [&](float u, float v) { // a torus knot, (p, q)
                       const auto curve = [&](float t) {
                           const float r = 0.24f + 0.09f * std::cos(float(q) * tau * t);
                           return glm::vec3(r * std::cos(float(p) * tau * t),
                                            1.42f + 0.3f * std::sin(float(q) * tau * t),
                                            r * std::sin(float(p) * tau * t));
                       };
                       const glm::vec3 c = curve(u), along = glm::normalize(curve(u + 1e-3f) - curve(u - 1e-3f));
                       const glm::vec3 out = glm::normalize(glm::cross(along, glm::vec3(0.1f, 1, 0.2f)));
                       const glm::vec3 up = glm::cross(along, out);
                       return c + 0.055f * (std::cos(tau * v) * out - std::sin(tau * v) * up);
                   });
    }

    void furnish() {
        const float quarter = tau / 4;
        for (int i = 0; i < 9; ++i)
            for (int k = 0; k < 2; ++k) {
                const Placing place{{2 + 4.5f * float(i), 0, k ? 14.7f : 5.3f}, 0};
                if (i % 2 == 0 || taken(i * 2 + k, 18)) column(place, fmt::format("column {}", 2 * i + k + 1));
            }
        for (int i = 0; i < 15; ++i)
            for (int k = 0; k < 2; ++k)
                if (taken(2 * i + k, 30))
                    bookcase({{1.6f + 2.6f * float(i), 0, k ? 19.98f : 0.02f}, k ? 2 * quarter : 0},
                             fmt::format("bookcase {}", 2 * i + k + 1), std::uint32_t(2 * i + k));
        for (int i = 0; i < 11; ++i)
            for (int k = 0; k < 4; ++k) {
                const int n = 4 * i + k;
                if (!taken(n, 44)) continue;
                const glm::vec3 at(3.4f + 3.3f * float(i), 0, 2.6f + 4.6f * float(k) + (k > 1 ? 0.4f : 0));
                const std::string name = fmt::format("table {}", n + 1);
                table({at, 0}, name);
                for (int c = 0; c < 6; ++c) {
                    const float x = -0.7f + 0.7f * float(c / 2), jitter = random_unit(std::uint32_t(n * 6 + c)) - 0.5f;
                    const bool far = c % 2;
                    chair({at + glm::vec3(x, 0, far ? 0.85f + 0.1f * jitter : -0.85f + 0.1f * jitter),
                           (far ? 0 : 2 * quarter) + 0.5f * jitter},
                          fmt::format("{} chair {}", name, c + 1));
                }
                for (int t = 0; t < 2; ++t)
                    on_table({at + glm::vec3(-0.5f + float(t), 0.752f, 0.1f), float(n)},
                             fmt::format("{} thing {}", name, t + 1), 2 * n + t);
            }
        for (int i = 0; i < 8; ++i)
            if (taken(i, 8))
                sculpture({{4.25f + 4.5f * float(i), 0, 10}, float(i)}, fmt::format("sculpture {}", i + 1), i);
    }

    std::size_t triangles() const {
        std::size_t sum = 0;
        for (const Part& p : parts) sum += p.triangles.size();
        return sum;
    }
};

Hall make_hall(float detail, const HallParams& params) {
    Hall hall{detail, std::min(1.0f, std::pow(float(params.triangles) / 200'000, 0.8f))};
    hall.room();
    hall.lamps(params.luminaires_along, params.luminaires_across);
    hall.furnish();
    return hall;
}

void write_glb(const std::filesystem::path& path, const Hall& hall) {
    std::string data, views, accessors, meshes, nodes, materials;
    const auto add = [&](const void* bytes, std::size_t size, const std::string& accessor, int target) {
        views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}",
                             views.empty() ? "" : ",", data.size(), size, target);
        accessors += (accessors.empty() ? "" : ",") + accessor;
        data.append(static_cast<const char*>(bytes), size);
    };
    for (const Paint& paint : paints)
        materials += fmt::format("{}{{\"name\":\"{}\",\"pbrMetallicRoughness\":{{\"baseColorFactor\":[{},{},{},1],"
                                 "\"metallicFactor\":0}}}}",
                                 materials.empty() ? "" : ",", paint.name, paint.reflectance.x, paint.reflectance.y,
                                 paint.reflectance.z);
    for (std::size_t p = 0; p < hall.parts.size(); ++p) {
        const Part& part = hall.parts[p];
        glm::vec3 low(1e30f), high(-1e30f);
        for (const glm::vec3& v : part.positions) low = glm::min(low, v), high = glm::max(high, v);
        const std::size_t vertices = part.positions.size(), indices = 3 * part.triangles.size();
        add(part.positions.data(), 12 * vertices,
            fmt::format("{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\",\"min\":[{},{},{}],"
                        "\"max\":[{},{},{}]}}",
                        3 * p, vertices, low.x, low.y, low.z, high.x, high.y, high.z),
            34962);
        add(part.normals.data(), 12 * vertices,
            fmt::format("{{\"bufferView\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\"}}", 3 * p + 1,
                        vertices),
            34962);
        add(part.triangles.data(), 4 * indices,
            fmt::format("{{\"bufferView\":{},\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}", 3 * p + 2,
                        indices),
            34963);
        meshes += fmt::format("{}{{\"primitives\":[{{\"attributes\":{{\"POSITION\":{},\"NORMAL\":{}}},\"indices\":{},"
                              "\"material\":{}}}]}}",
                              p ? "," : "", 3 * p, 3 * p + 1, 3 * p + 2, part.paint);
        nodes += fmt::format("{}{{\"name\":\"{}\",\"mesh\":{}}}", p ? "," : "", part.name, p);
    }
    std::string roots;
    for (std::size_t p = 0; p < hall.parts.size(); ++p) roots += fmt::format("{}{}", p ? "," : "", p);
    std::string json =
        fmt::format("{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}],"
                    "\"meshes\":[{}],"
                    "\"materials\":[{}],\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]}}",
                    roots, nodes, meshes, materials, accessors, views, data.size());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::ofstream file;
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.open(path, std::ios::binary);
    const auto word = [&](std::size_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        file.write(reinterpret_cast<const char*>(&bits), 4);
    };
    word(0x46546c67), word(2), word(28 + json.size() + data.size());
    word(json.size()), word(0x4e4f534a), file << json;
    word(data.size()), word(0x004e4942), file << data;
}

void write_toml(const std::filesystem::path& path, const std::string& name, const HallParams& params) {
    std::ofstream file;
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.open(path);
    file << fmt::format("name  = \"{0}\"\nunits = \"metre\"\nup    = \"y\"\n\n[[geometry]]\nfile = \"{0}.glb\"\n",
                        name);
    // Rows of lamps of three colours, some of them dimmed.
    static const char* spectra[] = {"blackbody = 3000", "daylight = 5000", "daylight = 6500"};
    for (int i = 0; i < params.luminaires_along; ++i)
        for (int k = 0; k < params.luminaires_across; ++k)
            file << fmt::format("\n[[luminaire]]\nname     = \"lamp {0}\"\nobjects  = [\"lamp {0}\"]\n"
                                "spectrum = {{ {1} }}\npower    = {{ lumen = {2} }}\n",
                                i * params.luminaires_across + k + 1, spectra[k % 3], k % 4 == 3 ? 1800 : 3000);
    file << "\n[camera]\nposition = [1.2, 1.75, 12.9]\ntarget   = [14, 1.2, 8.6]\nvertical_fov_degrees = 52\n";
}

} // namespace

HallSize write_hall(const std::filesystem::path& folder, const std::string& name, const HallParams& params) {
    float low = 0.5f, high = 40;
    for (int k = 0; k < 13; ++k) {
        const float middle = std::sqrt(low * high);
        (make_hall(middle, params).triangles() < params.triangles ? low : high) = middle;
    }
    const Hall hall = make_hall(low, params);
    std::filesystem::create_directories(folder);
    write_glb(folder / (name + ".glb"), hall);
    write_toml(folder / (name + ".toml"), name, params);
    return {hall.triangles(), hall.parts.size(),
            std::size_t(params.luminaires_along) * std::size_t(params.luminaires_across)};
}

} // namespace lueur::test
