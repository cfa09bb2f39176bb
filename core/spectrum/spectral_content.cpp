#include "core/spectrum/spectral_content.h"

#include <algorithm>

#include "core/spectrum/visible_grid.h"

namespace lueur {

namespace {

constexpr double most_mean = 0.95;    // for a scene that is all white
constexpr int all_triples_up_to = 60; // reflectances: 37,820 triples

} // namespace

SpectralContent with_a_light(SpectralContent content) {
    if (content.lights.empty()) content.lights.push_back({{visible_first_nm, visible_last_nm}, {1, 1}});
    return content;
}

std::vector<Spectrum> with_interreflection(std::vector<Spectrum> reflectances) {
    if (reflectances.size() < 2) return reflectances;
    Spectrum mean;
    for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) mean.nm.push_back(nm);
    mean.value.assign(mean.nm.size(), 0);
    for (const Spectrum& reflectance : reflectances) {
        const VisibleGrid values = on_visible_grid(reflectance, Outside::constant);
        for (std::size_t j = 0; j < values.size(); ++j)
            mean.value[j] += values[j] / static_cast<double>(reflectances.size());
    }
    for (double& value : mean.value) value = std::min(value, most_mean);
    const double most = *std::ranges::max_element(mean.value);
    for (double& value : mean.value) value *= (1 - most) / (1 - value);
    reflectances.push_back(std::move(mean));
    return reflectances;
}

std::vector<ReflectanceProduct> reflectance_products(int count, std::size_t most) {
    std::vector<ReflectanceProduct> products, deeper;
    for (int a = 0; a < count; ++a) products.push_back({a, -1, -1});
    for (int a = 0; a < count && products.size() < most; ++a) products.push_back({a, a, a});
    for (int a = 0; a < count && products.size() < most; ++a) products.push_back({a, a, -1});
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b) {
            if (a != b) deeper.push_back({a, b, -1});
            if (count > all_triples_up_to)
                deeper.push_back({a, b, (a + b) % count});
            else
                for (int c = b; c < count; ++c)
                    if (a != c) deeper.push_back({a, b, c});
        }
    const std::size_t room = most > products.size() ? most - products.size() : 0;
    if (deeper.size() <= room)
        products.insert(products.end(), deeper.begin(), deeper.end());
    else
        for (std::size_t k = 0; k < room; ++k) products.push_back(deeper[k * deeper.size() / room]);
    return products;
}

} // namespace lueur
