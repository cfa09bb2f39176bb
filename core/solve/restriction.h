// Between the fine mesh of direct light and the coarse one of indirect light.
#pragma once

#include <span>
#include <vector>

#include "core/solve/channel_field.h"
#include "core/transport/direct_transport.h"
#include "core/transport/mesh.h"

namespace lueur {

// The area-weighted mean of D under each coarse vertex's hat function, times emitters; buried fine vertices do not
// count. A shadow edge inside an element so costs a bounce no energy.
std::vector<float> restrict_direct(const Mesh& mesh, const DirectTransport& direct);

// Gives buried vertices the mean of their neighbours that are not, ring by ring, so that interpolation across a contact
// does not darken what is seen. `elements` may use any vertices below values.count.
void fill_buried(std::span<const glm::uvec3> elements, std::vector<std::uint8_t> buried, ChannelField& values);

} // namespace lueur
