#include "host/storage/recording/recording.hpp"

#include "host/base/json/json.hpp"
#include "host/storage/recording/build_id.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/image.hpp"
#include "host/storage/recording/serialise.hpp"

namespace liana::recording {

namespace {

constexpr const char* kEncoding = "liana-fields-2";
constexpr const char* kImageEncoding = "liana-snapshot-1";

// Lists the fields of one recorded structure, a line each: path and width in bytes.
class FieldLister {
 public:
  explicit FieldLister(const RecordedCounts& counts) : counts_(counts) {}
  template <Scalar T>
  void operator()(const char* name, const T& value) {
    text_ += path_ + name + " " + std::to_string(sizeof(bits_of(value))) + "\n";
  }
  template <class T, std::size_t N>
  void operator()(const char* name, const std::array<T, N>& values) {
    first(name, values, N);
  }
  template <class T, std::size_t N>
  void first(const char* name, const std::array<T, N>& values, std::size_t count) {
    (*this)((std::string(name) + "[" + std::to_string(count) + "]").c_str(), values[0]);
  }
  const RecordedCounts& counts() const { return counts_; }
  template <class T>
  requires std::is_class_v<T>
  void operator()(const char* name, const T& value) {
    const std::size_t length = path_.size();
    path_ += std::string(name) + ".";
    visit(*this, value);
    path_.resize(length);
  }
  const std::string& text() const { return text_; }

 private:
  RecordedCounts counts_;
  std::string path_, text_;
};

template <class Arm>
std::string inputs_schema(const RecordedCounts& counts) {
  FieldLister lister(counts);
  const Inputs<Arm> inputs;
  visit(lister, inputs);
  lister("telecommand_present", std::uint8_t{0});  // 0: the message ends here
  lister("telecommand", TelecommandFields<typename Arm::Setpoint>{});
  return lister.text();
}

template <class Arm>
std::string outputs_schema(const RecordedCounts& counts) {
  FieldLister lister(counts);
  const Outputs<Arm> outputs;
  visit(lister, outputs);
  return lister.text();
}

std::uint64_t tick_of(std::string_view inputs) {
  std::uint64_t tick = 0;
  Reader reader(inputs);
  reader("tick", tick);
  return tick;
}

}  // namespace

Recording::Recording(const std::string& directory, const RecordingInfo& info)
    : ticks_file_(directory + "/" + kRecordingFile, "liana " + build_id()),
      images_file_(directory + "/" + kImagesFile, "liana " + build_id()),
      period_s_(info.period_s),
      is_serial_(is_of_serial_arm(info.robot_json)) {
  constexpr const char* kImageSchema = "next_tick 8, fresh 1, robot table, fields of the Controller";
  start_ = ticks_file_.add_channel({kStartTopic, kImageEncoding, kImageEncoding, kImageSchema});
  image_ = images_file_.add_channel({kImageTopic, kImageEncoding, kImageEncoding, kImageSchema});
  ticks_file_.add_metadata("run", {{"build_id", info.recorded_by.empty() ? build_id() : info.recorded_by},
                                   {"config_hash", info.config_hash},
                                   {"robot", info.robot_json},
                                   {"scene", info.scene_json},
                                   {"buses", info.buses_json},
                                   {"time_mode", info.time_mode},
                                   {"period_s", std::to_string(info.period_s)}});
}

void Recording::write(McapWriter& file, std::uint16_t channel, std::uint64_t tick, std::string_view data) {
  const auto time_ns = static_cast<std::uint64_t>(static_cast<double>(tick) * period_s_ * 1e9);
  file.write_message(channel, static_cast<std::uint32_t>(tick), time_ns, data);
}

// Their schemas say how many of each the robot has, which the first tick tells.
template <class Arm>
void Recording::add_tick_channels(const RecordedCounts& counts) {
  inputs_ = ticks_file_.add_channel({kInputsTopic, kEncoding, kEncoding, inputs_schema<Arm>(counts)});
  outputs_ = ticks_file_.add_channel({kOutputsTopic, kEncoding, kEncoding, outputs_schema<Arm>(counts)});
}

template <class Arm>
void Recording::take_image(std::string_view data) {
  const auto image = parse_image<Arm>(data);
  McapWriter& file = image.fresh ? ticks_file_ : images_file_;
  write(file, image.fresh ? start_ : image_, image.next_tick, data);
  file.flush();
}

void Recording::take(const TickParts& parts) {
  const std::uint64_t tick = tick_of(parts.inputs);
  if (inputs_ == 0) {
    is_serial_ ? add_tick_channels<serial::SerialArm>(parts.counts) : add_tick_channels<cable::CableArm>(parts.counts);
  }
  write(ticks_file_, inputs_, tick, parts.inputs);
  write(ticks_file_, outputs_, tick, parts.outputs);
  dropped_ = parts.dropped;
  ++ticks_;
}

void Recording::take(std::string_view packet) {
  if (tick_packet_kind(packet) == TickPacket::kTick) return take(split_tick_packet(packet));
  const std::string_view image = packet.substr(1);
  is_serial_ ? take_image<serial::SerialArm>(image) : take_image<cable::CableArm>(image);
}

void Recording::finish() {
  ticks_file_.add_metadata("end", {{"ticks", std::to_string(ticks_)}, {"dropped", std::to_string(dropped_)}});
  ticks_file_.finish();
  images_file_.finish();
}

bool is_of_serial_arm(const std::string& robot_json) { return Json::parse(robot_json).value("kind", "") == "serial"; }

}  // namespace liana::recording
