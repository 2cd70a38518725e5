#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>

#include "planner/mesh_import/files/library_mesh.h"

namespace assay::mesh_import {
namespace {

// All nodes are put into one frame. Points, lines, normals, colours and textures are dropped.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType |
                            aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices |
                            aiProcess_PreTransformVertices;
constexpr int kDropped = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                         aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_ANIMATIONS |
                         aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS |
                         aiComponent_MATERIALS | aiComponent_BONEWEIGHTS;

bool HasPoints(const aiMesh& mesh) {
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  }
  return mesh.mNumVertices > 0;
}

void Add(const aiMesh& mesh, LibrarySurface& surface) {
  const int first = static_cast<int>(surface.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    surface.vertices.emplace_back(p.x, p.y, p.z);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    surface.triangles.push_back({first + static_cast<int>(face.mIndices[0]),
                                 first + static_cast<int>(face.mIndices[1]),
                                 first + static_cast<int>(face.mIndices[2])});
  }
}

class AssimpReader : public MeshLibrary {
 public:
  LibrarySurface Read(std::string_view text) const override {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kDropped);
    const aiScene* scene = importer.ReadFileFromMemory(text.data(), text.size(), kSteps, "dae");
    LibrarySurface surface;
    if (scene == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
      surface.error = scene == nullptr ? importer.GetErrorString() : "it has no meshes";
      return surface;
    }
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
      if (!HasPoints(*scene->mMeshes[i])) {
        surface.error = "a mesh without points, or with points that are no numbers";
        return surface;
      }
      Add(*scene->mMeshes[i], surface);
    }
    return surface;
  }
};

}  // namespace
}  // namespace assay::mesh_import

// The function that mesh_import::ReadLibraryMesh looks up in the module.
extern "C" const assay::mesh_import::MeshLibrary* AssayAssimpReader() {
  static const assay::mesh_import::AssimpReader reader;
  return &reader;
}
