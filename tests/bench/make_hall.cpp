// Writes the hall that growth is measured on (tests/support/hall.h):
//
//     make_hall FOLDER TRIANGLES...
//
// as FOLDER/hall_TRIANGLES.toml and .glb.
#include <exception>

#include "tests/bench/program.h"
#include "tests/support/hall.h"

using namespace lueur;

int main(int argc, char** argv) {
    CLI::App program{"Writes the hall that growth is measured on.", "make_hall"};
    std::string folder;
    std::vector<std::size_t> sizes;
    program.add_option("FOLDER", folder)->required();
    program.add_option("TRIANGLES", sizes)->required()->check(CLI::PositiveNumber);
    if (const auto status = bench::parse(program, argc, argv)) return *status;
    try {
        for (const std::size_t triangles : sizes) {
            const std::string name = fmt::format("hall_{}", triangles);
            const test::HallSize size = test::write_hall(folder, name, {.triangles = triangles});
            fmt::print("{}: {} triangles, {} objects, {} luminaires\n", name, size.triangles, size.objects,
                       size.luminaires);
        }
    } catch (const std::exception& exception) {
        fmt::print(stderr, "make_hall: {}\n", exception.what());
        return 1;
    }
    return 0;
}
