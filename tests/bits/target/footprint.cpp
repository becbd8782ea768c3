// The least program with the core in it, for its size: one Controller, Inputs and Outputs in memory, nothing else. It
// is never run.
#include "firmware_like/controller.hpp"

namespace {
liana::RobotTable table;
liana::Controller controller(table);
liana::Inputs inputs;
liana::Outputs outputs;
}  // namespace

int main() {
  for (;;) {
    asm volatile("" : "+m"(inputs), "+m"(outputs));  // something else writes the Inputs and reads the Outputs
    outputs = controller.tick(inputs);
  }
}
