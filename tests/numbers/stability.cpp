// The stability map of force feedback (stability_map.hpp): prints every cell as JSON. --count N: cells of each law and
// layer, spread over the map (192 are all); --json; --svg FILE draws all. Ends with exit code 1 where a cell with the
// whole layer is unstable.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "tests/numbers/options.hpp"
#include "tests/numbers/stability_map.hpp"
#include "tests/numbers/stability_picture.hpp"

namespace liana::numbers {
namespace {

constexpr std::uint64_t kFirstSeed = 1000;

std::vector<Judged> whole_map(std::size_t count) {
  const auto all = cells();
  std::vector<Judged> map;
  for (const auto law : {haptics::Law::kClaim, haptics::Law::kAbstract, haptics::Law::kAligned}) {
    for (const auto layer : {Layer::kNone, Layer::kTank, Layer::kTankAndDamping}) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place = i * all.size() / count;
        map.push_back({law, layer, all[place], judge(law, layer, all[place], kFirstSeed + place)});
      }
    }
  }
  return map;
}

void print(const Judged& judged, bool last) {
  const Cell& cell = judged.cell;
  const Verdict& v = judged.verdict;
  const auto word = [](bool yes) { return yes ? "true" : "false"; };
  std::printf(
      "{\"law\": \"%s\", \"layer\": \"%s\", \"hand_kg\": %g, \"hand_N_m\": %g, \"wall_N_m\": %g, \"delay_s\": %g, "
      "\"moving\": %s, \"active\": %s, \"speed_m_s\": %.5f, \"least_J\": %.5f, \"drift_m\": %.5f, \"drag_N\": %.3f, "
      "\"held_N\": %.3f, "
      "\"taken_pressing_N\": %.3f, \"taken_withdrawing_N\": %.3f}%s\n",
      std::string(haptics::name_of(judged.law)).c_str(),
      std::string(kLayerNames[static_cast<std::size_t>(judged.layer)]).c_str(), cell.hand_kg, cell.hand_N_m,
      cell.wall_N_m, cell.delay_s, word(v.moving()), word(v.active()), v.speed_m_s, v.least_J, v.drift_m, v.drag_N,
      v.held_N, v.taken_pressing_N, v.taken_withdrawing_N, last ? "" : ",");
}

// Takes `--svg FILE` out of the words; empty: not there.
std::string take_svg(int& argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--svg") != 0) continue;
    const std::string file = argv[i + 1];
    std::copy(argv + i + 2, argv + argc, argv + i);
    argc -= 2;
    return file;
  }
  return {};
}

bool write(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out) std::fprintf(stderr, "stability: --svg: %s cannot be written\n", file.c_str());
  return bool(out);
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana::numbers;
  const std::string svg = take_svg(argc, argv);
  const auto options = parse_options(argc, argv, 192);
  const auto map = whole_map(std::min<std::size_t>(192, static_cast<std::size_t>(options.count)));
  std::printf("[\n");
  for (const Judged& judged : map) print(judged, &judged == &map.back());
  std::printf("]\n");
  if (!svg.empty() && !write(svg, stability_picture(map))) return 2;
  return std::any_of(map.begin(), map.end(), [](const Judged& judged) {
    return judged.layer == Layer::kTankAndDamping && judged.verdict.unstable();
  });
}
