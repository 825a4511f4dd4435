// What was measured where a method may fail, beside its bound and the bound's reason.
#pragma once

#include <cmath>
#include <string>

namespace relume::stability {

enum class Sense {
    at_most,   // what must hold
    at_least,  // what shows that the scene provokes the failure, so that the rest can fail
    reported,  // no bound is claimed; to be known by who chooses a method
};

struct Finding {
    std::string measure;
    Sense sense = Sense::at_most;
    double bound = 0;
    double measured = 0;
    std::string reason;  // of the bound

    // False for what is not a number.
    [[nodiscard]] bool holds() const {
        switch (sense) {
            case Sense::at_most:
                return measured <= bound;
            case Sense::at_least:
                return measured >= bound;
            case Sense::reported:
                break;
        }
        return std::isfinite(measured);
    }
};

}  // namespace relume::stability
