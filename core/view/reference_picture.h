// A picture by the reference: what leaves the seen surfaces towards the eye, by paths, without a field.
//
// Each pass traces one ray through a random place of each pixel and one path from where it meets the scene; passes are
// independent, and so their spread is the standard error of each pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/solve/solution.h"
#include "core/view/picture.h"

namespace lueur {

struct ReferencePictureParams {
    int width = 1280, height = 800;
    PictureQuantity quantity = PictureQuantity::colour;
    double target_error = 0.02;         // of the picture, see below
    std::uint32_t most_passes = 100000; // and at least two
    double time_limit = 0;              // s; 0: none
    std::uint32_t seed = 1;
};

struct ReferencePicture {
    RadianceImage image;
    std::vector<float> standard_error; // of each pixel's Y, cd m^-2 (lx for illuminance)
    double relative_error = 1;         // RMS of error / Y over the pixels brighter than 2 % of their mean
    std::uint32_t passes = 0;
};

// Needs a solution that has a world; nothing of it need be solved. Progress goes from 0 to 1. Cancelled: no image.
ReferencePicture trace_picture(const Solution& solution, const Camera& camera, const ReferencePictureParams& params,
                               const std::atomic<bool>& cancel, const std::function<void(double)>& progress = {});

} // namespace lueur
