#include "client/cli/image_writer.h"

#include "client/cli/image_file.h"
#include "protocol/wire/half_image.h"

namespace relume::cli {
namespace {

void write(const ImageWriter::Job& job) {
    if (job.header.encoding == wire::ImageEncoding::jpeg) {
        write_image_file(job.path, job.payload, job.header);
        return;
    }
    const wire::HalfImage image = wire::decode_half_image(
        job.payload, job.header.width, job.header.height, job.header.has_alpha);
    write_image_file(job.path, image, job.header, job.display);
}

}  // namespace

ImageWriter::ImageWriter() : thread_([this] { run(); }) {}

ImageWriter::~ImageWriter() {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.clear();
        finishing_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) {
        thread_.join();
    }
}

void ImageWriter::add(Job job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting || failure_; });
    if (!failure_) {
        waiting_.push_back(std::move(job));
        changed_.notify_all();
    }
}

void ImageWriter::finish() {
    {
        const std::scoped_lock lock(mutex_);
        finishing_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void ImageWriter::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return !waiting_.empty() || finishing_; });
        if (waiting_.empty()) {
            return;
        }
        const Job job = std::move(waiting_.front());
        waiting_.pop_front();
        changed_.notify_all();
        lock.unlock();
        std::exception_ptr failure;
        try {
            write(job);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure && !failure_) {
            failure_ = failure;
            waiting_.clear();
            changed_.notify_all();
        }
    }
}

}  // namespace relume::cli
