// Reading and writing scenes: `.toml`, and `.obj`, `.gltf`, `.glb` opened as they are.
//
// All errors of a file come in one go, each `FILE:LINE:COLUMN: what is wrong; what is allowed` (line and column
// 1-based; where a library gives no place, `FILE: ...`). Unknown keys are errors. Warnings say what was repaired or
// left out (a degenerate triangle, a missing texture) and never change the light silently.
//
// The scene file is TOML. Paths are relative to it. Lengths are in its `units` and axes; numbers may be integers or
// decimals.
//
//     name  = "Two walls"          # default: the file's name
//     units = "millimetre"         # required: metre centimetre millimetre foot inch
//     up    = "y"                  # y (default) or z; right-handed either way
//
//     [[geometry]]                 # any number; all nodes, transforms applied
//     file  = "office.glb"         # required: .obj .gltf .glb
//     units = "metre"              # .obj only, default the scene's; glTF is metre and y up by its own standard
//     up    = "z"                  # .obj only, default the scene's
//     imported_emission = true     # default; false: the file's own emissive materials make no luminaires
//
//     [[polygon]]                  # any number; polygons of one name are one object and must have one material
//     name     = "left wall"       # required
//     material = "red paint"       # required; of a [[material]] below, or of a geometry file
//     # required: at least 3, counter-clockwise seen from the front; convex or concave
//     vertices = [[0, 0, 0], [0, 2500, 0], [0, 2500, 3000], [0, 0, 3000]]
//     # default none; one a vertex; (0,0) is the picture's top left; the picture repeats
//     uv       = [[0, 1], [0, 0], [1, 0], [1, 1]]
//
//     [[object]]                   # gives an object of a geometry file another material
//     name     = "desk.003"
//     material = "red paint"
//
//     [[material]]                 # with the name of an imported one: changes the keys given here, keeps the others
//     name        = "red paint"    # required, unique
//     reflectance = 0.5            # 0..1; or [r, g, b] each 0..1, linear sRGB; or
//                                  # { file = "paints.csv", column = "red", interpolation = "bin" } (column: default
//                                  # the first; interpolation: linear (default) or bin; the formats are in
//                                  # core/spectrum/read_spectrum.h); or { library = "ColorChecker red" } of the
//                                  # program's own spectra; or { points = [[400, 0.1], [700, 0.8]] } (nm, value)
//     two_sided   = false          # default; false: the back is black and opaque
//
//     [[material]]
//     name    = "picture"
//     texture = "pictures/sea.png" # its mean is the reflectance; where one is given, the picture is scaled to it;
//                                  # "office.glb*0": the first picture inside that geometry file;
//                                  # "none": takes an imported texture away
//
//     [[luminaire]]
//     name     = "lamp"            # required, unique
//     objects  = ["left wall"]     # required: names of polygons or imported objects, each in one luminaire at most;
//                                  # takes the place of what a geometry file says of their emission
//     spectrum = "flat"            # default: equal energy from 380 to 780 nm; or [r, g, b] >= 0; or
//                                  # { file = "lamp.csv" }, { library = "FL11" }, { points = [[400, 0], [700, 1]] } as
//                                  # above; or { blackbody = 2700 } (1000..25000 K); or { daylight = 6504 } (CIE,
//                                  # 4000..25000 K); or { lines = [{ nm = 589.3, width = 1, power = 1 }] } (nm; power
//                                  # relative); or { mix = [{ library = "FL11" }, { blackbody = 2700 }], share = 0.5 }:
//                                  # two of these but [r, g, b], share: of the lumens, that the second gives. What
//                                  # lies outside 380..780 nm is kept and counts in no figure
//     power    = { lumen = 3000 }  # required, one of: lumen, watt (of the whole luminaire), exitance (W/m2),
//                                  # radiance (W/m2/sr); exitance and radiance multiply [r, g, b] channel by channel
//     dimmer   = 1.0               # default; >= 0
//     side     = "front"           # default; front back both
//
//     [camera]                     # default: looks at the whole scene
//     position = [278, 273, -800]  # required
//     target   = [278, 273, 0]     # required
//     up       = [0, 1, 0]         # default: the up axis
//     vertical_fov_degrees = 39.3  # default 50; 1..170
//     mirrored = true              # default false; true: +x of the picture is drawn to the left
//
//     [display]                    # all optional; core/display/display_settings.h, display_fields.h for the ranges
//     max_display_rule = "by_hand" # percentile (default: of the picture), lecture (from lamps and floor), by_hand
//     max_display = 100            # cd/m2 shown as full white, 1e-30..1e30; the rules put theirs in its place
//     percentile = 98              # of the picture's luminances, 1..100
//     locked = true                # an edit never rescales the picture unasked
//     operator = "linear"          # linear tumblin_rushmeier filmic
//     adaptation_auto = true       # tumblin_rushmeier: the picture's geometric mean luminance; false: the next
//     adaptation = 20              # cd/m2, 0.001..1e6
//     display_contrast = 35        # tumblin_rushmeier: white to black of the display, 2..1e6
//     filmic_white = 4             # filmic: times MAXDISPLAY, 1..100
//     clip   = "clamp"             # clamp keep_chromaticity desaturate scale_all
//     curve  = "srgb"              # srgb gamma
//     gamma  = 2.2                 # 0.1..10; or [red, green, blue]
//     primaries = "srgb"           # srgb rec709 rec2020 display_p3 lecture; or x y of red, green, blue and white:
//                                  # [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329]
//     white_luminance = 80         # cd/m2 of the display's white, 1..1e5
//     mark_clipped = false         # stripes where a pixel is brighter than the display
//     mark_out_of_gamut = false    # ... more saturated than it
//     illuminance_auto = true      # false colours: the range from the scene; false: the next two
//     illuminance_low  = 1         # lx, 1e-6..1e12
//     illuminance_high = 1000
//     illuminance_log  = true      # else linear
//     illuminance_isolines = true  # contours
//     illuminance_levels = []      # of the contours, at most 16; none: the legend's numbers
//     # luminance_auto, _low, _high, _log, _isolines, _levels: the same in cd/m2
//
//     [solve]                      # all optional
//     solver       = "auto"        # auto gathering shooting overshooting jacobi gauss_seidel hierarchical reference
//     form_factors = "auto"        # of patches, for overshooting, jacobi, gauss_seidel and hierarchical: auto analytic
//                                  # point_to_disk area_sampled monte_carlo hemicube hemisphere
//     form_factor_samples = 0      # sub-elements, rays, or edge of the hemicube, 0..1048576; 0: the method's default
//     oracle       = "error"       # what links of hierarchical are refined by: form_factor flux error
//     link_tolerance = 0           # of the oracle, 0 or more; 0: from target_error
//     matrix_memory = 1024         # MiB that a full matrix of form factors may take, 1..1048576
//     wavelengths  = "auto"        # auto, folded:1 .. folded:32, uniform:4 .. uniform:81, meyer:4 (6, 10),
//                                  # gauss:3 .. gauss:20, rgb: core/spectrum/wavelengths.h
//     colour_error = 0.5           # CIEDE2000 that auto may be predicted at worst, > 0, <= 100
//     compare_trichromatic = false # solve in RGB beside, to see the difference
//     target_error = 0.02          # relative, > 0, <= 1
//     element_size = 0             # longest coarse element edge, in `units`; 0: chosen from the scene's area
//     max_rays     = 512           # gather rays a receiver at most, 1..1048576
//     seed         = 1             # 0..4294967295
//
// An .obj opened as it is counts in metres, Y up.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace lueur {

struct LoadedScene {
    Scene scene;
    std::vector<std::string> warnings;
};

struct LoadParams {
    std::filesystem::path spectrum_library; // the folder of the program's own spectra; empty: there is none
};
std::expected<LoadedScene, std::vector<std::string>> load_scene(const std::filesystem::path& file,
                                                                const LoadParams& params = {});

// As a .toml; paths inside are written relative to the new file's folder. Writes beside and renames. Saving what was
// just loaded from a file that save_scene wrote gives the same bytes.
std::expected<void, std::string> save_scene(const Scene& scene, const std::filesystem::path& file);
std::string scene_to_toml(const Scene& scene, const std::filesystem::path& folder);

// A texture for a material: reads, and says what is wrong in one line. set_texture also sets the mean reflectance over
// the texels that the material's triangles use.
std::expected<Texture, std::string> load_texture(const Scene& scene, const std::filesystem::path& file);
void set_texture(Scene& scene, MaterialIndex material, Texture texture);

// What is wrong with values a panel or a command may have changed: reflectance 0..1, powers, camera, display. Empty
// when fine.
std::vector<std::string> check(const Scene& scene);

} // namespace lueur
