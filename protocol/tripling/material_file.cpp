#include "protocol/tripling/material_file.h"

#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/regular_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace relume::tripling {
namespace {

// Numbers lie in the file as they lie in memory.
static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "RELUMEMF";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kNamePadding = 4;

struct Header {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t face_resolution = 0;
    std::uint32_t normal_side = 0;
    std::uint32_t reflection_side = 0;
    std::uint32_t lobes = 0;
    float energy_fraction = 0;
    std::uint32_t name_bytes = 0;
    std::uint32_t zero = 0;
    std::uint64_t squares = 0;  // of all entries of all lobes
};
static_assert(sizeof(Header) == 48);

using Scaling = std::array<float, basis::kFaceCount>;
using Counts = std::array<std::uint16_t, basis::kFaceCount>;

constexpr std::size_t kBytesPerEntry = sizeof(Scaling) + sizeof(Counts);
constexpr std::size_t kBytesPerSquare = sizeof(std::uint16_t) + sizeof(SquareCoefficients);

[[noreturn]] void fail(std::string_view what,
                       const std::string& found,
                       const std::string& expected) {
    throw MaterialFileError(fmt::format("{}: found {}, expected {}", what, found, expected));
}

void require_between(std::string_view what,
                     std::uint64_t found,
                     std::uint64_t least,
                     std::uint64_t most) {
    if (found < least || found > most) {
        fail(what, std::to_string(found), fmt::format("{} to {}", least, most));
    }
}

std::uint64_t padded(std::uint64_t bytes) {
    return (bytes + kNamePadding - 1) / kNamePadding * kNamePadding;
}

void require_name(std::string_view name) {
    require_between("bytes of the name", name.size(), 1, MaterialField::kMostNameBytes);
    const bool has_control = std::any_of(name.begin(), name.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
    });
    if (has_control) {
        fail("the name", "a control character", "none");
    }
}

void require_finite(std::string_view what, std::span<const float> values) {
    const auto bad = std::find_if_not(values.begin(), values.end(),
                                      [](float value) { return std::isfinite(value); });
    if (bad != values.end()) {
        fail(what, fmt::format("{}", *bad), "a finite number");
    }
}

void require_header(const Header& header) {
    if (std::string_view(header.magic.data(), header.magic.size()) != kMagic) {
        fail("the beginning", "other bytes", std::string(kMagic));
    }
    require_between("version", header.version, kVersion, kVersion);
    if (!basis::is_face_resolution(header.face_resolution)) {
        fail("face resolution", std::to_string(header.face_resolution),
             fmt::format("a power of two from {} to {}", basis::kMinFaceResolution,
                         basis::kMaxFaceResolution));
    }
    require_between("nodes along a face of normals", header.normal_side, 1,
                    DirectionGrid::kMostSide);
    require_between("nodes along a face of reflections", header.reflection_side, 1,
                    DirectionGrid::kMostSide);
    require_between("lobes", header.lobes, 1, MaterialField::kMostLobes);
    if (!(header.energy_fraction > 0 && header.energy_fraction <= 1)) {
        fail("fraction of energy", fmt::format("{}", header.energy_fraction),
             "above 0 and at most 1");
    }
    require_between("bytes of the name", header.name_bytes, 1, MaterialField::kMostNameBytes);
    require_between("the number after the name's bytes", header.zero, 0, 0);
}

// Of a file with this header; both factors are checked before they are multiplied.
std::uint64_t file_bytes(const Header& header) {
    const std::uint64_t entries = std::uint64_t{header.lobes} *
                                  DirectionGrid(header.normal_side).node_count() *
                                  DirectionGrid(header.reflection_side).node_count();
    return sizeof(Header) + padded(header.name_bytes) + header.lobes * sizeof(Imath::V3f) +
           entries * kBytesPerEntry + header.squares * kBytesPerSquare + sizeof(std::uint64_t);
}

// What kernels rely on: squares in range and ascending, each after its parent, finite values.
void require_face(std::uint32_t n,
                  std::span<const std::uint16_t> squares,
                  std::vector<bool>& is_there) {
    is_there.assign(square_count(n), false);
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const std::size_t square = squares[i];
        require_between("a square", square, i == 0 ? 0 : std::uint64_t{squares[i - 1]} + 1,
                        square_count(n) - 1);
        if (square != 0 && !is_there[parent_square(square)]) {
            fail(fmt::format("square {}", square), "no parent of it", "all squares above it");
        }
        is_there[square] = true;
    }
}

class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    MaterialField take_field() {
        const auto header = take_header();
        const std::span<const std::byte> name = take(padded(header.name_bytes));
        MaterialField field;
        field.name.assign(reinterpret_cast<const char*>(name.data()), header.name_bytes);
        require_name(field.name);
        if (std::any_of(name.begin() + header.name_bytes, name.end(),
                        [](std::byte b) { return b != std::byte{0}; })) {
            fail("bytes after the name", "other ones", "zeroes");
        }
        field.normals = DirectionGrid(header.normal_side);
        field.reflections = DirectionGrid(header.reflection_side);
        field.energy_fraction = header.energy_fraction;
        for (std::uint32_t lobe = 0; lobe < header.lobes; ++lobe) {
            take_colour(field);
        }
        std::uint64_t squares_left = header.squares;
        for (std::uint32_t lobe = 0; lobe < header.lobes; ++lobe) {
            field.lobes.push_back(
                take_lobe(header.face_resolution, field.entry_count(), squares_left));
        }
        if (squares_left != 0) {
            fail("squares", fmt::format("{} beyond those of all entries", squares_left),
                 "as many as the header says");
        }
        return field;
    }

  private:
    std::span<const std::byte> take(std::size_t count) {
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    template <typename T>
    T take_record() {
        T record;
        std::memcpy(&record, take(sizeof(T)).data(), sizeof(T));
        return record;
    }
    Header take_header() {
        if (bytes_.size() < sizeof(Header)) {
            fail("length", fmt::format("{} bytes", bytes_.size()),
                 fmt::format("at least {}", sizeof(Header)));
        }
        const auto header = take_record<Header>();
        require_header(header);
        // So that nothing below overflows.
        require_between("squares", header.squares, 0, kMostMaterialBytes / kBytesPerSquare);
        const std::uint64_t expected = file_bytes(header);
        if (bytes_.size() != expected) {
            fail("length", fmt::format("{} bytes", bytes_.size()), fmt::format("{}", expected));
        }
        const std::span<const std::byte> covered =
            bytes_.first(bytes_.size() - sizeof(std::uint64_t));
        std::uint64_t stated = 0;
        std::memcpy(&stated, bytes_.data() + covered.size(), sizeof(stated));
        const std::uint64_t found = XXH3_64bits(covered.data(), covered.size());
        if (found != stated) {
            fail("checksum", fmt::format("{:016x}", found), fmt::format("{:016x}", stated));
        }
        return header;
    }
    void take_colour(MaterialField& field) {
        const auto colour = take_record<std::array<float, 3>>();
        require_finite("a colour", colour);
        if (*std::min_element(colour.begin(), colour.end()) < 0) {
            fail("a colour", fmt::format("{}", *std::min_element(colour.begin(), colour.end())),
                 "no negative number");
        }
        field.colours.emplace_back(colour[0], colour[1], colour[2]);
    }
    // Heads of all entries, then their squares, then their values.
    WaveletStore take_lobe(std::uint32_t n, std::size_t entries, std::uint64_t& squares_left) {
        const auto scaling = take(entries * sizeof(Scaling));
        const auto counts = take(entries * sizeof(Counts));
        std::uint64_t total = 0;
        for (std::size_t i = 0; i < entries; ++i) {
            const auto of_entry = record_at<Counts>(counts, i);
            for (const std::uint16_t count : of_entry) {
                total += count;
            }
        }
        if (total > squares_left) {
            fail("squares", fmt::format("{} of a lobe", total),
                 fmt::format("at most {}", squares_left));
        }
        squares_left -= total;
        const auto squares = take(total * sizeof(std::uint16_t));
        const auto values = take(total * sizeof(SquareCoefficients));
        WaveletStore store(n);
        std::size_t first = 0;
        for (std::size_t i = 0; i < entries; ++i) {
            WaveletView view;
            view.scaling = record_at<Scaling>(scaling, i);
            require_finite("a scaling coefficient", view.scaling);
            const auto of_entry = record_at<Counts>(counts, i);
            for (std::size_t face = 0; face < of_entry.size(); ++face) {
                view.first[face + 1] = view.first[face] + of_entry[face];
            }
            fill_entry(n, view, squares, values, first);
            view.squares = squares_.data();
            view.values = values_.data();
            store.append(view);
            first += view.first.back();
        }
        return store;
    }
    void fill_entry(std::uint32_t n,
                    const WaveletView& view,
                    std::span<const std::byte> squares,
                    std::span<const std::byte> values,
                    std::size_t first) {
        const std::size_t count = view.first.back();
        squares_.resize(count);
        values_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            squares_[i] = record_at<std::uint16_t>(squares, first + i);
            const auto value = record_at<SquareCoefficients>(values, first + i);
            require_finite("a coefficient", value);
            values_[i] = {0, value[0], value[1], value[2]};
        }
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            require_face(n,
                         std::span(squares_).subspan(view.first[face],
                                                     view.first[face + 1] - view.first[face]),
                         is_there_);
        }
    }
    template <typename T>
    static T record_at(std::span<const std::byte> records, std::size_t i) {
        T record;
        std::memcpy(&record, records.data() + i * sizeof(T), sizeof(T));
        return record;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    // Of one entry, reused.
    std::vector<std::uint16_t> squares_;
    std::vector<SquareLanes> values_;
    std::vector<bool> is_there_;
};

class Writer {
  public:
    explicit Writer(std::size_t bytes) { bytes_.reserve(bytes); }

    template <typename T>
    void append(const T& record) {
        append_bytes(std::as_bytes(std::span(&record, 1)));
    }
    void append_bytes(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void append_lobe(const WaveletStore& lobe) {
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            append(lobe.view(i).scaling);
        }
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            const WaveletView view = lobe.view(i);
            Counts counts{};
            for (std::size_t face = 0; face < counts.size(); ++face) {
                counts[face] =
                    static_cast<std::uint16_t>(view.first[face + 1] - view.first[face]);
            }
            append(counts);
        }
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            const WaveletView view = lobe.view(i);
            append_bytes(std::as_bytes(std::span(view.squares, view.first.back())));
        }
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            const WaveletView view = lobe.view(i);
            for (std::uint32_t square = 0; square < view.first.back(); ++square) {
                const SquareLanes& value = view.values[square];
                append(SquareCoefficients{value[1], value[2], value[3]});
            }
        }
    }
    std::vector<std::byte> take() {
        append(std::uint64_t{XXH3_64bits(bytes_.data(), bytes_.size())});
        return std::move(bytes_);
    }
    void pad(std::size_t size) { bytes_.resize(size, std::byte{0}); }

  private:
    std::vector<std::byte> bytes_;
};

void require_lobes(const MaterialField& field) {
    require_between("lobes", field.lobes.size(), 1, MaterialField::kMostLobes);
    require_between("colours", field.colours.size(), field.lobes.size(), field.lobes.size());
    for (const WaveletStore& lobe : field.lobes) {
        require_between("entries of a lobe", lobe.size(), field.entry_count(),
                        field.entry_count());
        require_between("face resolution of a lobe", lobe.face_resolution(),
                        field.face_resolution(), field.face_resolution());
    }
}

}  // namespace

std::vector<std::byte> bytes_from_field(const MaterialField& field) {
    require_name(field.name);
    require_lobes(field);
    Header header{.version = kVersion,
                  .face_resolution = field.face_resolution(),
                  .normal_side = field.normals.side(),
                  .reflection_side = field.reflections.side(),
                  .lobes = static_cast<std::uint32_t>(field.lobes.size()),
                  .energy_fraction = field.energy_fraction,
                  .name_bytes = static_cast<std::uint32_t>(field.name.size())};
    std::copy(kMagic.begin(), kMagic.end(), header.magic.begin());
    for (const WaveletStore& lobe : field.lobes) {
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            header.squares += lobe.view(i).first.back();
        }
    }
    const std::uint64_t bytes = file_bytes(header);
    require_between("bytes of the file", bytes, 0, kMostMaterialBytes);
    Writer writer(bytes);
    writer.append(header);
    writer.append_bytes(std::as_bytes(std::span(field.name)));
    writer.pad(sizeof(Header) + padded(field.name.size()));
    for (const Imath::V3f& colour : field.colours) {
        writer.append(std::array<float, 3>{colour.x, colour.y, colour.z});
    }
    for (const WaveletStore& lobe : field.lobes) {
        writer.append_lobe(lobe);
    }
    std::vector<std::byte> whole = writer.take();
    // What is written can be read.
    (void)Reader(whole).take_field();
    return whole;
}

MaterialField field_from_bytes(std::string_view file, std::span<const std::byte> bytes) {
    try {
        return Reader(bytes).take_field();
    } catch (const MaterialFileError& error) {
        throw MaterialFileError(fmt::format("{}: {}", file, error.what()));
    }
}

void write_material_file(const std::filesystem::path& path, const MaterialField& field) {
    const std::vector<std::byte> bytes = bytes_from_field(field);
    files::write_file_atomically(path, {std::span(bytes)});
}

MaterialField read_material_file(const std::filesystem::path& path) {
    const std::string content = files::read_regular_file(path, kMostMaterialBytes);
    return field_from_bytes(path.string(), std::as_bytes(std::span(content)));
}

bool begins_as_material(std::string_view beginning) {
    return beginning.starts_with(kMagic);
}

}  // namespace relume::tripling
