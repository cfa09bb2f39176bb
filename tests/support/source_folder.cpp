#include "tests/support/source_folder.h"

namespace lueur::test {

std::filesystem::path source_folder() {
    return LUEUR_SOURCE_DIR;
}

} // namespace lueur::test
