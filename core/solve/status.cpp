#include "core/solve/status.h"

namespace lueur {

std::string to_string(SolveStage stage) {
    switch (stage) {
    case SolveStage::idle:
        return "idle";
    case SolveStage::meshing:
        return "meshing";
    case SolveStage::direct:
        return "direct light";
    case SolveStage::gathering_rays:
        return "gathering rays";
    case SolveStage::form_factors:
        return "form factors";
    case SolveStage::solving:
        return "solving";
    case SolveStage::settled:
        return "settled";
    case SolveStage::failed:
        return "failed";
    }
    return {};
}

} // namespace lueur
