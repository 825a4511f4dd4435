#include "server/net/library/tabulated_material.h"

#include "protocol/tripling/material_file.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <utility>

namespace relume::net {

TabulatedMaterial::TabulatedMaterial(std::filesystem::path file,
                                     std::shared_ptr<ResidentCache> cache)
    : file_(std::move(file)), cache_(std::move(cache)) {
    const tripling::MaterialField field = tripling::read_material_file(file_);
    face_resolution_ = field.face_resolution();
    colours_ = field.colours;
}

std::shared_ptr<const triple::TexelMaterial> TabulatedMaterial::texels() {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const triple::TexelMaterial> texels = texels_.lock();
    if (!texels) {
        if (failure_) {
            throw tripling::MaterialFileError(*failure_);
        }
        try {
            const tripling::MaterialField field = tripling::read_material_file(file_);
            if (field.face_resolution() != face_resolution_ || field.colours != colours_) {
                throw tripling::MaterialFileError(
                    fmt::format("{}: another material, expected the one that was there first",
                                file_.filename().string()));
            }
            // Whoever waits for the lock must not be run by this thread meanwhile.
            tbb::this_task_arena::isolate([&] {
                texels = std::make_shared<const triple::TexelMaterial>(field);
            });
        } catch (const std::exception& failure) {
            failure_ = failure.what();
            throw;
        }
        texels_ = texels;
    }
    cache_->keep(texels, texels->byte_count());
    return texels;
}

}  // namespace relume::net
