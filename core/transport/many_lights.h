// Direct light of all luminaires at one receiver, with rays where they tell something: a luminaire that gives a
// hundredth of the light there is not worth what one that gives half of it is.
//
// Shares are of geometry alone (guessed_exitances): an edit of a lamp traces nothing. One ray
// to a point of each tells who is seen at all; of those that are left, the larger their share of the light that
// arrives, the finer their shadow is known. The faintest, together a twentieth, are known by the luminaires of a small
// sample drawn among them by share (Shirley, Wang & Zimmerman 1996, "Monte Carlo techniques for direct lighting
// calculations"). What any of this leaves is stated in the deviations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/transport/direct_light.h"
#include "core/transport/world.h"

namespace lueur {

// Writes D of each emitter and its standard deviation. exitances: what makes them count. size_share, 0..1: how much
// what is lit counts in the picture (a receiver of a small element is lit less finely). Returns the rays.
std::uint64_t direct_form_factors(const World& world, std::span<const Emitter> emitters,
                                  std::span<const float> exitances, glm::vec3 origin, glm::vec3 normal,
                                  float size_share, float* factors, float* deviations);

} // namespace lueur
