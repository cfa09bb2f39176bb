// Published illuminants for tests: the spectra of the library, 380..780 nm at 5 nm, and their chromaticities.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/spectrum/colour.h"
#include "core/spectrum/read_spectrum.h"
#include "tests/support/source_folder.h"

namespace lueur {

// Chromaticities by the 2-degree observer, both computed independently from CIE 15:2018's tables: of the sum at 5 nm,
// which is how the published figures are made, and of the spectrum taken as linear between its samples, summed at 1 nm.
struct PublishedIlluminant {
    const char* name;
    Chromaticity summed_at_5nm, linear_at_1nm;
};
inline constexpr PublishedIlluminant published_illuminants[] = {
    {"A", {0.447575018, 0.407445717}, {0.447563642, 0.407439466}},
    {"C", {0.310062493, 0.316158940}, {0.310095561, 0.316232321}},
    {"D50", {0.345674591, 0.358510388}, {0.345691849, 0.358521661}},
    {"D55", {0.332431639, 0.347444399}, {0.332449525, 0.347459762}},
    {"D65", {0.312720525, 0.329030685}, {0.312738574, 0.329052047}},
    {"D75", {0.299033194, 0.314879887}, {0.299051049, 0.314905550}},
    {"FL1", {0.313062433, 0.337106478}, {0.313096761, 0.337271028}},
    {"FL2", {0.372068154, 0.375122558}, {0.372084889, 0.375289600}},
    {"FL3", {0.409090035, 0.394117134}, {0.409099512, 0.394296844}},
    {"FL4", {0.440181096, 0.403090691}, {0.440181970, 0.403288792}},
    {"FL5", {0.313757349, 0.345160650}, {0.313793009, 0.345310048}},
    {"FL6", {0.377877772, 0.388194149}, {0.377898307, 0.388351066}},
    {"FL7", {0.312852473, 0.329174178}, {0.312919660, 0.329328683}},
    {"FL8", {0.345805754, 0.358617583}, {0.345884973, 0.358751554}},
    {"FL9", {0.374099272, 0.372684196}, {0.374168018, 0.372823936}},
    {"FL10", {0.345787901, 0.358757928}, {0.345795057, 0.358963671}},
    {"FL11", {0.380537485, 0.376915309}, {0.380517960, 0.377125873}},
    {"FL12", {0.437024345, 0.404215001}, {0.436946029, 0.404414093}},
    {"HP1", {0.533000823, 0.414953238}, {0.532779969, 0.415170682}},
    {"HP2", {0.477792075, 0.415840459}, {0.477837872, 0.415858877}},
    {"HP3", {0.430231400, 0.407517011}, {0.430112103, 0.407543258}},
    {"HP4", {0.381171895, 0.379726575}, {0.381083451, 0.379707658}},
    {"HP5", {0.377583209, 0.371347973}, {0.377526477, 0.371360330}},
    {"LED-B1", {0.455951193, 0.407798831}, {0.455919218, 0.407904243}},
    {"LED-B2", {0.435662050, 0.401181156}, {0.435653146, 0.401293175}},
    {"LED-B3", {0.375614965, 0.372288746}, {0.375655330, 0.372445264}},
    {"LED-B4", {0.342184668, 0.350156024}, {0.342274406, 0.350348041}},
    {"LED-B5", {0.311808199, 0.323636391}, {0.311896770, 0.323846058}},
    {"LED-BH1", {0.447409198, 0.406594430}, {0.447412565, 0.406727969}},
    {"LED-RGB1", {0.455746205, 0.421120798}, {0.455757055, 0.421102975}},
    {"LED-V1", {0.454761935, 0.404406268}, {0.454532697, 0.404170957}},
    {"LED-V2", {0.378112121, 0.377499294}, {0.377967060, 0.377285391}},
};

inline Spectrum linear_spectrum(const std::string& name) {
    const char* file = name.starts_with("FL")    ? "cie_fluorescent.csv"
                       : name.starts_with("HP")  ? "cie_discharge.csv"
                       : name.starts_with("LED") ? "cie_led.csv"
                                                 : "cie_standard.csv";
    const auto whole = read_spectrum_csv((test::source_folder() / "assets/spectra" / file).string(), name);
    if (!whole) throw std::runtime_error(whole.error().front());
    Spectrum visible;
    for (int nm = 380; nm <= 780; nm += 5) {
        visible.nm.push_back(nm);
        visible.value.push_back(value_at(*whole, nm, Outside::zero));
    }
    return visible;
}

// The samples as lines of 0.2 pm: an exact integral of it is CIE 15's sum over the samples.
inline Spectrum line_spectrum(const std::string& name) {
    const Spectrum samples = linear_spectrum(name);
    Spectrum lines;
    constexpr double width = 1e-4;
    for (std::size_t i = 0; i < samples.nm.size(); ++i) {
        for (const double aside : {-width, 0.0, width}) lines.nm.push_back(samples.nm[i] + aside);
        for (const double peak : {0.0, 5 / width, 0.0}) lines.value.push_back(peak * samples.value[i]);
    }
    return lines;
}

} // namespace lueur
