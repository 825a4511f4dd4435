// Runs methods over a lighting sequence on one scene and measures every image.
#pragma once

#include "tests/lab/measures/coverage.h"
#include "tests/lab/measures/record.h"
#include "tests/lab/measures/temporal_bands.h"
#include "tests/lab/methods/method.h"
#include "tests/lab/sequences/lighting_sequence.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace relume::lab {

struct Experiment {
    LabScene scene;
    LightingSequence sequence;
    Environments environments;
    std::vector<Method> methods;
    std::vector<std::uint32_t> pictures;  // images to keep, of the methods and the reference
    // Called after each image with how many are done; false ends the experiment there.
    std::function<bool(std::uint32_t)> go_on = [](std::uint32_t) { return true; };
};

// An image that was kept, interleaved RGB.
struct Picture {
    std::string method;  // empty: the reference
    std::uint32_t image = 0;
    std::vector<float> rgb;
};

struct Findings {
    std::vector<Record> records;  // image by image, methods in their order
    std::vector<Picture> pictures;
    std::vector<Coverage> coverages;  // of the images kept, by methods in wavelets
    TemporalSpectrum spectrum;        // of the light asked for
    std::uint32_t images_done = 0;
    bool complete = false;  // false: `go_on` ended it
};

// Every image is given its light anew and one step, as in the papers: also at rest NWA-k stays
// at k terms, and nothing but the method's own increments improves the image. The reference of
// each image is the dense product of the stored Haar transport, seen by the same camera.
// Methods take turns within each image, so that what else the machine does hits all alike.
// Numbers of reproducible columns are the same on every run and any number of threads. Throws
// std::invalid_argument where the sequence moves the camera and the scene is an image.
[[nodiscard]] Findings run_experiment(const Experiment& experiment);

}  // namespace relume::lab
