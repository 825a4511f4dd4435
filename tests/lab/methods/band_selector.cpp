#include "tests/lab/methods/band_selector.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace relume::lab {
namespace {

using engine::Ranking;

// A column's part of the error from its importance, ‖w ΔL‖₂².
double error_from_importance(float importance, Norm norm) {
    if (importance == Ranking::kNoDifference) {
        return 0;
    }
    return norm == Norm::l1 ? std::sqrt(double{importance}) : double{importance};
}

// Columns of a band, as places in ColumnTable::by_band.
struct Places {
    std::size_t first = 0;
    std::size_t count = 0;
};

std::vector<Places> places_of_bands(const served::Scene& scene) {
    std::vector<Places> bands;
    std::size_t first = 0;
    for (std::uint32_t band = 0; band < scene.columns().band_count(); ++band) {
        bands.push_back({.first = first, .count = scene.columns().of_band(band).size()});
        first += bands.back().count;
    }
    return bands;
}

// What is left of a band when so many of its largest terms are taken: [0] none, … falling.
class Remainders {
  public:
    Remainders(std::span<const float> importances, std::uint32_t most_terms, Norm norm) {
        std::vector<double> errors;
        double left = 0;
        for (const float importance : importances) {
            errors.push_back(error_from_importance(importance, norm));
            left += errors.back();
        }
        const std::size_t kept = std::min<std::size_t>(most_terms, errors.size());
        std::partial_sort(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept),
                          errors.end(), std::greater<>());
        left_.push_back(left);
        for (std::size_t i = 0; i < kept; ++i) {
            left -= errors[i];
            left_.push_back(left);
        }
    }

    [[nodiscard]] double after(std::size_t terms) const {
        return left_[std::min(terms, left_.size() - 1)];
    }

  private:
    std::vector<double> left_;
};

// A band's hand of terms.
struct Hand {
    Remainders as_shown;
    Remainders from_nothing;
    std::size_t terms = 0;

    [[nodiscard]] double error(std::size_t with_terms) const {
        return std::min(as_shown.after(with_terms), from_nothing.after(with_terms));
    }
    [[nodiscard]] double gain() const { return error(terms) - error(terms + 1); }
    [[nodiscard]] bool begins_anew() const {
        return from_nothing.after(terms) < as_shown.after(terms);
    }
};

class SimpleSelector final : public BandSelector {
  public:
    explicit SimpleSelector(Norm norm) : norm_(norm) {}

    std::uint32_t bands_to_reset(const BandChoice& choice) override {
        std::uint32_t mask = 0;
        std::uint32_t band = 0;
        for (const Places& places : places_of_bands(choice.scene)) {
            double as_shown = 0;
            double from_nothing = 0;
            for (std::size_t i = places.first; i < places.first + places.count; ++i) {
                as_shown += error_from_importance(choice.ranking.as_shown()[i], norm_);
                from_nothing += error_from_importance(choice.ranking.from_nothing()[i], norm_);
            }
            mask |= from_nothing < as_shown ? 1U << band : 0U;
            ++band;
        }
        return mask;
    }

  private:
    Norm norm_;
};

class DealerSelector final : public BandSelector {
  public:
    explicit DealerSelector(Norm norm) : norm_(norm) {}

    std::uint32_t bands_to_reset(const BandChoice& choice) override {
        std::vector<Hand> hands;
        for (const Places& places : places_of_bands(choice.scene)) {
            const auto remainders = [&](std::span<const float> importances) {
                return Remainders(importances.subspan(places.first, places.count),
                                  choice.budget.columns, norm_);
            };
            hands.push_back({.as_shown = remainders(choice.ranking.as_shown()),
                             .from_nothing = remainders(choice.ranking.from_nothing())});
        }
        for (std::uint32_t dealt = 0; dealt < choice.budget.columns; ++dealt) {
            const auto best = std::max_element(
                hands.begin(), hands.end(),
                [](const Hand& a, const Hand& b) { return a.gain() < b.gain(); });
            if (best->gain() <= 0) {
                break;
            }
            best->terms += 1;
        }
        std::uint32_t mask = 0;
        for (std::size_t band = 0; band < hands.size(); ++band) {
            mask |= hands[band].begins_anew() ? 1U << band : 0U;
        }
        return mask;
    }

  private:
    Norm norm_;
};

class ExhaustiveSelector final : public BandSelector {
  public:
    explicit ExhaustiveSelector(Norm norm) : norm_(norm) {}

    std::uint32_t bands_to_reset(const BandChoice& choice) override {
        std::uint32_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t mask = 0; mask < 1U << choice.scene.columns().band_count(); ++mask) {
            plan_.bands_to_reset = mask;
            selection_.choose(choice.scene.columns(), choice.lighting, choice.ranking,
                              choice.scene.columns().places(), choice.budget, plan_);
            const double error = remaining_lighting_error(choice, plan_, norm_);
            if (error < least) {
                least = error;
                best = mask;
            }
        }
        return best;
    }

  private:
    Norm norm_;
    engine::Selection selection_;
    engine::Plan plan_;
};

}  // namespace

double remaining_lighting_error(const BandChoice& choice, const engine::Plan& plan, Norm norm) {
    // The changes come in the order of places, so that one walk meets them all.
    const std::span<const std::uint32_t> columns = choice.scene.columns().by_band();
    double error = 0;
    auto next = plan.changes.begin();
    for (std::size_t place = 0; place < columns.size(); ++place) {
        if (next != plan.changes.end() && next->column == columns[place]) {
            ++next;
            continue;
        }
        const bool begins_anew = plan.resets(choice.scene.columns().bands()[columns[place]]);
        error += error_from_importance(begins_anew ? choice.ranking.from_nothing()[place]
                                                   : choice.ranking.as_shown()[place],
                                       norm);
    }
    return error;
}

std::unique_ptr<BandSelector> make_simple_selector(Norm norm) {
    return std::make_unique<SimpleSelector>(norm);
}

std::unique_ptr<BandSelector> make_dealer_selector(Norm norm) {
    return std::make_unique<DealerSelector>(norm);
}

std::unique_ptr<BandSelector> make_exhaustive_selector(Norm norm) {
    return std::make_unique<ExhaustiveSelector>(norm);
}

}  // namespace relume::lab
