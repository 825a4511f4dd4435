// The numbers of a PLY file one after another, whatever they are written as.
#pragma once

#include "precompute/scene/ply/ply_header.h"

#include <string>
#include <string_view>

namespace relume::scene::ply {

class Values {
  public:
    // `data` is what follows the header; both must outlive this.
    Values(std::string_view data, Encoding encoding, const std::string& name)
        : data_(data), encoding_(encoding), name_(name) {}

    // Throws SceneError (corrupt_file) at the end of the data, and for what is no number.
    [[nodiscard]] double next(Type type);
    // A list's length or an index: a whole number from 0. Throws likewise.
    [[nodiscard]] std::uint64_t next_whole(Type type);
    // Whether `count` times the least that `element` can take is still there.
    [[nodiscard]] bool can_hold(const Element& element) const;

  private:
    [[noreturn]] void refuse(const std::string& why) const;
    [[nodiscard]] double next_text();

    std::string_view data_;
    Encoding encoding_;
    const std::string& name_;
};

}  // namespace relume::scene::ply
