// The loop over the pixels of a ray-cast picture: rows in parallel, cancelled and told of in between.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>

#include <tbb/parallel_for.h>

#include "core/view/picture.h"

namespace lueur {

// Calls pixel(x, y) for each, from many threads. False when cancelled.
template <typename Pixel>
bool for_each_pixel(const PictureParams& params, const std::atomic<bool>& cancel,
                    const std::function<void(double)>& progress, const Pixel& pixel) {
    constexpr int rows_at_once = 16;
    for (int first = 0; first < params.height; first += rows_at_once) {
        if (cancel.load(std::memory_order_relaxed)) return false;
        const int end = std::min(first + rows_at_once, params.height);
        tbb::parallel_for(first, end, [&](int y) {
            for (int x = 0; x < params.width; ++x) pixel(x, y);
        });
        if (progress) progress(double(end) / params.height);
    }
    return true;
}

// Calls add(point) for what each sample of a pixel sees of the field.
template <typename Add>
void for_each_sample(const FieldView& view, const Camera& camera, const PictureParams& params, int x, int y,
                     const Add& add) {
    const double aspect = double(params.width) / params.height;
    const int n = params.samples_per_axis;
    for (int s = 0; s < n * n; ++s) {
        const double u = (x + (s % n + 0.5) / n) / params.width, v = (y + (s / n + 0.5) / n) / params.height;
        if (const auto point = field_along_ray(view, camera_ray(camera, aspect, u, v))) add(*point);
    }
}

} // namespace lueur
