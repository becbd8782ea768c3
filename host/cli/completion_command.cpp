#include <cstdio>

#include "host/cli/commands.hpp"
#include "host/cli/errors.hpp"

namespace liana {
namespace {

constexpr const char* kBash = R"bash(_liana() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=""
  case $before in
    --time) words="fast paced real" ;;
    --physics) words="nominal ideal worn" ;;
    --bus | --buses) words="embedded embedded_500 embedded_single vcan" ;;
    --rate) words="250 500" ;;
    run) words="slit_crossing" ;;
    robot) words="export" ;;
    completion) words="bash" ;;
    --record | --json | --svg | --path | --api | --out | replay) COMPREPLY=($(compgen -f -- "$word")); return ;;
  esac
  if [[ $COMP_CWORD == 1 ]]; then
    words="run pose ik reach plan status estop clear faults latency replay robot doctor completion help"
  elif [[ -z $words ]]; then
    case ${COMP_WORDS[1]} in
      run) words="--robot --scene --bus --time --physics --record --json --seed" ;;
      latency) words="--rate --seconds --buses --arm --json" ;;
      pose) words="--robot --theta-deg --scene --json" ;;
      ik) words="--robot --from-deg --tip --hold --control-point --json" ;;
      reach) words="--robot --scene --hold --from-deg --to-deg --path --node --samples --seed --svg --json" ;;
      plan) words="--robot --scene --from-deg --to-deg --tip --hold --planar --control-point --follow --waypoints --margin --max-step-deg --iterations --out --json" ;;
      faults) words="--robot --markdown --json" ;;
      status | estop | clear) words="--api --json" ;;
      robot) words="--robot --out --json" ;;
      replay | doctor) words="--json" ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -F _liana liana
)bash";

}  // namespace

int completion_command(const std::string& shell) {
  if (shell != "bash") throw BadInput("completion: '" + shell + "': allowed: bash");
  std::fputs(kBash, stdout);
  return kExitOk;
}

}  // namespace liana
