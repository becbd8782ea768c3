// The least program with the core in it, for its size: one Controller, Inputs and Outputs in memory, nothing else. It
// is never run.
#include "firmware_like/cable_controller.hpp"

namespace {
liana::cable::RobotTable table;
liana::cable::Controller controller(table);
liana::cable::Inputs inputs;
liana::cable::Outputs outputs;
}  // namespace

int main() {
  for (;;) {
    asm volatile("" : "+m"(inputs), "+m"(outputs));  // something else writes the Inputs and reads the Outputs
    outputs = controller.tick(inputs);
  }
}
