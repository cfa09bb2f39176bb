// How little of the light a surface can be told to absorb.
#pragma once

namespace lueur {

// Reflectances are solved with in single precision: 1 - rho is known to about this. A reflectance that is nearer to 1
// is 1.
inline constexpr double least_absorbed = 1e-7;

} // namespace lueur
