#include "tests/bench/read_bandwidth.h"

#include "protocol/transport/cpu_clones.h"
#include "tests/support/timing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstring>
#include <functional>

namespace relume::bench {
namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);
// Words a task: 1 MB.
constexpr std::size_t kGrain = (std::size_t{1} << 20U) / kWord;

RELUME_CPU_CLONES std::uint64_t sum_words(const std::byte* bytes, std::size_t words) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < words; ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + i * kWord, kWord);
        sum += word;
    }
    return sum;
}

}  // namespace

std::uint64_t sum_of_words(std::span<const std::byte> bytes) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, bytes.size() / kWord, kGrain), std::uint64_t{0},
        [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t sum) {
            return sum + sum_words(bytes.data() + range.begin() * kWord, range.size());
        },
        std::plus<>());
}

ReadBandwidth::ReadBandwidth(std::size_t buffer_bytes) : buffer_(buffer_bytes / kWord) {
    // Written, or all of it would be one page of zeroes.
    for (std::size_t i = 0; i < buffer_.size(); ++i) {
        buffer_[i] = i;
    }
}

void ReadBandwidth::read(std::size_t bytes) {
    const auto all = std::as_bytes(std::span(buffer_));
    while (bytes > 0) {
        const std::size_t part = std::min(bytes, all.size() - position_);
        sum_ += sum_of_words(all.subspan(position_, part));
        position_ = (position_ + part) % all.size();
        bytes -= part;
    }
}

double ReadBandwidth::bytes_per_second(int threads) {
    constexpr std::size_t kPasses = 7;
    const std::size_t bytes =
        std::min(buffer_.size() * kWord, std::size_t{256} << 20U) / kWord * kWord;
    double seconds = 0;
    test::with_threads(threads, [&] {
        const test::TimedVariant pass = [&](std::size_t /*round*/) { read(bytes); };
        seconds = test::median(test::seconds_in_turn(std::span(&pass, 1), kPasses).front());
    });
    return static_cast<double>(bytes) / seconds;
}

}  // namespace relume::bench
