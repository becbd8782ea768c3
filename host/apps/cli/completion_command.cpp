#include <algorithm>
#include <array>
#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/known_values.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/install_paths/places.hpp"

namespace liana::cli {
namespace {

constexpr std::array<const char*, 4> kKinds{"robots", "scenes", "buses", "missions"};

// What is the same for both shells: names are looked up when they are asked for, by the program itself.
constexpr const char* kBash = R"bash(_liana_names() { "${_liana_program:-liana}" completion "$1" 2>/dev/null; }
_liana_names_or_files() {
  COMPREPLY=($(compgen -W "$(_liana_names "$1")" -- "$2") $(compgen -f -- "$2"))
}
_liana() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} path=liana i
  [[ $word == = ]] && word=""
  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ -z ${_liana_words["$path ${COMP_WORDS[i]}"]+is_there} ]] || path+=" ${COMP_WORDS[i]}"
  done
  [[ $before != --* ]] || ! _liana_values "$before" "$word" || return 0
  _liana_values "$path" "$word" || COMPREPLY=()
  COMPREPLY+=($(compgen -W "${_liana_words[$path]}" -- "$word"))
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

constexpr const char* kZsh = R"zsh(_liana() {
  local path_=liana before=${words[CURRENT-1]} i
  local -a list
  for ((i = 2; i < CURRENT; ++i)); do
    [[ -z ${_liana_commands[(re)$path_ ${words[i]}]} ]] || path_+=" ${words[i]}"
  done
  if [[ $before == --* ]] && _liana_values $before; then return; fi
  _liana_values $path_
  _liana_list $path_
  _describe 'liana' list
}
if [[ ${funcstack[1]} == _liana ]]; then _liana "$@"; else compdef _liana liana; fi
)zsh";

// In single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string names_of(const CommandHelp& command) {
  std::string names;
  for (const CommandHelp::Word& word : command.words) names += (names.empty() ? "" : " ") + word.name;
  return names;
}

void print_bash(const std::vector<CommandHelp>& commands) {
  std::printf("_liana_program=%s\n", quoted(install_paths::program_folder() + "/liana").c_str());
  std::puts("declare -gA _liana_words=(");
  for (const CommandHelp& command : commands)
    std::printf("  [%s]=%s\n", quoted(command.path).c_str(), quoted(names_of(command)).c_str());
  std::puts(")\n_liana_values() {\n  case $1 in");
  for (const KnownValues& values : known_values()) {
    const std::string names = *values.table == '\0' ? "" : std::string("$(_liana_names ") + values.table + ")";
    std::printf("    %s) COMPREPLY=($(compgen -W \"%s%s\" -- \"$2\")%s) ;;\n", quoted(values.after).c_str(),
                values.words, names.c_str(), values.files ? " $(compgen -f -- \"$2\")" : "");
  }
  std::puts("    *) return 1 ;;\n  esac\n  return 0\n}");
  std::fputs(kBash, stdout);
}

void print_zsh(const std::vector<CommandHelp>& commands) {
  std::printf("#compdef liana\n_liana_program=%s\n", quoted(install_paths::program_folder() + "/liana").c_str());
  std::puts("typeset -ga _liana_commands=(");
  for (const CommandHelp& command : commands) std::printf("  %s\n", quoted(command.path).c_str());
  std::puts(")\n_liana_list() {\n  case $1 in");
  for (const CommandHelp& command : commands) {
    std::printf("    (%s) list=(\n", quoted(command.path).c_str());
    for (const CommandHelp::Word& word : command.words)
      std::printf("      %s\n", quoted(word.name + ":" + word.about).c_str());
    std::puts("    ) ;;");
  }
  std::puts("  esac\n}\n_liana_values() {\n  case $1 in");
  for (const KnownValues& values : known_values()) {
    std::printf("    (%s)", quoted(values.after).c_str());
    if (*values.words != '\0') std::printf(" compadd -- %s;", values.words);
    if (*values.table != '\0')
      std::printf(" compadd -- $(${_liana_program:-liana} completion %s 2>/dev/null);", values.table);
    std::puts(values.files ? " _files ;;" : " ;;");
  }
  std::puts("    (*) return 1 ;;\n  esac\n  return 0\n}");
  std::fputs(kZsh, stdout);
}

}  // namespace

int completion_command(const std::string& what, const std::vector<CommandHelp>& commands) {
  if (what == "bash") {
    print_bash(commands);
  } else if (what == "zsh") {
    print_zsh(commands);
  } else if (std::find(kKinds.begin(), kKinds.end(), what) != kKinds.end()) {
    for (const std::string& name : table_names(what)) std::puts(name.c_str());
  } else {
    throw launcher::BadInput("completion: '" + what + "': allowed: bash, zsh, robots, scenes, buses, missions");
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
