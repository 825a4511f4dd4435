// How fast this machine reads memory: the roof over everything that follows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bench {

// A buffer far larger than any cache, summed. Every use goes on where the last one ended, so
// that nothing is found in a cache.
class ReadBandwidth {
  public:
    explicit ReadBandwidth(std::size_t buffer_bytes);

    // Reads so many bytes with the threads of the calling arena.
    void read(std::size_t bytes);
    // Bytes per second, the median of a few passes of 256 MB (or the buffer, if smaller).
    [[nodiscard]] double bytes_per_second(int threads);

    // Sum of all values read so far: keeps the compiler from leaving the reading out.
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

  private:
    std::vector<std::uint64_t> buffer_;
    std::size_t position_ = 0;
    std::uint64_t sum_ = 0;
};

// Reads every byte once with the threads of the calling arena; their sum as 64-bit words (a
// rest shorter than a word is left out).
[[nodiscard]] std::uint64_t sum_of_words(std::span<const std::byte> bytes);

}  // namespace relume::bench
