#include "precompute/scene/import_assimp.h"

#include "precompute/scene/error.h"
#include "precompute/scene/import_folder.h"
#include "precompute/scene/import_log.h"
#include "precompute/scene/import_nodes.h"
#include "precompute/scene/srgb.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

namespace relume::scene {
namespace {

namespace fs = std::filesystem;

// Where a file gives no normals, edges sharper than this stay sharp.
constexpr float kCreaseDegrees = 60;

// assimp 5.2 waits for ever for the rest of a PLY header that has no end.
void check_ply_header(const fs::path& path) {
    constexpr std::size_t kLongestHeader = 65536;
    std::string head(kLongestHeader, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    const bool is_ply = head.rfind("ply", 0) == 0;
    const std::size_t end = head.find("\nend_header");
    if (!is_ply || end == std::string::npos || head.find('\n', end + 1) == std::string::npos)
        throw SceneError(
            SceneFault::corrupt_file,
            fmt::format("scene '{}' has no PLY header; expected 'ply' … 'end_header' "
                        "in its first {} bytes",
                        path.string(), kLongestHeader));
}

// Before assimp's own steps walk over the arrays by these indices.
void check_mesh(const std::string& file, const aiMesh& mesh) {
    const auto where = [&] {
        return fmt::format("scene '{}', mesh '{}'", file, mesh.mName.C_Str());
    };
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw SceneError(
                SceneFault::non_finite_vertex,
                fmt::format("{}: vertex {} is ({}, {}, {}); expected finite numbers", where(),
                            i, p.x, p.y, p.z));
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices)
                throw SceneError(
                    SceneFault::index_out_of_range,
                    fmt::format("{}: face {} refers to vertex {}; expected below {}", where(),
                                i, face.mIndices[k], mesh.mNumVertices));
        }
    }
}

void report_unused(const aiScene& source, const FolderIo& io, ImportReport& report) {
    std::size_t loose = 0;
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        const aiMesh& mesh = *source.mMeshes[i];
        for (unsigned k = 0; k < mesh.mNumFaces; ++k)
            loose += mesh.mFaces[k].mNumIndices < 3 ? 1 : 0;
    }
    if (loose > 0)
        report.unused.push_back(fmt::format("{} points and lines", loose));
    for (const std::string& file : io.refused())
        report.unused.push_back(
            fmt::format("file '{}' (missing, too large or outside the scene's folder)", file));
}

void decode_vertex_colours(Scene& scene) {
    for (Mesh& mesh : scene.meshes) {
        for (Imath::V3f& c : mesh.colours)
            c = {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
    }
}

// Colour per vertex is the base colour where the file gives no other.
void whiten_coloured_materials(Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.colours.empty())
            scene.materials[mesh.material].base_colour = Imath::V3f(1);
    }
}

bool has_polygons(const aiMesh& mesh) {
    return std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                       [](const aiFace& face) { return face.mNumIndices >= 3; });
}

bool lacks_normals(const aiScene& source) {
    return std::any_of(source.mMeshes, source.mMeshes + source.mNumMeshes,
                       [](const aiMesh* mesh) { return !mesh->HasNormals(); });
}

// assimp drops faces whose indices it cannot follow and says so only in its log.
void check_log(const std::string& file, const ImportLog& log, ImportReport& report) {
    for (const std::string& warning : log.warnings()) {
        if (warning.find("out-of-range") != std::string::npos)
            throw SceneError(SceneFault::index_out_of_range,
                             fmt::format("scene '{}': {}", file, warning));
        report.repairs.push_back("reader: " + warning);
    }
}

const aiScene& read_file(Assimp::Importer& importer,
                         const fs::path& path,
                         ImportReport& report) {
    const ImportLog log;
    const std::string file = path.string();
    const auto require = [&](const aiScene* source) -> const aiScene& {
        if (source == nullptr || source->mRootNode == nullptr)
            throw SceneError(
                SceneFault::corrupt_file,
                fmt::format("scene '{}' cannot be read: {}", file, importer.GetErrorString()));
        return *source;
    };
    const aiScene& raw = require(importer.ReadFile(file, 0));
    check_log(file, log, report);
    bool has_faces = false;
    for (unsigned i = 0; i < raw.mNumMeshes; ++i) {
        check_mesh(file, *raw.mMeshes[i]);
        has_faces = has_faces || has_polygons(*raw.mMeshes[i]);
    }
    report_unused(raw, *static_cast<FolderIo*>(importer.GetIOHandler()), report);
    if (!has_faces)
        throw SceneError(
            SceneFault::no_geometry,
            fmt::format("scene '{}' holds no triangles; expected at least one", file));
    // Points and lines go first: assimp 5.2 ends the program where it should triangulate them.
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene& polygons = require(importer.ApplyPostProcessing(aiProcess_SortByPType));
    if (lacks_normals(polygons))
        report.repairs.emplace_back("missing normals made, smooth up to 60 degree edges");
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kCreaseDegrees);
    return require(importer.ApplyPostProcessing(
        aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenSmoothNormals));
}

}  // namespace

ImportedScene import_with_assimp(const fs::path& path,
                                 FileFormat format,
                                 const ImportOptions& options) {
    if (format == FileFormat::ply)
        check_ply_header(path);
    ImportedScene imported;
    Scene& scene = imported.scene;
    scene.name = path.stem().string();
    const fs::path folder = fs::absolute(path).parent_path();
    Assimp::Importer importer;
    importer.SetIOHandler(new FolderIo(folder, options.max_file_bytes));  // importer owns it
    const aiScene& source = read_file(importer, path, scene.report);
    import_meshes(source, options.max_triangles, options.max_nodes, imported);
    MaterialImporter(source, format, folder, options.max_textures, scene).import_all();
    decode_vertex_colours(scene);
    if (format == FileFormat::ply)
        whiten_coloured_materials(scene);
    return imported;
}

}  // namespace relume::scene
