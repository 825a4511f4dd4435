#include "precompute/scene/import_log.h"

#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>

#include <cstddef>

namespace relume::scene {
namespace {

constexpr std::size_t kMostWarnings = 100;

std::mutex& logger_mutex() {
    static std::mutex mutex;
    return mutex;
}

class WarningStream : public Assimp::LogStream {
  public:
    explicit WarningStream(std::vector<std::string>& warnings) : warnings_(warnings) {}
    void write(const char* message) override {
        // "Warn,  T0: text\n"
        std::string text = message;
        if (const std::size_t colon = text.find(": "); colon != std::string::npos)
            text.erase(0, colon + 2);
        while (!text.empty() && text.back() == '\n')
            text.pop_back();
        if (warnings_.size() < kMostWarnings)
            warnings_.push_back(text);
    }

  private:
    std::vector<std::string>& warnings_;
};

}  // namespace

ImportLog::ImportLog() : turn_(logger_mutex()) {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    // The logger owns the stream and deletes it with itself.
    Assimp::DefaultLogger::get()->attachStream(new WarningStream(warnings_),
                                               Assimp::Logger::Warn);
}

ImportLog::~ImportLog() {
    Assimp::DefaultLogger::kill();
}

}  // namespace relume::scene
