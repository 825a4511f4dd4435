// From MTL to the materials of a scene.
#pragma once

#include "precompute/scene/obj/mtl_file.h"
#include "precompute/scene/picture_files.h"
#include "precompute/scene/polygons/add_meshes.h"
#include "precompute/scene/scene.h"

#include <string>

namespace relume::scene::obj {

struct ObjMaterial {
    Material material;
    UvTransforms uv_sets;  // that its textures ask for
};

class Materials {
  public:
    // Both must outlive this.
    Materials(PictureFiles& pictures, Scene& scene) : pictures_(pictures), scene_(scene) {}

    // Metallic-roughness where the file speaks of roughness or metal, Phong where it shines
    // (Ks and Ns), else Lambert. What is not read is named in the scene's report. Throws
    // SceneError for pictures that cannot be decoded and for more than there may be.
    [[nodiscard]] ObjMaterial from_mtl(const MtlMaterial& source);

  private:
    // The picture of one keyword; null where there is none.
    [[nodiscard]] const Texture* picture(const MtlMaterial& source,
                                         const char* key,
                                         TextureContent content);
    [[nodiscard]] TextureUse use(Texture texture, const MtlTexture& how, ObjMaterial& target);
    void add_base(const MtlMaterial& source, ObjMaterial& target);
    void add_shine(const MtlMaterial& source, ObjMaterial& target);
    void add_roughness_and_metal(const MtlMaterial& source, ObjMaterial& target);
    void add_relief(const MtlMaterial& source, ObjMaterial& target);
    void name_unused(const MtlMaterial& source);
    void unused(const MtlMaterial& source, const std::string& what);
    void repaired(const MtlMaterial& source, const std::string& what);

    PictureFiles& pictures_;
    Scene& scene_;
};

}  // namespace relume::scene::obj
