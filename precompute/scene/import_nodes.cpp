#include "precompute/scene/import_nodes.h"

#include "precompute/scene/error.h"

#include <Imath/ImathMatrix.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

// Imath multiplies row vectors, assimp column vectors: hence the transpose.
Imath::M44d matrix_of(const aiMatrix4x4& m) {
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2,
            m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

Imath::V3d vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

// Normals go with the cofactors of the matrix: right for any scale and mirror, no inverse.
Imath::M33d cofactors_of(const Imath::M44d& m) {
    const Imath::V3d x(m[0][0], m[0][1], m[0][2]);
    const Imath::V3d y(m[1][0], m[1][1], m[1][2]);
    const Imath::V3d z(m[2][0], m[2][1], m[2][2]);
    const Imath::V3d yz = y.cross(z);
    const Imath::V3d zx = z.cross(x);
    const Imath::V3d xy = x.cross(y);
    return {yz.x, yz.y, yz.z, zx.x, zx.y, zx.z, xy.x, xy.y, xy.z};
}

std::vector<Imath::V3d> positions_in_world(const aiMesh& from, const Imath::M44d& to_world) {
    std::vector<Imath::V3d> positions;
    positions.reserve(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i)
        positions.push_back(vector_of(from.mVertices[i]) * to_world);
    return positions;
}

// All but the positions.
Mesh mesh_in_world(const aiMesh& from, const Imath::M44d& to_world, const std::string& name) {
    Mesh mesh;
    mesh.name = name;
    mesh.material = from.mMaterialIndex;
    if (from.HasNormals()) {
        const Imath::M33d cofactors = cofactors_of(to_world);
        mesh.normals.reserve(from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; ++i)
            mesh.normals.emplace_back((vector_of(from.mNormals[i]) * cofactors).normalized());
    }
    if (from.HasTextureCoords(0)) {
        mesh.uvs.reserve(from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; ++i)
            mesh.uvs.emplace_back(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y);
    }
    if (from.HasVertexColors(0)) {
        mesh.colours.reserve(from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; ++i) {
            const aiColor4D& c = from.mColors[0][i];
            mesh.colours.emplace_back(c.r, c.g, c.b);
        }
    }
    mesh.triangles.reserve(from.mNumFaces);
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (face.mNumIndices == 3)
            mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
    return mesh;
}

std::string mesh_name(const aiNode& node, const aiMesh& mesh) {
    return mesh.mName.length > 0 ? fmt::format("{}/{}", node.mName.C_Str(), mesh.mName.C_Str())
                                 : std::string(node.mName.C_Str());
}

}  // namespace

void import_meshes(const aiScene& source,
                   std::uint64_t max_triangles,
                   std::uint32_t max_nodes,
                   ImportedScene& imported) {
    Scene& scene = imported.scene;
    std::vector<std::pair<const aiNode*, Imath::M44d>> open{{source.mRootNode, Imath::M44d()}};
    std::uint64_t triangles = 0;
    std::uint64_t nodes = 0;
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        if (++nodes > max_nodes)
            throw SceneError(
                SceneFault::too_large,
                fmt::format("scene '{}' has more than {} nodes", scene.name, max_nodes));
        const Imath::M44d to_world = matrix_of(node->mTransformation) * parent;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            const aiMesh& mesh = *source.mMeshes[node->mMeshes[i]];
            triangles += mesh.mNumFaces;
            if (triangles > max_triangles)
                throw SceneError(SceneFault::too_large,
                                 fmt::format("scene '{}' has more than {} triangles",
                                             scene.name, max_triangles));
            scene.meshes.push_back(mesh_in_world(mesh, to_world, mesh_name(*node, mesh)));
            imported.positions.push_back(positions_in_world(mesh, to_world));
        }
        for (unsigned i = node->mNumChildren; i > 0; --i)  // children in the file's order
            open.emplace_back(node->mChildren[i - 1], to_world);
    }
}

}  // namespace relume::scene
