// Writes images on a thread of its own, so that a slow disk or encoder does not disturb what is
// being measured. Holds at most kMaxWaiting images; then add() waits, and the wire with it.
#pragma once

#include "protocol/wire/image_header.h"
#include "protocol/wire/room_state.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

namespace relume::cli {

class ImageWriter {
  public:
    static constexpr std::size_t kMaxWaiting = 128;

    struct Job {
        std::filesystem::path path;
        wire::ImageHeader header;
        std::vector<std::byte> payload;
        wire::Display display;
    };

    ImageWriter();
    ~ImageWriter();  // drops what waits
    ImageWriter(const ImageWriter&) = delete;
    ImageWriter& operator=(const ImageWriter&) = delete;
    ImageWriter(ImageWriter&&) = delete;
    ImageWriter& operator=(ImageWriter&&) = delete;

    void add(Job job);
    // Waits until all is written; throws what writing threw first.
    void finish();

  private:
    void run();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    bool finishing_ = false;
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace relume::cli
