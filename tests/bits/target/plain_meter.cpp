// Targets on the host count nothing: `./dev benchmark` does.
#include "tests/bits/target/meter.hpp"

namespace liana::bits {

template <class Arm>
Outputs<Arm> metered_tick(Controller<Arm>& controller, const Inputs<Arm>& inputs) noexcept {
  return controller.tick(inputs);
}

template Outputs<cable::CableArm> metered_tick(cable::Controller&, const cable::Inputs&) noexcept;
template Outputs<serial::SerialArm> metered_tick(serial::Controller&, const serial::Inputs&) noexcept;

bool close_meter() { return true; }

}  // namespace liana::bits
