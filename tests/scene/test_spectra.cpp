// Every form of a light and of a reflectance: what it is, that it saves and loads to the same bytes, what is refused.
#include <random>

#include "core/scene/luminaire.h"
#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/operations.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

using testing::HasSubstr;

const Spectrum drawn_curve{{400, 500.25, 700}, {0.1, 0.30000000000000004, 1}};

double watts(const Spectrum& spectrum) {
    return integral(spectrum, 0, 1e4, Outside::zero);
}
double lumens(const Spectrum& spectrum) {
    return xyz_from_spectrum(spectrum).y;
}

TEST(Spectra, AFormIsItsCurve) {
    EXPECT_EQ(*spectrum_of(EmissionSpectrum(Blackbody{3000})), blackbody(3000));
    EXPECT_EQ(*spectrum_of(EmissionSpectrum(Daylight{5000})), daylight(5000));
    EXPECT_EQ(*spectrum_of(EmissionSpectrum(Drawn{drawn_curve})), drawn_curve);
    EXPECT_EQ(*spectrum_of(EmissionSpectrum(LibrarySpectrum{"x", drawn_curve})), drawn_curve);
    EXPECT_FALSE(spectrum_of(EmissionSpectrum(Rgb(1))).has_value());
    EXPECT_EQ(spectrum_of(Reflectance(Drawn{drawn_curve})), drawn_curve);
    EXPECT_EQ(value_at(spectrum_of(Reflectance(0.25)), 900, Outside::constant), 0.25);
    // Bins come as linear pieces, so that whoever integrates them need not know.
    const SpectrumFile bins{"b.csv", "", Spectrum{{400, 500}, {1, 3}, Interpolation::bin}};
    const Spectrum pieces = *spectrum_of(EmissionSpectrum(bins));
    EXPECT_EQ(pieces.interpolation, Interpolation::linear);
    EXPECT_NEAR(watts(pieces), 400, 1e-9);
}

TEST(Spectra, ALineHoldsItsPowerWhateverItsWidth) {
    for (const double width : {1e-3, 0.1, 1.0, 50.0}) {
        const Spectrum one = *spectrum_of(EmissionSpectrum(Lines{{{589.3, width, 7}}}));
        EXPECT_NEAR(watts(one), 7, 1e-6) << width;
        if (width <= 1) {
            EXPECT_NEAR(lumens(one), 7 * 683 * observer_xyz(589.3).y, 2e-3 * lumens(one)) << width;
        }
    }
    // Mercury's lines, and one that covers another.
    const Lines many{{{435.8, 1, 2}, {546.1, 1, 3}, {546.3, 2, 5}, {404.7, 0.5, 1}}};
    const Spectrum all = *spectrum_of(EmissionSpectrum(many));
    EXPECT_TRUE(make_spectrum(all.nm, all.value));
    EXPECT_NEAR(watts(all), 11, 1e-6);
    EXPECT_NEAR(value_at(all, 546.1, Outside::zero), 3 + 2.5, 1e-9);
    EXPECT_NEAR(value_at(all, 500, Outside::zero), 0, 1e-12);
}

TEST(Spectra, AMixtureSharesTheLumensAndAddsThePower) {
    const SimpleEmission lamp = Blackbody{2700}, line = Lines{{{450, 2, 1}}};
    for (const double share : {0.0, 0.1, 0.5, 1.0}) {
        const Spectrum mix = *spectrum_of(EmissionSpectrum(Mix{{lamp, line}, share}));
        EXPECT_NEAR(lumens(mix), 1, 1e-9) << share;
        // Below 449 nm there is only the lamp; its share of the lumens is what it gives alone, scaled.
        EXPECT_NEAR(integral(mix, 460, 830, Outside::zero),
                    (1 - share) / lumens(blackbody(2700)) * integral(blackbody(2700), 460, 830, Outside::zero), 1e-12);
    }
    const Spectrum half = *spectrum_of(EmissionSpectrum(Mix{{lamp, line}, 0.5}));
    const Spectrum same = *spectrum_of(EmissionSpectrum(Mix{{lamp, lamp}, 0.3}));
    EXPECT_NEAR(lumens(half), lumens(same), 1e-9);
    for (std::size_t i = 0; i < same.nm.size(); ++i)
        EXPECT_NEAR(same.value[i], blackbody(2700).value[i] / lumens(blackbody(2700)), 1e-15);
}

TEST(Spectra, AnySimpleFormGoesIntoAMixtureAndBack) {
    const std::vector<EmissionSpectrum> forms{Flat{},
                                              SpectrumFile{"a", "b", drawn_curve},
                                              Blackbody{},
                                              LibrarySpectrum{"x", drawn_curve},
                                              Daylight{},
                                              Lines{{{550, 1, 1}}},
                                              Drawn{drawn_curve}};
    for (const EmissionSpectrum& form : forms) {
        ASSERT_TRUE(simple_emission(form));
        EXPECT_EQ(emission(*simple_emission(form)), form);
        EXPECT_TRUE(faults_of(form).empty());
    }
    EXPECT_FALSE(simple_emission(EmissionSpectrum(Rgb(1))));
    EXPECT_FALSE(simple_emission(EmissionSpectrum(Mix{})));
}

TEST(Spectra, FaultsSayWhatIsAllowed) {
    const double nan = std::nan("");
    const auto light = [](EmissionSpectrum spectrum) { return lines(faults_of(spectrum)); };
    const auto paint = [](Reflectance reflectance) { return lines(faults_of(reflectance)); };
    EXPECT_THAT(light(Daylight{3999}), HasSubstr("daylight is 3999; 4000..25000 K is allowed"));
    EXPECT_THAT(light(Daylight{nan}), HasSubstr("4000..25000 K"));
    EXPECT_THAT(light(Blackbody{25001}), HasSubstr("1000..25000 K"));
    EXPECT_THAT(light(Lines{}), HasSubstr("no lines; one or more"));
    EXPECT_THAT(light(Lines{{{0, 1, 1}}}), HasSubstr("1..1e6 nm"));
    EXPECT_THAT(light(Lines{{{550, 0, 1}}}), HasSubstr("0.001..1000 nm"));
    EXPECT_THAT(light(Lines{{{10, 500, 1}}}), HasSubstr("width of a line")) << "it would begin below 0";
    EXPECT_THAT(light(Lines{{{550, 1, -1}}}), HasSubstr("power of a line is -1; 0..1e12"));
    EXPECT_THAT(light(Lines{{{550, 1, 0}}}), HasSubstr("no line has power"));
    EXPECT_THAT(light(Drawn{}), HasSubstr("no samples; two or more"));
    EXPECT_THAT(light(Drawn{{{400, 400}, {1, 1}}}), HasSubstr("sample 2: wavelength 400 repeats"));
    EXPECT_THAT(light(Drawn{{{400, 500}, {1, nan}}}), HasSubstr("a finite number"));
    EXPECT_THAT(light(Drawn{{{400, 500}, {1, -1}}}), HasSubstr("-1 at 500 nm; 0..1e12"));
    EXPECT_THAT(light(Mix{{Flat{}, Flat{}}, 1.5}), HasSubstr("share is 1.5; 0..1 is allowed"));
    EXPECT_THAT(light(Mix{{Flat{}, Daylight{1}}, 0.5}), HasSubstr("4000..25000 K"));
    EXPECT_THAT(light(Mix{{Flat{}, Lines{{{1500, 1, 1}}}}, 0.5}), HasSubstr("gives no lumens"));
    EXPECT_THAT(paint(Drawn{{{400, 500}, {0.5, 1.01}}}), HasSubstr("1.01 at 500 nm; 0..1 is allowed"));
    EXPECT_THAT(paint(LibrarySpectrum{"x", {}}), HasSubstr("no samples"));
    EXPECT_THAT(paint(SpectrumFile{"p.csv", "", {{400, 500}, {4.5, 83}}}), HasSubstr("(percent? divide by 100)"));
    EXPECT_THAT(paint(SpectrumFile{"p.csv", "", {{400, 500}, {4.5, 8300}}}), testing::Not(HasSubstr("percent")));
    EXPECT_TRUE(faults_of(Reflectance(Drawn{{{400, 500}, {0, 1}}})).empty()) << "0 and 1 are reflectances";
}

class SpectraFiles : public SceneTest {
protected:
    void SetUp() override {
        SceneTest::SetUp();
        write("library/lamps.csv", "# library: Lamps\nwavelength_nm,FL11,\"odd\" lamp\n400,1,2\n500,3,4\n");
        write("library/paints.csv", "# library: Paints\n# kind: reflectance\nwavelength_nm,red\n400,0.1\n700,0.8\n");
        write("lamp.spd", "400 1\n500 2\n");
        write("paint.sp", "SPECT\nSPECTRAL_BANDS 2\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 700\nSPECTRAL_NORM 100\n"
                          "BEGIN_DATA\n10 80\nEND_DATA\n");
        write("percent.csv", "wavelength_nm,a\n400,10\n700,80\n");
        params.spectrum_library = folder / "library";
    }
    std::string with(const std::string& reflectance, const std::string& spectrum) const {
        std::string text = small_scene;
        text.replace(text.find("reflectance = 0.5"), 17, "reflectance = " + reflectance);
        text.replace(text.find("power ="), 7, "spectrum = " + spectrum + "\npower =");
        return text;
    }
    Scene load_with(const std::string& name, const std::string& text) const {
        auto loaded = load_scene(write(name, text), params);
        if (loaded) return std::move(loaded->scene);
        ADD_FAILURE() << lines(loaded.error()) << "\n" << text;
        return {};
    }
    std::string errors(const std::string& reflectance, const std::string& spectrum) const {
        const auto loaded = load_scene(write("bad.toml", with(reflectance, spectrum)), params);
        return loaded ? std::string() : lines(loaded.error());
    }
    LoadParams params;
};

// 100 W/m2 over 380..780 nm, and nine times as much per nm beside it.
TEST_F(SpectraFiles, WhatLiesOutsideTheVisibleIsKeptAndCountsInNoFigure) {
    Scene scene = load_with("s.toml", small_scene); // the lamp has 2 m2
    scene.luminaires[0].spectrum =
        SpectrumFile{"w.csv", "", Spectrum{{280, 379.999, 380, 780, 780.001, 2500}, {9, 9, 1, 1, 9, 9}}};
    Luminaire& lamp = scene.luminaires[0];
    const Wavelengths wavelengths = make_wavelengths({WavelengthRule::uniform, 31});
    for (const PowerUnit unit : {PowerUnit::watt, PowerUnit::exitance}) {
        lamp.unit = unit;
        lamp.power = unit == PowerUnit::watt ? 200 : 100;
        EXPECT_NEAR(radiant_flux(scene, lamp), 200, 1e-3);
        EXPECT_NEAR(watts_from_channels(wavelengths, exitance_channels(scene, lamp, wavelengths)), 100, 1e-9);
    }
    lamp.spectrum = SpectrumFile{"uv.csv", "", Spectrum{{300, 379}, {1, 1}}};
    EXPECT_THAT(lines(check(scene)), HasSubstr("no power in 380..780 nm, so it emits nothing"));
}

TEST_F(SpectraFiles, EveryFormIsReadSavedAndReadToTheSameBytes) {
    const Spectrum lamp{{400, 500}, {1, 2}}, fl11{{400, 500}, {1, 3}}, odd{{400, 500}, {2, 4}};
    const std::pair<const char*, EmissionSpectrum> lights[] = {
        {"{ file = \"lamp.spd\" }", SpectrumFile{"lamp.spd", "", lamp}},
        {"{ file = \"lamp.spd\", interpolation = \"bin\" }",
         SpectrumFile{"lamp.spd", "", {{400, 500}, {1, 2}, Interpolation::bin}}},
        {"{ file = \"lamp.spd\", interpolation = \"linear\" }", SpectrumFile{"lamp.spd", "", lamp}},
        {"{ library = \"FL11\" }", LibrarySpectrum{"FL11", fl11}},
        {"{ library = \"\\\"odd\\\" lamp\" }", LibrarySpectrum{"\"odd\" lamp", odd}},
        {"{ blackbody = 2700 }", Blackbody{2700}},
        {"{ daylight = 6503.5 }", Daylight{6503.5}},
        {"{ points = [[400, 0.1], [500.25, 0.30000000000000004], [700, 1]] }", Drawn{drawn_curve}},
        {"{ lines = [{ nm = 589.3 }, { nm = 435.8, width = 0.25, power = 1e-3 }] }",
         Lines{{{589.3, 1, 1}, {435.8, 0.25, 1e-3}}}},
        {"{ mix = [\"flat\", { library = \"FL11\" }] }", Mix{{Flat{}, LibrarySpectrum{"FL11", fl11}}, 0.5}},
        {"{ mix = [{ file = \"lamp.spd\" }, { lines = [{ nm = 500 }] }], share = 0.3333333333333333 }",
         Mix{{SpectrumFile{"lamp.spd", "", lamp}, Lines{{{500, 1, 1}}}}, 0.3333333333333333}},
        {"\"flat\"", Flat{}},
        {"[1, 0.5, 0]", Rgb(1, 0.5, 0)}};
    const std::pair<const char*, Reflectance> paints[] = {
        {"{ file = \"paint.sp\" }", SpectrumFile{"paint.sp", "", {{400, 700}, {0.1, 0.8}}}},
        {"{ library = \"red\" }", LibrarySpectrum{"red", {{400, 700}, {0.1, 0.8}}}},
        {"{ points = [[400, 0.1], [500.25, 0.30000000000000004], [700, 1]] }", Drawn{drawn_curve}}};
    for (std::size_t i = 0; i < std::size(lights); ++i) {
        const auto& [paint_text, paint] = paints[i % std::size(paints)];
        const Scene scene = load_with("s.toml", with(paint_text, lights[i].first));
        ASSERT_EQ(scene.luminaires.size(), 1u);
        EXPECT_EQ(scene.luminaires[0].spectrum, lights[i].second) << lights[i].first;
        EXPECT_EQ(scene.materials[0].reflectance, paint) << paint_text;
        EXPECT_TRUE(check(scene).empty()) << lights[i].first << lines(check(scene));
        const std::string saved = scene_to_toml(scene, folder);
        const Scene again = load_with("saved.toml", saved);
        EXPECT_EQ(again.luminaires[0].spectrum, scene.luminaires[0].spectrum) << saved;
        EXPECT_EQ(again.materials, scene.materials);
        EXPECT_EQ(scene_to_toml(again, folder), saved);
    }
}

TEST_F(SpectraFiles, WhatIsOfTheLibraryIsFoundFromAnyFolderAndPathsInAMixtureFollowTheFile) {
    const Scene scene = load_with(
        "s.toml", with("{ library = \"red\" }", "{ mix = [{ library = \"FL11\" }, { file = \"lamp.spd\" }] }"));
    std::filesystem::create_directories(folder / "far/away");
    ASSERT_TRUE(save_scene(scene, folder / "far/away/s.toml"));
    const auto moved = load_scene(folder / "far/away/s.toml", params);
    ASSERT_TRUE(moved) << lines(moved.error());
    EXPECT_EQ(moved->scene.materials, scene.materials);
    const Mix& mix = std::get<Mix>(moved->scene.luminaires[0].spectrum);
    EXPECT_EQ(std::get<SpectrumFile>(mix.lights[1]).path, "../../lamp.spd");
    EXPECT_EQ(std::get<LibrarySpectrum>(mix.lights[0]).spectrum.value, (std::vector<double>{1, 3}));
}

TEST_F(SpectraFiles, FaultsHaveTheirPlaceAndSayWhatIsAllowed) { // reflectance is in line 16, the spectrum in line 21
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"0.5", "{ library = \"FL12\" }",
         ":21:24: library = \"FL12\" is not a light of the library; did you mean \"FL11\"?"},
        {"{ library = \"FL11\" }", "\"flat\"",
         ":16:27: library = \"FL11\" is not a reflectance of the library; allowed: red"},
        {"0.5", "{ daylight = 3000 }", ":21:25: daylight = 3000 is out of range; 4000..25000 K"},
        {"0.5", "{ lines = [] }", ":21:22: lines is not a list of one or more"},
        {"0.5", "{ lines = [{ width = 1 }] }", ":21:23: a line has no nm"},
        {"0.5", "{ lines = [{ nm = 589, with = 1 }] }", "did you mean \"width\""},
        {"0.5", "{ lines = [{ nm = 589, width = 0 }] }", "0.001..1000 nm"},
        {"0.5", "{ points = [[400, 1]] }", ":21:23: points is not a list of two or more"},
        {"0.5", "{ points = [[500, 1], [400, 1]] }", ":21:34: wavelength 400 follows 500"},
        {"0.5", "{ points = [[500, 1], [500, 1]] }", "wavelength 500 repeats 500"},
        {"0.5", "{ points = [[500, 1], [600, nan]] }", ":21:40: a point is not finite"},
        {"0.5", "{ points = [[400, 1], [500, -1]] }", ":21:12: spectrum is -1 at 500 nm; 0..1e12"},
        {"0.5", "{ mix = [\"flat\"] }", "mix is not a list of two lights"},
        {"0.5", "{ mix = [\"flat\", [1, 1, 1]] }", "in no known form"},
        {"0.5", "{ mix = [\"flat\", { mix = [\"flat\", \"flat\"] }] }", "in no known form"},
        {"0.5", "{ mix = [\"flat\", \"flat\"], share = 2 }", "share = 2 is out of range; 0..1"},
        {"0.5", "{ mix = [\"flat\", \"flat\"], shar = 1 }", "did you mean \"share\""},
        {"0.5", "{ file = \"lamp.spd\", interpolation = \"bins\" }", "did you mean \"bin\""},
        {"0.5", "{ file = \"lamp.spd\", column = \"red\" }", "there is no column \"red\""},
        {"0.5", "{ glow = 1 }", "spectrum is in no known form"},
        {"{ glow = 1 }", "\"flat\"", "{ library = \"ColorChecker red\" }"},
        {"{ file = \"percent.csv\" }", "\"flat\"",
         ":16:15: reflectance is 10 at 400 nm; 0..1 is allowed (percent? divide by 100)"},
        {"{ points = [[400, 0.1], [700, 1.5]] }", "\"flat\"", ":16:15: reflectance is 1.5 at 700 nm"},
    };
    for (const auto& [reflectance, spectrum, wanted] : cases)
        EXPECT_THAT(errors(reflectance, spectrum), HasSubstr(wanted)) << reflectance << " " << spectrum;
    params.spectrum_library.clear();
    EXPECT_THAT(errors("0.5", "{ library = \"FL11\" }"), HasSubstr("there is no library of lights here"));
    write("library/lamps.csv", "# library: Lamps\nwavelength_nm,FL11\n400,x\n500,1\n");
    params.spectrum_library = folder / "library";
    EXPECT_THAT(errors("0.5", "{ library = \"FL11\" }"), HasSubstr("lamps.csv:3:5: \"x\" is not a number"));
}

TEST_F(SpectraFiles, DamagedScenesAreReadOrRefused) {
    const std::string good = with("{ points = [[400, 0.1], [700, 0.8]] }",
                                  "{ mix = [{ library = \"FL11\" }, { lines = [{ nm = 589.3, width = 1, power = 2 }] "
                                  "}], share = 0.25 }");
    static const std::string likely = "0123456789-.e[]{}\"=,\n nif";
    std::mt19937 random(77);
    int accepted = 0, refused = 0;
    for (int round = 0; round < 900; ++round) {
        std::string text = good;
        const std::size_t place = text.find("reflectance") + random() % (text.size() - text.find("reflectance"));
        if (random() % 2)
            text.erase(place, 1 + random() % 10);
        else
            text[place] = likely[random() % likely.size()];
        const auto loaded = load_scene(write("m.toml", text), params);
        if (!loaded) {
            ++refused;
            for (const std::string& error : loaded.error()) EXPECT_TRUE(error.starts_with(folder.string())) << error;
            continue;
        }
        ++accepted;
        const std::string saved = scene_to_toml(loaded->scene, folder);
        const Scene again = load_with("saved.toml", saved);
        EXPECT_EQ(scene_to_toml(again, folder), saved);
    }
    EXPECT_GT(accepted, 50);
    EXPECT_GT(refused, 300);
}

} // namespace
} // namespace lueur
