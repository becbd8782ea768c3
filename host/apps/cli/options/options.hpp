// The options of all commands, a file for each group of them.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace liana::cli {

// What the chosen command does; returns the exit code.
using Action = std::function<int()>;

// A command and what its options are written to; both live as long as the line they belong to.
template <class Options>
struct Declared {
  CLI::App& sub;
  Options& options;
};

// Adds a command whose options have their defaults; when it is chosen, `command` with them becomes the action. Its line
// in help is in tasks.cpp.
template <class Options>
Declared<Options> add(CLI::App& app, Action& action, const char* name, int (*command)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(name);
  sub->callback([&action, options, command] { action = [options, command] { return command(*options); }; });
  return {*sub, *options};
}

// A word before commands: `robot` of `robot export`.
CLI::App& add_group(CLI::App& app, const char* name);

// A number from `low` to `high`, both allowed; CLI::Range lets NaN through.
CLI::Validator within(double low, double high);

// Options that several commands have.
void add_robot(CLI::App& sub, std::string& robot);  // a table with a default
void add_json(CLI::App& sub, bool& json);
void add_seed(CLI::App& sub, std::uint64_t& seed, const std::string& what);  // `what` it is of
void add_physics(CLI::App& sub, std::string& physics, const std::string& of_what = "");
void add_cross_wired(CLI::App& sub, std::string& drives);
void add_control_points(CLI::App& sub, std::vector<std::string>& targets);

void declare_geometry(CLI::App& app, Action& action);  // pose, ik, reach, plan, budget, sweep, verify
void declare_missions(CLI::App& app, Action& action);  // run, check, mission, ground
void declare_seeing(CLI::App& app, Action& action);    // console, view, commands, log, replay
void declare_arm(CLI::App& app, Action& action);       // status, estop, clear, calibrate, latency, faults
void declare_drive(CLI::App& app, Action& action);     // drive scan, read, write, watch, check, jog
void declare_device(CLI::App& app, Action& action);    // device list, watch
void declare_robot(CLI::App& app, Action& action);     // robot export, check, new

// All of these, what stands before the command, and what help says of each.
void declare_all(CLI::App& app, Action& action);

}  // namespace liana::cli
