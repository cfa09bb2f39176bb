// One visitor of several functions, for std::visit.
#pragma once

namespace lueur {

template <typename... Functions>
struct Overload : Functions... {
    using Functions::operator()...;
};

} // namespace lueur
