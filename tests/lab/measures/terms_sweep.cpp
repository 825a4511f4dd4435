#include "tests/lab/measures/terms_sweep.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace relume::lab {
namespace {

std::vector<std::size_t> term_counts(std::size_t coefficients) {
    std::vector<std::size_t> counts;
    for (std::size_t count = 1; count < coefficients; count += (count + 1) / 2) {
        counts.push_back(count);
    }
    counts.push_back(coefficients);
    return counts;
}

// The methods of one form that there are.
std::vector<Method> methods_of_form(const std::string& form, std::size_t coefficients) {
    const std::size_t place = form.find("{}");
    if (place == std::string::npos) {
        throw std::invalid_argument(
            fmt::format("method '{}': expected {{}} where the number of terms goes", form));
    }
    std::vector<Method> methods;
    std::string refusal;
    for (const std::size_t count : term_counts(coefficients)) {
        std::string text = form;
        text.replace(place, 2, std::to_string(count));
        try {
            methods.push_back(method_from_text(text));
        } catch (const std::invalid_argument& error) {
            refusal = error.what();
        }
    }
    if (methods.empty()) {
        throw std::invalid_argument(refusal);
    }
    return methods;
}

}  // namespace

std::vector<TermsCurve> sweep_terms(const Experiment& experiment,
                                    const std::vector<std::string>& forms) {
    std::vector<TermsCurve> curves;
    for (const std::string& form : forms) {
        Experiment first = experiment;
        first.methods = methods_of_form(form, experiment.scene.haar->columns().count());
        first.sequence.images = 1;
        curves.push_back({.name = form, .records = run_experiment(first).records});
    }
    return curves;
}

}  // namespace relume::lab
