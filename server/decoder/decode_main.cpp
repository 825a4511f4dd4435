// relume-decode: one image file from standard input, its texels to standard output, and nothing
// else. Started by sandboxed_decoder.cpp, in a sandbox before it reads the first byte.
#include "protocol/base/program/program.h"
#include "protocol/light/environment_error.h"
#include "protocol/light/environment_import.h"
#include "server/decoder/decoder_reply.h"
#include "server/decoder/sandbox.h"

#include <CLI/CLI.hpp>
#include <OpenEXR/ImfThreading.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace {

using relume::decoder::ReplyHeader;
using relume::decoder::ReplyStatus;

struct Options {
    std::string projection;
    std::string layer;
    std::size_t max_texels = relume::light::kMaxMapTexels;
    std::size_t max_bytes = 0;
    relume::decoder::SandboxLimits sandbox;
};

void write_all(const void* data, std::size_t size) {
    const auto* at = static_cast<const std::byte*>(data);
    while (size > 0) {
        const ssize_t written = write(STDOUT_FILENO, at, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            _exit(EXIT_FAILURE);  // nobody listens any more
        }
        at += written;
        size -= static_cast<std::size_t>(written);
    }
}

void reply(ReplyHeader header, std::string text, std::span<const float> rgb) {
    text.resize(std::min(text.size(), relume::decoder::kMaxReplyTextBytes));
    header.text_bytes = static_cast<std::uint32_t>(text.size());
    write_all(&header, sizeof header);
    write_all(text.data(), text.size());
    write_all(rgb.data(), rgb.size_bytes());
}

std::string line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + '\n';
}

void refuse(const std::string& message, const std::string& found, const std::string& expected) {
    reply({.status = ReplyStatus::refused}, line(message) + line(found) + line(expected), {});
}

std::vector<std::byte> read_input(std::size_t max_bytes) {
    constexpr std::size_t kChunk = std::size_t{1} << 20;
    std::vector<std::byte> bytes;
    for (;;) {
        const std::size_t filled = bytes.size();
        bytes.resize(filled + kChunk);
        const ssize_t count = read(STDIN_FILENO, bytes.data() + filled, kChunk);
        if (count < 0 && errno != EINTR) {
            throw std::system_error(errno, std::generic_category(), "reading the image");
        }
        bytes.resize(filled + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (bytes.size() > max_bytes) {
            throw relume::light::EnvironmentError(
                "image file is longer than " + std::to_string(max_bytes) + " bytes",
                "more than " + std::to_string(max_bytes) + " bytes",
                "at most " + std::to_string(max_bytes) + " bytes");
        }
        if (count == 0) {
            return bytes;
        }
    }
}

int decode(const Options& options) {
    try {
        const std::vector<std::byte> bytes = read_input(options.max_bytes);
        const relume::light::ImportedImage imported = relume::light::import_image(
            bytes, {.projection = relume::light::projection_from_string(options.projection),
                    .layer = options.layer,
                    .max_texels = options.max_texels});
        const relume::light::ImportNotes& notes = imported.notes;
        std::string text = line(notes.layer);
        for (const std::string& warning : notes.warnings) {
            text += line(warning);
        }
        for (const std::string& layer : notes.layers) {
            text += line(layer);
        }
        reply({.status = ReplyStatus::decoded,
               .width = imported.image.width,
               .height = imported.image.height,
               .projection = static_cast<std::uint32_t>(imported.projection),
               .warnings = static_cast<std::uint32_t>(notes.warnings.size())},
              text, imported.image.rgb);
    } catch (const relume::light::EnvironmentError& e) {
        refuse(e.what(), e.found(), e.expected());
    } catch (const std::bad_alloc&) {
        refuse("image needs more memory than decoding may use", "",
               "at most " + std::to_string(options.sandbox.address_space_bytes) + " bytes");
    } catch (const std::exception& e) {
        refuse(std::string("image cannot be read: ") + e.what(), "", "");
    }
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Decodes one image in a sandbox. Part of relume-server; not for use by hand.",
                 "relume-decode");
    app.add_option("--projection", options.projection, "empty: by shape");
    app.add_option("--layer", options.layer, "empty: the beauty");
    app.add_option("--max-texels", options.max_texels)->required();
    app.add_option("--max-bytes", options.max_bytes)->required();
    app.add_option("--address-space-bytes", options.sandbox.address_space_bytes)->required();
    app.add_option("--cpu-seconds", options.sandbox.cpu_seconds)->required();
    return relume::program::run_program(app, argc, argv, [&]() -> int {
        Imf::setGlobalThreadCount(0);
        relume::decoder::run_sandboxed(options.sandbox, [&] { return decode(options); });
    });
}
