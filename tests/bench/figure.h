// A figure: one number, what it is called, and what it should be.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::bench {

class Workbench;

enum class Aim { at_least, at_most, reported };

struct Figure {
    std::string key;      // in the JSON object
    std::string meaning;  // for the table
    Aim aim = Aim::reported;
    double target = 0;  // of at_least and at_most

    // Of a value that was measured.
    [[nodiscard]] bool reached(double value) const;
};

// What came out. Not thread-safe.
class Results {
  public:
    void set(const std::string& key, double value) { values_[key] = value; }
    // Why a figure has no value.
    void omit(const std::string& key, const std::string& why) { omissions_[key] = why; }
    // What a figure was computed from; goes into the context.
    nlohmann::json& measured(const std::string& name) { return measured_[name]; }

    // Nothing when it was omitted or not asked for.
    [[nodiscard]] std::optional<double> value(const std::string& key) const;
    [[nodiscard]] const std::map<std::string, std::string>& omissions() const {
        return omissions_;
    }
    [[nodiscard]] const nlohmann::json& measured() const { return measured_; }

  private:
    std::map<std::string, double> values_;
    std::map<std::string, std::string> omissions_;
    nlohmann::json measured_ = nlohmann::json::object();
};

// Figures that come out of one experiment.
struct FigureGroup {
    std::vector<Figure> figures;
    // Sets or omits every one of them. Throws what the parts it measures throw.
    void (*measure)(Workbench& workbench, Results& results) = nullptr;
};

// All groups, in the order in which they are measured. Each is a function of its own file; the
// list is in figure.cpp.
[[nodiscard]] const std::vector<FigureGroup>& figure_groups();

}  // namespace relume::bench
