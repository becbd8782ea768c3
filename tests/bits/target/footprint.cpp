// The least program with the core of one kind of arm in it (BITS_ARM: its namespace), for its size: one Controller,
// Inputs and Outputs in memory, nothing else. It is never run.
#include "firmware_like/cable_controller.hpp"
#include "firmware_like/serial_controller.hpp"

namespace {
liana::BITS_ARM::RobotParams table;
liana::BITS_ARM::Controller controller(table);
liana::BITS_ARM::Inputs inputs;
liana::BITS_ARM::Outputs outputs;
}  // namespace

int main() {
  for (;;) {
    asm volatile("" : "+m"(inputs), "+m"(outputs));  // something else writes the Inputs and reads the Outputs
    outputs = controller.tick(inputs);
  }
}
