// What a system of processes is asked for: the options of `liana run`, which other verbs fill in part.
#pragma once

#include <cstdint>
#include <string>

#include "host/apps/launcher/operator_choice.hpp"

namespace liana::launcher {

struct RunOptions {
  std::string mission;        // empty: none (liana latency, liana console)
  std::string robot;          // empty: that of the plan or the mission, else zhu2022
  std::string scene;          // empty: that of the plan or the mission, else panel_slit, for a serial arm none
  std::string bus;            // empty: that of the mission with its own robot, else as buses_of (tables.hpp) has it
  std::string time;           // empty: fast, or real on SocketCAN
  bool simulated_arm = true;  // false: real drives are on the buses, there is no bench
  std::string physics = "nominal";
  std::string true_physics;  // empty: as physics; else what the simulated arm really has, and nobody declares
  std::string arm = "full";  // or light, which needs physics ideal
  std::string start_pose;    // of the simulated arm: empty, a named pose, or angles (start_pose.hpp)
  std::string fixture;       // empty: it begins near its start pose; a named pose: the simulated arm lies exactly there
  std::string in_pose;       // empty: nobody knows; a named pose: lianad enables only an arm that lies there, and the
                             // simulated one does
  std::string cross_wired;   // empty, or two drives whose cables are exchanged, e.g. 4,5
  std::string faults;        // empty, or the bench's fault list: a file (docs/how-to/run-hil.md)
  std::string fault;         // empty, or the name of a fault list of the mission's own (mission_faults.hpp)
  std::string scene_offset;  // empty, or MM,DEG: the simulated scene is so far from where the table has it
  double gravity_share = 0.0;  // what counterweights leave of the simulated arm's weight, 0 to 1
  double linkage_error = 0.0;  // share by which the simulated joints of a segment bend unevenly at most, 0 to 0.5
  std::string calibration;     // empty: as the robot table says
  std::string record_dir;      // empty: nothing is kept
  std::string report_file;     // empty: a summary on standard output; "-": JSON on standard output
  bool has_console = false;    // liana-gateway runs beside it and its address is told
  bool is_session = false;     // a person steers it, live: recorded as a mission is, without logs of the buses
  bool is_practice = false;    // the simulated arm takes faults by a socket
  bool is_lean = false;        // no archive, no traffic of the buses, nothing that lasts after a success
  bool is_dry_run = false;     // liana check: no logs of the buses, quicker physics, what verification took
  OperatorChoice people;       // who steers a mission
  std::uint64_t seed = 1;
};

}  // namespace liana::launcher
