// Where the source lies, for tests that read the project's own files.
#pragma once

#include <filesystem>

namespace lueur::test {

std::filesystem::path source_folder();

} // namespace lueur::test
