#include "cli/completion/completion.h"
#include "core/text.h"

namespace clusterbench::cli {
namespace {

using Kind = Values::Kind;

// bash splits words at equals signs (COMP_WORDBREAKS): the script joins them again, and removes the part before the
// sign from its answers.
constexpr const char* k_functions = R"(# bash completion of clusterbench, written by `clusterbench completion bash`

_clusterbench_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

_clusterbench_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$cur")
}

# "FORMAT=FILE"
_clusterbench_named_files() {
  if [[ $cur == *=* ]]; then
    [[ $COMP_WORDBREAKS == *=* ]] || keep=${cur%%=*}=
    cur=${cur#*=}
    _clusterbench_files
  else
    compopt -o nospace 2>/dev/null
    _clusterbench_words "$1"
  fi
}

_clusterbench_complete() {
  local words=("${COMP_WORDS[0]}") joins=0 at word
  for ((at = 1; at <= COMP_CWORD; at++)); do
    word=${COMP_WORDS[at]}
    if [[ $word == = || $joins == 1 ]]; then
      words[-1]+=$word
      [[ $word == = ]] && joins=1 || joins=0
    else
      words+=("$word")
    fi
  done
  cur=${words[-1]}
  local path='' option=${words[-2]} has_equals=0
  for word in "${words[@]:1:${#words[@]}-2}"; do
    case "$path $word" in
)";

constexpr const char* k_after_paths = R"( path="$path $word" ;;
    esac
  done
  if [[ $cur == --*=* ]]; then
    option=${cur%%=*} has_equals=1
    [[ $COMP_WORDBREAKS == *=* ]] || keep=$option=
    cur=${cur#*=}
  fi
  case "$path $option" in
)";

constexpr const char* k_after_options = R"(  esac
  [[ $has_equals == 0 ]] || return
  local flags='' arguments='' takes_files=0
  case "$path" in
)";

constexpr const char* k_bash_end = R"(  esac
  if [[ $cur == -* ]]; then
    _clusterbench_words "$flags"
  elif [[ $takes_files == 1 ]]; then
    _clusterbench_files
  else
    _clusterbench_words "$arguments"
  fi
}

_clusterbench() {
  local cur keep=''
  COMPREPLY=()
  _clusterbench_complete
  COMPREPLY=("${COMPREPLY[@]/#/$keep}")
}

complete -F _clusterbench clusterbench
)";

std::string action(const Values& values) {
  const std::string words = joined(values.words, " ");
  switch (values.kind) {
    case Kind::files:
      return "_clusterbench_files; return";
    case Kind::words:
      return "_clusterbench_words " + shell_word(words) + "; return";
    case Kind::named_files:
      return "_clusterbench_named_files " + shell_word(joined(values.words, "= ") + "=") + "; return";
    case Kind::free:
      break;
  }
  return "return";
}

// " run" for the command `run`, " scene generate" for one below another.
std::string key(const CommandNode& command) {
  return command.path.empty() ? "" : " " + command.path;
}

std::string option_line(const CommandNode& command, const OptionNode& option) {
  std::string patterns;
  for (const std::string& name : option.names)
    patterns += (patterns.empty() ? "" : " | ") + shell_word(key(command) + " " + name);
  const std::string act = action(option.values);
  return "    " + patterns + ") " +
         (option.is_value_optional ? "if [[ $has_equals == 1 ]]; then " + act + "; fi" : act) + " ;;\n";
}

std::string command_line(const CommandNode& command) {
  std::vector<std::string> flags, arguments;
  bool offers_files = false;
  for (const OptionNode& option : command.options) flags.insert(flags.end(), option.names.begin(), option.names.end());
  for (const CommandNode& below : command.commands) arguments.push_back(below.name);
  for (const ArgumentNode& argument : command.arguments) {
    offers_files |= argument.values.kind == Kind::files;
    arguments.insert(arguments.end(), argument.values.words.begin(), argument.values.words.end());
  }
  return "    " + shell_word(key(command)) + ") flags=" + shell_word(joined(flags, " ")) +
         " arguments=" + shell_word(joined(arguments, " ")) + " takes_files=" + (offers_files ? "1" : "0") + " ;;\n";
}

}  // namespace

std::string bash_completion(const CommandNode& root) {
  std::string paths, options, commands;
  for (const CommandNode* command : all_commands(root)) {
    if (!command->path.empty()) paths += (paths.empty() ? "      " : " | ") + shell_word(key(*command));
    for (const OptionNode& option : command->options)
      if (option.needs_value) options += option_line(*command, option);
    commands += command_line(*command);
  }
  return k_functions + paths + ")" + k_after_paths + options + k_after_options + commands + k_bash_end;
}

}  // namespace clusterbench::cli
