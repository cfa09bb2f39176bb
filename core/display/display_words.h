// The settings of the display as words, for metadata: key -> value, and back without loss.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/display/display_settings.h"

namespace lueur {

std::map<std::string, std::string> words_from_display(const DisplaySettings& settings);

// Changes what is named; keys that are no setting of the display are left alone. The error is the first value that
// cannot be read, in one line. Ranges are `check`'s business.
std::optional<std::string> read_display_words(DisplaySettings& settings,
                                              const std::map<std::string, std::string>& words);

} // namespace lueur
