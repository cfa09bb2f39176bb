// Item buffers see what their pixels meet: what is too small for them is counted, and what they have missed is told.
#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "core/transport/form_factor.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// A floor of 1 m under a ceiling of 24 x 24 squares of 20 mm that do not touch; a sheet between hides half of them.
struct Tiles {
    Scene scene;
    Tiles(bool sheet) {
        test::SceneBuilder b;
        const MaterialIndex grey = b.material("grey", 0.5);
        b.polygon("floor", grey, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
        for (int i = 0; i < 24; ++i)
            for (int k = 0; k < 24; ++k) {
                const float x = (float(i) + 0.25f) / 24, z = (float(k) + 0.25f) / 24, side = 0.02f;
                b.polygon("tile", grey, {{x, 1, z}, {x + side, 1, z}, {x + side, 1, z + side}, {x, 1, z + side}});
            }
        if (sheet)
            b.polygon("sheet", b.material("paper", 0.5, true),
                      {{-9, 0.99f, -9}, {-9, 0.99f, 9}, {9, 0.99f, 9}, {9, 0.99f, -9}});
        scene = b.build();
    }
};

// Of the first patch, which is of the floor.
FormFactorCost cost_of_row(const Scene& tiles, FormFactorMethod method, int resolution) {
    const Mesh mesh = make_mesh(tiles, {20});
    const World world(mesh);
    const PatchScene scene = make_patch_scene(mesh, world);
    std::vector<float> row(scene.size());
    FormFactorCost cost;
    FormFactorSettings settings = row_settings(method, 0, 1);
    settings.samples = 1, settings.resolution = resolution;
    form_factor_row(scene, 0, method, settings, row, cost);
    return cost;
}

} // namespace

TEST(MissedPatches, AreCountedWhereItemBuffersAreTooCoarse) {
    const Tiles seen(false), hidden(true);
    constexpr std::uint64_t tiles = 2 * 24 * 24;
    for (const FormFactorMethod method : {FormFactorMethod::hemicube, FormFactorMethod::hemisphere}) {
        // At 8 x 8 about a hundred pixels for a thousand triangles of 20 mm: nearly all are missed, all are too small.
        const FormFactorCost coarse = cost_of_row(seen.scene, method, 8), fine = cost_of_row(seen.scene, method, 1024);
        EXPECT_EQ(coarse.pairs, tiles);
        EXPECT_EQ(coarse.warned, tiles);
        EXPECT_GT(coarse.missed, tiles * 9 / 10);
        EXPECT_EQ(fine.pairs, tiles);
        EXPECT_EQ(fine.missed, 0u);
        EXPECT_LT(fine.warned, tiles / 10) << "a triangle of 20 mm at 1 m is 7 pixels wide";
        // What nobody sees is not missed.
        EXPECT_EQ(cost_of_row(hidden.scene, method, 8).missed, 0u);
    }
}
