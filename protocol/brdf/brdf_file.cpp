#include "protocol/brdf/brdf_file.h"

#include "protocol/brdf/error.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace relume::brdf {
namespace {

constexpr std::string_view kMagic = "RELUMEBR";
constexpr std::uint32_t kVersion = 1;

// What stands before the name and the values of a BRDF.
struct Record {
    std::uint32_t name_bytes;
    std::uint32_t terms;
    std::uint32_t lobes;
    std::uint32_t g_rows;
    std::uint32_t g_columns;
    std::uint32_t h_rows;
    std::uint32_t h_columns;
};
static_assert(sizeof(Record) == 28);

std::size_t padded(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

void require_count(std::size_t count) {
    if (count < 1 || count > kMostBrdfs) {
        throw BrdfError(fmt::format("{} BRDFs, expected 1 … {}", count, kMostBrdfs));
    }
}

class Writer {
  public:
    void append(std::span<const std::byte> more) {
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    void append_number(std::uint32_t value) { append(std::as_bytes(std::span(&value, 1))); }
    void append(const FactoredBrdf& brdf) {
        require_valid(brdf);
        const Record record{static_cast<std::uint32_t>(brdf.name.size()),
                            brdf.terms,
                            brdf.lobes,
                            brdf.g.shape().rows,
                            brdf.g.shape().columns,
                            brdf.h.shape().rows,
                            brdf.h.shape().columns};
        append(std::as_bytes(std::span(&record, 1)));
        append(std::as_bytes(std::span(brdf.name)));
        bytes_.resize(padded(bytes_.size()), std::byte{0});
        append(std::as_bytes(brdf.g.values()));
        append(std::as_bytes(brdf.h.values()));
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::vector<FactoredBrdf> take_all() {
        const auto magic = take_record<std::array<char, 8>>("the beginning");
        if (std::string_view(magic.data(), magic.size()) != kMagic) {
            throw BrdfError(fmt::format("does not begin with {}", kMagic));
        }
        const auto version = take_record<std::uint32_t>("the version");
        if (version != kVersion) {
            throw BrdfError(fmt::format("version {}, expected {}", version, kVersion));
        }
        const auto count = take_record<std::uint32_t>("the number of BRDFs");
        require_count(count);
        std::vector<FactoredBrdf> brdfs;
        for (std::uint32_t i = 0; i < count; ++i) {
            brdfs.push_back(take_brdf());
        }
        if (at_ != bytes_.size()) {
            throw BrdfError(fmt::format("{} bytes follow the last BRDF, expected none",
                                        bytes_.size() - at_));
        }
        return brdfs;
    }

  private:
    std::span<const std::byte> take(std::size_t count, std::string_view what) {
        if (count > bytes_.size() - at_) {
            throw BrdfError(fmt::format("{} bytes are left at byte {} for {}, expected {}",
                                        bytes_.size() - at_, at_, what, count));
        }
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    template <typename T>
    T take_record(std::string_view what) {
        T record;
        std::memcpy(&record, take(sizeof(T), what).data(), sizeof(T));
        return record;
    }
    DirectionTable take_table(const TableShape& shape, std::string_view what) {
        if (!shape.is_valid()) {
            throw BrdfError(fmt::format("{} has {} rows, {} columns, depth {}: out of range",
                                        what, shape.rows, shape.columns, shape.depth));
        }
        const auto bytes = take(shape.value_count() * sizeof(float), what);
        std::vector<float> values(shape.value_count());
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return {shape, std::move(values)};
    }
    FactoredBrdf take_brdf() {
        const auto record = take_record<Record>("a BRDF");
        if (record.name_bytes > FactoredBrdf::kMostNameBytes) {
            throw BrdfError(fmt::format("a name has {} bytes, expected at most {}",
                                        record.name_bytes, FactoredBrdf::kMostNameBytes));
        }
        if (record.terms > FactoredBrdf::kMostTerms ||
            record.lobes > FactoredBrdf::kMostLobes) {
            throw BrdfError(fmt::format(
                "a BRDF has {} terms and {} lobes, expected at most {} and {}", record.terms,
                record.lobes, FactoredBrdf::kMostTerms, FactoredBrdf::kMostLobes));
        }
        FactoredBrdf brdf{
            .name = {}, .terms = record.terms, .lobes = record.lobes, .g = {}, .h = {}};
        const auto name = take(padded(record.name_bytes), "a name");
        brdf.name.assign(reinterpret_cast<const char*>(name.data()), record.name_bytes);
        for (const std::byte padding : name.subspan(record.name_bytes)) {
            if (padding != std::byte{0}) {
                throw BrdfError("bytes after a name are not zero");
            }
        }
        brdf.g = take_table({record.g_rows, record.g_columns, record.terms}, "g");
        brdf.h =
            take_table({record.h_rows, record.h_columns, record.terms * record.lobes}, "h");
        require_valid(brdf);
        return brdf;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

}  // namespace

std::vector<std::byte> bytes_from_brdfs(std::span<const FactoredBrdf> brdfs) {
    require_count(brdfs.size());
    Writer writer;
    writer.append(std::as_bytes(std::span(kMagic)));
    writer.append_number(kVersion);
    writer.append_number(static_cast<std::uint32_t>(brdfs.size()));
    for (const FactoredBrdf& brdf : brdfs) {
        writer.append(brdf);
    }
    return writer.take();
}

std::vector<FactoredBrdf> brdfs_from_bytes(std::string_view file,
                                           std::span<const std::byte> bytes) {
    try {
        return Reader(bytes).take_all();
    } catch (const BrdfError& error) {
        throw BrdfError(fmt::format("{}: {}", file, error.what()));
    }
}

}  // namespace relume::brdf
