#include "core/spectrum/wavelengths_plan.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/spectrum/colour_difference.h"
#include "core/spectrum/dense_algebra.h"
#include "core/spectrum/folded_samples.h"
#include "core/spectrum/visible_grid.h"

namespace lueur {

namespace {

using Eigen::MatrixXd;

constexpr std::size_t most_predicted_products = 3300;
constexpr int most_samples = 24;
constexpr double much_better = 1.5;
// Times the target: what plain least squares may miss it by for weights of a small worst difference to be tried, and
// what those may miss it by for other wavelengths to be tried.
constexpr double within_reach = 3, nearly = 1.7;
constexpr double surely = 0.5; // the fit looks at fewer products than the prediction
constexpr WavelengthsSpec many_lamps{WavelengthRule::uniform, 31};

// One spectrum a column.
MatrixXd as_columns(const std::vector<std::vector<double>>& spectra, Eigen::Index length) {
    MatrixXd matrix(length, static_cast<Eigen::Index>(spectra.size()));
    for (std::size_t i = 0; i < spectra.size(); ++i)
        matrix.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::VectorXd>(spectra[i].data(), length);
    return matrix;
}

// Products of reflectances as columns, from one column a reflectance.
MatrixXd product_columns(const MatrixXd& reflectances, const std::vector<ReflectanceProduct>& products) {
    MatrixXd columns = MatrixXd::Ones(reflectances.rows(), static_cast<Eigen::Index>(products.size()));
    for (std::size_t i = 0; i < products.size(); ++i)
        for (const int index : products[i])
            if (index >= 0) columns.col(static_cast<Eigen::Index>(i)).array() *= reflectances.col(index).array();
    return columns;
}

// The colours that the content really has, by integration at 1 nm: computed once for all candidates.
class Truth {
public:
    explicit Truth(const SpectralContent& content)
        : content_(content)
        , reflectances_(with_interreflection(content.reflectances))
        , products_(reflectance_products(static_cast<int>(reflectances_.size()), most_predicted_products)) {
        std::vector<std::vector<double>> fine;
        for (const Spectrum& reflectance : reflectances_) {
            const VisibleGrid values = on_visible_grid(reflectance, Outside::constant);
            fine.emplace_back(values.begin(), values.end());
        }
        const MatrixXd products = product_columns(as_columns(fine, visible_count), products_);
        for (const Spectrum& light : content.lights) {
            const VisibleGrid moments = moments_on_visible_grid(light);
            MatrixXd functionals(visible_count, 3);
            for (int j = 0; j < visible_count; ++j) {
                const Xyz xyz = observer_xyz(observer_first_nm + j);
                for (int c = 0; c < 3; ++c)
                    functionals(j, c) = luminous_efficacy_km * moments[static_cast<std::size_t>(j)] * xyz[c];
            }
            Light truth;
            for (int c = 0; c < 3; ++c) truth.white[c] = functionals.col(c).sum();
            // A light of one line may have no Z: its Lab is taken against a white that has a little of everything.
            truth.lab_white = glm::max(truth.white, Xyz(1e-3 * truth.white.y));
            const MatrixXd xyz = transposed_times(products, functionals);
            if (truth.white.y > 0)
                for (Eigen::Index i = 0; i < xyz.rows(); ++i)
                    truth.lab.push_back(lab_from_xyz({xyz(i, 0), xyz(i, 1), xyz(i, 2)}, truth.lab_white));
            lights_.push_back(std::move(truth));
        }
    }

    ColourPrediction compare(const Wavelengths& wavelengths) const {
        std::vector<std::vector<double>> channels;
        for (const Spectrum& reflectance : reflectances_)
            channels.push_back(reflectance_channels(wavelengths, reflectance));
        const MatrixXd products = product_columns(as_columns(channels, wavelengths.size()), products_);
        ColourPrediction prediction;
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t l = 0; l < lights_.size(); ++l) {
            const Light& truth = lights_[l];
            if (!(truth.white.y > 0)) continue;
            const std::vector<double> emission = emission_channels(wavelengths, content_.lights[l]);
            MatrixXd weights(wavelengths.size(), 3);
            for (int k = 0; k < wavelengths.size(); ++k)
                for (int c = 0; c < 3; ++c)
                    weights(k, c) =
                        wavelengths.xyz_weight[static_cast<std::size_t>(k)][c] * emission[static_cast<std::size_t>(k)];
            // Lamps keep their luminous flux in whatever channels there are (core/scene/luminaire.h).
            const double flux = weights.col(1).sum();
            if (flux > 0) weights *= truth.white.y / flux;
            const MatrixXd seen = transposed_times(products, weights);
            const auto add = [&](const Lab& lab, const Xyz& xyz) {
                const double difference = delta_e_2000(lab, lab_from_xyz(xyz, truth.lab_white));
                prediction.worst = std::max(prediction.worst, difference);
                sum += difference;
                ++count;
            };
            add(lab_from_xyz(truth.white, truth.lab_white),
                {weights.col(0).sum(), weights.col(1).sum(), weights.col(2).sum()});
            for (Eigen::Index i = 0; i < seen.rows(); ++i)
                add(truth.lab[static_cast<std::size_t>(i)], {seen(i, 0), seen(i, 1), seen(i, 2)});
        }
        if (count > 0) prediction.mean = sum / static_cast<double>(count);
        return prediction;
    }

private:
    struct Light {
        Xyz white{0}, lab_white{0};
        std::vector<Lab> lab; // of the products
    };
    const SpectralContent& content_;
    std::vector<Spectrum> reflectances_;
    std::vector<ReflectanceProduct> products_;
    std::vector<Light> lights_;
};

std::string described(const Wavelengths& wavelengths, const ColourPrediction& prediction) {
    std::string what = fmt::format("{} channels", wavelengths.size());
    if (wavelengths.folded())
        what = wavelengths.lights.size() == 1 ? fmt::format("{} folded samples, one lamp spectrum", wavelengths.samples)
                                              : fmt::format("{} folded samples for each of {} lamp spectra",
                                                            wavelengths.samples, wavelengths.lights.size());
    return fmt::format("{}: predicted dE2000 {:.2f} on average, {:.2f} at worst", what, prediction.mean,
                       prediction.worst);
}

WavelengthsPlan finished(const WavelengthsSpec& asked, Wavelengths wavelengths, const ColourPrediction& prediction,
                         const std::string& why) {
    wavelengths.asked = asked;
    WavelengthsPlan plan{std::move(wavelengths), prediction, {}};
    plan.reason = described(plan.wavelengths, prediction) + why;
    return plan;
}

} // namespace

ColourPrediction predict_difference(const Wavelengths& wavelengths, const SpectralContent& content) {
    return Truth(content).compare(wavelengths);
}

WavelengthsPlan plan_wavelengths(const WavelengthsSpec& spec, const SpectralContent& asked, double target,
                                 const Wavelengths* before) {
    const SpectralContent content = with_a_light(asked);
    const Truth truth(content);
    const int lights = static_cast<int>(content.lights.size());
    const bool fits = spec.rule != WavelengthRule::folded || lights * spec.count <= max_channels;
    const bool keep = before && before->asked == spec && before->folded() && lights * before->samples <= max_channels;
    const auto kept = [&](const FoldedFit& fit) {
        return make_folded(spec, {before->nm.begin(), before->nm.begin() + before->samples}, content, fit);
    };
    if (spec.rule != WavelengthRule::automatic && fits) {
        Wavelengths wavelengths = make_wavelengths(spec, content);
        const ColourPrediction prediction = truth.compare(wavelengths);
        if (spec.rule == WavelengthRule::folded &&
            keep) { // other wavelengths are worth a solve when they are better by far
            Wavelengths old = kept(FoldedFit(content));
            const ColourPrediction of_old = truth.compare(old);
            if (of_old.worst <= std::max(target, much_better * prediction.worst))
                return finished(spec, std::move(old), of_old, "; kept");
        }
        return finished(spec, std::move(wavelengths), prediction, "");
    }
    Wavelengths uniform = make_wavelengths(many_lamps, content);
    const ColourPrediction of_uniform = truth.compare(uniform);
    if (!fits)
        return finished(spec, std::move(uniform), of_uniform,
                        fmt::format("; {} for each of {} different lamps would be more than the {} channels there are",
                                    to_string(spec), lights, max_channels));

    const FoldedFit fit(content);
    if (keep) {
        Wavelengths old = kept(fit);
        const ColourPrediction prediction = truth.compare(old);
        if (prediction.worst <= target) return finished(spec, std::move(old), prediction, "; kept");
        if (before->lights == content.lights) // a paint less: the weights that there are still hold
            if (const ColourPrediction as_is = truth.compare(*before); as_is.worst <= target)
                return finished(spec, *before, as_is, "; kept");
    }
    const int most = std::min(most_samples, max_channels / std::max(1, lights));
    for (int count = 1; count <= most; ++count) {
        if (lights * count > uniform.size() && of_uniform.worst <= target) break;
        std::vector<double> nm = fit.choose(count);
        if (count < most && fit.least_squares_worst(nm) > within_reach * target) continue;
        Wavelengths folded = make_folded(spec, nm, content, fit);
        ColourPrediction prediction = truth.compare(folded);
        if (prediction.worst > target && prediction.worst < nearly * target) {
            folded = make_folded(spec, fit.polish(std::move(nm), surely * target), content, fit);
            prediction = truth.compare(folded);
        }
        if (prediction.worst <= target)
            return finished(spec, std::move(folded), prediction, fmt::format("; the target is {:.2g}", target));
        if (count == most && prediction.worst < of_uniform.worst)
            return finished(spec, std::move(folded), prediction,
                            fmt::format("; the target of {:.2g} needs more samples than {}", target, most));
    }
    return finished(spec, std::move(uniform), of_uniform,
                    of_uniform.worst <= target ? "; fewer channels than folded samples would take"
                                               : fmt::format("; the target of {:.2g} is out of reach", target));
}

} // namespace lueur
