// Options of the commands for one motor on a desk: drive scan, read, write, watch, check, jog.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"

namespace liana::cli {
namespace {

// A command of `drive`, with what says on which bus.
Declared<DriveOptions> add_on_bus(CLI::App& group, Action& action, const char* name,
                                  int (*command)(const DriveOptions&)) {
  auto [sub, drive] = add<DriveOptions>(group, action, name, command);
  sub.add_option("--can", drive.can, "SocketCAN interface, e.g. can0");
  sub.add_option("--bitrate", drive.bitrate, "of --can, bit/s; 10000 to 1000000")->capture_default_str();
  sub.add_option("--bus", drive.bus, "bus table in place of --can: a name under lua/buses or a file");
  sub.add_option("--bus-socket", drive.bus_socket, "socket of liana-bus, for a table with the embedded backend");
  sub.add_option("--time", drive.time, "of that liana-bus: fast, paced or real")->capture_default_str();
  add_json(sub, drive.json);
  return {sub, drive};
}

void add_scan(CLI::App& group, Action& action) {
  auto [sub, scan] = add_on_bus(group, action, "scan", drive_scan_command);
  sub.add_option("--first", scan.first, "least node id, 1 to 126")->capture_default_str();
  sub.add_option("--last", scan.last, "largest node id, to 126")->capture_default_str();
}

// A command for one drive.
Declared<DriveOptions> add_on_node(CLI::App& group, Action& action, const char* name,
                                   int (*command)(const DriveOptions&)) {
  auto [sub, drive] = add_on_bus(group, action, name, command);
  sub.add_option("--node", drive.node, "node id of the drive, 1 to 126; has to be said");
  return {sub, drive};
}

// A command for one object of a drive.
Declared<DriveOptions> add_on_object(CLI::App& group, Action& action, const char* name,
                                     int (*command)(const DriveOptions&)) {
  auto [sub, drive] = add_on_node(group, action, name, command);
  sub.add_option("object", drive.object, "index, or index:sub-index, e.g. 6064 or 1018:1")->required();
  return {sub, drive};
}

void add_write(CLI::App& group, Action& action) {
  auto [sub, write] = add_on_object(group, action, "write", drive_write_command);
  sub.add_option("value", write.value, "whole number that fits in --bits, decimal or as 0x1F")->required();
  sub.add_option("--bits", write.bits, "size of the object: 8, 16 or 32")->capture_default_str();
}

void add_watch(CLI::App& group, Action& action) {
  auto [sub, watch] = add_on_object(group, action, "watch", drive_watch_command);
  sub.add_option("--rate", watch.rate_hz, "how often, Hz; 0.1 to 20")->capture_default_str();
  sub.add_option("--seconds", watch.seconds, "how long; 0.1 to 86400")->capture_default_str();
}

// Which motor of which type.
void add_type(CLI::App& sub, DriveOptions& drive) {
  sub.add_option("--axis", drive.axis, "axis of a node with two motors: 1 or 2")->capture_default_str();
  sub.add_option("--type", drive.type, "drive type: a name under lua/drives or a file")->capture_default_str();
}

void add_drive_check(CLI::App& group, Action& action) {
  auto [sub, check] = add_on_node(group, action, "check", drive_check_command);
  add_type(sub, check);
  sub.add_flag("--try", check.tries,
               "carry the boot out, without torque, and put back what it wrote; not given: only read");
  sub.add_option("--robot", check.robot,
                 "in place of --node: all drives of a robot table, of the types that the bus table says")
      ->excludes(sub.get_option("--node"))
      ->excludes(sub.get_option("--axis"))
      ->excludes(sub.get_option("--type"));
}

void add_drive_type(CLI::App& group, Action& action) {
  auto [sub, type] = add<DriveOptions>(group, action, "type", drive_type_command);
  sub.add_option("--from-eds", type.eds, "electronic data sheet (EDS) or device configuration (DCF) of the maker")
      ->required();
  sub.add_option("--mode", type.mode, "csp (follows positions) or cst (follows torques)")->capture_default_str();
  sub.add_option("--out", type.out, "file for the table, e.g. drives/NAME.lua; - is standard output")
      ->capture_default_str();
  add_json(sub, type.json);
}

void add_jog(CLI::App& group, Action& action) {
  auto [sub, drive] = add_on_node(group, action, "jog", drive_jog_command);
  add_type(sub, drive);
  JogOptions& jog = drive.jog;
  sub.add_option("--by", jog.by, "how far, in --unit, of either sign; at most --most")->required();
  sub.add_option("--speed", jog.speed, "how fast, in --unit a second; at most --most-speed; not given: 0.05 turns/s");
  sub.add_option("--unit", jog.unit, "turns (of the motor), deg, or mm")->capture_default_str();
  sub.add_option("--mm-per-turn", jog.mm_per_turn, "for mm: the way of one turn of the motor");
  sub.add_option("--counts-per-turn", jog.counts_per_turn, "of the encoder, for drives without 608F");
  sub.add_option("--most", jog.most, "longest way, turns of the motor; to 100")->capture_default_str();
  sub.add_option("--most-speed", jog.max_speed, "fastest, turns/s; to 100")->capture_default_str();
  sub.add_option("--torque", jog.torque, "at most, permille of the rated torque (6072); 10 to 1000")
      ->capture_default_str();
  sub.add_flag("--yes", jog.yes, "move without asking for the word at the terminal");
  sub.add_flag("--clear", jog.clear, "let the drive forget a fault from before");
}

}  // namespace

void declare_drive(CLI::App& app, Action& action) {
  CLI::App& group = add_group(app, "drive");
  add_scan(group, action);
  add_on_object(group, action, "read", drive_read_command);
  add_write(group, action);
  add_watch(group, action);
  add_drive_check(group, action);
  add_drive_type(group, action);
  add_jog(group, action);
}

}  // namespace liana::cli
