#include "firmware_like/serial_controller.hpp"

namespace liana {

template class Controller<serial::SerialArm>;

}  // namespace liana
