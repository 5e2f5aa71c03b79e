#include "cli/completion/completion.h"
#include "core/text.h"

namespace clusterbench::cli {
namespace {

using Kind = Values::Kind;

// In a specification of _arguments, brackets and colons have a meaning.
std::string zsh_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

// The part after the message of a specification: "(a b)", "_files", or no suggestion. A leading space keeps zsh from
// adding arguments of its own.
std::string value_action(const Values& values) {
  switch (values.kind) {
    case Kind::files:
      return "_files";
    case Kind::words:
      return "(" + joined(values.words, " ") + ")";
    case Kind::named_files:
      return " _clusterbench_named_files " + joined(values.words, " ");
    case Kind::free:
      break;
  }
  return " ";
}

std::string option_lines(const OptionNode& option) {
  std::string lines;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    if (option.is_value_optional && !is_long) continue;
    std::string line = option.is_repeatable ? "*" : "(" + joined(option.names, " ") + ")";
    line += name;
    if (option.needs_value && is_long) line += option.is_value_optional ? "=-" : "=";
    line += "[" + zsh_escaped(first_sentence(option.description)) + "]";
    if (option.needs_value) {
      line += option.is_value_optional ? "::" : ":";
      line += placeholder(option) + ":" + value_action(option.values);
    }
    lines += " \\\n    " + shell_word(line);
  }
  return lines;
}

std::string argument_line(const ArgumentNode& argument, std::size_t position) {
  const std::string where = argument.is_repeatable ? "*" : std::to_string(position);
  return " \\\n    " + shell_word(where + ":" + zsh_escaped(argument.name) + ":" + value_action(argument.values));
}

std::string function_name(const CommandNode& command) {
  std::string name = "_clusterbench";
  if (command.path.empty()) return name;
  for (const char c : "_command " + command.path) name += c == ' ' || c == '-' ? '_' : c;
  return name;
}

std::string subcommands(const CommandNode& command) {
  std::string list, cases;
  for (const CommandNode& below : command.commands) {
    list += "        " + shell_word(zsh_escaped(below.name) + ":" + first_sentence(below.description)) + "\n";
    cases += "        " + below.name + ") " + function_name(below) + " ;;\n";
  }
  return "  case $state in\n    command)\n      local -a commands=(\n" + list +
         "      )\n      _describe -t commands command commands ;;\n    argument)\n      case $words[1] in\n" + cases +
         "      esac ;;\n  esac\n";
}

std::string function(const CommandNode& command) {
  std::string text = function_name(command) + "() {\n";
  const bool has_commands = !command.commands.empty();
  if (has_commands) text += "  local curcontext=$curcontext context state state_descr line\n  typeset -A opt_args\n";
  text += has_commands ? "  _arguments -C -S" : "  _arguments -S";
  for (const OptionNode& option : command.options) text += option_lines(option);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) text += argument_line(command.arguments[i], i + 1);
  if (has_commands) text += " \\\n    '1: :->command' \\\n    '*:: :->argument'";
  return text + "\n" + (has_commands ? subcommands(command) : "") + "}\n\n";
}

constexpr const char* k_start = R"(#compdef clusterbench
# zsh completion of clusterbench, written by `clusterbench completion zsh`

# "FORMAT=FILE"
_clusterbench_named_files() {
  if compset -P '*='; then
    _files
  else
    compadd -S = -- "$@"
  fi
}

)";

constexpr const char* k_zsh_end = R"(if [[ $funcstack[1] == _clusterbench ]]; then
  _clusterbench "$@"
else
  compdef _clusterbench clusterbench
fi
)";

}  // namespace

std::string zsh_completion(const CommandNode& root) {
  std::string text = k_start;
  for (const CommandNode* command : all_commands(root)) text += function(*command);
  return text + k_zsh_end;
}

}  // namespace clusterbench::cli
