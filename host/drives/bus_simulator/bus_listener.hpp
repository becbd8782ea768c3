// Lets the participants of the embedded bus in.
#pragma once

#include <string>
#include <vector>

#include "host/drives/bus_simulator/participant.hpp"

namespace liana::bus_simulator {

// Asks the bus process to end soon; for signal handlers.
void request_bus_stop();
bool bus_stop_requested();

// Listens on `socket_path` (a left-over socket file is replaced) until one controller and one plant have said HELLO;
// each gets `welcome` at once, others get ERROR. Returns them, the controller first; fewer when a stop was requested.
// Throws std::runtime_error when it cannot listen.
std::vector<Participant> admit_participants(const std::string& socket_path, const wire::Welcome& welcome);

}  // namespace liana::bus_simulator
