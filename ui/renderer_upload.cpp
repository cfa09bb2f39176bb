// What of a snapshot goes to the graphics memory, and when.
#include <algorithm>
#include <numeric>

#include "ui/renderer.h"

namespace lueur {

void Renderer::set_snapshot(const Snapshot& snapshot) {
    const bool new_mesh = snapshot.mesh != mesh_;
    if (!snapshot.mesh || !snapshot.scene || !snapshot.field) {
        if (mesh_) stale_ = true;
        mesh_.reset();
        field_.reset();
        scene_.reset();
        batches_.clear();
        surface_images_.clear();
        return;
    }
    if (new_mesh) {
        mesh_ = snapshot.mesh;
        bounds_ = bounds_of(*snapshot.scene->geometry);
        upload_mesh(*mesh_, *snapshot.scene);
        surface_images_.clear();
        stale_ = true;
    }
    if (new_mesh || snapshot.scene != scene_) {
        scene_ = snapshot.scene;
        upload_elements(*mesh_, *scene_);
    }
    if (new_mesh || snapshot.field != field_) {
        field_ = snapshot.field;
        upload_field(*field_);
        stale_ = true;
    }
    if (snapshot.status.shooting_patch != shooting_) {
        shooting_ = snapshot.status.shooting_patch;
        stale_ = true;
    }
}

void Renderer::upload_mesh(const Mesh& mesh, const Scene& scene) {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> objects;
    positions.reserve(mesh.vertices.size());
    for (const auto& vertex : mesh.vertices) {
        positions.push_back(vertex.position);
        uvs.push_back(vertex.uv);
        objects.push_back(static_cast<std::uint32_t>(scene.geometry->surfaces[vertex.surface].object));
    }
    fill(GL_ARRAY_BUFFER, positions_, positions, GL_STATIC_DRAW);
    fill(GL_ARRAY_BUFFER, uvs_, uvs, GL_STATIC_DRAW);
    fill(GL_ARRAY_BUFFER, objects_, objects, GL_STATIC_DRAW);
}

// Elements in batches of one texture. Runs when the mesh or the textures of its surfaces have changed.
void Renderer::upload_elements(const Mesh& mesh, const Scene& scene) {
    std::vector<std::shared_ptr<const TextureImage>> images;
    std::vector<MaterialIndex> materials;
    for (const auto& surface : scene.geometry->surfaces) {
        const auto material = scene.objects[at(surface.object)].material;
        const auto& texture = scene.materials[at(material)].texture;
        images.push_back(texture ? texture->image : nullptr);
        materials.push_back(material);
    }
    if (!surface_images_.empty() && images == surface_images_ && materials == surface_materials_) return;
    surface_images_ = std::move(images);
    surface_materials_ = std::move(materials);
    stale_ = true;

    // Only textured materials need a batch of their own; their order is that of the scene.
    const auto key = [&](std::uint32_t element) {
        const auto surface = mesh.element_surface[element];
        return surface_images_[surface] ? at(surface_materials_[surface]) + 1 : 0;
    };
    std::vector<std::uint32_t> order(mesh.elements.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, key);

    ordered_elements_.clear();
    ordered_patches_.clear();
    planes_.clear();
    spheres_.clear();
    batches_.clear();
    std::size_t present = 0;
    for (const auto element : order) {
        if (batches_.empty() || key(element) != present) {
            present = key(element);
            const auto surface = mesh.element_surface[element];
            batches_.push_back(
                {surface_images_[surface].get(), surface_materials_[surface], ordered_elements_.size(), 0, 0, 0});
        }
        ++batches_.back().count;
        ordered_elements_.push_back(mesh.elements[element]);
        ordered_patches_.push_back(mesh.coarse_patch[mesh.element_coarse[element]]);
        const auto corner = [&](int k) { return mesh.vertices[mesh.elements[element][k]].position; };
        const glm::vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        planes_.emplace_back(normal, -glm::dot(normal, corner(0)));
    }
    for (std::size_t first = 0; first < ordered_elements_.size(); first += elements_a_block) {
        const std::size_t last = std::min(first + elements_a_block, ordered_elements_.size());
        glm::vec3 low(1e30f), high(-1e30f);
        for (std::size_t e = first; e < last; ++e)
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 p = mesh.vertices[ordered_elements_[e][k]].position;
                low = glm::min(low, p), high = glm::max(high, p);
            }
        spheres_.emplace_back(0.5f * (low + high), 0.5f * glm::distance(low, high));
    }
    glBindTexture(GL_TEXTURE_BUFFER, coarse_texture_);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_R32UI, coarse_);

    std::map<const TextureImage*, GlTexture> textures;
    for (const auto& batch : batches_) {
        if (!batch.image || textures.contains(batch.image)) continue;
        if (auto known = textures_.extract(batch.image)) {
            textures.insert(std::move(known));
            continue;
        }
        auto texture = new_texture();
        glBindTexture(GL_TEXTURE_2D, texture);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, batch.image->width, batch.image->height, 0, GL_RGB, GL_FLOAT,
                     batch.image->rgb.data());
        glGenerateMipmap(GL_TEXTURE_2D);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        textures.emplace(batch.image, std::move(texture));
    }
    textures_ = std::move(textures);
}

void Renderer::upload_field(const Field& field) {
    const auto upload = [](ShadeBuffers& buffers, const Shades& shades) {
        fill(GL_ARRAY_BUFFER, buffers.reflected, shades.reflected_xyz, GL_STREAM_DRAW);
        fill(GL_ARRAY_BUFFER, buffers.emitted, shades.emitted_xyz, GL_STREAM_DRAW);
        fill(GL_ARRAY_BUFFER, buffers.by_texel, shades.reflected_by_texel, GL_STREAM_DRAW);
    };
    any_texture_ = !field.reflected_by_texel.empty();
    upload(shades_, field);
    if (field.trichromatic) upload(trichromatic_, *field.trichromatic);
    std::vector<float> difference = field.colour_difference;
    difference.resize(field.unshot.size(), 0.0f);
    fill(GL_ARRAY_BUFFER, difference_, difference, GL_STREAM_DRAW);
    fill(GL_ARRAY_BUFFER, error_, field.relative_error, GL_STREAM_DRAW);
    fill(GL_ARRAY_BUFFER, unshot_, field.unshot, GL_STREAM_DRAW);
    std::vector<float> illuminance; // lx
    illuminance.reserve(field.irradiance_xyz.size());
    for (const glm::vec3& irradiance : field.irradiance_xyz) illuminance.push_back(irradiance.y);
    fill(GL_ARRAY_BUFFER, illuminance_, illuminance, GL_STREAM_DRAW);
}

} // namespace lueur
