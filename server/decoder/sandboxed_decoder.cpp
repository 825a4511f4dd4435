#include "server/decoder/sandboxed_decoder.h"

#include "protocol/light/environment_error.h"
#include "server/decoder/child_process.h"
#include "server/decoder/decoder_reply.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace relume::decoder {
namespace {

std::filesystem::path find_program(const DecodeLimits& limits) {
    if (!limits.program.empty()) {
        return limits.program;
    }
    std::error_code error;
    const std::filesystem::path here =
        std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    if (std::filesystem::path beside = here / "relume-decode";
        std::filesystem::exists(beside, error)) {
        return beside;
    }
    throw light::EnvironmentError(fmt::format("relume-decode is not in {}", here.string()));
}

std::vector<std::string> arguments(const light::ImportOptions& options,
                                   const DecodeLimits& limits) {
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(limits.timeout).count();
    std::vector<std::string> words{
        fmt::format("--max-texels={}", std::min(limits.max_texels, options.max_texels)),
        fmt::format("--max-bytes={}", limits.max_file_bytes),
        fmt::format("--address-space-bytes={}", limits.address_space_bytes),
        fmt::format("--cpu-seconds={}", std::max<std::int64_t>(1, seconds)),
    };
    if (options.projection) {
        words.push_back(fmt::format("--projection={}", to_string(*options.projection)));
    }
    if (!options.layer.empty()) {
        words.push_back(fmt::format("--layer={}", options.layer));
    }
    return words;
}

class Decoding {
  public:
    Decoding(std::span<const std::byte> file_bytes,
             const light::ImportOptions& options,
             const DecodeLimits& limits)
        : options_(options),
          limits_(limits),
          child_(find_program(limits),
                 arguments(options, limits),
                 file_bytes,
                 {.timeout = limits.timeout, .stop = limits.stop}) {}

    [[nodiscard]] light::ImportedEnvironment run() {
        ReplyHeader header;
        read(std::as_writable_bytes(std::span(&header, 1)));
        if (header.magic != kReplyMagic || header.text_bytes > kMaxReplyTextBytes) {
            fail("answered nonsense");
        }
        std::string text(header.text_bytes, '\0');
        read(std::as_writable_bytes(std::span(text)));
        std::vector<std::string> lines = split(text);
        if (header.status == ReplyStatus::refused) {
            lines.resize(3);
            throw light::EnvironmentError(lines[0], lines[1], lines[2]);
        }
        if (header.status != ReplyStatus::decoded ||
            header.projection > static_cast<std::uint32_t>(light::Projection::cubemap_strip)) {
            fail("answered nonsense");
        }
        light::MapImage image = read_image(header);
        if (const std::string end = child_.wait(); !end.empty()) {
            fail(end);
        }
        return {light::EnvironmentMap(std::move(image),
                                      static_cast<light::Projection>(header.projection),
                                      options_.centre),
                notes_from(lines, header.warnings)};
    }

  private:
    [[noreturn]] static void fail(const std::string& how) {
        throw light::EnvironmentError("the image could not be decoded: the decoder " + how);
    }

    void read(std::span<std::byte> into) {
        switch (child_.read(into)) {
            case ChildProcess::Read::complete:
                return;
            case ChildProcess::Read::timed_out:
                fail(fmt::format("took longer than {} ms", limits_.timeout.count()));
            case ChildProcess::Read::stopped:
                fail("was stopped, as nobody waits for the answer");
            case ChildProcess::Read::ended:
                break;
        }
        const std::string end = child_.wait();
        fail(end.empty() ? "ended before its answer was complete" : end);
    }

    [[nodiscard]] light::MapImage read_image(const ReplyHeader& header) {
        const std::size_t texels = std::size_t{header.width} * header.height;
        if (header.width > light::kMaxMapSide || header.height > light::kMaxMapSide ||
            texels > std::min(limits_.max_texels, light::kMaxMapTexels)) {
            fail(fmt::format("answered with {}x{} texels", header.width, header.height));
        }
        light::MapImage image{header.width, header.height, {}};
        image.rgb.resize(texels * 3);
        read(std::as_writable_bytes(std::span(image.rgb)));
        return image;
    }

    // Short by what the longest text cut off.
    static light::ImportNotes notes_from(const std::vector<std::string>& lines,
                                         std::size_t warnings) {
        light::ImportNotes notes;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i == 0) {
                notes.layer = lines[i];
            } else if (i <= warnings) {
                notes.warnings.push_back(lines[i]);
            } else {
                notes.layers.push_back(lines[i]);
            }
        }
        return notes;
    }

    // A decoder that was taken over may say anything; only plain text goes on to logs and
    // clients.
    static std::vector<std::string> split(const std::string& text) {
        std::vector<std::string> lines;
        std::string line;
        for (const char c : text) {
            if (c == '\n') {
                lines.push_back(std::exchange(line, {}));
            } else {
                line += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
            }
        }
        return lines;
    }

    const light::ImportOptions& options_;
    const DecodeLimits& limits_;
    ChildProcess child_;
};

}  // namespace

light::ImportedEnvironment decode_in_child(std::span<const std::byte> file_bytes,
                                           const light::ImportOptions& options,
                                           const DecodeLimits& limits) {
    if (file_bytes.size() > limits.max_file_bytes) {
        std::string found = fmt::format("{} bytes long", file_bytes.size());
        std::string expected = fmt::format("at most {} bytes", limits.max_file_bytes);
        throw light::EnvironmentError(
            fmt::format("image file is {}, expected {}", found, expected), found, expected);
    }
    try {
        return Decoding(file_bytes, options, limits).run();
    } catch (const std::system_error& e) {
        throw light::EnvironmentError(std::string("the image could not be decoded: ") +
                                      e.what());
    }
}

}  // namespace relume::decoder
