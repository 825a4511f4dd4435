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

// ‖w ΔL‖₂ of one column from its importance.
double norm_from_importance(float importance) {
    return importance == Ranking::kNoDifference ? 0 : std::sqrt(double{importance});
}

double norm_after_resets(const BandChoice& choice,
                         const engine::Plan& plan,
                         std::size_t place) {
    const std::uint32_t column = choice.scene.columns_by_band()[place];
    return norm_from_importance(plan.resets(choice.scene.bands()[column])
                                    ? choice.ranking.from_nothing()[place]
                                    : choice.ranking.as_shown()[place]);
}

// What is left of a band when so many of its largest terms are taken: [0] none, … falling.
class Remainders {
  public:
    Remainders(std::span<const float> importances, std::uint32_t most_terms) {
        std::vector<double> norms;
        double left = 0;
        for (const float importance : importances) {
            norms.push_back(norm_from_importance(importance));
            left += norms.back();
        }
        const std::size_t kept = std::min<std::size_t>(most_terms, norms.size());
        std::partial_sort(norms.begin(), norms.begin() + static_cast<std::ptrdiff_t>(kept),
                          norms.end(), std::greater<>());
        left_.push_back(left);
        for (std::size_t i = 0; i < kept; ++i) {
            left -= norms[i];
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

class DealerSelector final : public BandSelector {
  public:
    std::uint32_t bands_to_reset(const BandChoice& choice) override {
        std::vector<Hand> hands = hands_of(choice);
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
    static std::vector<Hand> hands_of(const BandChoice& choice) {
        std::vector<Hand> hands;
        std::size_t first = 0;
        for (std::uint32_t band = 0; band < choice.scene.band_count(); ++band) {
            std::size_t last = first;
            for (const engine::BandChunk& chunk : choice.scene.band_chunks()) {
                last = chunk.band == band ? chunk.last : last;
            }
            hands.push_back(
                {.as_shown = {choice.ranking.as_shown().subspan(first, last - first),
                              choice.budget.columns},
                 .from_nothing = {choice.ranking.from_nothing().subspan(first, last - first),
                                  choice.budget.columns}});
            first = last;
        }
        return hands;
    }
};

class ExhaustiveSelector final : public BandSelector {
  public:
    std::uint32_t bands_to_reset(const BandChoice& choice) override {
        std::uint32_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t mask = 0; mask < 1U << choice.scene.band_count(); ++mask) {
            plan_.bands_to_reset = mask;
            selection_.choose(choice.scene, choice.lighting, choice.ranking,
                              choice.scene.places(), choice.budget, plan_);
            const double error = remaining_lighting_error(choice, plan_);
            if (error < least) {
                least = error;
                best = mask;
            }
        }
        return best;
    }

  private:
    engine::Selection selection_;
    engine::Plan plan_;
};

}  // namespace

double remaining_lighting_error(const BandChoice& choice, const engine::Plan& plan) {
    // The changes come in the order of places, so that one walk meets them all.
    double error = 0;
    auto next = plan.changes.begin();
    for (std::size_t place = 0; place < choice.scene.columns_by_band().size(); ++place) {
        if (next != plan.changes.end() &&
            next->column == choice.scene.columns_by_band()[place]) {
            ++next;
        } else {
            error += norm_after_resets(choice, plan, place);
        }
    }
    return error;
}

std::unique_ptr<BandSelector> make_dealer_selector() {
    return std::make_unique<DealerSelector>();
}

std::unique_ptr<BandSelector> make_exhaustive_selector() {
    return std::make_unique<ExhaustiveSelector>();
}

}  // namespace relume::lab
