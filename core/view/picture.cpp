#include "core/view/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/view/pixel_loop.h"

namespace lueur {

namespace {

constexpr int most_back_faces = 64; // culled surfaces a ray looks through

glm::vec3 texel(const TextureImage& image, int x, int y) {
    const auto wrap = [](int i, int n) { return ((i % n) + n) % n; };
    return image.rgb[std::size_t(wrap(y, image.height)) * image.width + wrap(x, image.width)];
}

} // namespace

glm::vec3 sample_texture(const TextureImage& image, glm::vec2 uv) {
    const float x = uv.x * float(image.width) - 0.5f, y = uv.y * float(image.height) - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y), tx = x - fx, ty = y - fy;
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const glm::vec3 top = glm::mix(texel(image, ix, iy), texel(image, ix + 1, iy), tx);
    const glm::vec3 bottom = glm::mix(texel(image, ix, iy + 1), texel(image, ix + 1, iy + 1), tx);
    return glm::mix(top, bottom, ty);
}

Hit seen_hit(const World& world, Ray ray) {
    Hit hit = world.closest(ray);
    for (int k = 0; k < most_back_faces && hit.back_face; ++k) {
        ray.t_min = hit.t + std::max(world.epsilon(), 1e-6f * hit.t);
        hit = world.closest(ray);
    }
    return hit;
}

std::vector<double> irradiance_channels(const Field& field, const FieldPoint& point) {
    if (field.irradiance.count == 0 || !field.wavelengths) return {};
    std::vector<double> channels(static_cast<std::size_t>(field.wavelengths->size()), 0.0);
    for (int k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < channels.size(); ++c)
            channels[c] += double(point.weights[k]) * field.irradiance[point.vertices[k]][c];
    return channels;
}

std::optional<FieldPoint> field_along_ray(const FieldView& view, const Ray& ray) {
    if (!view.world || !view.mesh || !view.field) return std::nullopt;
    const Hit hit = seen_hit(*view.world, ray);
    if (!hit.any() || hit.back_face) return std::nullopt;
    const Mesh& mesh = *view.mesh;
    const Located at_point = locate(mesh, hit.element, hit.b1, hit.b2);
    FieldPoint point{};
    point.position = ray.origin + hit.t * ray.direction;
    point.surface = hit.surface;
    const Scene& scene = *view.scene;
    const Object& object = scene.objects[at(scene.geometry->surfaces[hit.surface].object)];
    const auto& texture = scene.materials[at(object.material)].texture;
    const Shades& shades = view.trichromatic && view.field->trichromatic ? *view.field->trichromatic
                                                                         : static_cast<const Shades&>(*view.field);
    const bool textured =
        texture && texture->image && !texture->image->rgb.empty() && !shades.reflected_by_texel.empty();
    glm::dvec3 reflected(0), emitted(0);
    glm::dmat3 by_texel(0);
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = at_point.vertices[k];
        const float w = at_point.weights[k];
        point.vertices[k] = v, point.weights[k] = w;
        point.normal += w * mesh.vertices[v].normal;
        point.uv += w * mesh.vertices[v].uv;
        point.irradiance += double(w) * glm::dvec3(view.field->irradiance_xyz[v]);
        reflected += double(w) * glm::dvec3(shades.reflected_xyz[v]);
        emitted += double(w) * glm::dvec3(shades.emitted_xyz[v]);
        if (textured) by_texel += double(w) * glm::dmat3(shades.reflected_by_texel[v]);
        point.unshot += w * view.field->unshot[v];
        if (!view.field->error.empty()) {
            point.error += w * std::hypot(view.field->error[v], view.field->interpolation_error[v]);
            point.relative_error += w * view.field->relative_error[v];
        }
        if (!view.field->colour_difference.empty()) point.colour_difference += w * view.field->colour_difference[v];
    }
    if (glm::dot(point.normal, point.normal) > 0) point.normal = glm::normalize(point.normal);
    // B_pixel = E + (B - E) rho_pixel / rho_mean at every wavelength (lecture, corrections 35): core/solve/field.h.
    if (textured) {
        point.texel = sample_texture(*texture->image, point.uv);
        reflected = by_texel * glm::dvec3(*point.texel);
    }
    point.emitted = emitted;
    point.radiance = emitted + reflected;
    return point;
}

RadianceImage render_picture(const FieldView& view, const Camera& camera, const PictureParams& params,
                             PictureQuantity quantity, const std::atomic<bool>& cancel,
                             const std::function<void(double)>& progress) {
    RadianceImage image{params.width, params.height, {}};
    image.xyz.assign(std::size_t(params.width) * params.height, glm::vec3(0));
    const int samples = params.samples_per_axis * params.samples_per_axis;
    // XYZ of a grey whose Y is 1: the picture of a single number.
    const glm::dvec3 grey = xyz_from_rgb(srgb) * glm::dvec3(1);
    if (!for_each_pixel(params, cancel, progress, [&](int x, int y) {
            glm::dvec3 sum(0);
            for_each_sample(view, camera, params, x, y, [&](const FieldPoint& point) {
                switch (quantity) {
                case PictureQuantity::colour:
                    sum += point.radiance;
                    break;
                case PictureQuantity::luminance:
                    sum += point.radiance.y * grey;
                    break;
                case PictureQuantity::illuminance:
                    sum += point.irradiance.y * grey;
                    break;
                case PictureQuantity::colour_difference:
                    sum += double(point.colour_difference) * grey;
                    break;
                case PictureQuantity::error:
                    sum += double(point.relative_error) * grey;
                    break;
                }
            });
            image.xyz[std::size_t(y) * params.width + x] = glm::vec3(sum / double(samples));
        }))
        return {};
    return image;
}

} // namespace lueur
