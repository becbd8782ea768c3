#include "firmware_like/cable_controller.hpp"

namespace liana {

template class Controller<cable::CableArm>;

}  // namespace liana
