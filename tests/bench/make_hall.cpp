// Writes the hall that growth is measured on (tests/support/hall.h):
//
//     make_hall FOLDER TRIANGLES...
//
// as FOLDER/hall_TRIANGLES.toml and .glb.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include "tests/support/hall.h"

int main(int count, char** words) {
    if (count < 3) {
        fmt::print(stderr, "make_hall FOLDER TRIANGLES...\n");
        return 2;
    }
    try {
        for (int i = 2; i < count; ++i) {
            const auto triangles = std::strtoull(words[i], nullptr, 10);
            if (triangles == 0) {
                fmt::print(stderr, "make_hall: \"{}\" is not a number of triangles\n", words[i]);
                return 2;
            }
            const auto size =
                lueur::test::write_hall(words[1], fmt::format("hall_{}", words[i]), {.triangles = triangles});
            fmt::print("hall_{}: {} triangles, {} objects, {} luminaires\n", words[i], size.triangles, size.objects,
                       size.luminaires);
        }
    } catch (const std::exception& exception) {
        fmt::print(stderr, "make_hall: {}\n", exception.what());
        return 1;
    }
    return 0;
}
