#include "core/solve/memory_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/solve/channel_field.h"
#include "core/solve/solve_budgets.h"
#include "core/transport/gather_rows.h"
#include "core/transport/light_samples.h"
#include "core/transport/mesh.h"

namespace lueur {

namespace {

// Bisection down to a longest edge h leaves about 5.6 / h^2 elements a square metre (automatic_element_size), half as
// many vertices.
constexpr double elements_in_a_square = 5.6;
// Embree's boxes and robust triangles take so many bytes a triangle, of 30,000 to 1,000,000.
constexpr double bytes_of_box = 150;
constexpr double cut_groups = 1.5; // as many samples as groups of full width: some are cut where things are close
// `lueur plan` of a scene of six walls.
constexpr std::uint64_t bytes_of_program = 140ull << 20;
constexpr double share_of_luminaires = 0.6; // that an entry of a row is kept for, of a hall's hundreds
// Arrays of the solve, bytes: of a vertex, where rays start, who is buried, areas, what surrounds it, what it reads; in
// the composed field; in the estimate of error.
constexpr double a_vertex = 48 + 12 * 2 + 14 + 8 + 56, a_shown_vertex = 3 * 12 + 4 * 4 + 12 * 4;
// Of an element: its node, its place in the lists of the levels, in the scene's triangle, and the copy that is shown.
constexpr double an_element = 2 * (24 + 25 + 2 * 21) + 24;
// The edges of the mesh by themselves: in the table of leaves, or two lists of bends and what they are sorted from.
constexpr double edges_of_an_element = 24 * 2, bends_of_an_element = 168 + 120;

} // namespace

std::uint64_t MemoryPlan::peak() const {
    return program + scene + mesh + world + direct + rows + fields;
}

MemoryPlan plan_memory(const Scene& scene, int channels) {
    MemoryPlan plan;
    const Geometry& geometry = *scene.geometry;
    const double size = scene.solve.element_size > 0 ? scene.solve.element_size : automatic_element_size(scene);
    double vertices = double(geometry.vertices.size()), elements = 0;
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
        const glm::uvec3 v = geometry.triangles[t];
        const glm::dvec3 a(geometry.vertices[v.x].position), b(geometry.vertices[v.y].position),
            c(geometry.vertices[v.z].position);
        const double area = glm::length(glm::cross(b - a, c - a)) / 2;
        const double parts = std::max(1.0, elements_in_a_square * area / (size * size));
        const bool two_sided =
            scene.materials[at(scene.objects[at(geometry.surfaces[at(geometry.triangle_surface[t])].object)].material)]
                .two_sided;
        elements += parts * (two_sided ? 2 : 1);
        vertices += (parts - 1) / 2 * (two_sided ? 2 : 1) + (two_sided ? 0.5 : 0);
    }
    const bool sampled = is_sampled(static_cast<std::uint64_t>(vertices));
    const double groups = count_light_samples(scene, static_cast<float>(receiver_cell * size), most_samples);
    const double apart = std::max(0.0, vertices - double(geometry.vertices.size())); // of refined walls
    const double gathering =
        sampled ? std::min<double>(cut_groups * groups + apart, most_samples) : std::min(groups + apart, vertices);
    const double lit = sampled ? gathering : vertices;
    const double contacts =
        contact_vertices(static_cast<std::uint64_t>(vertices), static_cast<std::uint32_t>(gathering));
    const double fine =
        std::max(contacts, std::min<double>(fine_vertices(static_cast<std::uint64_t>(vertices)), 4 * lit));
    plan.program = bytes_of_program;
    plan.samples = static_cast<std::uint64_t>(lit);
    plan.vertices = static_cast<std::uint64_t>(vertices + fine);
    plan.elements = static_cast<std::uint64_t>(elements + 2 * fine);

    const double channel_bytes = 4.0 * ChannelField(0, channels).stride;
    const double all_vertices = vertices + fine, all_elements = elements + 2 * fine;
    const auto bytes = [](double b) { return static_cast<std::uint64_t>(b); };
    plan.scene = bytes(32.0 * double(geometry.vertices.size()) + 16.0 * double(geometry.triangles.size()) +
                       16.0 * double(geometry.surfaces.size()));
    for (const Material& material : scene.materials)
        if (material.texture && material.texture->image) plan.scene += material.texture->image->rgb.size() * 12;
    plan.mesh = bytes(a_vertex * all_vertices + an_element * all_elements +
                      std::max(edges_of_an_element, bends_of_an_element) * all_elements);
    plan.world = bytes((bytes_of_box + 12 + 12 + 8) * double(geometry.triangles.size()) + 12 * vertices);
    // A row is of most luminaires where there are few.
    const double shares = double(scene.luminaires.size()) * share_of_luminaires + 1;
    plan.direct = bytes((lit + fine) * (24 + 12 * shares));
    const int most_rays = std::max(scene.solve.max_rays, independent_sets * rays_per_pass);
    const double receivers = gathering + contacts;
    plan.rows = bytes(8.0 * receivers * most_rays + 12.0 * receivers * independent_sets * rays_per_pass);
    // Of the system some fifteen vectors (gather_system.h); at all vertices indirect light, the whole of it, and what
    // is read of direct light.
    plan.fields = bytes(15 * channel_bytes * receivers + (3 * channel_bytes + a_shown_vertex) * all_vertices);
    return plan;
}

} // namespace lueur
