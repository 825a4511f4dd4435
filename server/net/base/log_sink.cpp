#include "server/net/base/log_sink.h"

#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace relume::net {

namespace {

constexpr std::size_t kMaxWaitingBytes = std::size_t{256} << 10;
constexpr std::chrono::milliseconds kLastMoment{500};

std::atomic<std::uint64_t> dropped_lines{0};

// Shared with the writing thread, which is left behind if it hangs in a pipe.
struct Queue {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::string> lines;
    std::size_t bytes = 0;
    bool ends = false;
    bool ended = false;
};

// A pipe that is ready for writing takes PIPE_BUF bytes without waiting; and more is not asked
// of it, so that the thread is never caught within a write.
void write_line(int descriptor, std::string_view line) {
    while (!line.empty()) {
        pollfd ready{.fd = descriptor, .events = POLLOUT, .revents = 0};
        if (::poll(&ready, 1, -1) < 0 && errno != EINTR) {
            return;
        }
        const ssize_t count =
            ::write(descriptor, line.data(), std::min<std::size_t>(line.size(), PIPE_BUF));
        if (count < 0 && errno != EINTR && errno != EAGAIN) {
            return;  // nobody will ever read it
        }
        line.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

void write_lines(const std::shared_ptr<Queue>& queue, int descriptor) {
    std::unique_lock lock(queue->mutex);
    while (true) {
        queue->changed.wait(lock, [&] { return queue->ends || !queue->lines.empty(); });
        if (queue->lines.empty()) {
            break;
        }
        const std::string line = std::move(queue->lines.front());
        queue->lines.pop_front();
        queue->bytes -= line.size();
        lock.unlock();
        write_line(descriptor, line);
        lock.lock();
    }
    queue->ended = true;
    queue->changed.notify_all();
}

class LogSink : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit LogSink(int descriptor) {
        // Signals are for the threads that wait for them.
        sigset_t all;
        sigset_t before;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
        std::thread(write_lines, queue_, descriptor).detach();
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    LogSink(const LogSink&) = delete;
    LogSink& operator=(const LogSink&) = delete;
    ~LogSink() override {
        std::unique_lock lock(queue_->mutex);
        queue_->ends = true;
        queue_->changed.notify_all();
        queue_->changed.wait_for(lock, kLastMoment, [this] { return queue_->ended; });
    }

  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        spdlog::memory_buf_t text;
        formatter_->format(message, text);
        const std::lock_guard lock(queue_->mutex);
        if (queue_->bytes + text.size() > kMaxWaitingBytes) {
            ++dropped_lines;
            return;
        }
        queue_->lines.emplace_back(text.data(), text.size());
        queue_->bytes += text.size();
        queue_->changed.notify_all();
    }
    void flush_() override {}

  private:
    const std::shared_ptr<Queue> queue_ = std::make_shared<Queue>();
};

}  // namespace

std::shared_ptr<spdlog::sinks::sink> make_log_sink(int descriptor) {
    return std::make_shared<LogSink>(descriptor);
}

std::uint64_t dropped_log_lines() {
    return dropped_lines.load();
}

}  // namespace relume::net
