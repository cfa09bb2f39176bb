#include "core/spectrum/cieluv.h"

#include "core/spectrum/cielab.h"

namespace lueur {

Uv1976 uv1976_from_xyz(const Xyz& xyz) {
    const double sum = xyz.x + 15 * xyz.y + 3 * xyz.z;
    if (sum == 0) return {};
    return {4 * xyz.x / sum, 9 * xyz.y / sum};
}

Uv1960 uv1960_from_xyz(const Xyz& xyz) {
    const Uv1976 uv = uv1976_from_xyz(xyz);
    return {uv.u, uv.v * 2 / 3};
}

Uv1976 uv1976_from_chromaticity(const Chromaticity& xy) {
    return uv1976_from_xyz({xy.x, xy.y, 1 - xy.x - xy.y});
}
Uv1960 uv1960_from_chromaticity(const Chromaticity& xy) {
    return uv1960_from_xyz({xy.x, xy.y, 1 - xy.x - xy.y});
}

Chromaticity chromaticity_from_uv(const Uv1976& uv) {
    const double sum = 6 * uv.u - 16 * uv.v + 12;
    if (sum == 0) return {};
    return {9 * uv.u / sum, 4 * uv.v / sum};
}
Chromaticity chromaticity_from_uv(const Uv1960& uv) {
    return chromaticity_from_uv(Uv1976{uv.u, uv.v * 3 / 2});
}

Luv luv_from_xyz(const Xyz& xyz, const Xyz& white) {
    if (xyz.x + 15 * xyz.y + 3 * xyz.z == 0) return {};
    const double L = lightness(xyz.y / white.y);
    const Uv1976 uv = uv1976_from_xyz(xyz), n = uv1976_from_xyz(white);
    return {L, 13 * L * (uv.u - n.u), 13 * L * (uv.v - n.v)};
}

Xyz xyz_from_luv(const Luv& luv, const Xyz& white) {
    if (luv.L == 0) return Xyz(0);
    const Uv1976 n = uv1976_from_xyz(white);
    const Uv1976 uv{luv.u / (13 * luv.L) + n.u, luv.v / (13 * luv.L) + n.v};
    return xyz_from_chromaticity(chromaticity_from_uv(uv), white.y * relative_luminance(luv.L));
}

} // namespace lueur
