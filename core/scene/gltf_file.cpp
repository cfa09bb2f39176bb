// glTF 2.0 (.gltf, .glb): the only code that sees assimp.
#include <algorithm>
#include <cmath>
#include <map>

#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/scene.h>

#include "core/scene/files.h"
#include "core/scene/gltf_json.h"
#include "core/scene/import.h"
#include "core/scene/texture.h"

namespace lueur {

namespace {

glm::dmat4 matrix_from(const aiMatrix4x4& m) { // assimp keeps rows
    return glm::transpose(
        glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}
glm::dvec3 vector_from(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

struct GltfReader {
    const ImportRequest& request;
    Diagnostics& diagnostics;
    const aiScene& file;
    const GltfJson& json;
    std::string name = request.file.string();
    ImportedModel model{};
    std::vector<std::optional<MaterialIndex>> material_of{}; // assimp's material -> ours, made when first used
    std::vector<Rgb> emission{};                             // of ours
    std::vector<std::shared_ptr<const TextureImage>> emission_picture{};
    UniqueNames object_names{}, material_names{};
    std::size_t lines_and_points = 0;
    bool failed = false;

    void warning(std::string_view what) { diagnostics.warning(name, {}, what); }
    void error(std::string_view what) {
        diagnostics.error(name, {}, what);
        failed = true;
    }

    void read() {
        material_of.resize(file.mNumMaterials);
        for (unsigned i = 0; i < file.mNumTextures; ++i) embedded(i);
        node(*file.mRootNode, glm::dmat4(1));
        for (unsigned i = 0; i < file.mNumLights; ++i)
            warning(fmt::format("light \"{}\" left out: only surfaces emit here", file.mLights[i]->mName.C_Str()));
        if (lines_and_points) warning(fmt::format("{} lines and points left out: they have no area", lines_and_points));
        if (file.mNumAnimations) warning("animations left out: the scene is shown as it stands");
        if (model.soup.triangles.empty() && !failed)
            error("has no triangles; at least one mesh of triangles is needed");
    }

    void embedded(unsigned i) {
        const aiTexture& texture = *file.mTextures[i];
        if (texture.mHeight != 0) return; // raw texels: glTF has none
        const auto* bytes = reinterpret_cast<const std::byte*>(texture.pcData);
        const std::string picture = fmt::format("*{}", i);
        if (auto image = read_texture_memory({bytes, texture.mWidth}, request.written + picture))
            model.pictures[picture] = std::make_shared<const TextureImage>(std::move(*image));
        else
            warning(fmt::format("picture {} inside the file left out: {}", picture, image.error()));
    }

    // The picture and the path that names it in a scene file.
    std::optional<Texture> texture_of(const aiMaterial& material, aiTextureType type,
                                      const std::string& material_name) {
        aiString path;
        if (material.GetTexture(type, 0, &path) != AI_SUCCESS) return {};
        Texture texture;
        if (path.C_Str()[0] == '*') {
            const auto found = model.pictures.find(path.C_Str());
            if (found == model.pictures.end()) return {}; // told when it was read
            texture.path = request.written + path.C_Str();
            texture.image = found->second;
        } else {
            std::string uri = path.C_Str();
            auto image = read_texture(request.file.parent_path() / uri);
            if (!image) {
                warning(fmt::format("texture of material \"{}\" left out, its mean colour stays the base colour: {}",
                                    material_name, image.error()));
                return {};
            }
            texture.path =
                (std::filesystem::path(request.written).parent_path() / uri).lexically_normal().generic_string();
            texture.image = std::make_shared<const TextureImage>(std::move(*image));
        }
        aiUVTransform transform;
        if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == AI_SUCCESS &&
            (transform.mScaling != aiVector2D(1, 1) || transform.mTranslation != aiVector2D(0, 0) ||
             transform.mRotation != 0))
            warning(
                fmt::format("texture of material \"{}\" is scaled, moved or turned (KHR_texture_transform): left out",
                            material_name));
        return texture;
    }

    MaterialIndex material(unsigned index) {
        if (material_of[index]) return *material_of[index];
        const MaterialIndex made{static_cast<std::uint32_t>(model.materials.size())};
        material_of[index] = made;
        const aiMaterial& source = *file.mMaterials[index];
        Material result;
        const std::string given = source.GetName().C_Str();
        result.name = material_names.take(given.empty() ? "material" : given);

        aiColor4D base(0.5f, 0.5f, 0.5f, 1), glow(0, 0, 0, 1);
        const bool has_base = source.Get(AI_MATKEY_BASE_COLOR, base) == AI_SUCCESS;
        if (!has_base)
            warning(fmt::format("material \"{}\" has no base colour; its reflectance becomes 0.5", result.name));
        const Rgb colour{base.r, base.g, base.b};
        for (int k = 0; k < 3; ++k)
            if (!(colour[k] >= 0 && colour[k] <= 1)) {
                error(fmt::format("material \"{}\": base colour {} is out of range; 0..1 is allowed", result.name,
                                  colour[k]));
                return made;
            }
        result.reflectance = colour;
        result.texture = texture_of(source, aiTextureType_BASE_COLOR, result.name);
        int sides = 0;
        result.two_sided = source.Get(AI_MATKEY_TWOSIDED, sides) == AI_SUCCESS && sides != 0;
        float metallic = 0;
        aiString metallic_picture; // times the factor, which is then 1 as a rule and says nothing
        if (source.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS && metallic > 0.5f &&
            source.GetTexture(aiTextureType_METALNESS, 0, &metallic_picture) != AI_SUCCESS)
            warning(fmt::format("material \"{}\" is a metal; it is taken as matt in its base colour", result.name));
        aiString alpha;
        if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, alpha) == AI_SUCCESS && std::string_view(alpha.C_Str()) != "OPAQUE")
            warning(fmt::format("material \"{}\" is transparent; it is taken as opaque", result.name));

        source.Get(AI_MATKEY_COLOR_EMISSIVE, glow);
        const double strength =
            index < json.emissive_strength.size() ? json.emissive_strength[index] : 1; // assimp keeps the file's order
        Rgb radiance = Rgb(glow.r, glow.g, glow.b) * strength;
        for (int k = 0; k < 3; ++k)
            if (!(radiance[k] >= 0 && radiance[k] < 1e12)) {
                error(fmt::format("material \"{}\": emission {} is out of range; 0 or more is allowed", result.name,
                                  radiance[k]));
                radiance = Rgb(0);
            }
        emission.push_back(radiance);
        emission_picture.emplace_back();
        if (radiance != Rgb(0))
            if (const auto picture = texture_of(source, aiTextureType_EMISSIVE, result.name)) {
                emission_picture.back() = picture->image;
                warning(fmt::format("material \"{}\" emits a picture; it emits the mean of it", result.name));
            }
        model.materials.push_back(std::move(result));
        return made;
    }

    void node(const aiNode& here, const glm::dmat4& world_from_parent) {
        const glm::dmat4 world_from_node = world_from_parent * matrix_from(here.mTransformation);
        std::map<unsigned, ObjectIndex> object_of; // assimp's material -> object
        for (unsigned i = 0; i < here.mNumMeshes; ++i) {
            const aiMesh& mesh = *file.mMeshes[here.mMeshes[i]];
            if (!(mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) {
                lines_and_points += mesh.mNumFaces;
                continue;
            }
            object_of[mesh.mMaterialIndex] = {};
        }
        std::string wanted = here.mName.C_Str();
        if (wanted.empty() && here.mNumMeshes) wanted = file.mMeshes[here.mMeshes[0]]->mName.C_Str();
        if (wanted.empty()) wanted = "object";
        for (auto& [index, object] : object_of) {
            const MaterialIndex made = material(index);
            if (failed) return;
            object = ObjectIndex{static_cast<std::uint32_t>(model.objects.size())};
            model.objects.push_back(
                {object_names.take(object_of.size() == 1 ? wanted : wanted + "." + model.materials[at(made)].name),
                 made});
        }
        for (unsigned i = 0; i < here.mNumMeshes; ++i) {
            const aiMesh& one = *file.mMeshes[here.mMeshes[i]];
            if (const auto object = object_of.find(one.mMaterialIndex); object != object_of.end())
                mesh(one, object->second, world_from_node);
        }
        for (const auto& [index, object] : object_of) emit(object);
        if (!model.camera) camera(here, world_from_node);
        for (unsigned i = 0; i < here.mNumChildren && !failed; ++i) node(*here.mChildren[i], world_from_node);
    }

    void mesh(const aiMesh& mesh, ObjectIndex object, const glm::dmat4& world_from_node) {
        const glm::dmat3 linear(world_from_node);
        const double determinant = glm::determinant(linear);
        const bool mirrored = determinant < 0; // glTF 2.0, 3.7.4: then clockwise triangles face forward
        // Normals go with the cofactors (inverse transpose times the determinant), which a flattened node still has.
        const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                   glm::cross(linear[0], linear[1]));
        unsigned uv_channel = 0;
        file.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_UVWSRC(aiTextureType_BASE_COLOR, 0), uv_channel);
        const bool has_uv = uv_channel < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(uv_channel);
        const auto base = static_cast<std::uint32_t>(model.soup.vertices.size());
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            Vertex vertex;
            vertex.position = glm::vec3(world_from_node * glm::dvec4(vector_from(mesh.mVertices[i]), 1));
            if (mesh.HasNormals()) {
                const glm::dvec3 normal = cofactors * vector_from(mesh.mNormals[i]) * (mirrored ? -1.0 : 1.0);
                const double length = glm::length(normal);
                if (std::isfinite(length) && length > 0) vertex.normal = glm::vec3(normal / length);
            }
            if (has_uv)
                vertex.uv = {mesh.mTextureCoords[uv_channel][i].x,
                             1 - mesh.mTextureCoords[uv_channel][i].y}; // assimp turned v up
            model.soup.vertices.push_back(vertex);
        }
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices != 3) {
                ++lines_and_points;
                continue;
            }
            glm::uvec3 corners{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
            if (std::max({corners.x, corners.y, corners.z}) >= mesh.mNumVertices) {
                error(fmt::format("mesh \"{}\" names vertex {}; it has {}", mesh.mName.C_Str(),
                                  std::max({corners.x, corners.y, corners.z}), mesh.mNumVertices));
                return;
            }
            if (mirrored) std::swap(corners.y, corners.z);
            model.soup.triangles.push_back(corners + base);
            model.soup.triangle_object.push_back(object);
        }
    }

    void emit(ObjectIndex object) {
        const MaterialIndex material_index = model.objects[at(object)].material;
        Rgb radiance = emission[at(material_index)];
        if (radiance == Rgb(0)) return;
        if (const auto& picture = emission_picture[at(material_index)]) {
            std::vector<glm::uvec3> triangles;
            for (std::size_t i = 0; i < model.soup.triangles.size(); ++i)
                if (model.soup.triangle_object[i] == object) triangles.push_back(model.soup.triangles[i]);
            radiance *= mean_texel(*picture, model.soup.vertices, triangles);
        }
        model.emission.push_back(
            {object, radiance, model.materials[at(material_index)].two_sided ? EmitSide::both : EmitSide::front});
    }

    void camera(const aiNode& here, const glm::dmat4& world_from_node) {
        for (unsigned i = 0; i < file.mNumCameras; ++i) {
            const aiCamera& source = *file.mCameras[i];
            if (source.mName != here.mName) continue;
            const glm::dmat3 linear(world_from_node);
            Camera seen;
            seen.position =
                glm::dvec3(world_from_node[3]); // in its node it stands at 0 and looks along -z: glTF 2.0, 3.10
            seen.target = seen.position - linear[2];
            seen.up = linear[1];
            const double fov = i < json.vertical_fov.size() ? json.vertical_fov[i] * 180 / 3.14159265358979323846 : 0;
            const double bend = glm::length(glm::cross(seen.target - seen.position, seen.up));
            if (!(fov >= 1 && fov <= 170) || !std::isfinite(bend) || bend == 0) continue;
            seen.vertical_fov_degrees = fov;
            model.camera = seen;
            return;
        }
    }
};

} // namespace

std::optional<ImportedModel> read_gltf(const ImportRequest& request, Diagnostics& diagnostics) {
    const std::string name = request.file.string();
    const auto bytes = read_bytes(request.file);
    if (!bytes) {
        diagnostics.error(name, {}, bytes.error());
        return {};
    }
    const std::optional<GltfJson> json = read_gltf_json(*bytes, name, diagnostics);
    if (!json) return {};
    try {
        Assimp::Importer importer;
        const aiScene* file = importer.ReadFile(name, 0);
        if (!file || !file->mRootNode) {
            std::string what = importer.GetErrorString();
            std::replace(what.begin(), what.end(), '\n', ' ');
            diagnostics.error(name, {},
                              fmt::format("{}; a glTF 2.0 file is allowed", what.empty() ? "cannot be read" : what));
            return {};
        }
        GltfReader reader{request, diagnostics, *file, *json};
        reader.read();
        if (reader.failed) return {};
        return std::move(reader.model);
    } catch (const std::exception& exception) { // assimp and its JSON reader throw what they please
        diagnostics.error(name, {}, fmt::format("{}; a glTF 2.0 file is allowed", exception.what()));
        return {};
    }
}

} // namespace lueur
