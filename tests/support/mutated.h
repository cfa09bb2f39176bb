// Damaged text, for readers that must end with a value or with errors whatever bytes change.
#pragma once

#include <random>
#include <string>

namespace lueur::test {

// One or two changes: bytes replaced, taken out, put in or repeated. `likely`: characters that mean something to the
// reader. The same for the same numbers.
inline std::string mutated(std::string text, const std::string& likely, std::mt19937& random) {
    for (int changes = 1 + static_cast<int>(random() % 2); changes > 0 && !text.empty(); --changes) {
        const std::size_t place = random() % text.size();
        switch (random() % 5) {
        case 0:
            text[place] = static_cast<char>(random());
            break;
        case 1:
            text.erase(place, 1 + random() % 20);
            break;
        case 2:
            text.insert(place, 1, likely[random() % likely.size()]);
            break;
        case 3:
            text[place] = likely[random() % likely.size()];
            break;
        case 4:
            text.insert(place, text.substr(random() % text.size(), random() % 40));
            break;
        }
    }
    return text;
}

} // namespace lueur::test
