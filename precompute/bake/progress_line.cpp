#include "precompute/bake/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace relume::bake {
namespace {

constexpr std::size_t kBarCells = 30;

std::string clock_text(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

std::string progress_text(const BakeProgress& progress, double seconds) {
    const double done =
        static_cast<double>(progress.receivers_done) / static_cast<double>(progress.receivers);
    const auto baked =
        static_cast<double>(progress.receivers_done - progress.receivers_resumed);
    const auto left = static_cast<double>(progress.receivers - progress.receivers_done);
    const double rate = seconds > 0 ? baked / seconds : 0;
    const double rays = seconds > 0 ? static_cast<double>(progress.rays) / seconds : 0;
    const bool of_points = progress.stage == BakeStage::visibility;
    std::string text = fmt::format(
        "{}{:3.0f}%  {:.0f} {}/s  {:.1f} Mrays/s  {} gone", of_points ? "visibility " : "",
        100 * done, rate, of_points ? "points" : "pixels", rays / 1e6, clock_text(seconds));
    constexpr double kTellingPart = 0.1;
    if (rate > 0 && left > 0 && baked >= kTellingPart * (baked + left)) {
        text += fmt::format("  {} left", clock_text(left / rate));
    }
    return text;
}

ProgressLine::ProgressLine(std::FILE* stream)
    : stream_(stream), terminal_(::isatty(::fileno(stream)) == 1) {}

ProgressLine::~ProgressLine() {
    if (terminal_ && drawn_) {
        std::fputc('\n', stream_);
    }
}

void ProgressLine::update(const BakeProgress& progress) {
    const auto now = Clock::now();
    if (progress.stage != stage_) {
        stage_ = progress.stage;
        start_ = next_ = now;
        if (terminal_ && drawn_) {
            std::fputc('\n', stream_);
        }
    }
    const bool last = progress.receivers_done == progress.receivers;
    if (now < next_ && !last) {
        return;
    }
    next_ = now + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double done =
        static_cast<double>(progress.receivers_done) / static_cast<double>(progress.receivers);
    const std::string text = progress_text(progress, seconds);
    if (terminal_) {
        const auto cells = static_cast<std::size_t>(done * static_cast<double>(kBarCells));
        std::fprintf(stream_, "\r[%s%s] %s\x1b[K", std::string(cells, '#').c_str(),
                     std::string(kBarCells - cells, '.').c_str(), text.c_str());
    } else {
        std::fprintf(stream_, "%s\n", text.c_str());
    }
    std::fflush(stream_);
    drawn_ = true;
}

}  // namespace relume::bake
