// What probes say of a solution: how large its errors are where the model says that there are some.
#pragma once

#include "core/solve/error_model.h"

namespace lueur {

// What the probes say: residuals and their own variance.
struct Residual {
    const ErrorProbes::Point* point;
    double direct, indirect, direct_noise, indirect_noise; // lx, lx^2
    double model_direct, model_hidden, model_rays, model_bent, model_between, model_read_direct, model_read_indirect;
    double unsent; // lm m^-2: what of `direct` would be reflected to where it is not as wrong
    double bright; // lx, what an error here is relative to: the larger of what is shown and what was gathered
    double area;   // m^2 that counts: none where it is dark
    // Area over bright squared: sums of squares become relative, and no point counts for more than itself.
    double weight;
};

double read(std::span<const float> values, const ErrorProbes::Point& p);

// None while there are no complete probes.
std::vector<Residual> residuals(const Solution::State& state, const ErrorLight& light, const ErrorModel& model);

// What variances of the model are to be multiplied with.
struct ErrorFactors {
    double direct = 1, hidden = 0, rays = 1, bent = 1, between = 1, read = 0;
    double rim = 1; // of buried vertices beside others
    double at(const ErrorModel& model, std::size_t vertex) const {
        return direct * model.direct[vertex] + hidden * model.hidden[vertex] + rays * model.rays[vertex] +
               bent * model.bent[vertex] + read * (model.read_direct[vertex] + model.read_indirect[vertex]);
    }
    double at(const Residual& r) const {
        return direct * r.model_direct + hidden * r.model_hidden + rays * r.model_rays + bent * r.model_bent +
               read * (r.model_read_direct + r.model_read_indirect);
    }
};
ErrorFactors fit_model(const Solution::State& state, const ErrorMesh& mesh, const ErrorLight& light,
                       const ErrorModel& model, const std::vector<Residual>& probes,
                       const std::vector<float>& missing_at, double rho);

// Errors have longer tails than the normal distribution: so many standard deviations hold 95 % of the residuals at the
// probed vertices, the probes' own noise counted in both.
double interval_factor(const std::vector<Residual>& probes, const std::vector<float>& error, bool knows_its_rays);

} // namespace lueur
