#include <cstdio>

#include "host/cli/commands.hpp"
#include "host/system/errors.hpp"

namespace liana::cli {
namespace {

// Names of tables and missions are looked up when they are asked for. A value that may be a file, too, is completed as
// both.
constexpr const char* kBash = R"bash(_liana_names() {
  local file
  for file in "$_liana_lua/$1"/*.lua; do file=${file##*/}; echo "${file%.lua}"; done
}
_liana_names_or_files() {
  COMPREPLY=($(compgen -W "$(_liana_names "$1")" -- "$2") $(compgen -f -- "$2"))
}
_liana() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=""
  [[ $word == = ]] && word=""
  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}
  case $before in
    --robot | export) _liana_names_or_files robots "$word"; return ;;
    --scene) _liana_names_or_files scenes "$word"; return ;;
    --bus | --buses) _liana_names_or_files buses "$word"; return ;;
    run | check) _liana_names_or_files missions "$word"; return ;;
    --follow) COMPREPLY=($(compgen -W "slit" -- "$word") $(compgen -f -- "$word")); return ;;
    --time) words="fast paced real" ;;
    --physics | --true-physics) words="nominal ideal worn" ;;
    --rate) words="250 500" ;;
    robot) words="export" ;;
    log) words="list show export verify" ;;
    completion) words="bash" ;;
    --record | --calibration | --faults | --json | --svg | --path | --api | --out | --csv | --mcap | --candump | replay | commands) COMPREPLY=($(compgen -f -- "$word")); return ;;
  esac
  if [[ $COMP_CWORD == 1 ]]; then
    words="run check calibrate pose ik reach plan verify status estop clear mission faults commands log latency replay robot doctor completion help"
  elif [[ -z $words ]]; then
    case ${COMP_WORDS[1]} in
      run) words="--robot --scene --bus --time --physics --calibration --in-pose --cross-wired --faults --true-physics --scene-offset --record --json --seed" ;;
      check) words="--robot --scene --bus --physics --calibration --faults --true-physics --scene-offset --json --seed" ;;
      calibrate) words="--robot --bus --poses --physics --cross-wired --friction --calibration --out --seed --json" ;;
      latency) words="--rate --seconds --buses --arm --json" ;;
      pose) words="--robot --theta-deg --scene --json" ;;
      ik) words="--robot --from-deg --tip --hold --control-point --json" ;;
      reach) words="--robot --scene --hold --from-deg --to-deg --path --node --samples --seed --svg --json" ;;
      plan) words="--robot --scene --from-deg --to-deg --tip --hold --planar --control-point --follow --waypoints --margin --max-step-deg --iterations --out --json" ;;
      verify) words="--robot --scene --from-deg --to-deg --duration --json" ;;
      faults) words="--robot --refusals --markdown --json" ;;
      mission) words="pause resume step confirm abort --api --json" ;;
      commands) words="--last --refused --margins --json" ;;
      log) words="--from --to --csv --mcap --candump --json" ;;
      status | estop | clear) words="--api --json" ;;
      robot) words="--robot --out --json" ;;
      replay | doctor) words="--json" ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -F _liana liana

_liana_mission() {
  local word=${COMP_WORDS[COMP_CWORD]} words=""
  if [[ $COMP_CWORD == 1 ]]; then
    words="eval run bindings"
  elif [[ ${COMP_WORDS[1]} == eval ]]; then
    case $COMP_CWORD/${COMP_WORDS[2]} in
      2/*) words="robot scene buses mission" ;;
      3/robot | 3/scene | 3/mission) _liana_names_or_files "${COMP_WORDS[2]}s" "$word"; return ;;
      3/buses) _liana_names_or_files buses "$word"; return ;;
      *) words="--robot --lua-dir" ;;
    esac
  elif [[ ${COMP_WORDS[1]} == run ]]; then
    words="--api --mission --lua-dir --report --lockstep --progress --json"
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -F _liana_mission liana-mission
)bash";

}  // namespace

int completion_command(const std::string& shell) {
  if (shell != "bash") throw system::BadInput("completion: '" + shell + "': allowed: bash");
  std::printf("_liana_lua='%s'\n", LIANA_LUA_DIR);
  std::fputs(kBash, stdout);
  return system::kExitOk;
}

}  // namespace liana::cli
